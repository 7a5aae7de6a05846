// How the window's thread uses the force devices: reads state and buttons, publishes tuning.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/settings/button_action_names.hpp"
#include "app/settings/settings.hpp"
#include "app/touching/touch_state.hpp"
#include "device/force_devices.hpp"

namespace dibhr {

/// Presses of one device button since the last take_presses().
struct DeviceButtonPress {
    int button{0};  ///< number on the device, from 0
    ButtonAction action{ButtonAction::none};
    std::uint32_t times{1};
    std::chrono::steady_clock::time_point at{};  ///< of the last press
};

class DeviceClient {
  public:
    /// Publishes the tuning, and adds the device to touch.devices. `kind`: index in
    /// force_device_kinds(). `device` must outlive this object.
    DeviceClient(std::size_t kind, ForceDevice& device, const Settings& settings, TouchState& touch)
        : kind_(kind), place_(touch.devices.size()), device_(device) {
        touch.devices.push_back({.kind = kind});
        publish(settings, touch);
    }

    [[nodiscard]] std::size_t kind() const noexcept { return kind_; }
    [[nodiscard]] ForceDevice& device() const noexcept { return device_; }

    /// Once a turn: copies the device's state into `touch`. Sets touch.needs_person when the
    /// device begins to need help. Returns a notice when the device becomes ready.
    [[nodiscard]] std::optional<std::string> poll(TouchState& touch) {
        DeviceInfo& info = touch.devices[place_];
        info.state = device_.state();
        info.answered = true;
        const int stage = info.state.stage;
        if (std::exchange(stage_, stage) == stage) return {};
        // A stage that comes again and again must not scroll the panels each time.
        if (info.state.needs_person && shown_ != stage) {
            touch.needs_person = true;
            shown_ = stage;
        }
        if (!info.state.ready) return {};
        shown_ = stage;
        const bool again = std::exchange(info.was_ready, true);
        return std::string("The ") + force_device_kinds()[kind_]->short_name + " touches" +
               (again ? " again" : "");
    }

    /// Appends the presses since the last call, in the order of the buttons' numbers.
    void take_presses(const Settings& settings, const TouchState& touch,
                      std::vector<DeviceButtonPress>& into) {
        const DeviceState& state = touch.devices[place_].state;
        const ButtonActions& actions = settings.devices[kind_].buttons;
        for (std::size_t k = 0; k < state.presses.size(); ++k) {
            const std::uint32_t times = state.presses[k] - taken_[k];
            if (state.presses[k] > taken_[k])
                into.push_back({static_cast<int>(k), actions[k], times, state.pressed_at[k]});
        }
        taken_ = state.presses;
    }

    /// Whether publish() would change the device's tuning.
    [[nodiscard]] bool has_new_tuning(const Settings& settings, const TouchState& touch) const {
        return device_.has_new_tuning(settings.devices[kind_],
                                      {settings.max_force_newton, touch.centre_count});
    }
    /// Publishes the tuning to the next tick. Call it after the loop got the settings that ramp.
    void publish(const Settings& settings, const TouchState& touch) {
        device_.publish(settings.devices[kind_], {settings.max_force_newton, touch.centre_count});
    }

  private:
    std::size_t kind_;
    std::size_t place_;  // in TouchState::devices
    ForceDevice& device_;
    ButtonPresses taken_{};
    int stage_{0};  // of the last poll()
    int shown_{0};  // the stage for which the panel was last scrolled into view
};

}  // namespace dibhr
