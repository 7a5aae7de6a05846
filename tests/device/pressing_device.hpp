// Any device in a loop at 1 kHz that presses with a force.
#pragma once

#include <algorithm>
#include <chrono>
#include <string>
#include <string_view>
#include <utility>

#include "core/haptics/safety.hpp"
#include "tests/device/ticking_device.hpp"

namespace dibhr::test {

/// The loop's own last stage limits the force, and lets it rise. A driver's Stage and Status are
/// those of `AnyDevice`.
template <typename AnyDevice>
class PressingDevice {
  public:
    template <typename... Arguments>
    explicit PressingDevice(Arguments&&... arguments)
        : loop(std::forward<Arguments>(arguments)...) {}

    TickingDevice<AnyDevice> loop;
    Vec3 pressed_newton{0.0, 0.0, 2.0};

    /// Ticks until the condition is true; false: it never was.
    template <typename IsSo>
    bool tick_until(IsSo&& is_so,
                    std::chrono::milliseconds patience = std::chrono::milliseconds(60'000)) {
        return loop.tick_until(
            [&] {
                choose_force();
                return is_so();
            },
            patience);
    }
    void tick_for(std::chrono::milliseconds span) {
        (void)tick_until([] { return false; }, span);
    }
    [[nodiscard]] auto status() const { return loop.device.status(); }
    [[nodiscard]] auto stage() const { return status().stage; }
    template <typename Stage>
    bool reaches(Stage stage) {
        return tick_until([&] { return this->stage() == stage; });
    }
    [[nodiscard]] std::string sentence() const { return status().sentence; }
    [[nodiscard]] bool says(std::string_view part) const {
        return sentence().find(part) != std::string::npos;
    }

  private:
    void choose_force() {
        SafetyInput input;
        input.device_ready = loop.reading.ready;
        input.from_zero = loop.reading.hand_changed;
        loop.force_newton = safety_.limit(pressed_newton, input, SafetyLimits{});
    }

    SafetyStage safety_{};
};

}  // namespace dibhr::test
