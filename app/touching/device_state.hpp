// What the state of the force devices means, and how it is said.
#pragma once

#include <string>

#include "app/touching/touch_state.hpp"
#include "device/device_or_mouse.hpp"

namespace dibhr {

/// What touched in the last tick that is known of.
[[nodiscard]] Touching touching(const TouchState& touch);

/// A device touched in the last tick that is known of.
[[nodiscard]] bool a_device_touches(const TouchState& touch);

/// A device touches, or may begin to before the next picture: that can be a slow one, as the first
/// is. One that was lost comes back without a word.
[[nodiscard]] bool may_touch(const TouchState& touch);

/// It waits for something that a person has to do.
[[nodiscard]] bool needs_its_person(falcon::Stage stage);
[[nodiscard]] bool needs_its_person(inverse3::Stage stage);

/// It is attached, was so in this run, or is waited for by name: else the mouse is all there is.
[[nodiscard]] bool falcon_in_sight(const TouchState& touch);
[[nodiscard]] bool inverse3_in_sight(const TouchState& touch);

/// "the mouse, meanwhile", "the Falcon", "the Inverse3".
[[nodiscard]] const char* touching_text(const TouchState& touch);

/// What a device that is there, or was lost, lacks to touch; empty: nothing, or another one
/// touches.
[[nodiscard]] std::string lacking_text(const TouchState& touch);

}  // namespace dibhr
