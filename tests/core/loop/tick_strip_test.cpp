// The values of each tick for the strip charts.
#include "core/loop/tick_strip.hpp"

#include <algorithm>
#include <cmath>

#include "tests/core/loop/loop_bench.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr;
using namespace dibhr::test;

TEST_CASE("a tick's strip has force, depth under the proxy, speed and lateness in their units",
          "[loop]") {
    Touch before;
    before.goal = {10.0, 20.0, 30.0};
    before.sent_force_newton = {1.0, 2.0, -2.0};
    Touch now = before;
    now.goal = {13.0, 20.0, 34.0};  // 5 px
    now.proxy.position = {13.0, 20.0, 46.0};
    now.proxy.contact = true;
    now.sent_force_newton = {0.0, 3.0, 4.0};
    const TickStrip strip = strip_of(before, now, 0.002, 7.5, 0.2);
    CHECK(strip.force_newton == Approx(5.0));
    CHECK(strip.penetration_mm == Approx(12.0 * 0.2));
    CHECK(strip.speed_mm_per_s == Approx(5.0 * 0.2 / 0.002));
    CHECK(strip.work_millijoule == Approx(1.0 * 0.6 - 2.0 * 0.8));
    CHECK(strip.lateness_us == Approx(7.5));

    now.proxy.contact = false;
    const TickStrip free = strip_of(before, now, 0.0, 0.0, 0.2);
    CHECK(free.penetration_mm == 0.0F);
    CHECK(free.speed_mm_per_s == 0.0F);  // it came from elsewhere
    CHECK(free.work_millijoule == 0.0F);
}

TEST_CASE("every tick leaves one strip, and a hand pressed down and lifted gets back what it gave",
          "[loop]") {
    Bench bench;
    bench.handed.limits.stability = false;
    bench.handed.parameters.coupling.damping_newton_s_per_m = 0.0;
    bench.frames.publish(flat_window(64, 48, 0));
    bench.hand_over();
    bench.hand.goal = {20.0, 10.0, 101.0};
    HapticTick tick(bench.connections());
    run_ticks(tick, 600);  // the force has risen
    double given = 0.0;
    double most = 0.0;
    int strips = 0;
    const auto drain = [&] {
        for (TickStrip strip; bench.strips->pop(strip);) {
            ++strips;
            given += static_cast<double>(strip.work_millijoule);
            most = std::min(most, given);
        }
    };
    drain();
    CHECK(strips == 600);
    constexpr int kWay = 200;
    for (int k = 0; k < 2 * kWay; ++k) {
        bench.hand.goal.z = 101.0 - 0.05 * (k < kWay ? k : 2 * kWay - k);
        run_ticks(tick, 1);
    }
    drain();
    CHECK(strips == 600 + 2 * kWay);
    const double pitch_mm = bench.handed.parameters.coupling.pixel_pitch_mm;
    const double depth_mm = 9.0 * pitch_mm;
    const double pressed_in =
        0.5 * bench.handed.parameters.coupling.stiffness_newton_per_mm * depth_mm * depth_mm;
    CHECK(-most == Approx(pressed_in).epsilon(0.03));  // a spring's energy
    CHECK(std::abs(given) < 0.03 * pressed_in);
}
