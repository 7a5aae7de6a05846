// The window by keyboard alone: panels, the hand, and what is said of them.
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/app/program/command_program.hpp"
#include "tests/app/program/desk.hpp"
#include "tests/app/program/open_dialog.hpp"
#include "tests/app/program/passing_ticks.hpp"
#include "tests/app/viewer/speech_bench.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/eventually.hpp"

using namespace dibhr;
using namespace dibhr::test;
namespace fs = std::filesystem;

namespace {

constexpr int kMostItems = 250;

/// Presses `key` until the item of that label has the keyboard.
void go_to(const WindowProgram& viewer, const std::string& label, const std::string& key = "Tab") {
    for (int k = 0; k < kMostItems; ++k) {
        if (viewer.seen().focus.str().starts_with(label)) return;
        viewer.act("key " + key);
        viewer.wait_for_turn();
        viewer.wait_for_turn();
    }
    FAIL("no item is called " + label + "; at last it was " + viewer.seen().focus.str());
}

WindowProgram view_sample(const Desk& desk, const TemporaryFolder& folder,
                          const std::vector<std::string>& more = {},
                          const std::vector<std::string>& host = {}) {
    std::vector<std::string> arguments{"--device", "mouse", "--pause"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return desk.start_viewer(folder, arguments, host);
}

std::vector<std::string> made_in(const TemporaryFolder& folder, const std::string& ending) {
    std::vector<std::string> names = names_in(folder.path());
    std::erase_if(names, [&ending](const std::string& name) {
        return !name.starts_with("dibhr-") || !name.ends_with(ending);
    });
    return names;
}

}  // namespace

TEST_CASE("F6 goes around toolbar and panels and Esc gives the keys back to the picture",
          "[keyboard]") {
    const Desk desk;
    const TemporaryFolder folder;
    WindowProgram viewer = view_sample(desk, folder);
    viewer.wait_for_surface();
    CHECK(viewer.seen().focus.str().empty());
    viewer.act("key F6");
    viewer.wait_until([](const Seen& now) { return now.focus.str().starts_with("Open a"); });
    viewer.act("key Down key space");
    viewer.wait_until([](const Seen& now) { return now.playing; });
    viewer.wait_until([](const Seen& now) { return now.focus.str().starts_with("Pause"); });
    viewer.act("key space");
    viewer.wait_until([](const Seen& now) { return !now.playing; });
    viewer.act("key F6");
    viewer.wait_until([](const Seen& now) { return now.focus.str() == "Video"; });
    CHECK(viewer.seen().focus_kind.str() == "section");
    viewer.act("key Escape");
    viewer.wait_until([](const Seen& now) { return now.focus.str().empty(); });
    viewer.act("key space");
    viewer.wait_until([](const Seen& now) { return now.playing; });
    viewer.act("key Tab");
    viewer.wait_until([](const Seen& now) { return !now.panels; });
}

TEST_CASE("a slider takes arrows and a typed number and a list takes its entry by keyboard",
          "[keyboard]") {
    const Desk desk;
    const TemporaryFolder folder;
    WindowProgram viewer = view_sample(desk, folder);
    viewer.wait_for_surface();
    viewer.act("key F6 key F6");
    go_to(viewer, "Cleaning");
    const std::string before = viewer.seen().focus_value.str();
    viewer.act("key Return");
    viewer.wait_until([](const Seen& now) { return now.focus_kind.str() == "entry"; });
    CHECK(viewer.seen().focus.str() == before);
    viewer.act("key Escape");
    viewer.wait_until([](const Seen& now) { return now.focus.str() == "Cleaning"; });
    viewer.act("key Return");
    viewer.wait_until([](const Seen& now) { return now.focus_kind.str() == "entry"; });
    viewer.act("key Down");
    viewer.act("key Return");
    viewer.wait_until([&](const Seen& now) {
        return now.focus.str() == "Cleaning" && now.focus_value.str() != before;
    });
    go_to(viewer, "Fingertip");
    viewer.act("key Right");
    viewer.wait_until([](const Seen& now) { return now.focus_value.str() == "0.1 mm"; });
    viewer.act("key Return");
    for (int k = 0; k < 6; ++k) viewer.wait_for_turn();  // the field opens
    viewer.act("type 2.5");
    viewer.act("key Return");
    viewer.wait_until([](const Seen& now) { return now.focus_value.str() == "2.5 mm"; });
    go_to(viewer, "Back to the default");
    viewer.act("key space");
    viewer.wait_until([](const Seen& now) { return now.focus.str() == "Fingertip"; });
    CHECK(viewer.seen().focus_value.str() == "a point");
}

TEST_CASE("what is typed before a field or a dialog has the keyboard arrives in it, and in order",
          "[keyboard]") {
    const Desk desk;
    const TemporaryFolder folder;
    write_depth_png(folder / "first_depth.png", 64, 48, 100);
    write_depth_png(folder / "second_depth.png", 64, 48, 100);
    WindowProgram viewer = view_sample(desk, folder, {"--open-dialog", "window"});
    viewer.wait_for_surface();
    viewer.act("key F6 key F6");
    go_to(viewer, "Fingertip");
    desk.press("key Return type 2.5");
    for (int k = 0; k < 6; ++k) viewer.wait_for_turn();
    viewer.act("key Return");
    viewer.wait_until([](const Seen& now) { return now.focus_value.str() == "2.5 mm"; });
    for (int k = 0; k < 6; ++k) viewer.wait_for_turn();
    viewer.act("key Return");
    for (int k = 0; k < 6; ++k) viewer.wait_for_turn();
    viewer.act("type 12");
    act_in_one_picture(desk, viewer, "key ctrl+a type 3.5");
    viewer.wait_until([](const Seen& now) { return now.focus_value.str() == "3.5 mm"; });
    viewer.act("key Return");
    for (int k = 0; k < 6; ++k) viewer.wait_for_turn();
    viewer.act("key Escape");
    // A key before it is not typed into it.
    act_in_one_picture(desk, viewer, "key m key ctrl+o type second");
    viewer.wait_until([](const Seen& now) { return now.dialog && now.dialog_entries == 1; });
}

TEST_CASE("keys move the hand over the relief and press it and a mouse click takes it back",
          "[keyboard]") {
    const Desk desk;
    const TemporaryFolder folder;
    write_depth_png(folder / "slope_depth.png", 64, 48, 100, 2);
    WindowProgram viewer = desk.start_viewer(
        folder, {"slope_depth.png", "--raw-depth", "--device", "mouse", "--record", "hand.dibhr"});
    viewer.wait_for_surface();
    viewer.act("mousemove 400 360 key t");
    viewer.wait_until([](const Seen& now) { return now.keys_move_hand; });
    viewer.act("key Return");  // keeps pressing
    viewer.wait_until([](const Seen& now) { return now.contact; });
    viewer.act("keydown Right");
    wait_for_ticks(viewer, 600);
    viewer.act("keyup Right key Return");
    viewer.wait_until([](const Seen& now) { return !now.contact; });
    desk.press("key space");  // a tap
    viewer.wait_until([](const Seen& now) { return now.contact; });
    viewer.wait_until([](const Seen& now) { return !now.contact; });
    CHECK_FALSE(viewer.seen().playing);
    viewer.act("mousemove 300 300 click 1");
    viewer.wait_until([](const Seen& now) { return !now.keys_move_hand; });
    desk.press("key q");
    REQUIRE(viewer.wait() == 0);
    double first = -1.0;
    double farthest = -1.0;
    for (const Row& row : read_session(folder / "hand.dibhr")) {
        if (!row.contact) continue;
        if (first < 0.0) first = row.proxy.x;
        farthest = std::max(farthest, row.proxy.x);
    }
    CHECK(farthest > first + 2.0);
}

TEST_CASE(
    "the keys' hand begins in the middle of the picture where the pointer is beside the relief",
    "[keyboard]") {
    const Desk desk;
    const TemporaryFolder folder;
    write_depth_png(folder / "slope_depth.png", 64, 48, 100, 2);
    WindowProgram viewer =
        desk.start_viewer(folder, {"slope_depth.png", "--raw-depth", "--device", "mouse"});
    viewer.wait_for_surface();
    viewer.act("mousemove 60 690 key t");
    viewer.wait_until([](const Seen& now) { return now.keys_move_hand; });
    viewer.act("keydown space");
    viewer.wait_until([](const Seen& now) { return now.contact; });
    viewer.act("keyup space");
    desk.press("key q");
    CHECK(viewer.wait() == 0);
}

TEST_CASE("a newcomer without a mouse opens touches paints explains records replays and clips",
          "[keyboard]") {
    const Desk desk;
    const TemporaryFolder folder;
    run_shell(folder,
              "ffmpeg -nostdin -v error -y -f lavfi -i testsrc2=s=160x120:r=20:d=3 -f lavfi -i "
              "\"nullsrc=s=160x120:r=20:d=3,format=gray,geq=lum='110+40*sin(X/12)'\" "
              "-map 0 -c:v ffv1 wave_color.mkv -map 1 -c:v ffv1 wave_depth.mkv");
    WindowProgram viewer = view_sample(desk, folder, {"--open-dialog", "window"});
    viewer.wait_for_surface();
    viewer.act("key F6");
    go_to(viewer, "Open a");
    viewer.act("key Return");
    open_by_name(viewer, "wave_color");
    viewer.wait_until(
        [](const Seen& now) { return now.surface && now.file.str().ends_with("wave_color.mkv"); });
    go_to(viewer, "Record what");
    viewer.act("key space");
    viewer.wait_until([](const Seen& now) { return now.records; });

    viewer.act("key Escape key t");
    viewer.wait_until([](const Seen& now) { return now.keys_move_hand; });
    viewer.act("keydown space");
    viewer.wait_until([](const Seen& now) { return now.contact; });
    viewer.act("keydown Right");
    wait_for_ticks(viewer, 300);
    viewer.act("keyup Right keyup space");

    viewer.act("key F6");
    go_to(viewer, "End the recording");
    viewer.act("key space");
    viewer.wait_until([](const Seen& now) { return !now.records; });
    go_to(viewer, "Paint materials", "Down");
    viewer.act("key space");
    viewer.wait_until([](const Seen& now) { return now.brush; });
    viewer.act("key Escape keydown space keydown Left");
    wait_for_ticks(viewer, 300);
    viewer.act("keyup Left keyup space");
    viewer.wait_until([](const Seen& now) { return now.painted; });
    viewer.act("key g");
    viewer.wait_until([](const Seen& now) { return !now.brush; });
    viewer.act("key e");
    viewer.wait_until([](const Seen& now) { return now.explained; });
    viewer.act("key period");
    viewer.wait_until([](const Seen& now) { return now.explained_steps > 0; });
    viewer.act("key F6");
    go_to(viewer, "End (E)");
    viewer.act("key space");
    viewer.wait_until([](const Seen& now) { return !now.explained; });

    go_to(viewer, "Save a clip");
    viewer.act("key space");
    viewer.wait_until([](const Seen& now) { return now.clip && now.clip_s > 0.2; });
    viewer.act("key space");
    viewer.wait_until([](const Seen& now) { return !now.clip; });
    CHECK(made_in(folder, ".mp4").size() == 1);
    go_to(viewer, "Replay it");
    viewer.act("key space");
    viewer.wait_until([](const Seen& now) { return now.replays && now.surface; });
    desk.press("key ctrl+q");
    CHECK(viewer.wait() == 0);
    CHECK(made_in(folder, ".dibhr").size() == 1);
}

TEST_CASE("where the keyboard goes is spoken and of a changed value the value alone",
          "[keyboard][speech]") {
    const Desk desk;
    const TemporaryFolder folder;
    const fs::path spoken = folder / "spoken";
    const auto says = [&spoken](const std::string& text) {
        return eventually([&] {
            const auto calls = calls_in(spoken);
            return std::ranges::find(calls, "say " + text) != calls.end();
        });
    };
    WindowProgram viewer = view_sample(desk, folder, {"--speak"}, with_stand_in(folder));
    viewer.wait_for_surface();
    viewer.act("key F6");
    CHECK(says("Open a recording (Ctrl+O), button"));
    viewer.act("key F6");
    CHECK(says("Video, section, open"));
    go_to(viewer, "Loop");
    CHECK(says("Loop, check box, on"));
    viewer.act("key space");
    CHECK(says("off"));
    go_to(viewer, "Speed");
    CHECK(says("Speed, slider, x 1.00"));
    desk.press("key q");
    REQUIRE(viewer.wait() == 0);
}
