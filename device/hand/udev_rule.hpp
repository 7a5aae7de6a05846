// How a user gets the permission to open a device on the USB.
#pragma once

#include <string>

namespace dibhr {

/// How to install dibhr's udev rule of this name; where it is installed, how the user gets the
/// permission it gives. `device`: "the Falcon".
[[nodiscard]] std::string how_to_get_permission(const std::string& rule, const std::string& device);

}  // namespace dibhr
