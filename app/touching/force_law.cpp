// The force law.
#include "app/touching/force_law.hpp"

#include "app/touching/device_state.hpp"
#include "core/haptics/safety.hpp"
#include "core/haptics/stability.hpp"

namespace dibhr {

namespace {

/// Workspace scale of the touching device, else of the first one (touch.devices is not empty).
double scale_of_hand(const Settings& settings, const TouchState& touch) {
    const DeviceInfo* const device = touching_device(touch);
    return settings.devices[(device == nullptr ? touch.devices.front() : *device).kind].scale();
}

}  // namespace

const DeviceLimits& limits_of_hand(const TouchState& touch) {
    const auto& now = touch.haptic.hand.limits;
    return now ? *now : touch.device.limits;
}

Coupling requested_coupling(const Settings& settings, const TouchState& touch) {
    const Coupling& chosen = settings.touch.coupling;
    if (touch.replay || !settings.stability || !settings.damping_as_needed) return chosen;
    const DeviceLimits& hand = limits_of_hand(touch);
    const double effective_stiffness = held_coupling(chosen, hand).stiffness_newton_per_mm;
    return stable_coupling(chosen, effective_stiffness, hand.dynamics);
}

Coupling effective_coupling(const Settings& settings, const TouchState& touch) {
    const Coupling requested = requested_coupling(settings, touch);
    if (!may_touch(touch)) return requested;
    // The loop's limits also contain the device's measured delay.
    if (a_device_touches(touch)) return held_coupling(requested, limits_of_hand(touch));
    return held_coupling(requested, at_scale(touch.device.limits, scale_of_hand(settings, touch)));
}

HapticSettings requested_settings(const Settings& settings, const TouchState& touch) {
    HapticSettings requested{
        .parameters = settings.touch,
        .limits = {.max_force_newton = settings.max_force_newton, .stability = settings.stability},
        .force_enabled = touch.force_enabled && !waits_for_front(settings, touch),
        .bump = touch.bump,
    };
    if (touch.depth_in_question) requested.force_enabled = false;
    requested.parameters.coupling = requested_coupling(settings, touch);
    return requested;
}

bool waits_for_front(const Settings& settings, const TouchState& touch) {
    return !touch.in_front && settings.force_in_front_only && may_touch(touch);
}

bool clutched(const Settings& settings, const TouchState& touch) {
    if (!a_device_touches(touch)) return false;
    const ButtonActions& buttons = settings.devices[touching_device(touch)->kind].buttons;
    return (touch.haptic.hand.buttons & unsigned{buttons_for(ButtonAction::clutch, buttons)}) != 0;
}

std::string device_banner(const Settings& settings, const TouchState& touch) {
    if (touch.force_enabled && a_device_touches(touch) && waits_for_front(settings, touch))
        return "force off: the window is not in front. Click it, and the force rises again";
    return missing_text(touch);
}

}  // namespace dibhr
