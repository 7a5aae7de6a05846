// A unit's place in the words of the system.
#include "tests/device/falcon/usb_place.hpp"

#include <iomanip>
#include <sstream>

namespace dibhr::test::falcon {

std::string UsbPlace::number() const {
    std::ostringstream text;
    text << std::setw(3) << std::setfill('0') << address;
    return text.str();
}

std::string UsbPlace::node() const {
    return "/dev/bus/usb/001/" + number();
}

}  // namespace dibhr::test::falcon
