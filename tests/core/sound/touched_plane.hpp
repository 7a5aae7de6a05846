// The real tick over a plane, for tests of sound and rumble.
#pragma once

#include <cmath>
#include <memory>
#include <numbers>

#include "core/sound/sound_tick.hpp"
#include "tests/core/loop/loop_bench.hpp"

namespace dibhr::test {

/// The plane may have a bump every `period_px`.
struct TouchedPlane {
    explicit TouchedPlane(double period_px = 0.0) {
        bench.frames.publish(flat_window(4096, 16, 0));
        bench.hand.goal = {20.0, 8.0, 130.0};
        if (period_px > 0.0) {
            BumpMap wave{64, 1, {}};
            for (int k = 0; k < 64; ++k)
                wave.heights.push_back(
                    static_cast<float>(0.5 + 0.5 * std::cos(2.0 * std::numbers::pi * k / 64.0)));
            bench.handed.bump = std::make_shared<const BumpMap>(wave);
            bench.handed.parameters.shape.bump_size_px = period_px;
            bench.handed.parameters.shape.roughness_px = 3.0;
        }
        bench.hand_over();
    }
    HapticConnections with_sound() {
        HapticConnections connections = bench.connections();
        connections.sound = ring.get();
        return connections;
    }
    /// `each` is called after every tick.
    template <typename Each>
    void pass(int count, Vec3 px_per_s, Each each) {
        for (int k = 0; k < count; ++k) {
            bench.hand.goal += 0.001 * px_per_s;
            run_ticks(tick, 1);
            each();
        }
    }
    /// From above, and until the force has risen.
    template <typename Each>
    void press(Each each) {
        pass(50, Vec3{0.0}, each);
        pass(100, {0.0, 0.0, -400.0}, each);
        pass(700, Vec3{0.0}, each);
    }
    [[nodiscard]] bool contact() { return bench.state.front().touch.proxy.contact; }

    Bench bench{};
    std::unique_ptr<SoundRing> ring{std::make_unique<SoundRing>()};
    SoundListener ticks{*ring};
    HapticTick tick{with_sound()};
};

}  // namespace dibhr::test
