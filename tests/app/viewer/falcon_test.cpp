// The whole program touches with a simulated Falcon below libusb, whose hand is pushed by the
// commanded torques.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <glm/geometric.hpp>
#include <string>
#include <vector>

#include "app/viewer/files.hpp"
#include "core/haptics/safety.hpp"
#include "tests/app/program/command_program.hpp"
#include "tests/app/program/desk.hpp"
#include "tests/app/program/falcon_on_usb.hpp"
#include "tests/app/program/falcon_scene.hpp"
#include "tests/app/program/strokes.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr;
using namespace dibhr::test;
using Catch::Matchers::WithinAbs;

namespace {

using TickRows = std::vector<Row>;

// Of two values, over panels that are closed.
constexpr const char* kAgree = "mousemove 90 159 click 1";
constexpr const char* kKeepUsual = "mousemove 230 142 click 1";
const std::string kWithoutPanels = "[window]\npanels-visible = false\n";

bool falcon_touches(const Row& row) {
    return row.contact && row.ready && !row.mouse_fallback;
}

bool is_firm(const Row& row) {
    return glm::length(row.sent_newton) > 0.5;
}

/// The depth of 0.5 N at the default 0.5 N/mm: the loop softens the spring of a Falcon that answers
/// late, as on a busy machine.
bool is_pressed(const Row& row) {
    return row.contact && glm::length(row.spring_newton) > 0.0 &&
           glm::distance(row.goal, row.proxy) * kSlopePitch_mm > 1.0;
}

bool cut_for(SafetyCut reason, const Row& row) {
    return row.cut == static_cast<int>(reason);
}

/// A window of another program, which takes the keyboard of the viewer.
class OtherWindow {
  public:
    explicit OtherWindow(const FalconScene& at)
        : at_(at), program_(at.desk.start(folder_, {}, {OTHER_WINDOW})) {
        at_.viewer.wait_until([](const Seen& now) { return !now.in_front; });
    }
    void close() {
        program_.send(SIGTERM);
        REQUIRE(program_.wait() == 0);
        at_.viewer.wait_until([](const Seen& now) { return now.in_front; });
    }

  private:
    const FalconScene& at_;
    const TemporaryFolder folder_{};
    WindowProgram program_;
};

/// The Falcon's rows in which the goal is that far from the last one [image mm], a millisecond
/// after it. Later rows are left out: the allowed distance depends on the time, which a busy
/// machine does not keep.
TickRows steps_of(const TickRows& rows, double least_mm, double most_mm) {
    TickRows steps;
    for (std::size_t k = 1; k < rows.size(); ++k) {
        const Row& before = rows[k - 1];
        const Row& after = rows[k];
        const bool of_falcon = before.surface && !before.mouse_fallback && !after.mouse_fallback;
        const bool in_time = std::fabs(after.t_s - before.t_s - 1e-3) < 2e-4;
        const double step_mm = glm::distance(before.goal, after.goal) * kSlopePitch_mm;
        if (of_falcon && in_time && step_mm > least_mm && step_mm < most_mm) steps.push_back(after);
    }
    return steps;
}

/// Steps of a fast hand after one lost reply.
TickRows fast_steps(const TickRows& rows) {
    return steps_of(rows, 15.0, 30.0);
}

/// Steps that no hand makes.
TickRows jumps(const TickRows& rows) {
    return steps_of(rows, 45.0, 75.0);
}

/// Whether the Falcon took over in contact, the force began at zero, and is firm again.
bool rises_anew(const TickRows& rows) {
    const auto anew = std::find_if(rows.begin(), rows.end(), [](const Row& row) {
        return row.releases_contact && falcon_touches(row);
    });
    const auto weak = std::find_if(anew, rows.end(), [](const Row& row) {
        return falcon_touches(row) && cut_for(SafetyCut::none, row) &&
               glm::length(row.sent_newton) < 0.05 * glm::length(row.spring_newton);
    });
    return std::any_of(rows.begin(), anew, is_firm) && std::any_of(weak, rows.end(), is_firm);
}

}  // namespace

TEST_CASE(
    "the program loads, homes, rests, presses and slides; its forces are those of dibhr touch",
    "[falcon][window]") {
    // `touch` has no hand that could swing. The sample plays slowly: few frames come late.
    FalconScene at(
        {.commands = {"realtime on"}, .arguments = {"--stability", "off", "--speed", "0.25"}});
    at.falcon.home();
    at.falcon.move_hand({0.0, 0.0, 140.0}, 0.2);
    const auto is_enough = [](const Stroked& so_far) {
        return so_far.contacts > 800 && so_far.held_back > 100;
    };
    Stroked so_far;
    for (int strokes = 0; strokes < 20 && !is_enough(so_far); ++strokes) {
        at.falcon.move_hand({0.0, 0.0, 118.0}, 0.2);
        at.falcon.move_hand({0.0, 0.0, 108.0}, 0.2);
        FalconOnUsb::wait_until([&at] { return at.falcon.number("lamp") == 2; });  // green: force
        at.wait_for_force();
        at.falcon.move_hand({14.0, 0.0, 108.0}, 0.8);
        at.falcon.move_hand({14.0, 0.0, 140.0}, 0.2);
        so_far = stroked(at.rows());
    }
    CHECK(is_enough(so_far));
    CHECK(at.falcon.number("force_before_homing") == 0);
    const TickRows rows = at.finish();

    run_shell("sqlite3 '" + (at.folder / "hand.dibhr").string() +
              "' \"SELECT value FROM session WHERE key = 'falcon-serial'\" | grep -qx SIM00001");
    CHECK(strongest(rows) <= SafetyLimits{}.max_force_newton + 1e-9);
    CHECK_THAT(worst_touched_again(rows), WithinAbs(0.0, 1e-9));
}

