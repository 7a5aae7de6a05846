// The force law: which values the tick gets, from the settings, the devices and the window. (The
// tick then limits them to what the device it reads can render.)
#pragma once

#include <string>

#include "app/settings/settings.hpp"
#include "app/touching/touch_state.hpp"

namespace dibhr {

/// The limits of the device that the last tick read.
[[nodiscard]] const DeviceLimits& limits_of_hand(const TouchState& touch);

/// The coupling that the window requests of the loop: the user's, with the damping that the device
/// needs where the user has left *damping as needed* on.
[[nodiscard]] Coupling requested_coupling(const Settings& settings, const TouchState& touch);

/// For panels: the requested coupling after the limits of the device that touches, or that may
/// begin to before the next picture.
[[nodiscard]] Coupling effective_coupling(const Settings& settings, const TouchState& touch);

/// All settings that the window requests of the loop, except recording, followed and version.
[[nodiscard]] HapticSettings requested_settings(const Settings& settings, const TouchState& touch);

/// Whether the force is off because another window is in front while a device touches, or may
/// begin to.
[[nodiscard]] bool waits_for_front(const Settings& settings, const TouchState& touch);

/// Whether the clutch button is held: the hand moves, the goal does not, and there is no force.
[[nodiscard]] bool clutched(const Settings& settings, const TouchState& touch);

/// The text over the relief about a device that cannot touch, was lost, or waits for the window to
/// be in front; empty: none.
[[nodiscard]] std::string device_banner(const Settings& settings, const TouchState& touch);

}  // namespace dibhr
