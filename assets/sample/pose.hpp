// How the sample person moves: every number is periodic in the length of the loop.
#pragma once

#include "assets/sample/sdf.hpp"

namespace dibhr::sample {

inline constexpr int kColumns = 640;
inline constexpr int kRows = 480;
inline constexpr int kFrames = 300;
inline constexpr int kFramesPerSecond = 30;

/// World: x right, y up from the middle of the picture, z towards the viewer, all in pixels; z is
/// also the depth level 0..255.
struct Pose {
    Mat3 head_from_world{
        1.0F};  ///< turn only; head origin is between the ears at the height of the eyes
    Vec3 head_origin{};
    float eye_opening{1.0F};  ///< 0 closed .. 1 open
    Vec2 gaze{};     ///< of the eyes in the head's frame, x right and y up, as sine of the angle
    float breath{};  ///< -1 out .. 1 in
    Mat3 hand_from_world{1.0F};  ///< turn only; the palm looks along +z, fingers along +y
    Vec3 palm{};                 ///< middle of the palm, world
    Vec3 wrist{};
    Vec3 elbow{};
    float finger_spread{};    ///< 0 closed .. 1 wide
    float finger_curl_rad{};  ///< of each joint, towards the viewer
};

/// The pose of a frame; `frame` may be any number, `kFrames` is one loop.
[[nodiscard]] Pose pose_at(float frame);

}  // namespace dibhr::sample
