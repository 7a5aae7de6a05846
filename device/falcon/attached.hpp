// One Falcon on the USB, as it can be named without opening it.
#pragma once

#include <string>

namespace dibhr::falcon {

struct AttachedFalcon {
    int bus{0};
    int address{0};
    std::string serial{};  ///< empty: could not be read

    bool operator==(const AttachedFalcon&) const = default;
};

/// "the Falcon SIM00001", or where it is plugged in when its serial is not known.
[[nodiscard]] std::string full_name_of(const AttachedFalcon& falcon);

}  // namespace dibhr::falcon
