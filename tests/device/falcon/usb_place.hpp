// Where a simulated unit is plugged in.
#pragma once

#include <string>

namespace dibhr::test::falcon {

/// On bus 1.
struct UsbPlace {
    int port{1};
    int address{2};  ///< 2 .. 127; a new one at every plug, as the kernel does it

    [[nodiscard]] std::string number() const;  ///< "002"
    [[nodiscard]] std::string node() const;    ///< "/dev/bus/usb/001/002"
};

}  // namespace dibhr::test::falcon
