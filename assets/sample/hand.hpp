// The shape of the sample's raised hand, palm towards the viewer.
#pragma once

#include <array>

#include "assets/sample/pose.hpp"
#include "assets/sample/sdf.hpp"

namespace dibhr::sample {

/// Four joints of a finger, from its base to the middle of its tip, in the hand's frame [px].
struct Finger {
    std::array<Vec3, 4> joint{};
    float base_radius{};
    float tip_radius{};
};

/// Index, middle, ring and little finger, then the thumb.
using Fingers = std::array<Finger, 5>;
[[nodiscard]] Fingers bend_fingers(const Pose& pose);

/// Distance [px]; `hand` is a point in the hand's frame, `forearm` the direction from wrist to
/// elbow in it.
[[nodiscard]] float hand_distance(Vec3 hand, const Fingers& fingers, Vec3 forearm) noexcept;

/// 1 on the creases of palm and joints, 0 beside them.
[[nodiscard]] float hand_crease(Vec3 hand, const Fingers& fingers) noexcept;

}  // namespace dibhr::sample
