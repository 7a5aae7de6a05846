// `dibhr devices`: brings every attached Falcon as far as it will go, and says what is missing.
#pragma once

#include <string>
#include <vector>

#include "device/falcon/firmware_image.hpp"
#include "device/falcon/status.hpp"
#include "device/falcon/usb.hpp"

namespace dibhr::falcon {

/// Every USB device 0403:cb48 in the order of serials. Looks, and touches nothing. Throws
/// DeviceError when the USB cannot be looked at.
[[nodiscard]] std::vector<AttachedFalcon> attached_falcons();

/// Opens it for a moment: why that was refused, and what to do; empty when it was not.
[[nodiscard]] std::string why_it_cannot_be_opened(const AttachedFalcon& falcon);

struct SurveyedFalcon {
    AttachedFalcon attached{};
    Stage stage{Stage::cannot_open};
    std::string sentence{};  ///< its state and the next step

    [[nodiscard]] bool usable() const noexcept { return stage == Stage::ready; }
};

/// Opens each, asks it, loads `firmware` when it has none, and asks for its homed axes; never any
/// force. Takes at most some seconds a Falcon.
[[nodiscard]] std::vector<SurveyedFalcon> survey_falcons(const ConnectionOptions& options,
                                                         const FirmwareImage& firmware);

}  // namespace dibhr::falcon
