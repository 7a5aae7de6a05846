// What words in the names of files, folders and arrays state about depth.
#pragma once

#include <string>
#include <string_view>

#include "core/video/depth/findings.hpp"

namespace dibhr {

/// The rows of the table by the words of a name: disparity or inverse depth, height, the unit of a
/// distance, or that it is a distance at all. Empty: it says nothing. `bits`: of the levels; words
/// for distances count for more than 8. `whose`: for people, "its name".
[[nodiscard]] Findings findings_in_name(std::string_view name, int bits, std::string_view whose);

}  // namespace dibhr
