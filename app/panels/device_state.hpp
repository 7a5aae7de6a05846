// What the state of the force devices means for the force, and how it is said.
#pragma once

#include <string>

#include "app/panels/viewer_state.hpp"

namespace dibhr {

/// The coupling that the loop is asked for: the chosen one, with the damping that the hand needs
/// where a person leaves it at that.
[[nodiscard]] Coupling asked_coupling(const ViewerState& state);

/// What the loop is asked for, but for recording, followers and the version.
[[nodiscard]] HapticSettings asked_settings(const ViewerState& state);

/// What the hand of the last tick can stand.
[[nodiscard]] const DeviceLimits& limits_of_hand(const ViewerState& state);

/// To say what is felt of the coupling that is asked for, where a device touches or may begin to
/// before the next picture. (The loop holds it to what the hand it reads can stand.)
[[nodiscard]] Coupling felt_coupling(const ViewerState& state);

/// No force until the window is in front again: people work in another one while a device touches
/// or may begin to.
[[nodiscard]] bool waits_for_front(const ViewerState& state);

/// The hand moves under a held point: no force, and nothing is wrong.
[[nodiscard]] bool clutched(const ViewerState& state);

/// It waits for something that a person has to do.
[[nodiscard]] bool needs_its_person(falcon::Stage stage);
[[nodiscard]] bool needs_its_person(inverse3::Stage stage);

/// It is attached, was so in this run, or is waited for by name: else the mouse is all there is.
[[nodiscard]] bool falcon_in_sight(const ViewerState& state);
[[nodiscard]] bool inverse3_in_sight(const ViewerState& state);

/// The device that touches has poses that mean no place, or that have grown old.
[[nodiscard]] bool without_pose(const ViewerState& state);

/// "the mouse, meanwhile", "the Falcon", "the Inverse3".
[[nodiscard]] const char* touching_text(const ViewerState& state);

/// What to say over the relief of a device that is there and does not touch, was lost, or waits for
/// the window; empty: nothing.
[[nodiscard]] std::string device_banner(const ViewerState& state);

}  // namespace dibhr
