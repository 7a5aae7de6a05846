// The display, the window's thread or a disk stands still while a hand presses: the force goes off,
// and a signal still ends the program.
#include <algorithm>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <glm/geometric.hpp>
#include <string>
#include <vector>

#include "core/haptics/safety.hpp"
#include "tests/app/program/command_program.hpp"
#include "tests/app/program/falcon_scene.hpp"
#include "tests/app/program/stall.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/eventually.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;

namespace {

using Rows = std::vector<Row>;

constexpr int kLasting = 200;  ///< packets without force, one after the other

/// SIGTERM ends it, with one line that says what hung and where the recording is, which is whole
/// and ends without force.
void check_end_by_signal(WindowProgram& viewer, const TemporaryFolder& folder,
                         const std::string& hung_while) {
    viewer.send(SIGTERM);
    CHECK(viewer.wait() == 1);
    const std::string errors = read_text(folder / "errors.txt");
    CHECK(contains(errors, "asked to end, but hung while " + hung_while));
    CHECK(contains(errors, "the recording up to now is in hand.dibhr"));
    CHECK(std::count(errors.begin(), errors.end(), '\n') == 1);
    CHECK(run_dibhr(folder, {"info", "hand.dibhr"}).exit_code == 0);
    CHECK(glm::length(read_session(folder / "hand.dibhr").back().sent_newton) < 1e-12);
    require_same_bits(folder, folder / "hand.dibhr");
}

/// Whether a command line succeeds on that display.
bool run_on(const Desk& desk, const std::string& command) {
    const std::string line = "DISPLAY=" + desk.display() + " " + command + " > /dev/null 2>&1";
    return std::system(line.c_str()) == 0;  // NOLINT: of this test
}

bool is_firm(const Row& row) {
    return glm::length(row.sent_newton) > 0.5;
}

bool stands_still(const Row& row) {
    return row.cut == static_cast<int>(SafetyCut::standstill);
}

/// Whether only the standstill keeps the force from the hand.
bool is_held_back(const Row& row) {
    return stands_still(row) && row.contact && glm::length(row.spring_newton) > 0.5 &&
           glm::length(row.sent_newton) < 1e-12;
}

/// How often a firm force was followed by a standstill without force.
int standstills(const Rows& rows) {
    int count = 0;
    auto at = rows.begin();
    while (at != rows.end()) {
        at = std::find_if(at, rows.end(), is_firm);
        at = std::find_if(at, rows.end(), is_held_back);
        if (at != rows.end()) ++count;
    }
    return count;
}

std::ptrdiff_t ticks_held_back(const Rows& rows) {
    return std::count_if(rows.begin(), rows.end(), is_held_back);
}

}  // namespace

TEST_CASE(
    "a display that stops takes the force off until it goes on, and SIGTERM ends the program all "
    "the same",
    "[ways out]") {
    FalconScene at({.desk = Desk::of_its_own()});
    at.press_in();
    at.desk.stop();
    at.falcon.wait_for_zeros(kLasting);
    at.desk.resume();
    at.wait_for_force();
    at.desk.stop();
    at.falcon.wait_for_zeros(kLasting);
    check_end_by_signal(at.viewer, at.folder, "drawing");
    const Rows rows = at.rows();
    CHECK(standstills(rows) >= 2);
    CHECK(ticks_held_back(rows) > kLasting);
}

TEST_CASE(
    "a disk under the recording that stops takes the force off until it goes on; a window's thread "
    "that loops for ever holds no force, nor the program",
    "[ways out]") {
    const Stall stall("hand.dibhr");
    FalconScene at({.host = stall.host()});
    at.press_in();
    stall.begin();
    at.falcon.wait_for_zeros(kLasting);
    stall.end();
    at.wait_for_force();
    at.wait_until_recorded([](const Rows& rows) { return standstills(rows) >= 1; });
    at.viewer.hang();
    at.falcon.wait_for_zeros(kLasting);
    check_end_by_signal(at.viewer, at.folder, "drawing");
    CHECK(standstills(at.rows()) >= 2);
}

TEST_CASE(
    "while a disk keeps the files from being opened, a window with their name is there, and a key "
    "or a signal ends it",
    "[ways out]") {
    const bool by_key = GENERATE(true, false);
    const Stall stall("sample/depth.mp4");
    stall.begin();
    const Desk desk;
    const TemporaryFolder folder;
    WindowProgram viewer = desk.start_viewer(folder, {"--device", "mouse"}, stall.host());
    const auto is_there = [&desk] {
        return run_on(desk, "xdotool search --onlyvisible --name '^The sample.* - dibhr$'");
    };
    REQUIRE(eventually(is_there));
    if (by_key)
        desk.press("key q");
    else
        viewer.send(SIGTERM);
    CHECK(viewer.wait() == 0);
    CHECK(read_text(folder / "errors.txt").empty());
}

