// The connections of a haptic tick in a test: a hand that the test moves, over a flat surface.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

#include "core/loop/haptic_tick.hpp"

namespace dibhr::test {

/// A hand at a place that the test sets; stores the force sent to it.
class TestHand final : public Device {
  public:
    [[nodiscard]] const DeviceSpecification& specification() const noexcept override {
        return described;
    }
    HandReading read(const HandContext&) noexcept override {
        return {.goal_in_grid = goal,
                .buttons = 1,
                .lifted = lifted,
                .hand_changed = std::exchange(hand_changed, false),
                .harmless = harmless,
                .force_off = force_off,
                .limits = limits_now,
                .own_force_newton = own_force_newton};
    }
    void send(Vec3 force_newton) noexcept override { sent = force_newton; }
    [[nodiscard]] bool rests() const noexcept override { return resting; }

    Vec3 goal{20.0, 10.0, 90.0};
    bool lifted{false};
    bool hand_changed{false};  // by the next reading
    bool harmless{false};
    bool force_off{false};
    bool resting{false};
    Vec3 own_force_newton{0.0};
    Vec3 sent{-1.0};
    std::optional<DeviceLimits> limits_now{};  // instead of the specification's
    DeviceSpecification described{};
};

inline Frame flat_frame(int columns, int rows, float level) {
    auto image = std::make_shared<DepthImage>();
    image->columns = columns;
    image->rows = rows;
    image->levels.assign(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), level);
    Frame frame;
    frame.depth = image;
    return frame;
}

inline FrameWindow flat_window(int columns, int rows, std::uint64_t discontinuity) {
    FrameWindow window;
    window.frames[0] = flat_frame(columns, rows, 100.0F);
    window.count = 1;
    window.discontinuity = discontinuity;
    return window;
}

/// All connections of a tick. The surface is flat at 100 px; the hand is 10 px under it.
struct Bench {
    TestHand hand{};
    TripleBuffer<FrameWindow> frames{};
    TripleBuffer<HapticSettings> settings{};
    TripleBuffer<HapticState> state{};
    std::unique_ptr<StripRing> strips{std::make_unique<StripRing>()};
    std::unique_ptr<TickRing> ticks{std::make_unique<TickRing>()};
    HapticSettings handed{.recording = true};

    HapticConnections connections() { return {hand, frames, settings, state, *strips, *ticks}; }
    void hand_over() {
        ++handed.version;
        settings.publish(handed);
    }
};

/// The time at which the last tick of any bench began. It advances with the ticks, not with the
/// machine's clock.
inline std::chrono::steady_clock::time_point& bench_time() {
    static std::chrono::steady_clock::time_point now{std::chrono::hours(1)};
    return now;
}

/// Ticks of a millisecond.
inline void run_ticks(HapticTick& tick, int count) {
    for (int k = 0; k < count; ++k) {
        bench_time() += std::chrono::milliseconds(1);
        tick.run({bench_time(), 0.001, {}, false}, 0);
    }
}

/// The parameters that a recorder writes for the settings published last.
inline SessionParameters as_recorded(const HapticSettings& handed) {
    return {.version = handed.version,
            .touch = handed.parameters,
            .limits = handed.limits,
            .force_enabled = handed.force_enabled,
            .bump = {}};
}

/// Lets the hand come from above, so that it is in contact and the force has risen.
inline void press(Bench& bench, HapticTick& tick) {
    const Vec3 pressed = bench.hand.goal;
    for (double z = pressed.z + 15.0; z > pressed.z; z -= 0.5) {
        bench.hand.goal.z = z;
        run_ticks(tick, 1);
    }
    bench.hand.goal = pressed;
    run_ticks(tick, 1500);
}

/// A bench whose hand has come from above and presses.
struct PressingBench : Bench {
    PressingBench() {
        hand_over();
        frames.publish(flat_window(64, 48, 0));
        press(*this, tick);
    }
    HapticTick tick{connections()};
};

}  // namespace dibhr::test
