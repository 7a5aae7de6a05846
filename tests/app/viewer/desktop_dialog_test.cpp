// Files opened in the real window through the desktop's dialog.
#include <chrono>
#include <csignal>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "tests/app/program/command_program.hpp"
#include "tests/app/program/desk.hpp"
#include "tests/app/program/open_dialog.hpp"
#include "tests/app/program/session_bus.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/eventually.hpp"
#include "tests/support/text.hpp"

namespace fs = std::filesystem;
using namespace dibhr;
using namespace dibhr::test;

namespace {

/// A window over a pair of pictures, with another pair, a bus, and helpers beside it.
class Room {
  public:
    Room() {
        for (const char* name : {"cup", "jug"}) {
            write_depth_png(folder_ / (std::string(name) + "_rgb.png"), 64, 48, 120);
            write_depth_png(folder_ / (std::string(name) + "_depth.png"), 64, 48, 20, 3);
        }
        fs::create_directory(folder_ / "bin");
    }

    [[nodiscard]] const SessionBus& bus() const { return bus_; }
    [[nodiscard]] fs::path file(const std::string& name) const { return folder_ / name; }
    [[nodiscard]] std::string address(const std::string& name) const {
        return "file://" + file(name).string();
    }

    void add_zenity(const std::string& script) {
        write_text(folder_ / "bin/zenity", "#!/bin/sh\n" + script);
        fs::permissions(folder_ / "bin/zenity", fs::perms::owner_all);
    }

    [[nodiscard]] WindowProgram open(const std::vector<std::string>& options = {}) const {
        std::vector<std::string> arguments{"cup_rgb.png", "--device", "mouse", "--size", "640x480"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        // No helper program but those of the test.
        const std::vector<std::string> host{"-u", "SSH_CONNECTION",
                                            "DBUS_SESSION_BUS_ADDRESS=" + bus_.address(),
                                            "XDG_CURRENT_DESKTOP=", "PATH=" + file("bin").string()};
        return desk_.start_viewer(folder_, arguments, host);
    }
    void press(const std::string& events) const { desk_.press(events); }

  private:
    Desk desk_{};
    TemporaryFolder folder_{};
    SessionBus bus_{};
};

void wait_for(const WindowProgram& viewer, const std::string& recording) {
    viewer.wait_until([name = recording + "_rgb.png"](const Seen& now) {
        return now.surface && now.file.str().ends_with(name);
    });
}

void wait_until_asked(const Portal& portal) {
    REQUIRE(eventually([&] { return portal.asked().times == 1; }));
}

void wait_until_closed(const Portal& portal) {
    CHECK(eventually([&] { return portal.asked().closed; }));
}

/// Asks a helper program that hangs for a file, and then ends the window.
void check_helper_ends(const std::function<void(const Room&, const WindowProgram&)>& end_window) {
    Room room;
    const fs::path told = room.file("told");
    room.add_zenity("echo $$ > '" + told.string() + "'\nexec /bin/sleep 1000\n");
    WindowProgram viewer = room.open();
    viewer.wait_for_surface();
    viewer.act("key ctrl+o");
    REQUIRE(eventually([&] { return read_text(told).ends_with('\n'); }));
    const std::string child = read_text(told);
    const fs::path words = "/proc/" + child.substr(0, child.find('\n')) + "/cmdline";
    // The system has no words of a process that is just changing into another program.
    REQUIRE(eventually([&] { return !read_text(words).empty(); }));
    end_window(room, viewer);
    CHECK(viewer.wait() == 0);
    CHECK(eventually([&words] { return read_text(words).empty(); }));
}

}  // namespace

TEST_CASE(
    "Ctrl+O asks the desktop, once, for colour and depth, and again after it was cancelled; "
    "the window asks itself by a key of its own, or where nobody answers",
    "[desktop]") {
    Room room;
    WindowProgram viewer = room.open();
    viewer.wait_for_surface();
    {
        const Portal portal(room.bus(), {.addresses = {room.address("jug_depth.png"),
                                                       room.address("jug_rgb.png")}});
        viewer.act("key ctrl+o");
        wait_for(viewer, "jug");  // with the depth file that was chosen with it
        const PortalAsked asked = portal.asked();
        CHECK(asked.times == 1);
        CHECK(asked.folder == room.file("").parent_path());
        CHECK(asked.parent.starts_with("x11:"));
        CHECK_FALSE(asked.closed);
    }
    {
        const Portal portal(room.bus(), {.response = 1});  // cancelled
        viewer.act("key ctrl+o");
        wait_until_asked(portal);
        CHECK(eventually([&] {
            viewer.act("key ctrl+o");  // no effect before the window knows of the cancel
            return portal.asked().times >= 2;
        }));
        CHECK(viewer.seen().file.str().ends_with("jug_rgb.png"));
    }
    {
        const Portal portal(room.bus(), {.answers = false});
        CHECK(eventually([&] {
            viewer.act("key ctrl+o");
            return portal.asked().times == 1;
        }));
        viewer.act("key ctrl+o");
        CHECK(portal.asked().times == 1);
        CHECK_FALSE(portal.asked().closed);
        viewer.act("key ctrl+shift+o");
        wait_until_closed(portal);
        open_by_name(viewer, "cup");
        wait_for(viewer, "cup");
        CHECK(portal.asked().times == 1);
    }
    {
        const Portal portal(room.bus(), {.replies = false});
        viewer.act("key ctrl+o");
        wait_until_asked(portal);
        open_by_name(viewer, "jug");  // the window's own dialog, which opens after two seconds
        wait_for(viewer, "jug");
    }
    room.add_zenity("echo '" + room.file("cup_rgb.png").string() + "'\n");
    viewer.act("key ctrl+o");
    wait_for(viewer, "cup");
    const Portal portal(room.bus(), {.answers = false});
    viewer.act("key ctrl+o");
    wait_until_asked(portal);
    room.press("key q");
    CHECK(viewer.wait() == 0);
    wait_until_closed(portal);
}

TEST_CASE("where the setting says so, the window asks itself", "[desktop]") {
    Room room;
    const Portal portal(room.bus(), {});
    WindowProgram viewer = room.open({"--open-dialog", "window"});
    viewer.wait_for_surface();
    viewer.act("key ctrl+o");
    open_by_name(viewer, "jug");
    wait_for(viewer, "jug");
    CHECK(portal.asked().times == 0);
    room.press("key q");
    CHECK(viewer.wait() == 0);
}

TEST_CASE("a helper program that hangs is ended with the window", "[desktop]") {
    check_helper_ends([](const Room& room, const WindowProgram&) { room.press("key q"); });
}

TEST_CASE("a helper program that hangs is ended with a window that a signal ends",
          "[desktop][realtime]") {
    check_helper_ends([](const Room&, const WindowProgram& viewer) { viewer.send(SIGTERM); });
}

TEST_CASE("a portal that is still thinking does not keep the program from ending",
          "[desktop][realtime]") {
    Room room;
    const Portal portal(room.bus(), {.replies = false});
    WindowProgram viewer = room.open();
    viewer.wait_for_surface();
    viewer.act("key ctrl+o");
    wait_until_asked(portal);
    const auto begin = std::chrono::steady_clock::now();
    room.press("key q");
    CHECK(viewer.wait() == 0);
    // The portal has two seconds while a person waits.
    CHECK(std::chrono::steady_clock::now() - begin < std::chrono::milliseconds(1500));
}
