// What a condition of a study is felt with, as the command line would have said it.
#pragma once

#include "app/settings/command_options.hpp"
#include "core/study/protocol.hpp"

namespace dibhr {

/// Algorithm, numbers, material, bump, cleaning and finger; the media and the stability are
/// TouchValues' own words. Throws InputError for a material that is not there.
[[nodiscard]] TouchRequest request_of(const TouchValues& values);

}  // namespace dibhr
