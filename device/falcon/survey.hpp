// `dibhr devices`: brings up every attached Falcon as far as possible, and reports what is missing.
#pragma once

#include <string>
#include <vector>

#include "device/falcon/firmware_image.hpp"
#include "device/falcon/status.hpp"
#include "device/falcon/usb.hpp"

namespace dibhr::falcon {

/// Every USB device 0403:cb48 in the order of serials. Changes nothing. Throws DeviceError when the
/// USB devices cannot be listed.
[[nodiscard]] std::vector<AttachedFalcon> attached_falcons();

/// Opens the Falcon for a moment. Returns why that failed and what to do; empty: it succeeded.
[[nodiscard]] std::string why_it_cannot_be_opened(const AttachedFalcon& falcon);

struct SurveyedFalcon {
    AttachedFalcon attached{};
    Stage stage{Stage::cannot_open};
    std::string sentence{};  ///< the state and the next step, for the user

    [[nodiscard]] bool usable() const noexcept { return stage == Stage::ready; }
};

/// Opens and probes each Falcon, loads `firmware` when it has none, and reads its homed axes. Sends
/// no force. Takes at most some seconds per Falcon.
[[nodiscard]] std::vector<SurveyedFalcon> survey_falcons(const ConnectionOptions& options,
                                                         const FirmwareImage& firmware);

}  // namespace dibhr::falcon
