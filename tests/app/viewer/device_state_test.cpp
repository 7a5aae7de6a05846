// What the state of the force devices means for the force, and how it is said in the window.
#include "app/panels/device_state.hpp"

#include <cstdint>
#include <string>

#include "app/panels/viewer_state.hpp"
#include "app/settings/grip_buttons.hpp"
#include "core/haptics/safety.hpp"
#include "device/device_or_mouse.hpp"
#include "device/falcon/packet.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr;
using Catch::Matchers::WithinAbs;
using falcon::Button;

namespace {

std::uint8_t bit_of(Button button) {
    return static_cast<std::uint8_t>(button);
}

}  // namespace

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

TEST_CASE("the stiffness shown for a device that answers late is the one that the loop applies",
          "[falcon][settings]") {
    ViewerState state;
    state.settings.touch.coupling.stiffness_newton_per_mm = 0.5;
    state.falcon.emplace().status.stage = falcon::Stage::ready;
    state.haptic.hand.limits = DeviceLimits{.max_stiffness_newton_per_mm = 0.3};
    CHECK_THAT(felt_coupling(state).stiffness_newton_per_mm, WithinAbs(0.5, 0.0));  // the mouse's
    state.haptic.hand.which = static_cast<std::uint8_t>(Touching::falcon);
    CHECK_THAT(felt_coupling(state).stiffness_newton_per_mm, WithinAbs(0.3, 1e-12));
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
    CHECK_FALSE(asked_settings(state).force_enabled);
    CHECK(state.force_enabled);  // the person's own switch stays as it is
    state.in_front = true;
    CHECK_FALSE(waits_for_front(state));
    CHECK(asked_settings(state).force_enabled);
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
    state.haptic.hand.buttons = bit_of(Button::centre);
    CHECK_FALSE(clutched(state));  // the mouse's button
    state.falcon.emplace();
    CHECK_FALSE(clutched(state));
    state.haptic.hand.which = static_cast<std::uint8_t>(Touching::falcon);
    state.falcon->status.stage = falcon::Stage::ready;
    CHECK(clutched(state));
    state.haptic.hand.stand_in = true;
    CHECK_FALSE(clutched(state));
    state.haptic.hand = {.buttons = bit_of(Button::plus)};
    CHECK_FALSE(clutched(state));
}

TEST_CASE("the window says over the relief what an Inverse3 that is there lacks",
          "[inverse3][banner]") {
    ViewerState state;
    inverse3::Status& status = state.inverse3.emplace().status;
    status.sentence = "do this";
    CHECK(device_banner(state).empty());  // no service, and nobody asked for one
    CHECK_FALSE(inverse3_in_sight(state));
    status.stage = inverse3::Stage::no_device;
    CHECK(device_banner(state).empty());
    status.stage = GENERATE(inverse3::Stage::no_power, inverse3::Stage::not_calibrated,
                            inverse3::Stage::locked, inverse3::Stage::in_use, inverse3::Stage::deaf,
                            inverse3::Stage::too_old, inverse3::Stage::not_understood);
    CHECK(device_banner(state) == "do this");
    CHECK(inverse3_in_sight(state));
    status.stage = inverse3::Stage::ready;
    CHECK(device_banner(state).empty());
}

TEST_CASE("what the Falcon lacks is not said while an Inverse3 touches", "[inverse3][banner]") {
    ViewerState state;
    state.falcon.emplace().status.stage = falcon::Stage::homing;
    state.falcon->status.sentence = "pull it out";
    state.inverse3.emplace().status.stage = inverse3::Stage::ready;
    CHECK(device_banner(state) == "pull it out");
    state.haptic.hand.which = static_cast<std::uint8_t>(Touching::inverse3);
    CHECK(device_banner(state).empty());
    state.haptic.hand.buttons = 1;
    CHECK(clutched(state));  // its own button A, not the Falcon's
}
