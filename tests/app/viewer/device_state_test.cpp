// What the state of the force devices means for the force, and the window's texts about it.
#include "app/touching/device_state.hpp"

#include <cstddef>
#include <cstdint>
#include <string>

#include "app/panels/viewer_state.hpp"
#include "app/settings/button_action_names.hpp"
#include "app/touching/force_law.hpp"
#include "core/haptics/safety.hpp"
#include "device/falcon/falcon_device.hpp"
#include "device/inverse3/inverse3_device.hpp"
#include "tests/app/settings/own_settings.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr;
using Catch::Matchers::WithinAbs;
using falcon::Button;

namespace {

std::uint8_t bit_of(Button button) {
    return static_cast<std::uint8_t>(button);
}

// Indices in force_device_kinds().
constexpr std::size_t kFalcon = 0;
constexpr std::size_t kInverse3 = 1;

DeviceInfo& look_for(ViewerState& state, std::size_t kind) {
    state.touch.devices.push_back({.kind = kind});
    return state.touch.devices.back();
}

/// Makes the device the one that touched in the last tick.
void touch_with(ViewerState& state, std::size_t kind) {
    state.touch.haptic.hand.device_number = static_cast<std::uint8_t>(kind + 1);
}

DeviceState state_at(falcon::Stage stage, const std::string& sentence = {}) {
    falcon::Status status;
    status.stage = stage;
    status.sentence = sentence;
    return state_of(status);
}

DeviceState state_at(inverse3::Stage stage, const std::string& sentence = {}) {
    inverse3::Status status;
    status.stage = stage;
    status.sentence = sentence;
    return state_of(status);
}

std::string banner_of(const ViewerState& state) {
    return device_banner(state.settings, state.touch);
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
    test::own_settings<falcon::FalconSettings>(state.settings).workspace.scale = 4.0;
    const auto stiffness = [&state] {
        return effective_coupling(state.settings, state.touch).stiffness_newton_per_mm;
    };
    CHECK_THAT(stiffness(), WithinAbs(2.0, 0.0));
    DeviceInfo& info = look_for(state, kFalcon);
    CHECK_THAT(stiffness(), WithinAbs(0.25, 1e-12));  // before the devices' states are known
    info.answered = true;
    CHECK_THAT(stiffness(), WithinAbs(2.0, 0.0));
    info.state = state_at(GENERATE(falcon::Stage::homing, falcon::Stage::ready));
    CHECK_THAT(stiffness(), WithinAbs(0.25, 1e-12));
}

TEST_CASE("the stiffness shown for a device that answers late is the one that the loop applies",
          "[falcon][settings]") {
    ViewerState state;
    state.settings.touch.coupling.stiffness_newton_per_mm = 0.5;
    look_for(state, kFalcon).state = state_at(falcon::Stage::ready);
    state.touch.haptic.hand.limits = DeviceLimits{.max_stiffness_newton_per_mm = 0.3};
    const auto stiffness = [&state] {
        return effective_coupling(state.settings, state.touch).stiffness_newton_per_mm;
    };
    CHECK_THAT(stiffness(), WithinAbs(0.5, 0.0));  // the mouse's
    touch_with(state, kFalcon);
    CHECK_THAT(stiffness(), WithinAbs(0.3, 1e-12));
}

TEST_CASE("only the force of a Falcon waits for the window, and only when it is wished",
          "[falcon][focus]") {
    ViewerState state;
    state.touch.in_front = false;
    CHECK_FALSE(waits_for_front(state.settings, state.touch));  // the mouse touches
    DeviceInfo& info = look_for(state, kFalcon);
    info.answered = true;
    CHECK_FALSE(waits_for_front(state.settings, state.touch));  // no Falcon is attached
    info.state = state_at(GENERATE(falcon::Stage::homing, falcon::Stage::ready));
    CHECK(waits_for_front(state.settings, state.touch));
    CHECK_FALSE(requested_settings(state.settings, state.touch).force_enabled);
    CHECK(state.touch.force_enabled);  // the person's own switch stays as it is
    state.touch.in_front = true;
    CHECK_FALSE(waits_for_front(state.settings, state.touch));
    CHECK(requested_settings(state.settings, state.touch).force_enabled);
    state.touch.in_front = false;
    state.settings.force_in_front_only = false;
    CHECK_FALSE(waits_for_front(state.settings, state.touch));
    state.settings.force_in_front_only = true;
    state.touch.replay.emplace();
    CHECK_FALSE(waits_for_front(state.settings, state.touch));
}

TEST_CASE("a force that waits for the window is told, unless the person has switched it off",
          "[falcon][banner]") {
    ViewerState state;
    look_for(state, kFalcon).state = state_at(falcon::Stage::ready);
    touch_with(state, kFalcon);
    state.touch.in_front = false;
    CHECK(banner_of(state).find("not in front") != std::string::npos);
    state.touch.force_enabled = false;
    CHECK(banner_of(state).empty());
}

TEST_CASE("the window says over the relief what an attached or lost Falcon needs",
          "[falcon][banner]") {
    ViewerState state;
    CHECK(banner_of(state).empty());
    DeviceInfo& info = look_for(state, kFalcon);
    info.state = state_at(falcon::Stage::looking, "plug it in");
    CHECK(banner_of(state).empty());  // never attached: only the panel says so
    info.state.trouble = true;        // one could not be brought up
    CHECK(banner_of(state) == "plug it in");
    info.state.trouble = false;
    info.was_ready = true;  // one was lost
    CHECK(banner_of(state) == "plug it in");
    info.state = state_at(falcon::Stage::ready, "plug it in");
    CHECK(banner_of(state).empty());
    info.was_ready = false;
    info.state = state_at(GENERATE(falcon::Stage::cannot_open, falcon::Stage::no_firmware,
                                   falcon::Stage::loading, falcon::Stage::homing),
                          "plug it in");
    CHECK(banner_of(state) == "plug it in");
}

TEST_CASE("a held clutch is told as such, and only of a Falcon that touches", "[falcon][banner]") {
    ViewerState state;
    state.touch.haptic.hand.buttons = bit_of(Button::centre);
    CHECK_FALSE(clutched(state.settings, state.touch));  // the mouse's button
    DeviceInfo& info = look_for(state, kFalcon);
    CHECK_FALSE(clutched(state.settings, state.touch));
    touch_with(state, kFalcon);
    info.state = state_at(falcon::Stage::ready);
    CHECK(clutched(state.settings, state.touch));
    state.touch.haptic.hand.mouse_fallback = true;
    CHECK_FALSE(clutched(state.settings, state.touch));
    state.touch.haptic.hand = {.buttons = bit_of(Button::plus)};
    CHECK_FALSE(clutched(state.settings, state.touch));
}

TEST_CASE("the window says over the relief what an Inverse3 that is there lacks",
          "[inverse3][banner]") {
    ViewerState state;
    DeviceInfo& info = look_for(state, kInverse3);
    info.state = state_at(inverse3::Stage::looking, "do this");
    CHECK(banner_of(state).empty());  // no service, and nobody asked for one
    CHECK_FALSE(attached_or_expected(info));
    info.state = state_at(inverse3::Stage::no_device, "do this");
    CHECK(banner_of(state).empty());
    info.state = state_at(
        GENERATE(inverse3::Stage::no_power, inverse3::Stage::not_calibrated,
                 inverse3::Stage::locked, inverse3::Stage::in_use, inverse3::Stage::force_refused,
                 inverse3::Stage::too_old, inverse3::Stage::not_understood),
        "do this");
    CHECK(banner_of(state) == "do this");
    CHECK(attached_or_expected(info));
    info.state = state_at(inverse3::Stage::ready, "do this");
    CHECK(banner_of(state).empty());
}

TEST_CASE("what the Falcon lacks is not said while an Inverse3 touches", "[inverse3][banner]") {
    ViewerState state;
    look_for(state, kFalcon).state = state_at(falcon::Stage::homing, "pull it out");
    look_for(state, kInverse3).state = state_at(inverse3::Stage::ready);
    CHECK(banner_of(state) == "pull it out");
    touch_with(state, kInverse3);
    CHECK(banner_of(state).empty());
    state.touch.haptic.hand.buttons = 1;
    CHECK(clutched(state.settings, state.touch));  // its own button A, not the Falcon's
}
