// What is kept about the Falcon, and what its buttons are mapped to.
#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "app/panels/device_state.hpp"
#include "app/panels/viewer_state.hpp"
#include "app/settings/falcon_settings.hpp"
#include "app/settings/settings.hpp"
#include "app/viewer/falcon.hpp"
#include "app/window/window.hpp"
#include "core/haptics/safety.hpp"
#include "device/device_or_mouse.hpp"
#include "device/falcon/packet.hpp"
#include "tests/app/program/desk.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr;
using namespace dibhr::test;
using Catch::Matchers::WithinAbs;
using falcon::Button;

namespace {

double value_of(const FalconNumber& number, FalconSettings settings) {
    return number.in(settings);
}

std::uint8_t bit(Button button) {
    return static_cast<std::uint8_t>(button);
}

std::string line_of(const FalconNumber& number, double value) {
    std::ostringstream line;
    line << "[falcon]\n" << number.name << " = " << std::fixed << value << "\n";
    return line.str();
}

Settings loaded(const std::string& text, std::vector<std::string>& warnings) {
    const TemporaryFolder folder;
    std::ofstream(folder / "settings.toml") << text;
    return load_settings(folder / "settings.toml", warnings);
}

}  // namespace

TEST_CASE("what is kept about the Falcon comes back exactly, whatever its serial is",
          "[falcon][settings]") {
    const TemporaryFolder folder;
    Settings settings;
    settings.falcon.connection = {GENERATE("", "SIM00001", "a \"b\" \\c\n\u00fc"), false, true};
    settings.falcon.buttons = {ButtonAction::none, ButtonAction::clutch, ButtonAction::clutch,
                               ButtonAction::take_screenshot};
    settings.falcon.force_in_front_only = false;
    for (const FalconNumber& number : falcon_numbers()) {
        number.in(settings.falcon) = number.lowest + 0.123456789 * (number.highest - number.lowest);
    }
    save_settings(settings, folder / "settings.toml");
    std::vector<std::string> warnings;
    const Settings back = load_settings(folder / "settings.toml", warnings);
    CHECK(warnings.empty());
    CHECK(same_settings(back, settings));
    CHECK(back.falcon.connection.serial == settings.falcon.connection.serial);
    CHECK_FALSE(same_settings(back, Settings{}));
}

TEST_CASE("each number of the Falcon has its own name, a help, and a default inside its range",
          "[falcon][settings]") {
    std::set<std::string> names;
    for (const FalconNumber& number : falcon_numbers()) {
        CAPTURE(number.name);
        CHECK(names.emplace(number.name).second);
        CHECK(std::string(number.help).size() > 10);
        CHECK(value_of(number, {}) >= number.lowest);
        CHECK(value_of(number, {}) <= number.highest);
    }
    CHECK(names.size() == 10 + 2 + 7);  // Geometry, Motors, WorkspaceOptions
}

TEST_CASE("a number of the Falcon out of its range keeps its default and is told with its line",
          "[falcon][settings]") {
    for (const FalconNumber& number : falcon_numbers()) {
        const double span = number.highest - number.lowest;
        for (const double wrong : {number.lowest - 0.5 * span, number.highest + 0.5 * span}) {
            CAPTURE(number.name, wrong);
            std::vector<std::string> warnings;
            const Settings settings = loaded(line_of(number, wrong), warnings);
            CHECK(same_settings(settings, Settings{}));
            REQUIRE(warnings.size() == 1);
            CHECK(warnings[0].find("settings.toml:2: falcon." + std::string(number.name)) !=
                  std::string::npos);
        }
    }
}

TEST_CASE("a button keeps its job when the file asks for one that there is not",
          "[falcon][settings]") {
    const std::string wrong = GENERATE("button-plus = \"dance\"", "button-plus = 3", "serial = 7",
                                       "button-up = \"none\"");
    CAPTURE(wrong);
    std::vector<std::string> warnings;
    CHECK(same_settings(loaded("[falcon]\n" + wrong + "\n", warnings), Settings{}));
    CHECK(warnings.size() == 1);
}

TEST_CASE("every job of a button is found by its name", "[falcon][buttons]") {
    for (const ButtonJob& job : button_jobs()) {
        CHECK(std::string_view(job.name) == name_of(job.value));
        CHECK(button_action_named(job.name) == job.value);
    }
    CHECK_FALSE(button_action_named("dance"));
}

TEST_CASE("the clutch is the centre button, and wherever else it is wished", "[falcon][buttons]") {
    CHECK(buttons_for(ButtonAction::clutch, FalconSettings{}.buttons) == bit(Button::centre));
    CHECK(buttons_for(ButtonAction::clutch, {}) == 0);
    const ButtonActions two{ButtonAction::clutch, ButtonAction::none, ButtonAction::record,
                            ButtonAction::clutch};
    CHECK(buttons_for(ButtonAction::clutch, two) == (bit(Button::plus) | bit(Button::minus)));
}

