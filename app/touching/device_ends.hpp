// The window thread's ends of the force devices: what they tell, their buttons, their tuning.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/settings/grip_buttons.hpp"
#include "app/settings/settings.hpp"
#include "app/touching/device_state.hpp"
#include "app/touching/touch_state.hpp"
#include "device/falcon/status.hpp"
#include "device/hand/pose_ages.hpp"
#include "device/hand_device.hpp"
#include "device/inverse3/status.hpp"

namespace dibhr {

/// What it means for the window that a device goes from one stage to another; `Stage` is the
/// device's own, with `looking` and `ready` among them.
template <typename Stage>
class StageNews {
  public:
    /// Once a picture, with the stage it is at; `device`: what people call it. Says once for each
    /// need that the device needs its person. A short notice when it begins to touch, of which
    /// `was_ready` tells whether it did before.
    [[nodiscard]] std::optional<std::string> take(Stage stage, const std::string& device,
                                                  bool& was_ready, TouchState& touch) {
        if (std::exchange(stage_, stage) == stage) return {};
        // One that comes again and again must not keep moving the panels.
        if (needs_its_person(stage) && shown_ != stage) {
            touch.needs_person = true;
            shown_ = stage;
        }
        if (stage != Stage::ready) return {};
        shown_ = stage;
        return "The " + device + " touches" + (std::exchange(was_ready, true) ? " again" : "");
    }

  private:
    Stage stage_{Stage::looking};  // as told
    Stage shown_{Stage::looking};  // for which the panel was brought into sight
};

/// Does nothing where no Falcon is looked for.
class FalconEnd {
  public:
    /// Publishes the tuning. `hand` outlives it.
    FalconEnd(const HandDevice& hand, const Settings& settings, TouchState& touch);

    /// Once a picture: its status into the state. A short notice when it begins to touch.
    [[nodiscard]] std::optional<std::string> poll(TouchState& touch);
    /// Adds the buttons that went down since the last call.
    void take_presses(const Settings& settings, const TouchState& touch,
                      std::vector<GripPress>& into);

    /// Whether publish() has something new.
    [[nodiscard]] bool is_retuned(const Settings& settings, const TouchState& touch) const;
    /// The settings to the next tick; to be called after the haptic loop was told to ramp.
    void publish(const Settings& settings, const TouchState& touch);

    /// Checks and keeps a firmware file, and gives it to the Falcon. What came of it, for a notice.
    /// Throws InputError.
    std::string use_firmware(const std::filesystem::path& file, TouchState& touch);

  private:
    falcon::FalconDevice* device_;
    falcon::Tuning published_{};
    TakenPresses presses_{};
    StageNews<falcon::Stage> stages_{};
};

/// The same of an Inverse3.
class Inverse3End {
  public:
    Inverse3End(const HandDevice& hand, const Settings& settings, TouchState& touch);

    [[nodiscard]] std::optional<std::string> poll(TouchState& touch);
    void take_presses(const Settings& settings, const TouchState& touch,
                      std::vector<GripPress>& into);
    [[nodiscard]] bool is_retuned(const Settings& settings, const TouchState& touch) const;
    void publish(const Settings& settings, const TouchState& touch);

  private:
    void take_ages(Inverse3News& news);

    inverse3::Inverse3Device* device_;
    inverse3::Tuning published_{};
    TakenPresses presses_{};
    StageNews<inverse3::Stage> stages_{};
    PoseAges told_ages_{};  // of the second before this one
    std::chrono::steady_clock::time_point second_begin_{};
};

}  // namespace dibhr
