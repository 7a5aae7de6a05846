// The window thread's end of the Falcon: its news, its buttons, its tuning, its firmware.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/hand_device.hpp"
#include "app/keys.hpp"
#include "app/viewer_state.hpp"
#include "device/falcon/options.hpp"

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
    std::array<std::uint32_t, kFalconButtons> presses_{};  // taken
    falcon::Stage stage_{falcon::Stage::looking};          // as told
    falcon::Stage shown_{falcon::Stage::looking};  // for which the panel was brought into sight
};

/// The touch parameters for the next tick: stiffness is held below what the Falcon can give, when
/// it touches or may begin to.
[[nodiscard]] TouchParameters touch_parameters(const ViewerState& state);

/// The limits for the next tick: a jump of the goal is one of the hand while the Falcon touches,
/// a hand millimetre being `scale` image millimetres.
[[nodiscard]] SafetyLimits safety_limits(const ViewerState& state);

/// No force until the window is in front again: people work in another one while a Falcon touches
/// or may begin to (fact sheet, section 11).
[[nodiscard]] bool waits_for_front(const ViewerState& state);

/// The hand moves under a held point: no force, and nothing is wrong.
[[nodiscard]] bool clutched(const ViewerState& state);

/// What to say over the relief of a Falcon that is there and does not touch, was lost, or waits for
/// the window; empty: nothing.
[[nodiscard]] std::string falcon_banner(const ViewerState& state);

/// The file is for a Falcon, not to be looked at.
[[nodiscard]] bool named_firmware(const std::filesystem::path& file);

}  // namespace dibhr
