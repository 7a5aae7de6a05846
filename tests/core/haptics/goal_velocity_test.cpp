// The velocity that is damped: plain or filtered, and never another hand's.
#include "core/haptics/touch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <glm/geometric.hpp>

#include "tests/core/haptics/surfaces.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

constexpr double kTick_s = 0.001;

double time_constant_s(double cutoff_hz) {
    return 1.0 / (2.0 * std::numbers::pi * cutoff_hz);
}

/// A filter at rest.
GoalVelocity resting() {
    GoalVelocity velocity;
    static_cast<void>(velocity.after(Vec3(0.0), kTick_s, 0.0));
    return velocity;
}

/// The time at which the velocity of a hand that starts at once reaches 1 - 1/e, interpolated.
double rise_time_s(double cutoff_hz, double dt_s) {
    constexpr double kSpeed = 300.0;
    const double wanted = kSpeed * (1.0 - std::exp(-1.0));
    GoalVelocity velocity = resting();
    double before = 0.0;
    for (int n = 1; n < 100000; ++n) {
        const double now = velocity.after({kSpeed * dt_s, 0.0, 0.0}, dt_s, cutoff_hz).x;
        if (now >= wanted) return (n - 1 + (wanted - before) / (now - before)) * dt_s;
        before = now;
    }
    return 0.0;
}

/// Peak to peak of the velocity when a goal's steady motion comes as one step every `ticks`.
double ripple(int ticks, double cutoff_hz) {
    GoalVelocity velocity = resting();
    double lowest = 1e300;
    double highest = -1e300;
    for (int n = 0; n < 3000; ++n) {
        const double step = n % ticks == 0 ? 0.4 : 0.0;
        const double now = velocity.after({0.0, 0.0, step}, kTick_s, cutoff_hz).z;
        if (n < 2000) continue;
        lowest = std::min(lowest, now);
        highest = std::max(highest, now);
    }
    return highest - lowest;
}

/// A hand that slides over flat ground, 10 px deep and without friction: its force across is the
/// damper's alone, but for the way that the proxy lags behind.
class SlidingHand {
  public:
    explicit SlidingHand(double cutoff_hz, double damping_newton_s_per_m = 20.0) {
        parameters.friction = {0.0, 0.0};
        parameters.coupling.damping_newton_s_per_m = damping_newton_s_per_m;
        parameters.coupling.damping_cutoff_hz = cutoff_hz;
    }

    const Touch& update(Vec3 goal, SafetyInput input = {}) {
        return renderer.update(surface_, goal, parameters, input, {});
    }

    /// Moves on at 500 px/s; returns the goal.
    Vec3 slide(int ticks) {
        for (int k = 0; k < ticks; ++k) {
            goal_.x += 0.5;
            update(goal_);
        }
        return goal_;
    }

    /// The damper's part of the force [N].
    [[nodiscard]] Vec3 damper_newton(const Touch& touch) const {
        const Vec3 spring = coupling_force(touch.proxy, touch.goal, Vec3(0.0), parameters.coupling);
        return touch.spring_force_newton - spring;
    }

    TouchParameters parameters{};
    TouchRenderer renderer{};

  private:
    DepthImage image_{test::flat(200, 40, 100.0)};
    DepthSurface surface_{image_, image_, 0.0, {255.0, 0.0}};
    Vec3 goal_{10.0, 20.0, 90.0};
};

/// Events between two goals after which their difference is not a motion of the hand.
struct Interruption {
    const char* name;
    void (*happens)(SlidingHand& hand, SafetyInput& next);
};

}  // namespace

TEST_CASE("without a cutoff frequency the velocity is the plain difference, bit by bit",
          "[velocity]") {
    const double none_hz = GENERATE(0.0, -5.0, std::nan(""));
    GoalVelocity velocity;
    test::Dice dice(3);
    for (int k = 0; k < 5000; ++k) {
        const Vec3 step{dice.uniform(-9.0, 9.0), dice.uniform(-1.0, 1.0), dice.uniform(-1e9, 1e9)};
        const double dt_s = k % 50 == 0 ? 0.0 : dice.uniform(1e-5, 0.05);
        if (k % 70 == 0) velocity.forget();
        const Vec3 expected = dt_s > 0.0 ? step / dt_s : Vec3(0.0);
        REQUIRE(velocity.after(step, dt_s, none_hz) == expected);
    }
}

