// The whole program touches its sample with a simulated Falcon below libusb, whose hand is pushed
// by the commanded torques.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstddef>
#include <filesystem>
#include <glm/geometric.hpp>
#include <iterator>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "core/haptics/parameters.hpp"
#include "core/haptics/safety.hpp"
#include "tests/app/program/command_program.hpp"
#include "tests/app/program/desk.hpp"
#include "tests/app/program/falcon_on_usb.hpp"
#include "tests/app/program/falcon_scene.hpp"
#include "tests/app/program/strokes.hpp"
#include "tests/device/falcon/packet_file.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr;
using namespace dibhr::test;
using Catch::Matchers::WithinAbs;
using dibhr::test::falcon::LoggedPacket;
using dibhr::test::falcon::packets_after;

namespace {

using namespace std::chrono_literals;
using Words = std::vector<std::string>;
using Rows = std::vector<Row>;

constexpr const char* kMeet = "search --sync --onlyvisible --name dibhr sleep 0.1 ";

bool falcon_touches(const Row& row) {
    return row.contact && row.ready && !row.stand_in;
}

/// A window of another program, which takes the keyboard when it opens.
class OtherWindow {
  public:
    explicit OtherWindow(const Desk& desk)
        : desk_(desk),
          viewer_(desk.start_viewer(folder_, {"--device", "mouse", "--size", "200x160", "--record",
                                              "other.dibhr", "--seconds", "60"})) {
        FalconOnUsb::wait_until(
            [this] { return std::filesystem::exists(folder_ / "other.dibhr"); });
    }

    /// By a key, which only the window that has the keyboard is told of.
    void close() {
        desk_.act("key q");
        REQUIRE(viewer_.wait() == 0);
    }

  private:
    const Desk& desk_;
    const TemporaryFolder folder_{};
    Process viewer_;
};

bool cut_for(SafetyCut reason, const Row& row) {
    return row.cut == static_cast<int>(reason);
}

/// The rows of the Falcon in which the goal is so far from the one before [image mm], and which
/// come a millisecond after it: how far it may be goes by the time, which a busy machine does not
/// keep.
Rows steps_of(const Rows& rows, double least_mm, double most_mm) {
    Rows steps;
    for (std::size_t k = 1; k < rows.size(); ++k) {
        const Row& before = rows[k - 1];
        const Row& after = rows[k];
        const bool of_falcon = before.surface && !before.stand_in && !after.stand_in;
        const bool in_time = std::fabs(after.t_s - before.t_s - 1e-3) < 2e-4;
        const double step_mm = glm::distance(before.goal, after.goal) * Coupling{}.pixel_pitch_mm;
        if (of_falcon && in_time && step_mm > least_mm && step_mm < most_mm) steps.push_back(after);
    }
    return steps;
}

}  // namespace

TEST_CASE(
    "the program loads, homes, rests, presses and slides; its forces are those of dibhr touch",
    "[falcon][window]") {
    // `touch` has no hand that could swing.
    FalconScene at({"realtime on"}, {"--device", "falcon", "--stability", "off"});
    at.falcon.home();
    at.falcon.move_hand({0.0, 0.0, 140.0}, 0.3);
    at.desk.act("key Home sleep 0.3");  // ten seconds of video to touch

    for (int stroke = 0; stroke < 3; ++stroke) {  // a busy machine passes frames over in some
        at.falcon.move_hand({0.0, 0.0, 118.0}, 0.5);
        std::this_thread::sleep_for(400ms);
        at.falcon.move_hand({0.0, 0.0, 108.0}, 0.4);
        FalconOnUsb::wait_until([&at] { return at.falcon.number("lamp") == 2; });  // green: force
        at.wait_for_force();
        std::this_thread::sleep_for(800ms);
        at.falcon.move_hand({14.0, 0.0, 108.0}, 1.0);
        at.falcon.move_hand({14.0, 0.0, 140.0}, 0.3);
    }
    CHECK(at.falcon.number("force_before_homing") == 0);
    const Rows rows = at.finish();

    run_shell("sqlite3 '" + (at.folder / "hand.dibhr").string() +
              "' \"SELECT value FROM session WHERE key = 'falcon-serial'\" | grep -qx SIM00001");
    CHECK(strongest(rows) <= SafetyLimits{}.max_force_newton + 1e-9);
    const TouchedAgain again = touched_again(rows);
    CHECK(again.contacts > 800);
    CHECK(again.held_back > 100);
    CHECK_THAT(again.worst_newton, WithinAbs(0.0, 1e-9));
}

