// How the sample person moves: sines of whole numbers of turns a loop, and two blinks.
#include "assets/sample/pose.hpp"

#include <cmath>
#include <numbers>

namespace dibhr::sample {
namespace {

constexpr float kTurn_rad = 2.0F * std::numbers::pi_v<float>;
constexpr float kDegree = std::numbers::pi_v<float> / 180.0F;

/// Turns the world into a frame that is rolled, pitched and yawed by these angles.
Mat3 turned(float yaw_rad, float pitch_rad, float roll_rad) {
    const float cy = std::cos(yaw_rad), sy = std::sin(yaw_rad);
    const float cp = std::cos(pitch_rad), sp = std::sin(pitch_rad);
    const float cr = std::cos(roll_rad), sr = std::sin(roll_rad);
    const Mat3 yaw{{cy, 0, -sy}, {0, 1, 0}, {sy, 0, cy}};
    const Mat3 pitch{{1, 0, 0}, {0, cp, sp}, {0, -sp, cp}};
    const Mat3 roll{{cr, sr, 0}, {-sr, cr, 0}, {0, 0, 1}};
    return glm::transpose(yaw * pitch * roll);
}

/// 1 far from the blink, 0 in its middle; times in frames, on the circle of the loop.
float open_around(float frame, float blink_frame) {
    const auto loop = static_cast<float>(kFrames);
    const float distance = std::abs(std::remainder(frame - blink_frame, loop));
    return smooth_step(1.0F, 5.0F, distance);
}

}  // namespace

Pose pose_at(float frame) {
    const float turn = kTurn_rad * frame / static_cast<float>(kFrames);
    const auto wave = [turn](float turns, float phase) { return std::sin(turns * turn + phase); };

    Pose pose;
    pose.breath = wave(3.0F, 0.0F);
    const float yaw = (7.0F * wave(1.0F, -0.6F) + 2.0F * wave(2.0F, 1.0F)) * kDegree;
    const float pitch = (1.0F + 2.0F * wave(2.0F, 0.4F)) * kDegree;
    const float roll = (-2.0F + 2.5F * wave(1.0F, 0.9F)) * kDegree;
    pose.head_from_world = turned(yaw, pitch, roll);
    pose.head_origin = {3.0F * wave(1.0F, -0.3F), 72.0F + 1.2F * pose.breath, 72.0F};
    const Vec3 to_viewer = pose.head_from_world * Vec3{0.0F, 0.0F, 1.0F};
    pose.gaze = {to_viewer.x, to_viewer.y};
    pose.eye_opening = open_around(frame, 52.0F) * open_around(frame, 211.0F);

    const float near = 0.5F - 0.5F * std::cos(turn);
    const float hand_roll = (-9.0F + 5.0F * wave(2.0F, 0.5F)) * kDegree;
    const float hand_yaw = (-8.0F + 7.0F * wave(1.0F, 0.7F)) * kDegree;
    const float hand_pitch = (-7.0F + 9.0F * near) * kDegree;
    pose.hand_from_world = turned(hand_yaw, hand_pitch, hand_roll);
    pose.palm = {220.0F - 26.0F * near + 2.0F * wave(2.0F, 0.2F), -46.0F - 32.0F * near,
                 144.0F + 72.0F * near};
    pose.wrist = pose.palm + glm::transpose(pose.hand_from_world) * Vec3{2.0F, -60.0F, -3.0F};
    pose.elbow = {262.0F, -330.0F + 1.5F * pose.breath, 100.0F};
    pose.finger_spread = 0.75F + 0.25F * wave(2.0F, -1.2F);
    pose.finger_curl_rad = (9.0F + 4.0F * wave(2.0F, 2.2F) - 4.0F * near) * kDegree;
    return pose;
}

}  // namespace dibhr::sample
