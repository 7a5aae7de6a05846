// The vectors of grid space: x = column, y = row (down), z = elevation towards the viewer, pixels.
// In all of core the *goal* is the haptic interaction point (HIP), the *proxy* the god-object.
#pragma once

#include <cmath>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace dibhr {

using Vec2 = glm::dvec2;
using Vec3 = glm::dvec3;
static_assert(sizeof(Vec3) == 3 * sizeof(double),
              "dibhr needs GLM without GLM_FORCE_DEFAULT_ALIGNED_GENTYPES");

[[nodiscard]] inline bool is_finite(Vec3 v) noexcept {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

}  // namespace dibhr
