// What a person does when the system refuses them the Falcon: the udev rule.
#pragma once

#include <string>

namespace dibhr::falcon {

/// The commands that install the rule; or, when the rule is in place, how to come under it.
[[nodiscard]] std::string how_to_get_permission();

}  // namespace dibhr::falcon
