// The window thread's end of the Inverse3: its news, its buttons, its tuning.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "app/panels/viewer_state.hpp"
#include "app/settings/keys.hpp"
#include "app/viewer/errand.hpp"
#include "app/viewer/stage_news.hpp"
#include "device/hand/pose_ages.hpp"
#include "device/hand_device.hpp"
#include "device/inverse3/inverse3_device.hpp"

namespace dibhr {

/// Does nothing when no Inverse3 is looked for.
class ViewerInverse3 {
  public:
    /// `hand` outlives it.
    ViewerInverse3(const HandDevice& hand, ViewerState& state);

    /// Once a picture: its status into `state`. A short notice when it begins to touch.
    [[nodiscard]] std::optional<std::string> take_news(ViewerState& state);

    /// What its buttons, pressed since the last call, ask for.
    [[nodiscard]] std::vector<Action> take_presses(const ViewerState& state);

    /// Whether hand_over() has something new.
    [[nodiscard]] bool tuning_changed(const ViewerState& state) const;

    /// The settings to the next tick; to be called after the haptic loop was told to ramp.
    void hand_over(const ViewerState& state);

  private:
    void take_ages(Inverse3News& news);

    inverse3::Inverse3Device* device_;
    inverse3::Tuning handed_{};
    TakenPresses presses_{};
    StageNews<inverse3::Stage> stages_{};
    PoseAges told_ages_{};  // of the second before this one
    std::chrono::steady_clock::time_point second_begin_{};
};

/// What the service keeps of the device: asked when one comes, a few times while nothing is
/// answered, away from the window's thread.
class ServiceSettings {
  public:
    explicit ServiceSettings(Errands& errands) : asking_(errands) {}

    /// Once a picture, after ViewerInverse3::take_news().
    void follow(ViewerState& state);

  private:
    std::string device_{};  ///< that was asked of last
    int tries_{0};
    std::chrono::steady_clock::time_point asked_{};
    Errand<std::vector<inverse3::KeptSetting>> asking_;
};

}  // namespace dibhr
