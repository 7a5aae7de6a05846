// What the state of the force devices means, as conditions and as texts.
#pragma once

#include <string>

#include "app/touching/touch_state.hpp"

namespace dibhr {

/// The device that gave the goal of the last known tick; null: none of touch.devices.
[[nodiscard]] const DeviceInfo* touching_device(const TouchState& touch);

/// Whether a ready device gave the goal of the last known tick.
[[nodiscard]] bool a_device_touches(const TouchState& touch);

/// Whether a device touches, or may begin to before the next picture. (A picture can take long, as
/// the first one does; and a lost device returns without notice.)
[[nodiscard]] bool may_touch(const TouchState& touch);

/// Whether the device is attached, was attached in this run, or was requested by name.
[[nodiscard]] bool attached_or_expected(const DeviceInfo& info);

/// "the mouse, meanwhile", "the Falcon".
[[nodiscard]] std::string touching_text(const TouchState& touch);

/// Why an attached or lost device cannot touch; empty: it can, or another device touches.
[[nodiscard]] std::string missing_text(const TouchState& touch);

}  // namespace dibhr
