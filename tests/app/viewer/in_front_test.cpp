// The force of a device only while people work in the window, under real window managers: the
// events that a window gets come in different orders there, and the pointer stays inside it.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tests/app/program/compositor.hpp"
#include "tests/app/program/falcon_scene.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/eventually.hpp"
#include "tests/support/text.hpp"

using namespace dibhr::test;

namespace {

/// A display of its own with a window manager.
struct ManagedDesk {
    const Desk desk = Desk::of_its_own();
    const TemporaryFolder folder{};
    const Process manager;

    explicit ManagedDesk(const std::string& program)
        : manager({"sh", "-c", "exec " + program + " > /dev/null"}, {"DISPLAY=" + desk.display()},
                  folder / "manager.txt") {
        REQUIRE(eventually([this] { return performs("wmctrl -m"); }));
    }
    /// Whether a command line succeeds on this display.
    [[nodiscard]] bool performs(const std::string& command) const {
        const std::string line = "export DISPLAY=" + desk.display() + "; " + command;
        return std::system(("exec > /dev/null 2>&1; " + line).c_str()) ==
               0;  // NOLINT: of this test
    }
    /// The number of the program's window.
    [[nodiscard]] std::string window() const {
        const std::filesystem::path file = folder / "window.txt";
        const std::string last = "xdotool search --class dibhr | tail -1 | tr -d '\\n'";
        REQUIRE(performs(last + " > '" + file.string() + "'"));
        return read_text(file);
    }
};

/// A screen lock: it covers all windows, and has grabbed keyboard and mouse.
class ScreenLock {
  public:
    explicit ScreenLock(const Desk& desk)
        : process_({"i3lock", "--nofork"}, {"DISPLAY=" + desk.display()}, folder_ / "lock.txt") {}
    void open() {
        process_.send(SIGTERM);
        process_.wait();
    }

  private:
    TemporaryFolder folder_{};
    Process process_;
};

/// Takes the window from the front; reports how long the force lasted after that.
template <typename Act>
void check_force_goes(const FalconScene& at, const std::string& what, const Act& act) {
    at.wait_for_force();
    const auto moment = std::chrono::steady_clock::now();
    act();
    at.viewer.wait_until([](const Seen& now) { return !now.in_front; });
    at.falcon.wait_for_zeros(100.0);
    WARN(what << ": zero force after " << at.seconds_to_zero(moment) << " s");
}

void check_force_goes_and_comes_back(const std::string& manager) {
    CAPTURE(manager);
    const ManagedDesk managed(manager);
    FalconScene at({.records = false, .keeps_packets = true, .desk = managed.desk});
    at.press_in();
    const std::string window = managed.window();
    REQUIRE(managed.performs("xdotool mousemove --window " + window + " 50 60"));
    // Some managers activate a window by themselves, and some before the X server shows it: then
    // the server does not give it the keyboard, and a person would click once more.
    const auto has_force_again = [&] {
        REQUIRE(eventually([&] {
            if (!at.viewer.seen().in_front)
                static_cast<void>(managed.performs("wmctrl -i -a " + window));
            return at.falcon.vector("motor_newton").z > 0.6;
        }));
    };
    const auto goes_and_comes_back = [&](const std::string& goes, const std::string& back) {
        CAPTURE(goes);
        check_force_goes(at, manager + ", " + goes, [&] { REQUIRE(managed.performs(goes)); });
        REQUIRE(managed.performs(back));
        has_force_again();
    };
    goes_and_comes_back("xdotool windowminimize " + window, "xdotool windowmap " + window);
    goes_and_comes_back("xdotool windowunmap " + window, "xdotool windowmap " + window);
    goes_and_comes_back("wmctrl -k on", "wmctrl -k off");
    goes_and_comes_back("wmctrl -s 1", "wmctrl -s 0");
    std::optional<ScreenLock> lock;
    check_force_goes(at, manager + ", lock", [&] { lock.emplace(managed.desk); });
    lock->open();
    has_force_again();
    at.desk.press("key q");
    CHECK(at.viewer.wait() == 0);
}

}  // namespace

TEST_CASE("minimised, unmapped, under a lock, on another workspace a window has no force",
          "[window][focus]") {
    check_force_goes_and_comes_back("openbox");
}

TEST_CASE("nor has it under other window managers", "[window][focus][long]") {
    check_force_goes_and_comes_back(GENERATE(as<std::string>{}, "icewm", "metacity"));
}

TEST_CASE("nor has it under Wayland on another workspace, put away, or under a lock",
          "[window][focus][long]") {
    if (!contains(glfwGetVersionString(), "Wayland")) {
        SUCCEED("this GLFW is for X11 alone");
        return;
    }
    const Compositor compositor;
    FalconScene at({.records = false, .host = compositor.host(), .keeps_packets = true});
    at.press_in();
    const auto has_force_again = [&] {
        at.viewer.wait_until([](const Seen& now) { return now.in_front; });
        at.wait_for_force();
    };
    const auto goes_and_comes_back = [&](const std::string& goes, const std::string& back) {
        CAPTURE(goes);
        check_force_goes(at, "sway, " + goes, [&] { REQUIRE(compositor.performs(goes)); });
        REQUIRE(compositor.performs(back));
        has_force_again();
    };
    goes_and_comes_back("swaymsg workspace 2", "swaymsg workspace 1");
    goes_and_comes_back("swaymsg move scratchpad", "swaymsg scratchpad show");
    std::optional<Process> lock;
    check_force_goes(at, "sway, lock", [&] {
        lock.emplace(std::vector<std::string>{"swaylock"}, compositor.environment,
                     compositor.folder / "lock.txt");
    });
    lock.reset();
    has_force_again();
}
