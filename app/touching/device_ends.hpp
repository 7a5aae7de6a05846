// The window thread's ends of the force devices: what they tell, their buttons, their tuning.
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
#include "app/touching/device_state.hpp"
#include "app/touching/touch_state.hpp"
#include "device/falcon/falcon_device.hpp"
#include "device/hand_device.hpp"
#include "device/inverse3/inverse3_device.hpp"

namespace dibhr {

/// A button of a grip that went down since it was asked for last.
struct GripPress {
    int button{0};  ///< of the device, from 0
    ButtonAction action{ButtonAction::none};
    std::uint32_t times{1};
    std::chrono::steady_clock::time_point at{};  ///< the last time
};

/// What a device has of its own.
struct FalconKind {
    using Device = falcon::FalconDevice;
    using Tuning = falcon::Tuning;
    using Stage = falcon::Stage;
    static constexpr const char* kName = "The Falcon";

    static auto& news(auto& touch) { return touch.falcon; }
    static const ButtonActions& buttons(const Settings& all) { return all.falcon.buttons; }
    static Tuning tuning(const Settings& all, const TouchState& touch) {
        return tuning_of(all.falcon, touch.centred);
    }
};
struct Inverse3Kind {
    using Device = inverse3::Inverse3Device;
    using Tuning = inverse3::Tuning;
    using Stage = inverse3::Stage;
    static constexpr const char* kName = "The Inverse3";

    static auto& news(auto& touch) { return touch.inverse3; }
    static const ButtonActions& buttons(const Settings& all) { return all.inverse3.buttons; }
    static Tuning tuning(const Settings& all, const TouchState& touch) {
        return tuning_of(all.inverse3, all.max_force_newton, touch.centred);
    }
};

/// Does nothing where the device is not looked for.
template <typename Kind>
class DeviceEnd {
  public:
    /// Publishes the tuning. `device` null: it is not looked for; else it outlives this.
    DeviceEnd(typename Kind::Device* device, const Settings& settings, TouchState& touch)
        : device_(device) {
        if (device_ == nullptr) return;
        Kind::news(touch).emplace();
        publish(settings, touch);
    }

    /// Null: it is not looked for.
    [[nodiscard]] typename Kind::Device* device() const noexcept { return device_; }

    /// Once a picture: its status into the state. Says once for each need that it needs its person.
    /// A short notice when it begins to touch.
    [[nodiscard]] std::optional<std::string> poll(TouchState& touch) {
        if (device_ == nullptr) return {};
        auto& news = *Kind::news(touch);
        news.status = device_->status();
        news.asked = true;
        const auto stage = news.status.stage;
        if (std::exchange(stage_, stage) == stage) return {};
        // One that comes again and again must not keep moving the panels.
        if (needs_its_person(stage) && shown_ != stage) {
            touch.needs_person = true;
            shown_ = stage;
        }
        if (stage != Kind::Stage::ready) return {};
        shown_ = stage;
        const bool again = std::exchange(news.was_ready, true);
        return std::string(Kind::kName) + " touches" + (again ? " again" : "");
    }

    /// Adds the buttons that went down since the last call, the lowest first.
    void take_presses(const Settings& settings, const TouchState& touch,
                      std::vector<GripPress>& into) {
        if (device_ == nullptr) return;
        const auto& status = Kind::news(touch)->status;
        for (std::size_t k = 0; k < status.presses.size(); ++k) {
            const std::uint32_t times = status.presses[k] - taken_[k];
            if (status.presses[k] > taken_[k])
                into.push_back(
                    {static_cast<int>(k), Kind::buttons(settings)[k], times, status.pressed_at[k]});
        }
        taken_ = status.presses;
    }

    /// Whether publish() has something new.
    [[nodiscard]] bool is_retuned(const Settings& settings, const TouchState& touch) const {
        return device_ != nullptr && !(published_ == Kind::tuning(settings, touch));
    }
    /// The settings to the next tick; to be called after the haptic loop was told to ramp.
    void publish(const Settings& settings, const TouchState& touch) {
        published_ = Kind::tuning(settings, touch);
        device_->tuning().publish(published_);
    }

  private:
    typename Kind::Device* device_;
    typename Kind::Tuning published_{};
    ButtonPresses taken_{};
    typename Kind::Stage stage_{Kind::Stage::looking};  // as told
    typename Kind::Stage shown_{Kind::Stage::looking};  // for which the panel came into sight
};

}  // namespace dibhr
