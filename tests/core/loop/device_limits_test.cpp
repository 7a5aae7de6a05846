// Whatever the settings, the device of a haptic tick gets no more than it can stand, also without a
// window.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "core/loop/haptic_tick.hpp"
#include "tests/core/haptics/surfaces.hpp"
#include "tests/core/loop/loop_bench.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr;
using namespace dibhr::test;
using Catch::Matchers::WithinAbs;

namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

/// Settings that no device can stand.
HapticSettings greedy() {
    HapticSettings settings{.recording = true};
    settings.parameters.coupling.stiffness_newton_per_mm = 1e6;
    settings.parameters.coupling.damping_newton_s_per_m = 1e6;
    settings.limits.max_force_newton = 1e6;
    settings.limits.max_change_newton_per_ms = 1e6;
    settings.limits.ramp_s = 0.0;
    settings.limits.max_goal_speed_mm_per_ms = 1e6;
    return settings;
}

/// A hand that goes anywhere around the surface at 100 px, mostly in small steps.
Vec3 wander(Dice& dice, Vec3 from) {
    if (dice.uniform(0.0, 1.0) < 0.02) {
        return {dice.uniform(-10.0, 70.0), dice.uniform(-10.0, 60.0), dice.uniform(40.0, 140.0)};
    }
    return from + Vec3{dice.uniform(-3.0, 3.0), dice.uniform(-3.0, 3.0),
                       dice.uniform(-3.0, 3.0) + 0.02 * (95.0 - from.z)};
}

/// The strongest force that `ticks` with a wandering hand send. Each spring force is one of a
/// coupling that the hand can stand.
double strongest_sent(Bench& bench, HapticTick& tick, Dice& dice, const DeviceLimits& stands,
                      int ticks) {
    const DeviceLimits most = usable(stands);
    const double mm = bench.handed.parameters.coupling.pixel_pitch_mm;
    double strongest = 0.0;
    for (int k = 0; k < ticks; ++k) {
        const Vec3 before = bench.state.front().touch.goal;
        bench.hand.goal = wander(dice, bench.hand.goal);
        run_ticks(tick, 1);
        const Touch& touch = bench.state.front().touch;
        REQUIRE(is_finite(bench.hand.sent));
        strongest = std::max(strongest, glm::length(bench.hand.sent));
        const double spring =
            most.max_stiffness_newton_per_mm * mm * glm::distance(touch.proxy.position, touch.goal);
        const double damper =
            most.max_damping_newton_s_per_m * 1e-3 * mm * glm::distance(touch.goal, before) / 0.001;
        REQUIRE(glm::length(touch.spring_force_newton) <=
                (spring + damper) * (1.0 + 1e-12) + 1e-12);
    }
    return strongest;
}

}  // namespace

TEST_CASE(
    "a device that stands 1 N never gets more, whatever it is asked for and wherever the "
    "hand goes",
    "[loop][limits]") {
    Dice dice(7);
    Bench bench;
    bench.handed = greedy();
    bench.hand.described.limits = {1.0, 0.5, 2.0, 10.0};
    bench.hand_over();
    bench.frames.publish(flat_window(64, 48, 0));
    HapticTick tick(bench.connections());
    const double strongest = strongest_sent(bench, tick, dice, bench.hand.described.limits, 20000);
    CHECK(strongest <= 1.0 + 1e-12);
    CHECK(strongest > 0.9);  // it is held, not taken off
    bench.hand.own_force_newton = {3.0, -200.0, 1e300};
    CHECK(strongest_sent(bench, tick, dice, bench.hand.described.limits, 2000) <= 1.0 + 1e-12);
}

TEST_CASE("what people ask for below a device's limits is left as it is, bit by bit",
          "[loop][limits]") {
    Bench bench;
    bench.frames.publish(flat_window(64, 48, 0));
    bench.handed.parameters.coupling.stiffness_newton_per_mm = 0.3;
    bench.handed.limits.max_force_newton = 0.2;
    bench.hand_over();
    HapticTick tick(bench.connections());
    press(bench, tick);
    const Touch& touch = bench.state.front().touch;
    const Coupling& coupling = bench.handed.parameters.coupling;
    CHECK(touch.spring_force_newton ==
          coupling_force(touch.proxy, touch.goal, Vec3(0.0), coupling));
    CHECK_THAT(glm::length(bench.hand.sent), WithinAbs(0.2, 1e-12));
}

TEST_CASE("a value of a specification that is no limit lets no force of its kind through",
          "[loop][limits]") {
    const double odd = GENERATE(as<double>(), kNoNumber, kInfinite, -kInfinite, -1.0, 0.0);
    const int which = GENERATE(0, 1, 2, 3);
    CAPTURE(odd, which);
    Dice dice(11);
    Bench bench;
    bench.handed = greedy();
    bench.hand.described.limits = {1.0, 0.5, 2.0, 10.0};
    (which == 0   ? bench.hand.described.limits.max_force_newton
     : which == 1 ? bench.hand.described.limits.max_stiffness_newton_per_mm
     : which == 2 ? bench.hand.described.limits.max_damping_newton_s_per_m
                  : bench.hand.described.limits.max_goal_speed_mm_per_ms) = odd;
    bench.hand_over();
    bench.frames.publish(flat_window(64, 48, 0));
    HapticTick tick(bench.connections());
    const double strongest = strongest_sent(bench, tick, dice, bench.hand.described.limits, 1000);
    CHECK(strongest <= 1.0 + 1e-12);
    if (which == 0) CHECK_THAT(strongest, WithinAbs(0.0, 0.0));
}