TEST_CASE("a disk under the video that stops takes the force off, and a signal ends the program",
          "[ways out]") {
    constexpr std::uint64_t kTicks = 300;
    constexpr std::uint64_t kTurns = 30;
    const Stall stall("sample/depth.mp4");
    const Desk desk;
    const TemporaryFolder folder;
    std::filesystem::create_directories(folder / "config/dibhr");
    write_text(folder / "config/dibhr/settings.toml", "[window]\npanels-visible = false\n");
    // A Falcon's bus would have its own way to the disk.
    WindowProgram viewer = desk.start_viewer(
        folder, {"--device", "mouse", "--size", "320x240", "--record", "hand.dibhr"}, stall.host());
    viewer.wait_for_surface();
    viewer.act("mousemove 160 120 mousedown 1");
    viewer.wait_until([](const Seen& now) { return now.contact && now.sent_newton > 0.1; });
    stall.begin();  // what was read ahead is played first
    const auto is_off = [](const Seen& now) {
        return now.cut == static_cast<int>(SafetyCut::standstill) && now.sent_newton < 1e-12;
    };
    // A window that is late on a busy machine takes the force off, too, but not for so long.
    Seen last_on = viewer.seen();
    viewer.wait_until([&](const Seen& now) {
        if (!is_off(now)) last_on = now;
        return now.turn > last_on.turn + kTurns &&
               now.recorded_rows > last_on.recorded_rows + 2 * kTicks;
    });
    check_end_by_signal(viewer, folder, "closing the window");
    const Rows rows = read_session(folder / "hand.dibhr");
    // Up to the signal, which also makes the hand not ready.
    const auto ready = [](const Row& row) { return row.ready; };
    const Rows until_signal(rows.begin(), std::find_if(rows.rbegin(), rows.rend(), ready).base());
    REQUIRE(until_signal.size() > kTicks);
    for (std::size_t k = until_signal.size() - kTicks; k < until_signal.size(); ++k) {
        const Row& row = until_signal[k];
        // On a busy machine a notice about a late tick comes first.
        const bool is_late = row.t_s - until_signal[k - 1].t_s > SafetyLimits{}.max_tick_s;
        CHECK(row.cut == static_cast<int>(is_late ? SafetyCut::late_tick : SafetyCut::standstill));
        CHECK(row.contact);
        CHECK(glm::length(row.spring_newton) > 0.01);
        CHECK(glm::length(row.sent_newton) < 1e-12);
    }
}

TEST_CASE("a file that is opened from a disk that stands still does not hold up the end",
          "[ways out]") {
    const Stall stall("z_color");
    const Desk desk;
    const TemporaryFolder folder;
    for (const char* name : {"a_color.png", "a_depth.png", "z_color.png", "z_depth.png"})
        write_depth_png(folder / name, 64, 48, 64, 2);
    WindowProgram viewer = desk.start_viewer(
        folder, {"a_color.png", "--device", "mouse", "--size", "320x240", "--screenshot", "a.png"},
        stall.host());
    viewer.wait_for_surface();
    stall.begin();
    viewer.act("key ctrl+Next");
    viewer.wait_until([](const Seen& now) { return now.opening; });
    desk.press("key q");
    CHECK(viewer.wait() == 0);
    CHECK(read_text(folder / "errors.txt").empty());
    CHECK(std::filesystem::exists(folder / "a.png"));
}

TEST_CASE("a clip on a disk that stands still does not hold up the end for ever", "[ways out]") {
    const Stall stall("all.mp4");
    const Desk desk = Desk::of_its_own();
    const TemporaryFolder folder;
    WindowProgram viewer = desk.start_viewer(
        folder, {"--device", "mouse", "--size", "320x240", "--clip", "all.mp4"}, stall.host());
    viewer.wait_for_surface();
    viewer.wait_until([](const Seen& now) { return now.clip && now.clip_s > 0.1; });
    stall.begin();
    desk.kill();
    CHECK(viewer.wait() == 1);
    CHECK(contains(
        read_text(folder / "errors.txt"),
        "all.mp4: the clip is not finished after 5 s; what was written so far is beside it"));
}
