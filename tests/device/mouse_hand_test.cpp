// The virtual hand with the button up: it waits, follows the cursor, and stays clear of the
// surface.
#include "device/mouse_hand.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "tests/device/hand_in_loop.hpp"
#include "tests/support/catch.hpp"

namespace {

using Catch::Matchers::WithinAbs;
using dibhr::HandReading;
using dibhr::MouseHandOptions;

using dibhr::Vec3;
using dibhr::test::flat;
using dibhr::test::HandInLoop;
using dibhr::test::kPitch_mm;
using dibhr::test::SmallRelief;
using dibhr::test::wide;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kHover_px = MouseHandOptions{}.hover_px;

bool same(Vec3 a, Vec3 b) {
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

}  // namespace

TEST_CASE("the mouse is a device by that name with a force limit", "[mouse]") {
    const dibhr::MouseHand hand;
    CHECK(hand.specification().name == "mouse");
    CHECK(hand.specification().limits.max_force_newton > 0.0);
    CHECK(hand.specification().limits.max_stiffness_newton_per_mm >= 2.0);
}

TEST_CASE("until the cursor points, the hand waits above the middle, clear of the highest place",
          "[mouse]") {
    const SmallRelief relief(401, 301,
                             [](int i, int j) { return i == 3 && j == 7 ? 240.0 : 10.0; });
    HandInLoop loop(relief);
    const HandReading reading = loop.run(0.1);
    CHECK(reading.ready);
    CHECK(reading.buttons == 0);
    CHECK_THAT(reading.goal_in_grid.x, WithinAbs(200.0, 1e-9));
    CHECK_THAT(reading.goal_in_grid.y, WithinAbs(150.0, 1e-9));
    CHECK(reading.goal_in_grid.z >= 240.0 + kHover_px - 1e-9);
}

TEST_CASE("a hand that has nothing to point at any more goes back to waiting", "[mouse]") {
    HandInLoop loop(flat());
    loop.point_at(100.0, 100.0);
    loop.run(0.5);
    loop.cursor.pressed = true;
    loop.run(0.5);
    loop.cursor.pointing = false;
    const Vec3 goal = loop.run(0.6).goal_in_grid;
    CHECK_THAT(goal.x, WithinAbs(199.5, 0.01));
    CHECK(loop.depth_px(goal) <= -kHover_px + 0.01);
}

TEST_CASE("the hand comes to rest above the cursor at its hover height", "[mouse]") {
    const SmallRelief slope(400, 300, [](int i, int j) { return 0.3 * i + 0.2 * j; });
    HandInLoop loop(slope);
    loop.point_at(120.5, 80.25);
    const Vec3 goal = loop.run(0.6).goal_in_grid;
    CHECK_THAT(goal.x, WithinAbs(120.5, 0.01));
    CHECK_THAT(goal.y, WithinAbs(80.25, 0.01));
    CHECK_THAT(loop.depth_px(goal), WithinAbs(-kHover_px, 0.01));
}

TEST_CASE("the hand follows a jump of the cursor within a fifth of a second, without overshoot",
          "[mouse]") {
    HandInLoop loop(flat());
    loop.point_at(100.0, 150.0);
    loop.run(0.5);
    loop.point_at(200.0, 150.0);
    double furthest = 0.0;
    for (int k = 0; k < 200; ++k) furthest = std::max(furthest, loop.tick().goal_in_grid.x);
    CHECK_THAT(furthest, WithinAbs(200.0, 0.5));
    CHECK(furthest <= 200.0 + 1e-9);
}

TEST_CASE("a steadily moving cursor leads the hand by some 37 ms, whatever the tick", "[mouse]") {
    const double dt_s = GENERATE(0.0005, 0.001, 0.004);
    constexpr double kSpeed_px_per_s = 200.0;
    HandInLoop loop(flat(), 0.0, dt_s);
    loop.point_at(50.0, 150.0);
    loop.run(0.5);
    double x = 50.0;
    Vec3 goal{0.0};
    for (double t = 0.0; t < 1.0; t += dt_s) {
        x += kSpeed_px_per_s * dt_s;
        loop.point_at(x, 150.0);
        goal = loop.tick().goal_in_grid;
    }
    CHECK_THAT((x - goal.x) / kSpeed_px_per_s, WithinAbs(0.037, 0.002));
}

TEST_CASE("the hand rests where it waits and where the cursor stands, with the button up",
          "[mouse]") {
    HandInLoop loop(flat());
    loop.run(1.0);
    CHECK(loop.hand.rests());
    loop.point_at(100.0, 150.0);
    loop.tick();
    CHECK_FALSE(loop.hand.rests());
    loop.run(1.0);
    CHECK(loop.hand.rests());
    loop.cursor.pressed = true;
    loop.tick();
    CHECK_FALSE(loop.hand.rests());
    loop.run(2.0);
    CHECK_FALSE(loop.hand.rests());
    loop.cursor.pressed = false;
    loop.tick();
    CHECK_FALSE(loop.hand.rests());
    loop.run(1.0);
    CHECK(loop.hand.rests());
}

TEST_CASE("the main button is passed on", "[mouse]") {
    HandInLoop loop(flat());
    loop.point_at(100.0, 100.0);
    loop.cursor.pressed = true;
    CHECK(loop.tick().buttons == 1);
    loop.cursor.pressed = false;
    CHECK(loop.tick().buttons == 0);
}

TEST_CASE("a hovering hand never touches a still relief, however the cursor jumps over cliffs",
          "[mouse]") {
    const unsigned seed = GENERATE(1U, 2U, 3U);
    CAPTURE(seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> anywhere(-30.0, 430.0);
    const SmallRelief cliffs(400, 300, [&](int i, int j) {
        const bool needle = i % 90 == 45 && j % 2 == 0;
        return needle ? 250.0 : ((i / 40 + j / 40) % 3) * 100.0;
    });
    HandInLoop loop(cliffs);
    loop.run(0.01);
    double least_clearance = 1e9;
    for (int k = 0; k < 10000; ++k) {
        if (k % 100 == 0) loop.point_at(anywhere(random), anywhere(random));
        least_clearance = std::min(least_clearance, -loop.depth_px(loop.tick().goal_in_grid));
    }
    CHECK(least_clearance > 0.0);
}

TEST_CASE("a surface that rises takes a hovering hand along and does not touch it", "[mouse]") {
    dibhr::MouseHand hand;
    hand.target().publish({.cursor_in_grid = {20.0, 15.0}, .pointing = true});
    double least_clearance_px = 1e9;
    for (int tick = 0; tick < 3000; ++tick) {
        const double t_s = 0.001 * tick;  // up and down by 100 px, twice a second, and by noise
        const double elevation_px =
            80.0 + 50.0 * std::sin(12.566 * t_s) + 4.0 * std::sin(190.0 * t_s);
        const SmallRelief relief(40, 30, [&](int, int) { return elevation_px; });
        const HandReading reading = hand.read({0.001, relief.surface(), kPitch_mm});
        CHECK(reading.lifted);
        least_clearance_px = std::min(least_clearance_px, reading.goal_in_grid.z - elevation_px);
    }
    CHECK(least_clearance_px > 1.0);
}

TEST_CASE("a cliff or a needle on the way does not stop a hovering hand for long", "[mouse]") {
    const SmallRelief wall(400, 300, [](int i, int) { return i == 201 ? 250.0 : 10.0; });
    HandInLoop loop(wall);
    loop.point_at(100.0, 150.0);
    loop.run(0.5);
    loop.point_at(300.0, 150.0);
    CHECK_THAT(loop.run(0.8).goal_in_grid.x, WithinAbs(300.0, 0.5));
}

TEST_CASE("however far the cursor jumps, the goal moves at a hand's speed at most", "[mouse]") {
    const double dt_s = GENERATE(0.001, 0.02);
    const bool pressed = GENERATE(false, true);
    CAPTURE(dt_s, pressed);
    HandInLoop loop(wide(), 0.5, dt_s);
    loop.point_at(10.0, 10.0);
    loop.run(1.0);
    loop.cursor.pressed = pressed;
    Vec3 last = loop.run(0.5).goal_in_grid;
    double fastest_mm_per_ms = 0.0;
    for (int k = 0; k < 4000; ++k) {
        if (k % 1000 == 0) loop.point_at(k % 2000 == 0 ? 2990.0 : 5.0, 5.0);
        const Vec3 goal = loop.tick().goal_in_grid;
        fastest_mm_per_ms =
            std::max(fastest_mm_per_ms, glm::distance(goal, last) * kPitch_mm / (1000.0 * dt_s));
        last = goal;
    }
    CHECK(fastest_mm_per_ms <= 3.0 + 1e-6);
    CHECK(fastest_mm_per_ms > 1.0);
}

TEST_CASE("the hovering hand stays over the image when the cursor leaves it", "[mouse]") {
    HandInLoop loop(flat());
    loop.point_at(1000.0, -500.0);
    const Vec3 goal = loop.run(1.0).goal_in_grid;
    CHECK_THAT(goal.x, WithinAbs(399.0, 0.01));
    CHECK_THAT(goal.y, WithinAbs(0.0, 0.01));
}

TEST_CASE("a cursor that is no number is not followed", "[mouse]") {
    HandInLoop loop(flat());
    loop.point_at(100.0, 100.0);
    const Vec3 before = loop.run(1.0).goal_in_grid;
    loop.point_at(kNan, 100.0);
    const Vec3 after = loop.run(0.2).goal_in_grid;
    CHECK_THAT(glm::distance(before, after), WithinAbs(0.0, 1e-3));
}

TEST_CASE("a force that is no number moves nothing", "[mouse]") {
    const bool not_a_number = GENERATE(true, false);
    const double bad = not_a_number ? kNan : std::numeric_limits<double>::infinity();
    HandInLoop pushed(flat());
    HandInLoop alone(flat());
    pushed.point_at(100.0, 100.0);
    pushed.run(0.05);
    alone.point_at(100.0, 100.0);
    alone.run(0.05);
    pushed.hand.send({0.0, bad, 0.0});
    CHECK(same(pushed.tick().goal_in_grid, alone.tick().goal_in_grid));
}

TEST_CASE("a tick of no length, or of no sensible length, leaves the hand where it is", "[mouse]") {
    const double dt_s = GENERATE(0.0, -1.0, kNan);
    const SmallRelief relief = flat();
    dibhr::MouseHand hand;
    const Vec3 before = hand.read({0.001, relief.surface(), kPitch_mm}).goal_in_grid;
    hand.target().publish({.cursor_in_grid = {10.0, 10.0}, .pointing = true});
    CHECK(same(hand.read({dt_s, relief.surface(), kPitch_mm}).goal_in_grid, before));
}
