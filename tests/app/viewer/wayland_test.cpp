// The window under a Wayland compositor whose screen has a scale: skipped where GLFW has X11 alone.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <string>

#include "tests/app/program/compositor.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/text.hpp"

using namespace dibhr::test;

namespace {

/// In 1/1000 of the screen of 1024 x 640 screen units: the toolbar's second picture, and the
/// relief.
constexpr std::uint32_t kPlayX = 21;
constexpr std::uint32_t kPlayY = 406;
constexpr std::uint32_t kReliefX = 300;

}  // namespace

TEST_CASE("under Wayland at 125 % the pointer meets what is drawn under it", "[window][long]") {
    if (!contains(glfwGetVersionString(), "Wayland")) {
        SUCCEED("this GLFW is for X11 alone");
        return;
    }
    const Desk desk;
    const TemporaryFolder folder;
    const Compositor compositor("resolution 1280x800 scale 1.25");
    WindowProgram viewer =
        desk.start_viewer(folder, {"--device", "mouse", "--pause"}, compositor.host());
    viewer.wait_for_surface();
    viewer.wait_until([](const Seen& now) { return now.columns * 640 == now.rows * 1024; });
    compositor.pointer->move_to(kReliefX, 500);
    viewer.wait_until([](const Seen& now) { return now.pointed_column > 0.0F; });
    const float column = viewer.seen().pointed_column;
    compositor.pointer->move_to(kReliefX + 20, 500);
    viewer.wait_until([column](const Seen& now) { return now.pointed_column > column; });
    compositor.pointer->move_to(800, 500);  // the panels
    viewer.wait_until([](const Seen& now) { return now.pointed_column < 0.0F; });
    compositor.pointer->move_to(kPlayX, kPlayY);
    viewer.wait_for_turn();
    compositor.pointer->click();
    viewer.wait_until([](const Seen& now) { return now.playing; });
    viewer.send(SIGTERM);
    CHECK(viewer.wait() == 0);
}