TEST_CASE("a Falcon pulled in mid-touch leaves the mouse, and is taken back after homing",
          "[falcon][window]") {
    FalconScene at({.device = "auto", .settings = "[window]\npanels-visible = false\n"});
    at.press_in();
    at.viewer.wait_until([](const Seen& now) { return !now.mouse_fallback && now.contact; });
    at.falcon.tell("unplug");
    at.viewer.wait_until([](const Seen& now) { return now.mouse_fallback; });
    at.viewer.act("mousemove 160 120 mousedown 1");
    at.viewer.wait_until(
        [](const Seen& now) { return now.mouse_fallback && now.contact && now.sent_newton > 0.2; });
    at.viewer.act("mouseup 1");
    at.falcon.tell("power off");
    at.falcon.tell("power on");
    at.falcon.tell("replug");
    at.falcon.home();
    at.viewer.wait_until([](const Seen& now) { return !now.mouse_fallback; });
    at.falcon.move_hand({0.0, 0.0, 140.0}, 0.2);
    at.press_in();
    CHECK(at.falcon.number("force_before_homing") == 0);
    const TickRows rows = at.finish();

    const auto touched = std::find_if(rows.begin(), rows.end(), falcon_touches);
    REQUIRE(touched != rows.end());
    const auto lost =
        std::find_if(touched, rows.end(), [](const Row& row) { return row.mouse_fallback; });
    REQUIRE(lost != rows.end());
    CHECK(strongest({touched, lost}) > 0.5);
    CHECK_THAT(glm::length(lost->sent_newton), WithinAbs(0.0, 1e-12));
    const auto back =
        std::find_if(lost, rows.end(), [](const Row& row) { return !row.mouse_fallback; });
    REQUIRE(back != rows.end());
    const TickRows of_mouse(lost, back);
    CHECK(std::any_of(of_mouse.begin(), of_mouse.end(),
                      [](const Row& row) { return row.contact && row.pressed; }));
    CHECK(strongest(of_mouse) > 0.1);
    CHECK_THAT(glm::length(back->sent_newton), WithinAbs(0.0, 1e-12));
    const TickRows after(back, rows.end());
    CHECK(std::any_of(after.begin(), after.end(), falcon_touches));
    CHECK(strongest(after) > 0.5);
}

TEST_CASE("the grip's buttons record, hold the film, and take the force off", "[falcon][window]") {
    FalconScene at({.arguments = {"--speed", "0.25"}});
    const auto press = [&at](unsigned bit, const auto& is_done) {
        at.falcon.tell("press " + std::to_string(bit));
        at.viewer.wait_until([&](const Seen& now) { return now.buttons == bit && is_done(now); });
        at.falcon.tell("press 0");
        at.viewer.wait_until([](const Seen& now) { return now.buttons == 0; });
    };
    const auto records = [](const Seen& now) { return now.records; };
    const auto rests = [](const Seen& now) { return !now.records; };
    at.press_in();
    press(2, [](const Seen& now) { return !now.playing; });        // forward
    press(8, [](const Seen& now) { return !now.force_enabled; });  // minus
    at.falcon.wait_for_zeros(5.0);
    const auto held_since = at.viewer.seen().recorded_rows;
    at.viewer.wait_until(
        [held_since](const Seen& now) { return now.recorded_rows > held_since + 300; });
    press(1, rests);  // plus: the recording on the command line ends
    press(1, records);
    press(1, rests);
    const TickRows rows = at.finish();
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
    FalconScene at;
    at.press_in();
    OtherWindow other(at);
    at.falcon.wait_for_zeros(200.0);
    other.close();
    at.wait_for_force();
    const TickRows rows = at.finish();

    const auto off = [](const Row& row) { return cut_for(SafetyCut::off, row); };
    const auto lost = std::find_if(rows.begin(), rows.end(), off);
    REQUIRE(lost != rows.end());
    CHECK(std::any_of(rows.begin(), lost, is_firm));
    // On a busy machine a notice about a late tick may come first.
    const auto back = std::find_if(lost, rows.end(),
                                   [](const Row& row) { return cut_for(SafetyCut::none, row); });
    CHECK(std::count_if(lost, back, off) > 100);
    CHECK(std::all_of(lost, back, [](const Row& row) {
        return is_pressed(row) && !(glm::length(row.sent_newton) > 0.0);
    }));
    REQUIRE(back != rows.end());
    CHECK(falcon_touches(*back));
    CHECK(glm::length(back->sent_newton) < 0.05 * glm::length(back->spring_newton));
    CHECK(strongest({back, rows.end()}) > 0.5);
    require_same_bits(at.folder, at.folder / "hand.dibhr");
}

