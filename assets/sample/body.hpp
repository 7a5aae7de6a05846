// The shape of the sample's neck, sweater and sleeves.
#pragma once

#include "assets/sample/pose.hpp"
#include "assets/sample/sdf.hpp"

namespace dibhr::sample {

inline constexpr Vec3 kCollarCentre{0.0F, -88.0F, 74.0F};

/// A world point taken back to where it lies when the person does not breathe.
[[nodiscard]] Vec3 without_breath(Vec3 world, float breath) noexcept;

/// Distances [px]. `rest` is a point without breath, `world` one with it.
[[nodiscard]] float neck_distance(Vec3 rest, Vec3 head_origin) noexcept;
[[nodiscard]] float sweater_distance(Vec3 rest, const Pose& pose) noexcept;
[[nodiscard]] float sleeve_distance(Vec3 world, const Pose& pose) noexcept;

/// Where on the collar a point is: `ring` is the distance to the collar's middle line [px],
/// `angle_rad` around it.
struct CollarPlace {
    float ring{};
    float angle_rad{};
};
[[nodiscard]] CollarPlace collar_at(Vec3 rest) noexcept;

/// Where on the raised sleeve a point is.
struct SleevePlace {
    float along_px{};   ///< from the cuff's end towards the elbow
    float angle_rad{};  ///< around the sleeve, 0 towards the viewer
};
[[nodiscard]] SleevePlace sleeve_at(Vec3 world, const Pose& pose) noexcept;

inline constexpr float kCuffLength = 34.0F;

}  // namespace dibhr::sample
