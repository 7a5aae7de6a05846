// Distances, blends and noise that the sample's shapes are made of; lengths in pixels.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <glm/glm.hpp>

namespace dibhr::sample {

using Vec2 = glm::vec2;
using Vec3 = glm::vec3;
using Mat3 = glm::mat3;

/// Smallest of two distances, rounded where they differ by less than `k` [px].
inline float smooth_min(float a, float b, float k) noexcept {
    const float h = std::max(k - std::abs(a - b), 0.0F) / k;
    return std::min(a, b) - h * h * k * 0.25F;
}

/// Largest of two distances, rounded likewise.
inline float smooth_max(float a, float b, float k) noexcept {
    return -smooth_min(-a, -b, k);
}

/// 0 below `from`, 1 above `to`, smooth between.
inline float smooth_step(float from, float to, float x) noexcept {
    const float t = std::clamp((x - from) / (to - from), 0.0F, 1.0F);
    return t * t * (3.0F - 2.0F * t);
}

/// A smooth hill of height 1 at zero; e^-1 at `width`.
inline float hill(float x, float width) noexcept {
    const float t = x / width;
    return t * t < 20.0F ? std::exp(-t * t) : 0.0F;
}

inline float sphere(Vec3 p, float radius) noexcept {
    return glm::length(p) - radius;
}

/// Distance to an ellipsoid, exact to first order near its surface.
inline float ellipsoid(Vec3 p, Vec3 radii) noexcept {
    const Vec3 q = p / radii;
    const float k0 = glm::length(q);
    const float k1 = glm::length(q / radii);
    return k1 > 0.0F ? k0 * (k0 - 1.0F) / k1 : -std::min({radii.x, radii.y, radii.z});
}

/// Where along a..b the point lies: 0 at a, 1 at b.
inline float along(Vec3 p, Vec3 a, Vec3 b) noexcept {
    const Vec3 ab = b - a;
    return std::clamp(glm::dot(p - a, ab) / glm::dot(ab, ab), 0.0F, 1.0F);
}

/// A rod from a to b whose radius goes from `radius_a` to `radius_b`.
inline float rod(Vec3 p, Vec3 a, Vec3 b, float radius_a, float radius_b) noexcept {
    const float t = along(p, a, b);
    return glm::length(p - a - t * (b - a)) - (radius_a + t * (radius_b - radius_a));
}

/// A repeatable number in 0..1 for a lattice point.
inline float lattice(int x, int y) noexcept {
    auto h =
        static_cast<std::uint32_t>(x) * 0x8da6b343U + static_cast<std::uint32_t>(y) * 0xd8163841U;
    h = (h ^ (h >> 15U)) * 0x2c1b3c6dU;
    h = (h ^ (h >> 12U)) * 0x297a2d39U;
    return static_cast<float>((h ^ (h >> 15U)) >> 8U) * (1.0F / 16777216.0F);
}

/// Smooth noise in 0..1 with one feature a unit; for |x|, |y| < 4096.
inline float noise(float x, float y) noexcept {
    const int ix = static_cast<int>(x + 4096.0F) - 4096,
              iy = static_cast<int>(y + 4096.0F) - 4096;  // a quick floor
    const auto fx = static_cast<float>(ix), fy = static_cast<float>(iy);
    const float u = smooth_step(0.0F, 1.0F, x - fx), v = smooth_step(0.0F, 1.0F, y - fy);
    const float low = lattice(ix, iy) + u * (lattice(ix + 1, iy) - lattice(ix, iy));
    const float high = lattice(ix, iy + 1) + u * (lattice(ix + 1, iy + 1) - lattice(ix, iy + 1));
    return low + v * (high - low);
}

}  // namespace dibhr::sample
