// The sentences about a Touch for the user.
#include "device/openhaptics/status.hpp"

#include <algorithm>

#include "device/openhaptics/hd.hpp"

namespace dibhr::openhaptics {

namespace {

std::string how_to_calibrate(const Status& status) {
    if ((status.style & kHdAuto) != 0)
        return "the Touch calibrates itself: move its stylus through the room that it reaches";
    if ((status.style & kHdInkwell) != 0)
        return "the Touch is not calibrated: put its stylus into the inkwell, and take it out "
               "again";
    if ((status.style & kHdEncoderReset) != 0)
        return "the Phantom is not calibrated: hold its arm in the reset position, as its manual "
               "shows it, and press the stylus's button";
    return "the Touch is not calibrated: calibrate it with 3D Systems' setup program";
}

}  // namespace

bool is_on_usb(const std::filesystem::path& devices) {
    const auto all = listed_usb_devices(devices);
    return std::any_of(all.begin(), all.end(), [](const UsbDevice& device) {
        const bool older = device.maker == "0301" && device.product == "2988";
        return device.maker == "2988" || older;
    });
}

std::string sentence_for(Stage stage, const Status& status) {
    switch (stage) {
        case Stage::opening:
            return "3D Systems' library looks for the Touch";
        case Stage::no_library:
            return "OpenHaptics is not installed: get OpenHaptics and the Touch Device Driver from "
                   "3D Systems, and start dibhr again";
        case Stage::broken_library:
        case Stage::cannot_open:
        case Stage::looking:
            return status.sentence;
        case Stage::starting:
            return "the Touch starts";
        case Stage::not_calibrated:
            return how_to_calibrate(status);
        case Stage::stands_still:
            return "the Touch's position stands still while its stylus moves: no force; put the "
                   "stylus into the inkwell, or plug the Touch in again";
        case Stage::not_understood:
            return "the Touch reports positions that it cannot have: no force; plug it in again, "
                   "and set it up with 3D Systems' setup program";
        case Stage::force_cut:
            return "the Touch has cut the force (" + status.last_error +
                   "): the force comes back; move more slowly, and let it rest if this happens "
                   "again";
        case Stage::refused:
            return "3D Systems' library refused a call of dibhr (" + status.last_error +
                   "): the force comes back; if this happens again, send us this line";
        case Stage::hot:
            return "the Touch's motors are too warm: no force; let it rest for some minutes";
        case Stage::silent:
            return "3D Systems' library stands still: no force; if this remains, plug the Touch in "
                   "again and start dibhr again";
        case Stage::ready:
            return status.warm
                       ? "ready to touch, but its motors are warm: the force is lower until "
                         "they cool; let it rest"
                       : "ready to touch";
    }
    return {};
}

}  // namespace dibhr::openhaptics
