// Files opened in the real window through the desktop's dialog.
#include <chrono>
#include <csignal>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/app/program/command_program.hpp"
#include "tests/app/program/desk.hpp"
#include "tests/app/program/session_bus.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/eventually.hpp"
#include "tests/support/text.hpp"

namespace fs = std::filesystem;
using namespace dibhr;
using namespace dibhr::test;
using namespace std::chrono_literals;

namespace {

using Clock = std::chrono::steady_clock;

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

    [[nodiscard]] Process open(const std::vector<std::string>& options = {}) const {
        std::vector<std::string> arguments{"cup_rgb.png", "--device",          "mouse",
                                           "--size",      "800x600",           "--seconds",
                                           "60",          "--screenshot-name", "shot-{file}"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        const std::vector<std::string> host{
            "-u", "SSH_CONNECTION", "DBUS_SESSION_BUS_ADDRESS=" + bus_.address(),
            "XDG_CURRENT_DESKTOP=", "PATH=" + file("bin").string() + ":/usr/bin:/bin"};
        return desk_.start_viewer(folder_, arguments, host);
    }
    /// In the window once it is there.
    void begin(const std::string& commands) const {
        act("search --sync --onlyvisible --name dibhr sleep 0.7 " + commands);
    }
    void act(const std::string& commands) const { desk_.act(commands); }

    /// Asks for a picture; whether it is one of that recording.
    [[nodiscard]] bool shows(const std::string& recording) const {
        act("key s");
        const fs::path picture = folder_ / ("shot-" + recording + "_rgb.png");
        return eventually([&] { return fs::exists(picture); }, 5s);
    }

  private:
    Desk desk_{};
    TemporaryFolder folder_{};
    SessionBus bus_{};
};

}  // namespace

TEST_CASE("Ctrl+O asks the desktop, and shows the colour and the depth that are chosen together",
          "[desktop]") {
    Room room;
    const Portal portal(
        room.bus(), {.addresses = {room.address("jug_depth.png"), room.address("jug_rgb.png")}});
    Process viewer = room.open();
    room.begin("key ctrl+o sleep 1");
    CHECK(room.shows("jug"));
    room.act("key q");
    CHECK(viewer.wait() == 0);
    const PortalAsked asked = portal.asked();
    CHECK(asked.times == 1);
    CHECK(asked.folder == room.file("").parent_path());
    CHECK(asked.parent.starts_with("x11:"));
    CHECK_FALSE(asked.closed);
}

TEST_CASE("what is shown stays when the desktop's dialog is cancelled, and it can be asked again",
          "[desktop]") {
    Room room;
    const Portal portal(room.bus(), {.response = 1, .after = 400ms});
    Process viewer = room.open();
    room.begin("key ctrl+o sleep 1 key ctrl+o sleep 1");
    CHECK(portal.asked().times == 2);
    CHECK(room.shows("cup"));
    room.act("key q");
    CHECK(viewer.wait() == 0);
}

TEST_CASE("the desktop's dialog is open once, and is closed with the window", "[desktop]") {
    const bool by_signal = GENERATE(false, true);
    Room room;
    const Portal portal(room.bus(), {.answers = false});
    Process viewer = room.open();
    room.begin("key ctrl+o sleep 0.5 key ctrl+o sleep 0.5");
    CHECK(portal.asked().times == 1);
    CHECK_FALSE(portal.asked().closed);
    const auto begin = Clock::now();
    by_signal ? viewer.send(SIGTERM) : room.act("key q");
    CHECK(viewer.wait() == 0);
    CHECK(Clock::now() - begin < 1500ms);
    CHECK(eventually([&] { return portal.asked().closed; }, 1s));
}

TEST_CASE("the window's own dialog has a key of its own, which puts away the desktop's",
          "[desktop]") {
    Room room;
    const Portal portal(room.bus(), {.answers = false});
    Process viewer = room.open();
    room.begin("key ctrl+o sleep 0.5 key ctrl+shift+o sleep 0.5 type jug");
    CHECK(eventually([&] { return portal.asked().closed; }, 1s));
    room.act("sleep 0.3 key Return sleep 0.7");
    CHECK(room.shows("jug"));
    room.act("key q");
    CHECK(viewer.wait() == 0);
}

TEST_CASE("where the portal does not answer, or the setting says so, the window asks itself",
          "[desktop]") {
    Room room;
    const bool as_set = GENERATE(false, true);
    const Portal portal(room.bus(), {.replies = false});
    room.add_zenity("exit 255\n");
    const std::vector<std::string> options =
        as_set ? std::vector<std::string>{"--open-dialog", "window"} : std::vector<std::string>{};
    Process viewer = room.open(options);
    room.begin(std::string("key ctrl+o sleep ") + (as_set ? "0.5" : "3.5") + " type jug");
    room.act("sleep 0.3 key Return sleep 0.7");
    CHECK(portal.asked().times == (as_set ? 0 : 1));
    CHECK(room.shows("jug"));
    room.act("key q");
    CHECK(viewer.wait() == 0);
}

TEST_CASE("a desktop that has no portal is asked through its helper program", "[desktop]") {
    Room room;
    room.add_zenity("echo '" + room.file("jug_rgb.png").string() + "'\n");
    Process viewer = room.open();
    room.begin("key ctrl+o sleep 1");
    CHECK(room.shows("jug"));
    room.act("key q");
    CHECK(viewer.wait() == 0);
}

TEST_CASE("a helper program that hangs is ended with the window", "[desktop]") {
    Room room;
    const fs::path told = room.file("told");
    room.add_zenity("echo $$ > '" + told.string() + "'\nexec sleep 1000\n");
    Process viewer = room.open();
    room.begin("key ctrl+o sleep 0.5");
    REQUIRE(eventually([&] { return !read_text(told).empty(); }));
    const std::string child = read_text(told);
    const fs::path words = "/proc/" + child.substr(0, child.find('\n')) + "/cmdline";
    CHECK_FALSE(read_text(words).empty());
    const auto begin = Clock::now();
    room.act("key q");
    CHECK(viewer.wait() == 0);
    CHECK(Clock::now() - begin < 1500ms);
    CHECK(eventually([&words] { return read_text(words).empty(); }, 1s));
}

TEST_CASE("a portal that is still thinking does not keep the program from ending", "[desktop]") {
    Room room;
    const Portal portal(room.bus(), {.replies = false});
    Process viewer = room.open();
    room.begin("key ctrl+o sleep 0.3");
    const auto begin = Clock::now();
    room.act("key q");
    CHECK(viewer.wait() == 0);
    CHECK(Clock::now() - begin < 1500ms);
}
