// Clicks and key presses that come while the window draws nothing: none is lost. The toolbar, and
// keys that an open list takes.
#include <algorithm>
#include <string>
#include <vector>

#include "tests/app/program/command_program.hpp"
#include "tests/app/program/desk.hpp"
#include "tests/app/program/passing_ticks.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr;
using namespace dibhr::test;

namespace {

/// A window over a plane that stands still; its relief is 352 px wide.
WindowProgram view_slope(const Desk& desk, const TemporaryFolder& folder,
                         const std::vector<std::string>& options) {
    write_depth_png(folder / "slope_depth.png", 64, 48, 100, 2);
    std::vector<std::string> arguments{"slope_depth.png", "--raw-depth", "--device",
                                       "mouse",           "--size",      "640x480"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return desk.start_viewer(folder, arguments);
}

// The places of buttons in the window as it starts, 1280 x 800.
constexpr const char* kPlayTool = "mousemove 23 338 click 1";
constexpr const char* kRulerTool = "mousemove 23 467 click 1";
constexpr const char* kCleaningList = "mousemove 1150 285 click 1";

}  // namespace

TEST_CASE("taps within one picture are all felt, each at its place, in their order", "[clicks]") {
    const Desk desk;
    const TemporaryFolder folder;
    WindowProgram viewer = view_slope(desk, folder, {"--record", "hand.dibhr"});
    viewer.wait_for_surface();
    viewer.act("mousemove 100 240");
    wait_for_ticks(viewer, kTicksToRest);
    act_in_one_picture(desk, viewer,
                       "click 1 mousemove 170 240 click 1 mousemove 240 240 click 1 mousemove 130 "
                       "240 click 1");
    wait_for_ticks(viewer, 10 * kTicksToRest);
    desk.press("key q");
    REQUIRE(viewer.wait() == 0);
    std::vector<double> columns;
    bool before = false;
    for (const Row& row : read_session(folder / "hand.dibhr")) {
        if (row.contact && !before) columns.push_back(row.proxy.x);
        before = row.contact;
    }
    REQUIRE(columns.size() == 4);
    CHECK(columns[0] < columns[3]);
    CHECK(columns[3] < columns[1]);
    CHECK(columns[1] < columns[2]);
    require_same_bits(folder, folder / "hand.dibhr");
}

TEST_CASE("every click of the ruler counts, and every press of a key", "[clicks]") {
    const Desk desk;
    const TemporaryFolder folder;
    WindowProgram viewer = view_slope(desk, folder, {});
    viewer.wait_for_surface();
    viewer.act("mousemove 170 240 key n");
    REQUIRE(viewer.seen().ruler);
    act_in_one_picture(desk, viewer,
                       "click 1 mousemove 190 240 click 1 mousemove 200 240 click 1 mousemove 210 "
                       "240 click 1 mousemove 180 240 click 1");
    viewer.wait_until([](const Seen& now) { return now.ruler_points == 1; });
    viewer.act("key n");
    act_in_one_picture(desk, viewer, "key ctrl+r", 3);
    viewer.wait_until([](const Seen& now) { return now.records && now.recorded_rows > 10; });
    desk.press("key q");
    REQUIRE(viewer.wait() == 0);
    const auto is_session = [](const std::string& name) { return name.ends_with(".dibhr"); };
    CHECK(std::ranges::count_if(names_in(folder.path()), is_session) == 2);
}

TEST_CASE("keys and characters within one picture act in their order", "[clicks]") {
    const Desk desk;
    const TemporaryFolder folder;
    WindowProgram viewer = desk.start_viewer(folder, {"--device", "mouse", "--pause"});
    viewer.wait_for_surface();
    viewer.act("mousemove 300 400");
    // A step has a character, Home has none.
    act_in_one_picture(desk, viewer, "key Home key period");
    viewer.wait_until([](const Seen& now) { return now.drawn_frame == 1; });
    act_in_one_picture(desk, viewer, "key period key Home");
    viewer.wait_until([](const Seen& now) { return now.drawn_frame == 0; });
    CHECK(viewer.seen().media_s == 0.0);
    desk.press("key q");
    CHECK(viewer.wait() == 0);
}

TEST_CASE("an open list takes the keys, and Esc closes it", "[clicks]") {
    const Desk desk;
    const TemporaryFolder folder;
    WindowProgram viewer = desk.start_viewer(folder, {"--device", "mouse", "--pause"});
    viewer.wait_for_surface();
    viewer.act(kCleaningList);
    viewer.wait_for_turn();
    viewer.act("key i key space");
    CHECK_FALSE(viewer.seen().statistics);
    CHECK_FALSE(viewer.seen().playing);
    viewer.act("key Escape");
    viewer.wait_for_turn();
    viewer.act("key i");
    CHECK(viewer.seen().statistics);
}

TEST_CASE("the toolbar's pictures do what their keys do, and hide with the panels", "[clicks]") {
    const Desk desk;
    const TemporaryFolder folder;
    WindowProgram viewer = desk.start_viewer(folder, {"--device", "mouse", "--pause"});
    viewer.wait_for_surface();
    viewer.act(kPlayTool);
    viewer.wait_until([](const Seen& now) { return now.playing; });
    viewer.act(kPlayTool);
    viewer.wait_until([](const Seen& now) { return !now.playing; });
    viewer.act(kRulerTool);
    viewer.wait_until([](const Seen& now) { return now.ruler; });
    viewer.act(kRulerTool);
    viewer.wait_until([](const Seen& now) { return !now.ruler; });
    CHECK_FALSE(viewer.seen().contact);
    viewer.act("key Tab");
    viewer.act(kRulerTool);
    viewer.wait_for_turn();
    CHECK_FALSE(viewer.seen().ruler);
}
