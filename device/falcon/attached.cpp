// One Falcon on the USB, in words.
#include "device/falcon/attached.hpp"

#include <algorithm>

namespace dibhr::falcon {

std::string full_name_of(const AttachedFalcon& falcon) {
    if (!falcon.serial.empty()) return "the Falcon " + falcon.serial;
    return "the Falcon at USB bus " + std::to_string(falcon.bus) + " address " +
           std::to_string(falcon.address);
}

std::optional<AttachedFalcon> choose(std::span<const AttachedFalcon> attached,
                                     const std::string& serial) {
    const auto found = std::find_if(
        attached.begin(), attached.end(),
        [&](const AttachedFalcon& falcon) { return serial.empty() || falcon.serial == serial; });
    if (found == attached.end()) return std::nullopt;
    return *found;
}

std::string why_none(std::span<const AttachedFalcon> attached, const std::string& serial) {
    const std::string wanted = serial.empty() ? "no Falcon" : "the Falcon " + serial;
    const std::string verb = serial.empty() ? " is attached" : " is not attached";
    if (attached.empty()) return wanted + verb + ": plug in its USB cable and its power adapter";
    return wanted + verb + ", but " + serials_of(attached) +
           ": plug it in, or choose the serial of another";
}

std::string serials_of(std::span<const AttachedFalcon> attached) {
    std::string serials;
    for (const AttachedFalcon& falcon : attached) {
        serials += (serials.empty() ? "" : ", ") +
                   (falcon.serial.empty() ? "one without a readable serial" : falcon.serial);
    }
    return serials;
}

}  // namespace dibhr::falcon
