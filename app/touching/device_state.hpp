// What the state of the force devices means, and how it is said.
#pragma once

#include <string>

#include "app/touching/touch_state.hpp"

namespace dibhr {

/// What touched in the last tick that is known of; null: none of those that are looked for.
[[nodiscard]] const DeviceNews* touching_device(const TouchState& touch);

/// A device touched in the last tick that is known of.
[[nodiscard]] bool a_device_touches(const TouchState& touch);

/// A device touches, or may begin to before the next picture: that can be a slow one, as the first
/// is. One that was lost comes back without a word.
[[nodiscard]] bool may_touch(const TouchState& touch);

/// It is attached, was so in this run, or is waited for by name: else the mouse is all there is.
[[nodiscard]] bool in_sight(const DeviceNews& news);

/// "the mouse, meanwhile", "the Falcon".
[[nodiscard]] std::string touching_text(const TouchState& touch);

/// What a device that is there, or was lost, lacks to touch; empty: nothing, or another one
/// touches.
[[nodiscard]] std::string lacking_text(const TouchState& touch);

}  // namespace dibhr
