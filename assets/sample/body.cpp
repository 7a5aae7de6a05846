// The shape of neck, sweater and sleeves: rods and ellipsoids, with ribs at collar and cuff.
#include "assets/sample/body.hpp"

#include <cmath>

namespace dibhr::sample {
namespace {

constexpr Vec3 kShoulder{170.0F, -172.0F, 66.0F};

/// Distance from the middle of the body, without a crease in the middle.
float rounded_side(float x) noexcept {
    return std::sqrt(x * x + 300.0F);
}

/// Soft folds of the cloth: height over the smooth sweater [px].
float folds(Vec3 rest) noexcept {
    const float side = rounded_side(rest.x);
    const float lazy = noise(rest.x * 0.018F + 7.0F, rest.y * 0.011F + 0.008F * side);
    const float armpit = side - 138.0F + 0.22F * (rest.y + 215.0F);
    return 5.0F * (lazy - 0.5F) - 5.0F * hill(armpit, 9.0F) * smooth_step(-168.0F, -205.0F, rest.y);
}

Vec3 cuff_end(const Pose& pose) noexcept {
    return pose.wrist - 0.02F * (pose.elbow - pose.wrist);
}

}  // namespace

Vec3 without_breath(Vec3 world, float breath) noexcept {
    const float chest = hill(world.y + 205.0F, 95.0F) * hill(world.x, 150.0F);
    const float shoulders = smooth_step(-60.0F, -130.0F, world.y);
    return {world.x, world.y - 1.8F * breath * shoulders, world.z - 5.0F * breath * chest};
}

CollarPlace collar_at(Vec3 rest) noexcept {
    Vec3 p = rest - kCollarCentre;
    p.y += 0.40F * p.z + 0.0022F * p.x * p.x * -1.0F;  // the front hangs lower, the sides ride up
    const float around = glm::length(Vec2{p.x, p.z}) - 53.0F;
    // An upright band rather than a round tube.
    return {glm::length(Vec2{around, std::max(std::abs(p.y) - 7.0F, 0.0F)}), std::atan2(p.x, p.z)};
}

float neck_distance(Vec3 rest, Vec3 head_origin) noexcept {
    const Vec3 top{head_origin.x, head_origin.y - 90.0F, head_origin.z - 4.0F};
    const float column = rod(rest, top, {0.0F, -96.0F, 68.0F}, 38.0F, 42.0F);
    const Vec3 side{std::abs(rest.x), rest.y, rest.z};
    const float cord = rod(side, {33.0F, -46.0F, 80.0F}, {12.0F, -98.0F, 102.0F}, 6.0F, 6.0F);
    return smooth_min(column, cord, 14.0F);
}

float sweater_distance(Vec3 rest, const Pose& pose) noexcept {
    const Vec3 side{rounded_side(rest.x), rest.y, rest.z};
    const float chest = ellipsoid(rest - Vec3{0.0F, -262.0F, 62.0F}, {170.0F, 165.0F, 66.0F});
    if (chest > 130.0F) return chest - 115.0F;
    const float slope = rod(side, {20.0F, -86.0F, 54.0F}, {160.0F, -164.0F, 62.0F}, 40.0F, 46.0F);
    const float shoulder = sphere(side - kShoulder, 52.0F);
    const Vec3 elbow =
        rest.x > 0.0F ? pose.elbow + Vec3{-14.0F, 0.0F, -12.0F} : Vec3{222.0F, -330.0F, 70.0F};
    const float arm = rod(side, kShoulder, elbow, 51.0F, 44.0F);
    const float breastbone = ellipsoid(rest - Vec3{0.0F, -142.0F, 64.0F}, {96.0F, 52.0F, 50.0F});
    float d = smooth_min(smooth_min(chest, breastbone, 40.0F), slope, 40.0F);
    d = smooth_min(d, smooth_min(shoulder, arm, 10.0F), 26.0F) - folds(rest);
    if (side.x > 90.0F || rest.y < -150.0F) return d;  // far from the collar
    const CollarPlace collar = collar_at(rest);
    const float ribs = 0.9F * std::cos(collar.angle_rad * 44.0F);
    return smooth_min(d, collar.ring - 8.0F - ribs, 5.0F);
}

SleevePlace sleeve_at(Vec3 world, const Pose& pose) noexcept {
    const Vec3 end = cuff_end(pose);
    const Vec3 axis = glm::normalize(pose.elbow - end);
    const Vec3 right = glm::normalize(glm::cross(axis, Vec3{0.0F, 0.0F, 1.0F}));
    const Vec3 front = glm::cross(right, axis);
    const Vec3 p = world - end;
    return {glm::dot(p, axis), std::atan2(glm::dot(p, right), glm::dot(p, front))};
}

float sleeve_distance(Vec3 world, const Pose& pose) noexcept {
    const Vec3 end = cuff_end(pose);
    const float sleeve = rod(world, end, pose.elbow, 31.0F, 52.0F);
    if (sleeve > 30.0F) return sleeve - 10.0F;
    const SleevePlace place = sleeve_at(world, pose);
    const float cuff = smooth_step(kCuffLength + 5.0F, kCuffLength - 3.0F, place.along_px);
    const float ribs = 0.9F * std::cos(place.angle_rad * 26.0F);
    const float drape = noise(place.along_px * 0.035F, place.angle_rad * 1.3F + 9.0F) - 0.5F;
    const float cloth = sleeve + 5.0F * cuff - ribs * cuff - 5.0F * drape * (1.0F - cuff);
    return smooth_max(cloth, -place.along_px, 5.0F);
}

}  // namespace dibhr::sample
