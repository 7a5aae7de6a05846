// The virtual hand with the button down: pressed in, pushed back, stable, and gentle at cliffs.
#include <algorithm>
#include <cmath>

#include "core/haptics/touch.hpp"
#include "device/mouse_hand.hpp"
#include "tests/device/hand_in_loop.hpp"
#include "tests/support/catch.hpp"

namespace {

using Catch::Matchers::WithinAbs;
using dibhr::MouseHandOptions;
using dibhr::Vec3;
using dibhr::test::cliff;
using dibhr::test::flat;
using dibhr::test::HandInLoop;
using dibhr::test::kPitch_mm;

constexpr MouseHandOptions kOptions{};

/// Hovering at rest above (100, 150).
void settle(HandInLoop& loop) {
    loop.point_at(100.0, 150.0);
    loop.run(0.6);
}

}  // namespace

TEST_CASE("the longer the button is held the deeper the hand goes, to a limit", "[mouse]") {
    HandInLoop loop(flat());
    settle(loop);
    loop.cursor.pressed = true;
    double last = loop.depth_px(loop.run(0.1).goal_in_grid);
    for (int k = 0; k < 5; ++k) {
        const double depth = loop.depth_px(loop.run(0.1).goal_in_grid);
        CHECK(depth > last + 3.0);
        last = depth;
    }
    CHECK_THAT(loop.depth_px(loop.run(2.0).goal_in_grid), WithinAbs(kOptions.deepest_px, 0.01));
}

TEST_CASE("the wheel presses deeper at once, and never pulls", "[mouse]") {
    HandInLoop loop(flat());
    settle(loop);
    loop.cursor.pressed = true;
    loop.run(2.0);
    loop.cursor.wheel_px = 15.0;
    CHECK_THAT(loop.depth_px(loop.run(0.4).goal_in_grid),
               WithinAbs(kOptions.deepest_px + 15.0, 0.01));
    loop.cursor.wheel_px = -15.0;
    CHECK_THAT(loop.depth_px(loop.run(0.4).goal_in_grid), WithinAbs(kOptions.deepest_px, 0.01));
}

TEST_CASE("a released hand comes off the surface whatever pulls it, and says that it is lifted",
          "[mouse]") {
    HandInLoop loop(flat(), 0.5);
    settle(loop);
    loop.cursor.pressed = true;
    CHECK_FALSE(loop.run(1.0).lifted);
    loop.cursor.pressed = false;
    dibhr::HandReading reading;
    for (int k = 0; k < 500; ++k) {
        loop.hand.send({3.0, 0.0, -3.0});  // a proxy held back under an overhang
        reading = loop.tick();
    }
    CHECK(reading.lifted);
    CHECK(loop.depth_px(reading.goal_in_grid) < 0.0);
}

TEST_CASE("a released hand is back at its hover height within a quarter of a second", "[mouse]") {
    HandInLoop loop(flat(), 0.5);
    settle(loop);
    loop.cursor.pressed = true;
    loop.run(2.0);
    loop.cursor.pressed = false;
    CHECK_THAT(loop.depth_px(loop.run(0.25).goal_in_grid), WithinAbs(-kOptions.hover_px, 0.1));
}

TEST_CASE("against a surface of stiffness k the pressed hand rests at h / (h + k) of its depth",
          "[mouse]") {
    const double k = GENERATE(0.1, 0.25, 0.5, 1.0, 2.0);
    const double dt_s = GENERATE(0.001, 0.005);
    CAPTURE(k, dt_s);
    const double h = kOptions.hand_stiffness_newton_per_mm;
    HandInLoop loop(flat(), k, dt_s);
    settle(loop);
    loop.cursor.pressed = true;
    const double depth = loop.depth_px(loop.run(2.5).goal_in_grid);
    CHECK_THAT(depth, WithinAbs(kOptions.deepest_px * h / (h + k), 0.01));
}

TEST_CASE("pressing on a surface as stiff as the hand gives one to two newtons", "[mouse]") {
    HandInLoop loop(flat(), 0.5);
    settle(loop);
    loop.cursor.pressed = true;
    const double depth = loop.depth_px(loop.run(2.0).goal_in_grid);
    CHECK(depth >= 10.0);
    CHECK(depth <= 20.1);
    CHECK(0.5 * kPitch_mm * depth >= 1.0);
    CHECK(0.5 * kPitch_mm * depth <= 2.0);
}

