// From an open port to a Falcon that answers.
#include "device/falcon/bring_up.hpp"

#include "device/falcon/probe.hpp"

namespace dibhr::falcon {

BroughtUp bring_up(FtdiPort& port, const FirmwareImage& firmware, const UploadOptions& options,
                   const std::stop_token& stop) {
    if (answers(port, stop)) return BroughtUp::answers;
    if (stop.stop_requested()) return BroughtUp::stopped;
    if (firmware.empty()) return BroughtUp::no_firmware;
    return upload(port, firmware.bytes, options, stop) ? BroughtUp::answers : BroughtUp::stopped;
}

std::string firmware_is_wanted(const AttachedFalcon& falcon) {
    return full_name_of(falcon) +
           " does not answer: check its power adapter; if that is in, it has no firmware: " +
           where_firmware_comes_from();
}

}  // namespace dibhr::falcon
