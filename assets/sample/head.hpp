// The shape of the sample's head: skin, eyes and hair, and the curves its painting shares with it.
#pragma once

#include "assets/sample/pose.hpp"
#include "assets/sample/sdf.hpp"

namespace dibhr::sample {

inline constexpr Vec3 kEyeCentre{
    33.5F, 0.0F, 49.0F};  ///< of the right one in the picture; mirror x for the other
inline constexpr float kEyeRadius = 20.5F;

/// The mouth seen from the front, in the head's frame [px].
struct Mouth {
    float line{};      ///< height of the line between the lips at this x
    float upper{};     ///< upper edge of the upper lip
    float lower{};     ///< lower edge of the lower lip
    float presence{};  ///< 1 in the middle, 0 at and beyond the corners
};
[[nodiscard]] Mouth mouth_at(float x) noexcept;

/// How far inside the opening between the lids a point is [px]; negative on the lids.
/// `out` is the distance from the eye's centre away from the nose, `up` upwards.
struct EyeOpening {
    float inside{};
    float upper_edge{};  ///< height of the upper lid's edge at this place
    float lower_edge{};
};
[[nodiscard]] EyeOpening eye_opening(float out, float up, float opening) noexcept;

/// Where the hair is combed: `across` changes from strand to strand, `edge` is the distance to the
/// hairline (positive in the hair) [px].
struct HairFlow {
    float across{};
    float edge{};
    float parting{};  ///< distance to the parting, over the head [px]
};
[[nodiscard]] HairFlow hair_flow(Vec3 head) noexcept;

/// Distances [px]; `head` is a point in the head's frame.
[[nodiscard]] float face_distance(Vec3 head, float eye_opening) noexcept;
[[nodiscard]] float eye_distance(Vec3 head) noexcept;
[[nodiscard]] float hair_distance(Vec3 head) noexcept;

}  // namespace dibhr::sample
