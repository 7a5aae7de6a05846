// The window thread's ends of the force devices: their state, their buttons, their tuning.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/settings/grip_buttons.hpp"
#include "app/settings/settings.hpp"
#include "app/touching/touch_state.hpp"
#include "device/force_devices.hpp"

namespace dibhr {

/// A button of a grip that went down since it was asked for last.
struct GripPress {
    int button{0};  ///< of the device, from 0
    ButtonAction action{ButtonAction::none};
    std::uint32_t times{1};
    std::chrono::steady_clock::time_point at{};  ///< the last time
};

class DeviceEnd {
  public:
    /// Publishes the tuning, and adds the device to those of the state. `kind`: its place in
    /// force_device_kinds(). `device` outlives this.
    DeviceEnd(std::size_t kind, ForceDevice& device, const Settings& settings, TouchState& touch)
        : kind_(kind), place_(touch.devices.size()), device_(device) {
        touch.devices.push_back({.kind = kind});
        publish(settings, touch);
    }

    [[nodiscard]] std::size_t kind() const noexcept { return kind_; }
    [[nodiscard]] ForceDevice& device() const noexcept { return device_; }

    /// Once a picture: its state into that of the window. Says once for each need that it needs its
    /// person. A short notice when it begins to touch.
    [[nodiscard]] std::optional<std::string> poll(TouchState& touch) {
        DeviceNews& news = touch.devices[place_];
        news.state = device_.state();
        news.asked = true;
        const int stage = news.state.stage;
        if (std::exchange(stage_, stage) == stage) return {};
        // One that comes again and again must not keep moving the panels.
        if (news.state.needs_person && shown_ != stage) {
            touch.needs_person = true;
            shown_ = stage;
        }
        if (!news.state.ready) return {};
        shown_ = stage;
        const bool again = std::exchange(news.was_ready, true);
        return std::string("The ") + force_device_kinds()[kind_]->called + " touches" +
               (again ? " again" : "");
    }

    /// Adds the buttons that went down since the last call, the lowest first.
    void take_presses(const Settings& settings, const TouchState& touch,
                      std::vector<GripPress>& into) {
        const DeviceState& state = touch.devices[place_].state;
        const ButtonActions& actions = settings.devices[kind_].buttons;
        for (std::size_t k = 0; k < state.presses.size(); ++k) {
            const std::uint32_t times = state.presses[k] - taken_[k];
            if (state.presses[k] > taken_[k])
                into.push_back({static_cast<int>(k), actions[k], times, state.pressed_at[k]});
        }
        taken_ = state.presses;
    }

    /// Whether publish() has something new.
    [[nodiscard]] bool is_retuned(const Settings& settings, const TouchState& touch) const {
        return device_.is_retuned(settings.devices[kind_],
                                  {settings.max_force_newton, touch.centred});
    }
    /// The settings to the next tick; to be called after the haptic loop was told to ramp.
    void publish(const Settings& settings, const TouchState& touch) {
        device_.publish(settings.devices[kind_], {settings.max_force_newton, touch.centred});
    }

  private:
    std::size_t kind_;
    std::size_t place_;  // in TouchState::devices
    ForceDevice& device_;
    ButtonPresses taken_{};
    int stage_{0};  // as told
    int shown_{0};  // for which the panel came into sight
};

}  // namespace dibhr
