// Whether motion found in noisy and coded pictures carries a finger like the true motion.
#include "tests/bench/carried.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "tests/support/catch.hpp"
#include "tests/support/some_of.hpp"

namespace dibhr::bench {

namespace {

using test::MovingScene;
using Shape = MovingScene::Shape;
using Goes = MovingScene::Goes;

struct Seen {
    Shape shape;
    Goes goes;
    double px_per_s, frames_per_s;
};

CarriedFinger finger_on(const Seen& seen, Filming filming) {
    filming.frames_per_s = seen.frames_per_s;
    return carried_finger(MovingScene({seen.shape, seen.goes, seen.px_per_s, 320, 240}), filming);
}

}  // namespace

TEST_CASE("a finger on what moves in a video ends at its material point, dragged as by the truth",
          "[carried][long]") {
    const Seen seen = GENERATE(some_of<Seen>({{Shape::hand, Goes::along, 50.0, 30.0},
                                              {Shape::plane, Goes::along, 200.0, 15.0},
                                              {Shape::sphere, Goes::along, 100.0, 60.0},
                                              {Shape::plane, Goes::round, 200.0, 30.0},
                                              {Shape::sphere, Goes::apart, 50.0, 15.0}},
                                             1));
    CAPTURE(static_cast<int>(seen.shape), static_cast<int>(seen.goes), seen.px_per_s);
    const CarriedFinger felt = finger_on(seen, {});
    REQUIRE(felt.fingers >= 3);
    CHECK(felt.astray_px < 2.0);
    CHECK(felt.turned_deg < 5.0);
    CHECK(felt.drag_share > 0.9);
    CHECK(felt.drag_share < 1.1);
}

TEST_CASE("true motion carries a finger without drift, though updates fall on frames",
          "[carried][long]") {
    const CarriedFinger felt =  // every fortieth update
        finger_on({Shape::plane, Goes::along, 200.0, 25.0},
                  {.seconds = 0.5, .coded = false, .found = false});
    CHECK(felt.worst_astray_px < 0.01);
}

TEST_CASE("true motion carries fingers on a disc of any look and size, and exposure is seen",
          "[carried][long]") {
    using Look = MovingScene::Look;
    const double diameter_px = GENERATE(30.0, 60.0);
    const Look look = GENERATE(Look::plain, Look::shaded);
    const MovingScene scene({.shape = Shape::disc,
                             .speed_px_per_s = 150.0,
                             .columns = 320,
                             .rows = 240,
                             .look = look,
                             .diameter_px = diameter_px});
    const std::array times_s{0.25, 0.5};
    const std::vector<Astray> astray =
        astray_after(scene, {.coded = false, .found = false}, times_s);
    REQUIRE(astray.size() == 2);
    for (const Astray& each : astray) {
        CHECK(each.fingers >= 3);
        CHECK(each.worst_px < 0.05);
    }
    constexpr double kBrightest_s = 0.125;
    const Frame even = scene.frame(kBrightest_s);
    const Frame bright = scene.frame(kBrightest_s, {.exposure = 0.25});
    CHECK(std::abs(bright.colour->rgb[0] - std::min(1.25 * even.colour->rgb[0], 255.0)) <= 1.0);
}

TEST_CASE("fingers on things without texture are carried, whatever their size and the exposure",
          "[carried][long]") {
    using Look = MovingScene::Look;
    const Look look = GENERATE(Look::plain, Look::shaded);
    const double diameter_px = GENERATE(some_of<double>({30.0, 60.0, 120.0}, 1));
    const double px_per_s = GENERATE(some_of<double>({60.0, 150.0}, 1));
    const double exposure = GENERATE(0.0, 0.25);
    CAPTURE(static_cast<int>(look), diameter_px, px_per_s, exposure);
    const MovingScene scene({.shape = Shape::disc,
                             .speed_px_per_s = px_per_s,
                             .columns = 480,
                             .rows = 270,
                             .look = look,
                             .diameter_px = diameter_px});
    const std::array times_s{0.25, 1.0};
    const std::vector<Astray> astray = astray_after(scene, {.exposure = exposure}, times_s);
    REQUIRE(astray.back().fingers >= 3);
    CHECK(astray.front().median_px < 1.0);
    CHECK(astray.back().median_px < 2.0);
    CHECK(astray.back().worst_px < 3.0);
}

TEST_CASE("a finger that nothing carries stays behind, and feels no drag", "[carried][long]") {
    const CarriedFinger felt = finger_on({Shape::plane, Goes::along, 100.0, 30.0},
                                         {.seconds = 0.5, .coded = false, .carry = false});
    CHECK(felt.astray_px > 20.0);
    CHECK(felt.drag_share < 0.1);
}

}  // namespace dibhr::bench
