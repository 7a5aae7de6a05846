// The force law: what of a person's settings, of the devices and of the window reaches the tick.
// (The tick holds all of it to what the hand it reads can stand.)
#pragma once

#include <string>

#include "app/settings/settings.hpp"
#include "app/touching/touch_state.hpp"

namespace dibhr {

/// What the hand of the last tick can stand.
[[nodiscard]] const DeviceLimits& limits_of_hand(const TouchState& touch);

/// The coupling that the loop is asked for: the chosen one, with the damping that the hand needs
/// where a person leaves it at that.
[[nodiscard]] Coupling asked_coupling(const Settings& settings, const TouchState& touch);

/// To say what is felt of the coupling that is asked for, where a device touches or may begin to
/// before the next picture.
[[nodiscard]] Coupling felt_coupling(const Settings& settings, const TouchState& touch);

/// What the loop is asked for, but for recording, followers and the version.
[[nodiscard]] HapticSettings asked_settings(const Settings& settings, const TouchState& touch);

/// No force until the window is in front again: people work in another one while a device touches
/// or may begin to.
[[nodiscard]] bool waits_for_front(const Settings& settings, const TouchState& touch);

/// The hand moves under a held point: no force, and nothing is wrong.
[[nodiscard]] bool clutched(const Settings& settings, const TouchState& touch);

/// What to say over the relief of a device that is there and does not touch, was lost, or waits for
/// the window; empty: nothing.
[[nodiscard]] std::string device_banner(const Settings& settings, const TouchState& touch);

}  // namespace dibhr