TEST_CASE("a steady speed is not changed by the filter, whatever the ticks", "[velocity]") {
    const double cutoff_hz = GENERATE(1.0, 50.0, 800.0);
    const Vec3 speed{300.0, -20.0, 0.5};
    GoalVelocity velocity = resting();
    test::Dice dice(5);
    Vec3 now(0.0);
    for (int k = 0; k < 8000; ++k) {
        const double dt_s = dice.uniform(0.0002, 0.003);
        now = velocity.after(speed * dt_s, dt_s, cutoff_hz);
    }
    CHECK_THAT(now.x, WithinRel(speed.x, 1e-9));
    CHECK_THAT(now.y, WithinRel(speed.y, 1e-9));
    CHECK_THAT(now.z, WithinRel(speed.z, 1e-9));
}

TEST_CASE("a sudden speed is felt to 63 % after 1 / (2 pi cutoff), at 1 kHz and at 500 Hz",
          "[velocity]") {
    const double dt_s = GENERATE(0.001, 0.002);
    SECTION("of a slow filter, within a fiftieth") {
        const double cutoff_hz = GENERATE(0.5, 2.0);
        CHECK_THAT(rise_time_s(cutoff_hz, dt_s), WithinRel(time_constant_s(cutoff_hz), 0.02));
    }
    SECTION("of a fast one, within a tick") {
        const double cutoff_hz = GENERATE(10.0, 50.0, 200.0);
        CHECK_THAT(rise_time_s(cutoff_hz, dt_s), WithinAbs(time_constant_s(cutoff_hz), dt_s));
    }
}

TEST_CASE("the ripple of a goal that comes in steps falls by the filter's own factor",
          "[velocity]") {
    // Each step is a pulse of the plain velocity, every `ticks` ticks: a geometric series.
    const double cutoff_hz = GENERATE(20.0, 50.0, 120.0);
    const int ticks = GENERATE(2, 10, 50);
    CAPTURE(cutoff_hz, ticks);
    const double share = kTick_s / (kTick_s + time_constant_s(cutoff_hz));
    const double kept = 1.0 - share;
    const double factor = share * (1.0 - std::pow(kept, ticks - 1)) / (1.0 - std::pow(kept, ticks));
    CHECK_THAT(ripple(ticks, cutoff_hz) / ripple(ticks, 0.0), WithinRel(factor, 1e-9));
    if (cutoff_hz <= 50.0) CHECK(factor < 0.25);
}

TEST_CASE("no velocity is left behind that is not a number, and no time changes nothing",
          "[velocity]") {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    GoalVelocity velocity = resting();
    const Vec3 step{0.3, 0.1, -0.2};
    Vec3 before(0.0);
    for (int k = 0; k < 20; ++k) before = velocity.after(step, kTick_s, 50.0);
    for (const double dt_s : {0.0, -1.0, std::nan("")}) {
        CHECK(velocity.after(Vec3(0.0), dt_s, 50.0) == before);
    }
    const auto odd = GENERATE_COPY(std::pair{step, kInfinity}, std::pair{Vec3(1e300), 1e-300},
                                   std::pair{Vec3(0.0, kInfinity, 0.0), kTick_s});
    CHECK(velocity.after(odd.first, odd.second, 50.0) == Vec3(0.0));
    CHECK(velocity.after(step, kTick_s, 50.0) == Vec3(0.0));
    CHECK(velocity.after(step, kTick_s, 50.0).x > 0.0);
}

TEST_CASE("sliding steadily, a filtered damper holds back as much as a plain one", "[coupling]") {
    SlidingHand plain(0.0);
    SlidingHand filtered(50.0);
    plain.slide(200);
    filtered.slide(200);
    const Vec3 goal{110.5, 20.0, 90.0};
    const Vec3 expected = plain.update(goal).spring_force_newton;
    CHECK(expected.x < -1.0);
    CHECK_THAT(glm::distance(filtered.update(goal).spring_force_newton, expected),
               WithinAbs(0.0, 1e-9));
}

