// One Falcon on the USB, in words.
#include "device/falcon/attached.hpp"

namespace dibhr::falcon {

std::string full_name_of(const AttachedFalcon& falcon) {
    if (!falcon.serial.empty()) return "the Falcon " + falcon.serial;
    return "the Falcon at USB bus " + std::to_string(falcon.bus) + " address " +
           std::to_string(falcon.address);
}

}  // namespace dibhr::falcon