TEST_CASE("the hand never feels more stiffness or damping than the device can give, at any scale",
          "[falcon][settings]") {
    const double scale = GENERATE(0.1, 0.5, 1.0, 2.5, 10.0);
    Coupling wished;
    wished.stiffness_newton_per_mm = GENERATE(0.0, 0.05, 0.5, 2.0, 10.0);
    wished.damping_newton_s_per_m = GENERATE(0.0, 1.0, 15.0, 100.0);
    const DeviceLimits device = DeviceSpecification{}.limits;
    const Coupling held = held_coupling(wished, at_scale(device, scale));
    CAPTURE(scale, wished.stiffness_newton_per_mm, wished.damping_newton_s_per_m);
    const auto check = [scale](double felt, double asked, double most) {
        CHECK(felt * scale <= most + 1e-12);
        CHECK(felt <= asked);
        if (asked * scale <= most) CHECK_THAT(felt, WithinAbs(asked, 0.0));
    };
    check(held.stiffness_newton_per_mm, wished.stiffness_newton_per_mm,
          device.max_stiffness_newton_per_mm);
    check(held.damping_newton_s_per_m, wished.damping_newton_s_per_m,
          device.max_damping_newton_s_per_m);
    CHECK_THAT(held.pixel_pitch_mm, WithinAbs(wished.pixel_pitch_mm, 0.0));
}

TEST_CASE("stiffness is held for the Falcon, and left to the mouse while none answers",
          "[falcon][settings]") {
    ViewerState state;
    state.settings.touch.coupling.stiffness_newton_per_mm = 2.0;
    state.settings.falcon.workspace.scale = 4.0;
    const auto stiffness = [&state] { return felt_coupling(state).stiffness_newton_per_mm; };
    CHECK_THAT(stiffness(), WithinAbs(2.0, 0.0));
    state.falcon.emplace();
    CHECK_THAT(stiffness(), WithinAbs(0.25, 1e-12));  // before it is known what is there
    state.falcon->asked = true;
    CHECK_THAT(stiffness(), WithinAbs(2.0, 0.0));
    state.falcon->status.stage = GENERATE(falcon::Stage::homing, falcon::Stage::ready);
    CHECK_THAT(stiffness(), WithinAbs(0.25, 1e-12));
}

TEST_CASE("a window is in front until it loses a keyboard that it had, or is an icon",
          "[falcon][focus]") {
    CHECK(WindowFocus{}.in_front());  // no window manager has given it one
    CHECK(WindowFocus{.had = true, .has = true}.in_front());
    CHECK_FALSE(WindowFocus{.had = true}.in_front());
    CHECK_FALSE(WindowFocus{.iconified = true}.in_front());
    CHECK_FALSE(WindowFocus{.had = true, .has = true, .iconified = true}.in_front());
}

TEST_CASE("only the force of a Falcon waits for the window, and only when it is wished",
          "[falcon][focus]") {
    ViewerState state;
    state.in_front = false;
    CHECK_FALSE(waits_for_front(state));  // the mouse touches
    state.falcon.emplace().asked = true;
    CHECK_FALSE(waits_for_front(state));  // no Falcon is there
    state.falcon->status.stage = GENERATE(falcon::Stage::homing, falcon::Stage::ready);
    CHECK(waits_for_front(state));
    CHECK(state.force_enabled);  // the person's own switch stays as it is
    state.in_front = true;
    CHECK_FALSE(waits_for_front(state));
    state.in_front = false;
    state.settings.falcon.force_in_front_only = false;
    CHECK_FALSE(waits_for_front(state));
    state.settings.falcon.force_in_front_only = true;
    state.replay.emplace();
    CHECK_FALSE(waits_for_front(state));
}

TEST_CASE("a force that waits for the window is told, unless the person has switched it off",
          "[falcon][banner]") {
    ViewerState state;
    state.falcon.emplace().status.stage = falcon::Stage::ready;
    state.haptic.hand.which = static_cast<std::uint8_t>(Touching::falcon);
    state.in_front = false;
    CHECK(device_banner(state).find("not in front") != std::string::npos);
    state.force_enabled = false;
    CHECK(device_banner(state).empty());
}

TEST_CASE("the window says over the relief what an attached or lost Falcon needs",
          "[falcon][banner]") {
    ViewerState state;
    CHECK(device_banner(state).empty());
    state.falcon.emplace();
    state.falcon->status.sentence = "plug it in";
    CHECK(device_banner(state).empty());  // none has been there: only the panel says so
    state.falcon->status.trouble = true;  // one could not be brought up
    CHECK(device_banner(state) == "plug it in");
    state.falcon->status.trouble = false;
    state.falcon->was_ready = true;  // one was lost
    CHECK(device_banner(state) == "plug it in");
    state.falcon->status.stage = falcon::Stage::ready;
    CHECK(device_banner(state).empty());
    state.falcon->was_ready = false;
    state.falcon->status.stage = GENERATE(falcon::Stage::cannot_open, falcon::Stage::no_firmware,
                                          falcon::Stage::loading, falcon::Stage::homing);
    CHECK(device_banner(state) == "plug it in");
}

TEST_CASE("a held clutch is told as such, and only of a Falcon that touches", "[falcon][banner]") {
    ViewerState state;
    state.haptic.hand.buttons = bit(Button::centre);
    CHECK_FALSE(clutched(state));  // the mouse's button
    state.falcon.emplace();
    CHECK_FALSE(clutched(state));
    state.haptic.hand.which = static_cast<std::uint8_t>(Touching::falcon);
    state.falcon->status.stage = falcon::Stage::ready;
    CHECK(clutched(state));
    state.haptic.hand.stand_in = true;
    CHECK_FALSE(clutched(state));
    state.haptic.hand = {.buttons = bit(Button::plus)};
    CHECK_FALSE(clutched(state));
}

TEST_CASE("a dropped firmware file is told from a picture by its name", "[falcon][firmware]") {
    CHECK(named_firmware("nvent_firmware.bin"));
    CHECK(named_firmware("/media/cd/NOVINT.BIN"));
    CHECK(named_firmware("FalconFirmwareBinaryNvent.h"));
    CHECK_FALSE(named_firmware("color.mp4"));
    CHECK_FALSE(named_firmware("bin"));
}
