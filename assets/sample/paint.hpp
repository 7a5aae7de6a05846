// The surface colours of the scene's parts, without light.
#pragma once

#include "assets/sample/scene.hpp"

namespace dibhr::sample {

struct Paint {
    Vec3 albedo{};     ///< linear RGB, 0..1
    Vec3 wrap{};       ///< how far light creeps round the edge, per colour, 0..1
    Vec3 tilt{};       ///< added to the normal: fine relief that depth does not carry
    Vec3 strand{};     ///< direction of a hair, length 1; used when `strands`
    Vec3 shine{1.0F};  ///< colour of the highlight
    float gloss{};
    float sharpness{20.0F};
    float sheen{};  ///< soft light at grazing angles, as on wool
    float glint{};  ///< light added without the lamps: the catch-light in the eye
    bool strands{false};
};

/// Linear RGB of an sRGB colour written as 0xRRGGBB.
[[nodiscard]] Vec3 colour(unsigned rgb) noexcept;

/// The paint at a place on a part; `normal` is the shape's own.
[[nodiscard]] Paint paint_at(const Scene& scene, Vec3 world, Part part, Vec3 normal) noexcept;

[[nodiscard]] Paint paint_face(const Scene& scene, Vec3 world) noexcept;
[[nodiscard]] Paint paint_eye(const Scene& scene, Vec3 world) noexcept;
[[nodiscard]] Paint paint_hair(const Scene& scene, Vec3 world, Vec3 normal) noexcept;
[[nodiscard]] Paint paint_hand(const Scene& scene, Vec3 world) noexcept;
[[nodiscard]] Paint paint_sweater(const Scene& scene, Vec3 world) noexcept;
[[nodiscard]] Paint paint_sleeve(const Scene& scene, Vec3 world) noexcept;
[[nodiscard]] Paint paint_wall(Vec3 world) noexcept;

}  // namespace dibhr::sample
