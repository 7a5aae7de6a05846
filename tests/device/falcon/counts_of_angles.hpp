// Encoder counts of thigh angles, the way back of the driver's angles_of_counts().
#pragma once

#include <glm/trigonometric.hpp>

#include "device/falcon/kinematics.hpp"

namespace dibhr::test::falcon {

[[nodiscard]] inline Vec3 counts_of_angles(Vec3 angles_rad,
                                           const dibhr::falcon::Geometry& geometry) noexcept {
    return (glm::degrees(angles_rad) - geometry.angle_at_zero_deg) *
           (1280.0 * geometry.gear / 360.0);
}

}  // namespace dibhr::test::falcon
