// From an open port to a Falcon that answers: asks it, and loads its firmware.
#pragma once

#include <stop_token>
#include <string>

#include "device/falcon/attached.hpp"
#include "device/falcon/firmware_image.hpp"
#include "device/falcon/upload.hpp"

namespace dibhr::falcon {

enum class BroughtUp { answers, no_firmware, stopped };

/// Asks it; when nothing answers, loads `firmware`, if there is any. Throws UploadError or
/// UsbError.
[[nodiscard]] BroughtUp bring_up(FtdiPort& port, const FirmwareImage& firmware,
                                 const UploadOptions& options, const std::stop_token& stop);

/// What a person does when there is no firmware in `falcon` and no file to load.
[[nodiscard]] std::string firmware_is_wanted(const AttachedFalcon& falcon);

}  // namespace dibhr::falcon
