// What the state of the Falcon means for the force, and how it is said.
#pragma once

#include <string>

#include "app/panels/viewer_state.hpp"

namespace dibhr {

/// The touch parameters for the next tick. The loop holds them to what the hand it reads can stand;
/// where that is the Falcon, or may be before the next picture, they are held here already: what
/// the panel says is felt, and does not change when a lost Falcon is back.
[[nodiscard]] TouchParameters touch_parameters(const ViewerState& state);

/// The limits for the next tick, as the loop will hold them: a jump of the goal is one of the hand
/// while the Falcon touches, a hand millimetre being `scale` image millimetres.
[[nodiscard]] SafetyLimits safety_limits(const ViewerState& state);

/// No force until the window is in front again: people work in another one while a Falcon touches
/// or may begin to.
[[nodiscard]] bool waits_for_front(const ViewerState& state);

/// The hand moves under a held point: no force, and nothing is wrong.
[[nodiscard]] bool clutched(const ViewerState& state);

/// It waits for something that a person has to do.
[[nodiscard]] bool needs_its_person(falcon::Stage stage);

/// What to say over the relief of a Falcon that is there and does not touch, was lost, or waits for
/// the window; empty: nothing.
[[nodiscard]] std::string falcon_banner(const ViewerState& state);

}  // namespace dibhr