TEST_CASE("a Falcon pulled in mid-touch leaves the mouse, and is taken back after homing",
          "[falcon][window]") {
    FalconScene at(kHomedFalcon, {"--device", "auto"});
    at.falcon.move_hand({0.0, 0.0, 105.0}, 0.3);
    at.wait_for_force();
    at.falcon.tell("unplug");
    std::this_thread::sleep_for(300ms);
    at.desk.act("mousemove 330 400 sleep 0.5 mousedown 1 sleep 0.8 mouseup 1 sleep 0.2");
    at.falcon.tell("power off");
    at.falcon.tell("power on");
    at.falcon.tell("replug");
    at.falcon.home();
    at.falcon.move_hand({0.0, 0.0, 140.0}, 0.2);
    std::this_thread::sleep_for(200ms);
    at.falcon.move_hand({0.0, 0.0, 105.0}, 0.3);
    at.wait_for_force();
    CHECK(at.falcon.number("force_before_homing") == 0);
    const Rows rows = at.finish();

    const auto touched = std::find_if(rows.begin(), rows.end(), falcon_touches);
    REQUIRE(touched != rows.end());
    const auto lost =
        std::find_if(touched, rows.end(), [](const Row& row) { return row.stand_in; });
    REQUIRE(lost != rows.end());
    CHECK(strongest({touched, lost}) > 0.5);
    CHECK_THAT(glm::length(lost->sent_newton), WithinAbs(0.0, 1e-12));
    const auto back = std::find_if(lost, rows.end(), [](const Row& row) { return !row.stand_in; });
    REQUIRE(back != rows.end());
    const Rows of_mouse(lost, back);
    CHECK(std::any_of(of_mouse.begin(), of_mouse.end(),
                      [](const Row& row) { return row.contact && row.pressed; }));
    CHECK(strongest(of_mouse) > 0.1);
    CHECK_THAT(glm::length(back->sent_newton), WithinAbs(0.0, 1e-12));
    const Rows after(back, rows.end());
    CHECK(std::any_of(after.begin(), after.end(), falcon_touches));
    CHECK(strongest(after) > 0.5);
}

TEST_CASE("centring the hand in mid-touch lets the force rise again from zero",
          "[falcon][window]") {
    FalconScene at(kHomedFalcon, {"--device", "falcon"});
    at.press_in();
    std::this_thread::sleep_for(700ms);
    at.desk.act("key c sleep 1.2");
    const Rows rows = at.finish();
    const auto firm = std::find_if(rows.begin(), rows.end(), [](const Row& row) {
        return falcon_touches(row) && glm::length(row.sent_newton) > 0.5;
    });
    const auto weak = std::find_if(firm, rows.end(), [](const Row& row) {
        return row.contact && cut_for(SafetyCut::none, row) &&
               glm::length(row.sent_newton) < 0.05 * glm::length(row.spring_newton);
    });
    REQUIRE(weak != rows.end());
    CHECK(strongest({weak, rows.end()}) > 0.5);
}

TEST_CASE("killed in mid-touch, the program leaves a Falcon without force within 100 ms",
          "[falcon][window]") {
    const int signal = GENERATE(SIGKILL, SIGSEGV);
    Words commands = kHomedFalcon;
    commands.insert(commands.end(), {"hold 0", "realtime on"});
    FalconScene at(commands, {"--device", "falcon"});
    at.press_in();
    const auto killed = std::chrono::steady_clock::now();
    at.viewer.signal_program(signal);
    CHECK(at.viewer.wait() == 128 + signal);
    CHECK(at.seconds_to_zero(killed) < 0.1);
    const double killed_s = std::chrono::duration<double>(killed.time_since_epoch()).count();
    const auto packets = packets_after(at.falcon.packets(), killed_s);
    CHECK(std::ranges::count_if(packets, [](const auto& each) { return !each.has_force(); }) >= 5);
}

TEST_CASE("the grip's buttons record, hold the film, and take the force off", "[falcon][window]") {
    FalconScene at(kHomedFalcon, {"--device", "falcon"});
    const auto press = [&at](int bit) {
        at.falcon.tell("press " + std::to_string(bit));
        std::this_thread::sleep_for(150ms);
        at.falcon.tell("press 0");
        std::this_thread::sleep_for(350ms);
    };
    at.falcon.move_hand({0.0, 0.0, 105.0}, 0.3);
    at.wait_for_force();
    press(2);  // forward
    std::this_thread::sleep_for(300ms);
    press(8);  // minus
    FalconOnUsb::wait_until([&at] { return at.falcon.number("zeros_in_a_row") > 5.0; });
    press(1);  // plus: the recording on the command line ends
    press(1);  // and a new one begins
    press(1);
    const Rows rows = at.finish();
    CHECK_THAT(rows.back().video_s - rows[rows.size() - 300].video_s, WithinAbs(0.0, 1e-12));
    CHECK(cut_for(SafetyCut::off, rows.back()));
    std::size_t recordings = 0;
    for (const auto& entry : std::filesystem::directory_iterator(at.folder.path())) {
        const std::string name = entry.path().filename().string();
        if (name.starts_with("dibhr-") && name.ends_with(".dibhr")) ++recordings;
    }
    CHECK(recordings == 1);
}

