// The vectors of grid space: x = column, y = row (down), z = elevation towards the viewer, pixels.
// In all of core the *goal* is the haptic interaction point (HIP), the *proxy* the god-object.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

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

/// The rectangle around places of an image [px], which belong to it; without any, left > right.
struct PlaceBox {
    double left{std::numeric_limits<double>::infinity()}, top{left};
    double right{-std::numeric_limits<double>::infinity()}, bottom{right};

    [[nodiscard]] bool empty() const noexcept { return !(left <= right); }
    void add(Vec2 place) noexcept { *this = with({place.x, place.y, place.x, place.y}); }
    [[nodiscard]] PlaceBox with(const PlaceBox& other) const noexcept {
        return {std::min(left, other.left), std::min(top, other.top), std::max(right, other.right),
                std::max(bottom, other.bottom)};
    }
    [[nodiscard]] PlaceBox wider(double by_px) const noexcept {
        return {left - by_px, top - by_px, right + by_px, bottom + by_px};
    }
    bool operator==(const PlaceBox&) const = default;
};

}  // namespace dibhr
