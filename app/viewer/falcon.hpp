// The window thread's end of the Falcon: its news, its buttons, its tuning, its firmware.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/panels/viewer_state.hpp"
#include "app/settings/keys.hpp"
#include "app/viewer/stage_news.hpp"
#include "device/falcon/falcon_device.hpp"
#include "device/hand_device.hpp"

namespace dibhr {

/// Does nothing when the device is no Falcon.
class ViewerFalcon {
  public:
    /// `hand` outlives it.
    ViewerFalcon(const HandDevice& hand, ViewerState& state);

    /// Once a picture: its status into `state`. A short notice when it begins to touch.
    [[nodiscard]] std::optional<std::string> take_news(ViewerState& state);

    /// What its buttons, pressed since the last call, ask for.
    [[nodiscard]] std::vector<Action> take_presses(const ViewerState& state);

    /// Whether hand_over() has something new.
    [[nodiscard]] bool tuning_changed(const ViewerState& state) const;

    /// The settings to the next tick; to be called after the haptic loop was told to ramp.
    void hand_over(const ViewerState& state);

    /// Checks and keeps a firmware file, and gives it to the Falcon. What came of it, for a notice.
    /// Throws InputError.
    std::string use_firmware(const std::filesystem::path& file, ViewerState& state);

  private:
    falcon::FalconDevice* device_;
    falcon::Tuning handed_{};
    TakenPresses presses_{};
    StageNews<falcon::Stage> stages_{};
};

/// The file is for a Falcon, not to be looked at.
[[nodiscard]] bool named_firmware(const std::filesystem::path& file);

}  // namespace dibhr