TEST_CASE("with a cutoff of 0 the force is the spring's and the plain damper's, bit by bit",
          "[coupling]") {
    SlidingHand hand(0.0, 3.0);
    test::Dice dice(11);
    Vec3 before{50.0, 20.0, 90.0};
    hand.update(before);
    for (int k = 0; k < 2000; ++k) {
        const Vec3 goal = before + Vec3{dice.uniform(-1.0, 1.0), 0.0, dice.uniform(-1.0, 1.0)};
        const SafetyInput input{.dt_s = dice.uniform(0.0005, 0.003), .from_zero = k % 300 == 0};
        const Touch& touch = hand.update(goal, input);
        const Vec3 velocity = (goal - before) / input.dt_s;
        REQUIRE(touch.spring_force_newton ==
                coupling_force(touch.proxy, goal, velocity, hand.parameters.coupling));
        before = goal;
    }
}

TEST_CASE("what is no motion of the hand is not damped, then or afterwards", "[coupling]") {
    SlidingHand hand(50.0);
    const Vec3 before = hand.slide(100);
    const Vec3 elsewhere = before + Vec3{3.0, 5.0, -2.0};
    REQUIRE(glm::length(hand.damper_newton(hand.update(before + Vec3{0.5, 0.0, 0.0}))) > 1.0);
    SafetyInput input;
    const auto interruption = GENERATE(values<Interruption>({
        {"a force from zero: a seek, other parameters, another hand",
         [](SlidingHand&, SafetyInput& next) { next.from_zero = true; }},
        {"another algorithm",
         [](SlidingHand& at, SafetyInput&) { at.parameters.algorithm = Algorithm::god_object; }},
        {"a goal that was no number, for two ticks",
         [](SlidingHand& at, SafetyInput&) {
             at.update(Vec3(std::nan("")));
             at.update(Vec3(std::nan("")));
         }},
        {"no time has passed", [](SlidingHand&, SafetyInput& next) { next.dt_s = 0.0; }},
        {"a pause without a surface", [](SlidingHand& at, SafetyInput&) { at.renderer.pause(); }},
        {"a renderer that was reset", [](SlidingHand& at, SafetyInput&) { at.renderer.reset(); }},
    }));
    CAPTURE(interruption.name);
    interruption.happens(hand, input);
    Touch touch = hand.update(elsewhere, input);
    for (int k = 0; k < 50; ++k) {
        REQUIRE(hand.damper_newton(touch) == Vec3(0.0));
        REQUIRE(touch.proxy.contact);
        touch = hand.update(elsewhere);
    }
    touch = hand.update(elsewhere + Vec3{0.5, 0.0, 0.0});
    CHECK(hand.damper_newton(touch).x < 0.0);
}

TEST_CASE("a jump is not damped, and what moves on after it is", "[coupling]") {
    SlidingHand hand(50.0);
    const Vec3 before = hand.slide(40);
    const Vec3 far = before + Vec3{100.0, 0.0, 0.0};  // 14 mm
    const Touch jumped = hand.update(far);
    REQUIRE(jumped.cut == SafetyCut::goal_jump);
    CHECK(hand.damper_newton(jumped) == Vec3(0.0));
    const Touch still = hand.update(far);
    CHECK(hand.damper_newton(still) == Vec3(0.0));
    CHECK(hand.damper_newton(hand.update(far + Vec3{0.5, 0.0, 0.0})).x < 0.0);
}

TEST_CASE("the filter runs in the air too: a fast hand is damped from its first contact on",
          "[coupling]") {
    SlidingHand hand(50.0);
    Vec3 goal{50.0, 20.0, 130.0};
    Touch touch = hand.update(goal);
    for (int k = 0; k < 100 && !touch.proxy.contact; ++k) {
        goal.z -= 0.8;
        touch = hand.update(goal);
    }
    REQUIRE(touch.proxy.contact);
    const double plain_newton = 20.0 * 1e-3 * hand.parameters.coupling.pixel_pitch_mm * 800.0;
    CHECK_THAT(hand.damper_newton(touch).z, WithinRel(plain_newton, 0.01));
}