TEST_CASE(
    "the force stays while another window has the keyboard, when it is wished so, and rises again "
    "from zero when the hand is centred",
    "[falcon][window]") {
    FalconScene at({.settings = "[falcon]\nforce-in-front-only = false\n",
                    .agreed = "falcon.force-in-front-only false\n"});
    at.press_in();
    OtherWindow other(at);
    at.falcon.wait_for_forces(300.0);
    other.close();
    at.wait_for_force();
    at.viewer.act("key c");
    at.wait_until_recorded(rises_anew);
    const TickRows rows = at.finish();
    CHECK(std::none_of(rows.begin(), rows.end(),
                       [](const Row& row) { return cut_for(SafetyCut::off, row); }));
}

TEST_CASE(
    "what protects the hand less in a settings file of others holds when a person agrees to it",
    "[falcon][window]") {
    const std::string sent =
        kWithoutPanels + "[device]\nmax-force = 8.0\n[falcon]\nforce-in-front-only = false\n";
    FalconScene at({.settings = sent});
    const auto pressed_newton = [&at] { return glm::length(at.falcon.vector("motor_newton")); };
    at.falcon.move_hand({0.0, 0.0, 80.0}, 0.4);
    FalconOnUsb::wait_until([&] { return pressed_newton() > 3.9; });
    {
        OtherWindow other(at);
        at.falcon.wait_for_zeros(200.0);
        other.close();
    }
    FalconOnUsb::wait_until([&] { return pressed_newton() > 3.9; });
    CHECK(at.viewer.seen().unsafe_settings == 2);
    CHECK(strongest(at.rows()) <= SafetyLimits{}.max_force_newton + 1e-9);
    at.viewer.act(kAgree);
    FalconOnUsb::wait_until([&] { return pressed_newton() > 6.0; });
    {
        OtherWindow other(at);
        at.falcon.wait_for_forces(300.0);
        other.close();
    }
    CHECK(at.viewer.seen().unsafe_settings == 0);
    at.desk.press("key q");
    REQUIRE(at.viewer.wait() == 0);
    CHECK(
        contains(at.errors(), "settings.toml asks for Max force [N] 8 in place of 4, Force only"));
    CHECK(read_text(at.folder / "config/dibhr/settings.toml") == sent);
    CHECK(contains(read_text(at.folder / "state/dibhr/agreed"),
                   "device.max-force 8\nfalcon.force-in-front-only false\n"));
}

TEST_CASE("whoever keeps the usual values is not asked again", "[falcon][window]") {
    FalconScene at(
        {.settings = kWithoutPanels + "[touch]\nstability = false\ndamping-as-needed = false\n"});
    at.viewer.wait_until([](const Seen& now) { return now.unsafe_settings == 2; });
    at.viewer.act(kKeepUsual);
    at.viewer.wait_until([](const Seen& now) { return now.unsafe_settings == 0; });
    at.desk.press("key q");
    REQUIRE(at.viewer.wait() == 0);
    CHECK(contains(read_text(at.folder / "config/dibhr/settings.toml"), "stability = true\n"));
    CHECK(contains(read_text(at.folder / "config/dibhr/settings.toml"), "as-needed = true\n"));
    CHECK(read_text(at.folder / "state/dibhr/agreed").empty());
}

TEST_CASE("what is a jump is measured in the hand's millimetres, whatever the scale",
          "[falcon][window]") {
    FalconScene at({.settings = "[falcon]\nscale = 4.0\n"});
    FalconOnUsb::wait_until([&at] {
        for (const char* const place :
             {"place 6 0 140", "place 0 0 140", "place 6 0 140", "place -9 0 140"}) {
            at.falcon.tell(place);
            at.falcon.wait_for_commands(20.0);
        }
        const TickRows rows = at.rows();
        return !fast_steps(rows).empty() && !jumps(rows).empty();
    });
    const TickRows rows = at.finish();
    const auto is_jump = [](const Row& row) { return cut_for(SafetyCut::goal_jump, row); };
    const TickRows fast = fast_steps(rows);
    const TickRows too_fast = jumps(rows);
    CHECK(std::none_of(fast.begin(), fast.end(), is_jump));
    CHECK(std::all_of(too_fast.begin(), too_fast.end(), is_jump));
    require_same_bits(at.folder, at.folder / "hand.dibhr");
}

TEST_CASE("a dropped firmware file is told from a picture by its name", "[falcon][firmware]") {
    CHECK(named_firmware("nvent_firmware.bin"));
    CHECK(named_firmware("/media/cd/NOVINT.BIN"));
    CHECK(named_firmware("FalconFirmwareBinaryNvent.h"));
    CHECK_FALSE(named_firmware("color.mp4"));
    CHECK_FALSE(named_firmware("bin"));
}