TEST_CASE("settings that are no numbers send no force that the device cannot stand",
          "[loop][limits]") {
    const double odd = GENERATE(as<double>(), kNoNumber, kInfinite, -kInfinite, -1e9);
    const int which = GENERATE(0, 1, 2, 3, 4);
    CAPTURE(odd, which);
    Dice dice(13);
    Bench bench;
    bench.handed = greedy();
    const std::array<double*, 5> values{&bench.handed.parameters.coupling.stiffness_newton_per_mm,
                                        &bench.handed.parameters.coupling.damping_newton_s_per_m,
                                        &bench.handed.limits.max_force_newton,
                                        &bench.handed.limits.max_change_newton_per_ms,
                                        &bench.handed.limits.ramp_s};
    *values.at(static_cast<std::size_t>(which)) = odd;
    bench.hand.described.limits = {1.0, 0.5, 2.0, 10.0};
    bench.hand_over();
    bench.frames.publish(flat_window(64, 48, 0));
    HapticTick tick(bench.connections());
    for (int k = 0; k < 2000; ++k) {
        bench.hand.goal = wander(dice, bench.hand.goal);
        run_ticks(tick, 1);
        REQUIRE(is_finite(bench.hand.sent));
        REQUIRE(glm::length(bench.hand.sent) <= 1.0 + 1e-12);
    }
}

TEST_CASE("limits that change between ticks hold in the very tick that reads them",
          "[loop][limits]") {
    Dice dice(17);
    Bench bench;
    bench.handed = greedy();
    bench.hand_over();
    bench.frames.publish(flat_window(64, 48, 0));
    HapticTick tick(bench.connections());
    for (int change = 0; change < 300; ++change) {
        const DeviceLimits now{dice.uniform(0.0, 2.0), dice.uniform(0.0, 2.0),
                               dice.uniform(0.0, 20.0), dice.uniform(1.0, 20.0)};
        bench.hand.limits_now = now;
        CHECK(strongest_sent(bench, tick, dice, now, 20) <= now.max_force_newton + 1e-12);
    }
}

TEST_CASE("a hand that stands in has its own limits, and the device's hold again when it is back",
          "[loop][limits]") {
    Bench bench;
    bench.handed = greedy();
    bench.handed.parameters.coupling.damping_newton_s_per_m = 0.0;
    bench.hand.described.limits = {1.0, 0.5, 2.0, 10.0};
    bench.hand.limits_now = DeviceLimits{3.0, 2.0, 20.0, 10.0};  // the one that stands in
    bench.hand_over();
    bench.frames.publish(flat_window(64, 48, 0));
    HapticTick tick(bench.connections());
    press(bench, tick);
    const double way_mm = 10.0 * bench.handed.parameters.coupling.pixel_pitch_mm;
    const auto spring = [&bench] { return bench.state.front().touch.spring_force_newton.z; };
    CHECK_THAT(spring(), WithinAbs(2.0 * way_mm, 1e-9));
    CHECK_THAT(bench.hand.sent.z, WithinAbs(std::min(2.0 * way_mm, 3.0), 1e-9));
    bench.hand.limits_now.reset();
    run_ticks(tick, 1);
    CHECK_THAT(spring(), WithinAbs(0.5 * way_mm, 1e-9));
    CHECK(glm::length(bench.hand.sent) <= 1.0 + 1e-12);
}

TEST_CASE("a jump of the goal is what the hand calls one: ten times farther at ten times the scale",
          "[loop][limits]") {
    const double scale = GENERATE(1.0, 10.0);
    Bench bench;
    bench.hand.limits_now = at_scale(DeviceLimits{}, scale);
    bench.hand_over();
    bench.frames.publish(flat_window(640, 48, 0));
    bench.hand.goal = {20.0, 10.0, 150.0};
    bench.hand.own_force_newton = {0.0, 0.0, -0.5};  // in the air, so that a force is sent
    HapticTick tick(bench.connections());
    run_ticks(tick, 1000);
    REQUIRE(glm::length(bench.hand.sent) > 0.4);
    bench.hand.goal.x += 300.0;  // 42 mm in a millisecond
    run_ticks(tick, 1);
    CHECK((bench.state.front().touch.cut == SafetyCut::goal_jump) == (scale < 2.0));
}

TEST_CASE("what was held once is held for good: the same bits when it is held again",
          "[loop][limits]") {
    Dice dice(19);
    for (int k = 0; k < 10000; ++k) {
        const DeviceLimits device = at_scale({dice.uniform(-1.0, 9.0), dice.uniform(-0.1, 2.0),
                                              dice.uniform(-1.0, 30.0), dice.uniform(-1.0, 20.0)},
                                             dice.uniform(0.1, 10.0));
        Coupling coupling;
        coupling.stiffness_newton_per_mm = dice.uniform(-1.0, 10.0);
        coupling.damping_newton_s_per_m = dice.uniform(-1.0, 100.0);
        SafetyLimits limits;
        limits.max_force_newton = dice.uniform(-1.0, 10.0);
        const Coupling held = held_coupling(coupling, device);
        const SafetyLimits held_once = held_limits(limits, device);
        REQUIRE(held_coupling(held, device) == held);
        REQUIRE(held_limits(held_once, device) == held_once);
        REQUIRE(usable(device) == device);
    }
}
