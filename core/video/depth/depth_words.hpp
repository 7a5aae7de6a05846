// What words in the names of files, folders and arrays state about depth.
#pragma once

#include <string>
#include <string_view>

#include "core/video/depth/findings.hpp"

namespace dibhr {

/// What belongs to a recording, and is neither its colour nor its depth; the one list of it, for
/// the names of files, folders and arrays.
struct OtherContent {
    std::string_view what;    ///< for people: "a mask"
    std::string_view words;   ///< that name it, in small letters, each between blanks
    bool shows_depth{false};  ///< it may be felt, though something else is better
    bool shows_scene{false};  ///< a picture of it serves as the colour
    /// Numbers of another kind: a file is asked about, for "ski_slope" may well be depth.
    bool is_quantity{false};
};

/// What this word of a name, in small letters, says; null: nothing of that.
[[nodiscard]] const OtherContent* other_content_of(std::string_view word);

/// The rows of the table by the words of a name: disparity or inverse depth, height, the unit of a
/// distance, or that it is a distance at all. Empty: it says nothing. `bits`: of the levels; words
/// for distances count for more than 8. `whose`: for people, "its name".
[[nodiscard]] Findings findings_in_name(std::string_view name, int bits, std::string_view whose);

/// The row that it may be no depth (kNoDepth), where the last word of a name that tells what its
/// numbers are is that of another quantity; empty: it is not.
[[nodiscard]] Findings quantities_in_name(std::string_view name, std::string_view whose);

}  // namespace dibhr
