// The pieces of the stability control: damping, velocity, the video's motion, the energy account.
#include "core/haptics/stability.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "core/haptics/safety.hpp"
#include "core/haptics/touch.hpp"
#include "tests/core/haptics/surfaces.hpp"
#include "tests/support/catch.hpp"

namespace dibhr {

namespace {

using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

constexpr double kTick_s = 0.001;
constexpr DeviceDynamics kDevice{
    .mass_kg = 0.1, .friction_newton_s_per_m = 0.5, .resolution_mm = 0.05, .delay_s = 0.002};

/// The reading of a place by a device with coarse steps.
double in_steps(double place, double step) {
    return std::round(place / step) * step;
}

}  // namespace

TEST_CASE("the needed damping leaves the device its margin, at every stiffness, delay and scale",
          "[stability]") {
    test::Dice dice(1);
    for (int k = 0; k < 2000; ++k) {
        DeviceLimits device;
        device.dynamics = {dice.uniform(0.01, 1.0), dice.uniform(0.0, 5.0), dice.uniform(0.0, 0.2),
                           dice.uniform(0.0, 0.01), dice.uniform(0.0, 6.0)};
        const double stiffness = dice.uniform(0.0, 10.0);
        const double needed = needed_damping(stiffness, device.dynamics);
        const Coupling damped{.stiffness_newton_per_mm = stiffness,
                              .damping_newton_s_per_m = needed};
        REQUIRE(needed >= 0.0);
        REQUIRE(stability_margin(damped, device.dynamics) >=
                device.dynamics.margin_newton_s_per_m - 1e-9);
        const double scale = dice.uniform(0.1, 10.0);
        const DeviceDynamics scaled = at_scale(device, scale).dynamics;
        REQUIRE_THAT(needed_damping(stiffness / scale, scaled),
                     WithinRel(needed / scale, 1e-9) || WithinAbs(needed / scale, 1e-9));
    }
    CHECK(needed_damping(10.0, DeviceDynamics{}) == 0.0);
}

TEST_CASE("the stiffest spring of a device has the most damping that is stable on it, and no more",
          "[stability]") {
    test::Dice dice(2);
    for (int k = 0; k < 2000; ++k) {
        const DeviceDynamics device{.mass_kg = dice.uniform(0.05, 1.0),
                                    .friction_newton_s_per_m = dice.uniform(0.0, 2.0),
                                    .resolution_mm = 0.01,
                                    .delay_s = dice.uniform(0.0, 0.03)};
        const double most = most_stiffness(device);
        const double strongest = 0.75 * device.mass_kg / (0.0005 + device.delay_s);
        CAPTURE(device.mass_kg, device.delay_s, most);
        REQUIRE(most >= 0.0);
        if (most > 0.0)
            CHECK_THAT(needed_damping(most, device), WithinRel(strongest, 1e-9));
        else
            CHECK(needed_damping(0.0, device) >= strongest);
        DeviceDynamics later = device;
        later.delay_s += 0.001;
        CHECK(most_stiffness(later) <= most);
    }
    CHECK(std::isinf(most_stiffness(DeviceDynamics{})));
}

TEST_CASE("the window reads a steady speed exactly, and through a device's steps nearly",
          "[stability]") {
    AdaptiveWindow exact;
    Vec3 speed(0.0);
    for (int k = 0; k < 50; ++k) speed = exact.after(Vec3{0.3, -0.02, 0.0}, kTick_s, 0.05);
    CHECK_THAT(speed.x, WithinRel(300.0, 1e-9));
    CHECK_THAT(speed.y, WithinRel(-20.0, 1e-9));

    const double slow = GENERATE(2.0, 7.0, 20.0, 120.0);  // mm/s; a step a millisecond is 50
    AdaptiveWindow window;
    double last = 0.0;
    double worst = 0.0;
    for (int k = 1; k < 2000; ++k) {
        const double place = in_steps(slow * k * kTick_s, 0.05);
        const double read = window.after(Vec3{place - last, 0.0, 0.0}, kTick_s, 0.05).x;
        last = place;
        if (k > 20) worst = std::max(worst, std::abs(read - slow));
    }
    CAPTURE(slow, worst);
    CHECK(worst < 0.5 * 50.0);  // the plain difference is wrong by up to a whole step
}

TEST_CASE("a sudden stop is read within two ticks", "[stability]") {
    AdaptiveWindow window;
    for (int k = 0; k < 30; ++k) (void)window.after(Vec3{0.3, 0.0, 0.0}, kTick_s, 0.05);
    (void)window.after(Vec3(0.0), kTick_s, 0.05);
    CHECK(std::abs(window.after(Vec3(0.0), kTick_s, 0.05).x) < 30.0);
}

TEST_CASE("slow motion of the video is followed, flicker is not, and nothing stays behind",
          "[stability]") {
    constexpr double kFar = 1e9;
    const auto passed = [](double hertz) {
        VideoMotion motion;
        double felt = 0.0;
        double before = 0.0;
        double highest = 0.0;
        for (int k = 1; k <= 8000; ++k) {
            const double place = std::sin(2.0 * std::numbers::pi * hertz * k * kTick_s);
            felt += motion.filtered_rise(place - before, kTick_s, kFar);
            before = place;
            if (k > 4000) highest = std::max(highest, felt);
        }
        return highest;
    };
    CHECK(passed(0.25) > 0.99);
    CHECK(passed(15.0) < 0.3);
    VideoMotion motion;
    double felt = motion.filtered_rise(5.0, kTick_s, kFar);
    for (int k = 0; k < 1000; ++k) felt += motion.filtered_rise(0.0, kTick_s, kFar);
    CHECK_THAT(felt, WithinAbs(5.0, 1e-6));
}

TEST_CASE("a spring felt late creates energy, and the controller takes it out", "[stability]") {
    PassivityControl control;
    constexpr double kStiffness = 1.0;
    double depth_mm = 2.0;
    double taken_mj = 0.0;
    double given_mj = 0.0;  // for a tick or two after each turn
    double strongest = 0.0;
    for (int k = 1; k < 3000; ++k) {  // a hand that is moved to and fro, 7 Hz
        const double next = 2.0 + std::sin(2.0 * std::numbers::pi * 7.0 * k * kTick_s);
        const double way = next - depth_mm;  // downwards
        depth_mm = next;
        const Vec3 against = control.force_after({.dt_s = kTick_s,
                                                  .goal_step_mm = {0.0, 0.0, -way},
                                                  .lag_mm = {0.0, 0.0, depth_mm},
                                                  .stiffness_newton_per_mm = kStiffness,
                                                  .max_force_newton = 4.0},
                                                 kDevice);
        (against.z * way > 0.0 ? taken_mj : given_mj) += against.z * way;
        strongest = std::max(strongest, control.flow().damping_newton_s_per_m);
        control.record_sent_force(
            {0.0, 0.0, kStiffness * depth_mm});  // as if nothing were taken out
    }
    CHECK(taken_mj > 1.0);
    CHECK(-given_mj < 0.01 * taken_mj);
    CHECK(strongest <= 0.75 * kDevice.mass_kg / 0.0025 + 1e-9);
    CHECK(control.flow().created_mw > 0.0);
}

TEST_CASE("a cut of the video under a hand that hovers begins by the ramp, a slow rise does not",
          "[stability]") {
    const DepthImage low = test::flat(40, 30, 100.0);
    const DepthImage high = test::flat(40, 30, 200.0);
    SafetyLimits asked;
    asked.stability = true;
    DeviceLimits moved;
    moved.dynamics = kDevice;
    const SafetyLimits limits = held_limits(asked, moved);
    const TouchParameters parameters;
    const auto strongest_within = [&](int ticks, int blended_over) {
        TouchRenderer renderer;
        double strongest = 0.0;
        for (int k = -1000; k < ticks; ++k) {
            const double blend = std::clamp(k / double(blended_over), 0.0, 1.0);
            const DepthSurface surface(low, high, blend, {255.0, 0.0});
            strongest = std::max(
                strongest,
                glm::length(renderer.update(surface, {20.3, 15.2, 120.4}, parameters, {}, limits)
                                .sent_force_newton));
        }
        return strongest;
    };
    for (const int blended_over : {1, 20, 33, 66}) {
        CAPTURE(blended_over);
        CHECK(strongest_within(blended_over + 20, blended_over) < 0.35);
        CHECK(strongest_within(blended_over + 1000, blended_over) > 3.9);  // by the ramp
    }
    CHECK(strongest_within(200, 500) > 0.8);  // 28 mm/s, felt as it comes: 2.8 mm, 1.1 of them lag
}

TEST_CASE("ticks that take no time, or no number of it, leave numbers in the flow of energy",
          "[stability]") {
    PassivityControl control;
    for (const double dt_s : {0.0, std::nan(""), -1.0}) control.skip_tick(dt_s);
    control.skip_tick(kTick_s);
    CHECK(control.flow().from_video_mw == 0.0);
    CHECK(std::isfinite(control.most_rise_mm(1.0)));
}

TEST_CASE("a controller that nothing moves, or that is not asked for, changes no bit",
          "[stability]") {
    const DepthImage image = test::flat(40, 30, 100.0);
    const DepthSurface surface(image, image, 0.0, {255.0, 0.0});
    TouchParameters parameters;
    parameters.coupling.damping_newton_s_per_m = 3.0;
    SafetyLimits asked;
    asked.stability = true;
    const DeviceLimits virtual_hand;
    REQUIRE_FALSE(held_limits(asked, virtual_hand).watched.moves());
    DeviceLimits moved;
    moved.dynamics = kDevice;
    REQUIRE(held_limits(asked, moved).watched == kDevice);
    REQUIRE_FALSE(held_limits(SafetyLimits{}, moved).watched.moves());

    TouchRenderer plain;
    TouchRenderer other;
    test::Dice dice(7);
    for (int k = 0; k < 3000; ++k) {
        const Vec3 goal{dice.uniform(5.0, 30.0), dice.uniform(5.0, 20.0),
                        dice.uniform(80.0, 105.0)};
        const Touch& a = plain.update(surface, goal, parameters, {}, {});
        const Touch& b =
            other.update(surface, goal, parameters, {}, held_limits(asked, virtual_hand));
        REQUIRE(a.spring_force_newton == b.spring_force_newton);
        REQUIRE(a.sent_force_newton == b.sent_force_newton);
    }
}

}  // namespace dibhr
