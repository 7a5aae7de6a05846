// What the state of the Falcon means for the force, and how it is said.
#pragma once

#include <string>

#include "app/panels/viewer_state.hpp"

namespace dibhr {

/// The coupling that the loop is asked for: the chosen one, with the damping that the hand needs
/// where a person leaves it at that.
[[nodiscard]] Coupling asked_coupling(const ViewerState& state);

/// What the hand of the last tick can stand.
[[nodiscard]] const DeviceLimits& limits_of_hand(const ViewerState& state);

/// To say what is felt of the coupling that is asked for, where the Falcon touches or may begin to
/// before the next picture. (The loop holds it to what the hand it reads can stand.)
[[nodiscard]] Coupling felt_coupling(const ViewerState& state);

/// No force until the window is in front again: people work in another one while a Falcon touches
/// or may begin to.
[[nodiscard]] bool waits_for_front(const ViewerState& state);

/// The hand moves under a held point: no force, and nothing is wrong.
[[nodiscard]] bool clutched(const ViewerState& state);

/// It waits for something that a person has to do.
[[nodiscard]] bool needs_its_person(falcon::Stage stage);

/// It is attached, was so in this run, or is waited for by name: else the mouse is all there is.
[[nodiscard]] bool in_sight(const ViewerState& state);

/// What to say over the relief of a Falcon that is there and does not touch, was lost, or waits for
/// the window; empty: nothing.
[[nodiscard]] std::string falcon_banner(const ViewerState& state);

}  // namespace dibhr
