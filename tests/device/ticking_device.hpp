// Any device in a loop at 1 kHz, over a flat relief.
#pragma once

#include <chrono>
#include <functional>
#include <utility>

#include "core/loop/device.hpp"
#include "core/realtime/tick_timer.hpp"
#include "tests/device/small_relief.hpp"

namespace dibhr::test {

/// Runs the device with the force that a test sets.
template <typename AnyDevice>
class TickingDevice {
  public:
    template <typename... Arguments>
    explicit TickingDevice(Arguments&&... arguments)
        : device(std::forward<Arguments>(arguments)...) {}

    AnyDevice device;
    Vec3 force_newton{0.0};  ///< sent in every tick
    HandReading reading{};   ///< the last one

    void tick() {
        reading = device.read({0.001, surface_, kPitch_mm});
        device.send(force_newton);
    }
    /// Ticks until the condition is true; false: it never was.
    bool tick_until(const std::function<bool()>& is_so,
                    std::chrono::milliseconds patience = std::chrono::seconds(60)) {
        const auto end = std::chrono::steady_clock::now() + patience;
        while (std::chrono::steady_clock::now() < end) {
            (void)timer_.wait();
            tick();
            if (is_so()) return true;
        }
        return false;
    }
    void tick_for(std::chrono::milliseconds span) {
        (void)tick_until([] { return false; }, span);
    }
    void tick_times(int count) {
        (void)tick_until([&count] { return --count <= 0; }, std::chrono::hours(1));
    }
    bool tick_until_ready() {
        return tick_until([this] { return reading.ready && !reading.mouse_fallback; });
    }
    [[nodiscard]] const DepthSurface& surface() const noexcept { return surface_; }

    static constexpr double kPitch_mm = 101.6 / 720.0;

  private:
    SmallRelief relief_{flat()};
    DepthSurface surface_{relief_.surface()};
    TickTimer timer_{};
};

}  // namespace dibhr::test
