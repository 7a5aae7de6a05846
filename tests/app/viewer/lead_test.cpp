// The first start leads through the first touch: press, stroke, choose; once, and never in the way.
#include <array>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/app/program/command_program.hpp"
#include "tests/app/program/desk.hpp"
#include "tests/app/viewer/speech_bench.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/eventually.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;
namespace fs = std::filesystem;

namespace {

/// A folder in which nobody was led yet.
std::vector<std::string> first_start(const TemporaryFolder& folder) {
    return {"env", "XDG_STATE_HOME=" + (folder / "first").string()};
}

fs::path led(const TemporaryFolder& folder) {
    return folder / "first" / "dibhr" / "led";
}

WindowProgram view_sample(const Desk& desk, const TemporaryFolder& folder,
                          const std::vector<std::string>& more = {},
                          std::vector<std::string> host = {}, const std::string& device = "mouse") {
    std::vector<std::string> arguments{"--device", device, "--pause", "--no-sync"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const auto first = first_start(folder);
    host.insert(host.begin(), first.begin(), first.end());
    return desk.start_viewer(folder, arguments, host);
}

void check_nobody_is_led(const Desk& desk, const TemporaryFolder& folder, WindowProgram viewer) {
    viewer.wait_for_surface();
    viewer.wait_for_turn();
    CHECK(viewer.seen().lead == 0);
    desk.press("key ctrl+shift+q key q");
    REQUIRE(viewer.wait() == 0);
    CHECK_FALSE(fs::exists(led(folder)));
}

/// Where the nose and the jumper of the sample's first frame are in the window.
constexpr const char* kNose = "mousemove 484 356";
constexpr const char* kJumper = "mousemove 340 604";
constexpr std::array kAlongJumper{"mousemove 420 598", "mousemove 500 590", "mousemove 560 582"};

}  // namespace

TEST_CASE("the first start leads from the nose to the jumper and to a material as each is done",
          "[lead]") {
    const Desk desk;
    const TemporaryFolder folder;
    WindowProgram viewer = view_sample(desk, folder);
    viewer.wait_until([](const Seen& now) { return now.lead == 1; });
    viewer.act(std::string(kNose) + " mousedown 1");
    viewer.wait_until([](const Seen& now) { return now.lead == 2; });
    viewer.act("mouseup 1");
    viewer.act(std::string(kJumper) + " mousedown 1");
    viewer.wait_until([](const Seen& now) { return now.contact; });
    const auto stroked = [](const Seen& now) {
        return now.lead == 3 || (now.lead == 2 && now.lead_done);
    };
    constexpr std::size_t kMostMoves = 60;
    for (std::size_t k = 0; k < kMostMoves && !stroked(viewer.seen()); ++k)
        viewer.act(kAlongJumper.at(k % kAlongJumper.size()));
    viewer.wait_until(stroked);
    viewer.act("mouseup 1");
    viewer.wait_until([](const Seen& now) { return now.lead == 3; });
    viewer.wait_until([](const Seen& now) { return now.lead == 0; });
    desk.press("key q");
    REQUIRE(viewer.wait() == 0);
    CHECK(fs::exists(led(folder)));
}

TEST_CASE("a key does what it does and nobody is led any more also not at the next start",
          "[lead]") {
    const Desk desk;
    const TemporaryFolder folder;
    {
        WindowProgram viewer = view_sample(desk, folder);
        viewer.wait_until([](const Seen& now) { return now.lead == 1; });
        viewer.act("key i");
        CHECK(viewer.seen().lead == 0);
        CHECK(viewer.seen().statistics);
        desk.press("key q");
        REQUIRE(viewer.wait() == 0);
    }
    CHECK(fs::exists(led(folder)));
    WindowProgram viewer = view_sample(desk, folder);
    viewer.wait_for_surface();
    viewer.wait_for_turn();
    CHECK(viewer.seen().lead == 0);
    desk.press("key q");
    REQUIRE(viewer.wait() == 0);
}

TEST_CASE("whoever does nothing is led to the end at ten pictures a second and each step is said",
          "[lead]") {
    const Desk desk;
    const TemporaryFolder folder;
    WindowProgram viewer = view_sample(desk, folder, {"--speak"}, with_stand_in(folder));
    viewer.wait_until([](const Seen& now) { return now.lead == 2; });
    const Seen begin = viewer.seen();
    viewer.wait_until([](const Seen& now) { return now.lead == 3; });
    const std::uint64_t pictures = viewer.seen().picture - begin.picture;
    CHECK(pictures > 10);
    CHECK(pictures < 85);  // of 6.5 s, and of what else moves between two steps
    viewer.wait_until([](const Seen& now) { return now.lead == 0; });
    std::string all;
    for (const std::string& call : calls_in(folder / "spoken")) all += call + "\n";
    INFO(all);
    for (const char* part : {"say Touch the nose", "say Stroke the jumper", "say Choose Bark"})
        CHECK(contains(all, part));
    desk.press("key q");
    REQUIRE(viewer.wait() == 0);
}

TEST_CASE("nobody is led where something else was asked for than to touch with the mouse",
          "[lead]") {
    const Desk desk;
    const TemporaryFolder folder;
    using Options = std::vector<std::string>;
    const Options with =
        GENERATE(Options{"--seconds", "600"}, Options{"--kiosk"}, Options{"--full-screen"},
                 Options{"--screenshot", "last.png"}, Options{"--record", "a.dibhr"});
    check_nobody_is_led(desk, folder, view_sample(desk, folder, with));
}

TEST_CASE("nobody is led where the mouse is not the hand", "[lead]") {
    const Desk desk;
    const TemporaryFolder folder;
    write_text(folder / "goals.csv", "t,x,y,z\n0,320,240,150\n");
    check_nobody_is_led(desk, folder, view_sample(desk, folder, {}, {}, "goals:goals.csv"));
}

TEST_CASE("nobody is led over another recording", "[lead]") {
    const Desk desk;
    const TemporaryFolder folder;
    write_depth_png(folder / "cup_depth.png", 60, 40, 120);
    check_nobody_is_led(
        desk, folder,
        desk.start_viewer(folder, {"cup_depth.png", "--device", "mouse", "--no-sync"},
                          first_start(folder)));
}