TEST_CASE("the force is off while another window has the keyboard, and rises again when it is back",
          "[falcon][window]") {
    FalconScene at(kHomedFalcon, {"--device", "falcon"});
    at.press_in();
    std::this_thread::sleep_for(700ms);
    OtherWindow other(at.desk);
    FalconOnUsb::wait_until([&at] { return at.falcon.number("zeros_in_a_row") > 100.0; });
    other.close();
    at.desk.act(std::string(kMeet) + "windowfocus");
    at.wait_for_force();
    std::this_thread::sleep_for(700ms);
    const Rows rows = at.finish();

    const auto off = [](const Row& row) { return cut_for(SafetyCut::off, row); };
    const auto lost = std::find_if(rows.begin(), rows.end(), off);
    REQUIRE(lost - rows.begin() > 500);
    REQUIRE(lost != rows.end());
    // A busy machine takes it off for a moment.
    CHECK(std::count_if(lost - 500, lost,
                        [](const Row& row) { return glm::length(row.sent_newton) > 0.5; }) > 250);
    // A late tick, which a busy machine has, is told before it.
    const auto back = std::find_if(lost, rows.end(),
                                   [](const Row& row) { return cut_for(SafetyCut::none, row); });
    CHECK(std::count_if(lost, back, off) > 100);
    CHECK(std::all_of(lost, back, [](const Row& row) {
        return glm::length(row.spring_newton) > 0.5 && !(glm::length(row.sent_newton) > 0.0);
    }));
    REQUIRE(back != rows.end());
    CHECK(falcon_touches(*back));
    CHECK(glm::length(back->sent_newton) < 0.05 * glm::length(back->spring_newton));
    CHECK(strongest({back, rows.end()}) > 0.5);
    require_same_bits(at.folder, at.folder / "hand.dibhr");
}

TEST_CASE("the force stays while another window has the keyboard, when it is wished so",
          "[falcon][window]") {
    FalconScene at(kHomedFalcon, {"--device", "falcon"}, "[falcon]\nforce-in-front-only = false\n");
    at.press_in();
    OtherWindow other(at.desk);
    std::this_thread::sleep_for(700ms);
    at.wait_for_force();  // which a late tick, as on a busy machine, takes off for a moment
    other.close();
    std::this_thread::sleep_for(300ms);
    at.wait_for_force();
    at.desk.act(std::string(kMeet) + "windowfocus");
    const Rows rows = at.finish();
    CHECK(std::none_of(rows.begin(), rows.end(),
                       [](const Row& row) { return cut_for(SafetyCut::off, row); }));
    const auto is_felt = [](const Row& row) { return row.sent_newton.z > 0.5; };
    const auto felt = std::find_if(rows.begin(), rows.end(), is_felt);
    CHECK(std::count_if(felt, rows.end(), is_felt) > (rows.end() - felt) / 2);
}

TEST_CASE("what is a jump is measured in the hand's millimetres, whatever the scale",
          "[falcon][window]") {
    FalconScene at(kHomedFalcon, {"--device", "falcon"}, "[falcon]\nscale = 4.0\n");
    std::this_thread::sleep_for(1500ms);  // the window has seen that it touches
    // A fast hand, of which a reply was lost, and one that no hand is, often enough.
    for (int time = 0; time < 5; ++time) {
        for (const char* const place :
             {"place 6 0 140", "place 0 0 140", "place 6 0 140", "place -9 0 140"}) {
            at.falcon.tell(place);
            std::this_thread::sleep_for(100ms);
        }
    }
    const Rows rows = at.finish();
    const auto is_jump = [](const Row& row) { return cut_for(SafetyCut::goal_jump, row); };
    const Rows fast = steps_of(rows, 15.0, 30.0);
    REQUIRE_FALSE(fast.empty());
    CHECK(std::none_of(fast.begin(), fast.end(), is_jump));
    const Rows too_fast = steps_of(rows, 45.0, 75.0);
    REQUIRE_FALSE(too_fast.empty());
    CHECK(std::all_of(too_fast.begin(), too_fast.end(), is_jump));
    require_same_bits(at.folder, at.folder / "hand.dibhr");
}
