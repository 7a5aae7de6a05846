// Distances between two points on the relief.
#include <optional>
#include <string>

#include "app/panels/panels.hpp"
#include "tests/app/program/command_program.hpp"
#include "tests/app/program/desk.hpp"
#include "tests/app/program/passing_ticks.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr;
using namespace dibhr::test;

TEST_CASE("a ruler says how far two points are apart, in pixels, under the hand and in the file",
          "[ruler]") {
    ViewerState state;
    state.settings.touch.coupling.pixel_pitch_mm = 0.5;
    state.ui.ruler.emplace();
    CHECK(contains(ruler_text(state), "click two points"));
    state.ui.ruler->ends = {{.column = 10, .row = 20, .nearness = 0.25, .elevation_px = 5.0}};
    CHECK(contains(ruler_text(state), "the other point"));
    state.ui.ruler->ends.push_back(
        {.column = 13, .row = 24, .nearness = 0.75, .elevation_px = 17.0});
    CHECK(ruler_text(state) == "Ruler   13.0 px, 6.50 mm under the hand");
    DepthMeaning meaning;
    meaning.unit.value = DepthUnit::mm;
    meaning.scale.value = 1.0;
    meaning.range.value = {500.0, 1500.0};
    state.media.meaning = meaning;
    CHECK(contains(ruler_text(state), "500 mm of depth"));
    state.ui.ruler->ends[1].unseen = true;
    CHECK(contains(ruler_text(state), "no data"));
}

TEST_CASE("each click of a ruler sets a point, and the third begins anew", "[ruler]") {
    Ruler ruler;
    const Vec3 first{1.0, 2.0, 3.0};
    const Vec3 second{4.0, 5.0, 6.0};
    for (int pictures = 0; pictures < 3; ++pictures) ruler.press(true, first);
    CHECK(ruler.places.size() == 1);
    ruler.press(false, second);
    ruler.press(true, std::nullopt);
    ruler.press(false, second);
    CHECK(ruler.places.size() == 1);
    ruler.press(true, second);
    CHECK(ruler.places.size() == 2);
    ruler.press(false, first);
    ruler.press(true, second);
    REQUIRE(ruler.places.size() == 1);
    CHECK(ruler.places[0] == second);
}

TEST_CASE("a click of the ruler touches nothing, and one after it does", "[ruler]") {
    const Desk desk;
    const TemporaryFolder folder;
    write_depth_png(folder / "slope_depth.png", 64, 48, 100, 2);
    WindowProgram viewer =
        desk.start_viewer(folder, {"slope_depth.png", "--raw-depth", "--device", "mouse", "--size",
                                   "640x480", "--record", "hand.dibhr"});
    viewer.wait_for_surface();
    const auto click = [&viewer] {
        viewer.act("mousedown 1");
        wait_for_ticks(viewer, kTicksToRest);  // long enough to be felt
        viewer.act("mouseup 1");
    };
    viewer.act("mousemove 170 240 key n");
    REQUIRE(viewer.seen().ruler);
    click();
    CHECK(viewer.seen().ruler_points == 1);
    viewer.act("mousemove 190 250");
    click();
    CHECK(viewer.seen().ruler_points == 2);
    CHECK_FALSE(viewer.seen().contact);
    viewer.act("key n");
    CHECK_FALSE(viewer.seen().ruler);
    click();
    desk.press("key q");
    REQUIRE(viewer.wait() == 0);
    int presses = 0;
    bool before = false;
    for (const Row& row : read_session(folder / "hand.dibhr")) {
        if (row.pressed && !before) ++presses;
        before = row.pressed;
    }
    CHECK(presses == 1);
}