TEST_CASE("the loop of hand and surface is stable for ticks up to 20 ms and 2 N/mm", "[mouse]") {
    const double k = GENERATE(0.1, 0.5, 1.0, 2.0, 10.0);
    const double longest_s = k > 2.0 ? 0.010 : 0.020;  // 10 N/mm is the most that can be asked for
    const double dt_s =
        std::min(GENERATE(0.0005, 0.001, 0.002, 0.005, 0.010, 0.015, 0.020), longest_s);
    CAPTURE(dt_s, k);
    HandInLoop loop(flat(), k, dt_s);
    settle(loop);
    loop.cursor.pressed = true;
    loop.run(3.0);
    double least = 1e9;
    double most = -1e9;
    for (int n = 0; n < 50; ++n) {
        const double depth = loop.depth_px(loop.tick().goal_in_grid);
        least = std::min(least, depth);
        most = std::max(most, depth);
    }
    CHECK(most - least < 1e-3);
    CHECK(least > 0.0);
}

TEST_CASE("a sideways force leans the pressed hand against the cursor by force over stiffness",
          "[mouse]") {
    HandInLoop loop(flat());
    settle(loop);
    loop.cursor.pressed = true;
    Vec3 goal{0.0};
    for (int n = 0; n < 2000; ++n) {
        goal = loop.tick().goal_in_grid;
        loop.hand.send({-1.0, 0.0, 0.0});
    }
    const double lean_px = 1.0 / kOptions.hand_stiffness_newton_per_mm / kPitch_mm;
    CHECK_THAT(goal.x, WithinAbs(100.0 - lean_px, 0.01));
}

TEST_CASE("a press far from the hand begins only when the hand has come there", "[mouse]") {
    HandInLoop loop({3000, 20, [](int, int) { return 20.0; }});
    loop.point_at(10.0, 10.0);
    loop.run(1.5);
    loop.point_at(2900.0, 10.0);
    loop.cursor.pressed = true;
    bool arrived = false;
    for (int n = 0; n < 2000; ++n) {
        const Vec3 goal = loop.tick().goal_in_grid;
        arrived = goal.x > 2894.0;
        if (!arrived) REQUIRE(loop.depth_px(goal) < 0.0);
    }
    CHECK(arrived);
    CHECK_THAT(loop.depth_px(loop.tick().goal_in_grid), WithinAbs(kOptions.deepest_px, 0.1));
}

TEST_CASE("a drag up a cliff ends at the same depth on top, and does not stay buried", "[mouse]") {
    HandInLoop loop(cliff(20.0, 170.0));
    settle(loop);
    loop.cursor.pressed = true;
    loop.run(2.0);
    loop.point_at(300.0, 150.0);
    double buried_s = 0.0;
    for (int n = 0; n < 500; ++n) {
        if (loop.depth_px(loop.tick().goal_in_grid) > 2.0 * kOptions.deepest_px) buried_s += 0.001;
    }
    CHECK(buried_s < 0.08);
    CHECK_THAT(loop.depth_px(loop.run(0.3).goal_in_grid), WithinAbs(kOptions.deepest_px, 0.1));
}

TEST_CASE("a drag down a cliff never lifts the hand far off the surface for long", "[mouse]") {
    HandInLoop loop(cliff(170.0, 20.0), 0.5);
    settle(loop);
    loop.cursor.pressed = true;
    loop.run(2.0);
    loop.point_at(300.0, 150.0);
    loop.run(0.4);
    CHECK(loop.depth_px(loop.run(0.1).goal_in_grid) > 10.0);
}

TEST_CASE("the pressed hand may lean against the image's border, not run away from it", "[mouse]") {
    HandInLoop loop(flat());
    loop.point_at(395.0, 150.0);
    loop.run(0.6);
    loop.cursor.pressed = true;
    loop.run(0.5);
    loop.point_at(5000.0, 150.0);
    const double x = loop.run(1.0).goal_in_grid.x;
    CHECK(x > 399.0);
    CHECK(x < 450.0);
}

TEST_CASE("through the whole touch, safety stage included, the pressed hand comes to rest",
          "[mouse]") {
    const double k = GENERATE(0.5, 2.0);
    CAPTURE(k);
    const auto relief = flat();
    const auto surface = relief.surface();
    dibhr::MouseHand hand;
    dibhr::TouchRenderer touch;
    dibhr::TouchParameters parameters;
    parameters.coupling.stiffness_newton_per_mm = k;
    const dibhr::SafetyLimits limits;
    Vec3 goal{0.0};
    for (int n = 0; n < 4000; ++n) {
        hand.target().publish(
            {.cursor_in_grid = {100.0, 150.0}, .pointing = true, .pressed = n > 800});
        goal = hand.read({0.001, surface, kPitch_mm}).goal_in_grid;
        const auto& felt = touch.update(surface, goal, parameters, {}, limits);
        REQUIRE(felt.cut == dibhr::SafetyCut::none);
        hand.send(felt.sent_force_newton);
    }
    const double h = kOptions.hand_stiffness_newton_per_mm;
    CHECK_THAT(20.0 - goal.z, WithinAbs(kOptions.deepest_px * h / (h + k), 0.05));
}
