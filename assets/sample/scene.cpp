// The whole scene at one frame: bounds each part, and evaluates only those near a point.
#include "assets/sample/scene.hpp"

#include "assets/sample/body.hpp"
#include "assets/sample/head.hpp"

namespace dibhr::sample {
namespace {

constexpr std::array<Part, 6> kSolid{Part::Face,    Part::Eye,    Part::Hair,
                                     Part::Sweater, Part::Sleeve, Part::Hand};

}  // namespace

Scene::Scene(const Pose& pose)
    : pose_{pose},
      fingers_{bend_fingers(pose)},
      forearm_{pose.hand_from_world * glm::normalize(pose.elbow - pose.wrist)} {
    const auto around = [](Vec2 middle, Vec2 low, Vec2 high) {
        return Rectangle{middle + low, middle + high};
    };
    const Vec2 head{pose.head_origin.x, pose.head_origin.y};
    const Vec2 palm{pose.palm.x, pose.palm.y};
    bounds_[static_cast<std::size_t>(Part::Face)] =
        around(head, {-105.0F, -215.0F}, {105.0F, 145.0F});
    bounds_[static_cast<std::size_t>(Part::Eye)] = around(head, {-70.0F, -30.0F}, {70.0F, 30.0F});
    bounds_[static_cast<std::size_t>(Part::Hair)] =
        around(head, {-135.0F, -215.0F}, {135.0F, 160.0F});
    bounds_[static_cast<std::size_t>(Part::Sweater)] = {{-400.0F, -400.0F}, {400.0F, -50.0F}};
    bounds_[static_cast<std::size_t>(Part::Sleeve)] = {{pose.wrist.x - 48.0F, -400.0F},
                                                       {400.0F, pose.wrist.y + 30.0F}};
    bounds_[static_cast<std::size_t>(Part::Hand)] =
        around(palm, {-95.0F, -130.0F}, {95.0F, 140.0F});
}

Vec3 Scene::to_head(Vec3 world) const noexcept {
    return pose_.head_from_world * (world - pose_.head_origin);
}

Vec3 Scene::to_hand(Vec3 world) const noexcept {
    return pose_.hand_from_world * (world - pose_.palm);
}

Parts Scene::parts_near(Vec2 place, float margin) const noexcept {
    Parts parts = 0;
    for (const Part part : kSolid) {
        const Rectangle& r = bounds_[static_cast<std::size_t>(part)];
        if (place.x >= r.low.x - margin && place.x <= r.high.x + margin &&
            place.y >= r.low.y - margin && place.y <= r.high.y + margin)
            parts |= bit(part);
    }
    return parts;
}

float Scene::distance(Vec3 world, Part part) const noexcept {
    switch (part) {
        case Part::Face: {
            const float face = face_distance(to_head(world), pose_.eye_opening);
            const float neck =
                neck_distance(without_breath(world, pose_.breath), pose_.head_origin);
            return smooth_min(face, neck, 10.0F);
        }
        case Part::Eye:
            return eye_distance(to_head(world));
        case Part::Hair:
            return hair_distance(to_head(world));
        case Part::Sweater:
            return sweater_distance(without_breath(world, pose_.breath), pose_);
        case Part::Sleeve:
            return sleeve_distance(world, pose_);
        case Part::Hand:
            return hand_distance(to_hand(world), fingers_, forearm_);
        case Part::Wall:
            break;
    }
    return world.z - kWallLevel;
}

float Scene::distance(Vec3 world, Parts parts) const noexcept {
    float nearest = 1.0e6F;
    for (const Part part : kSolid)
        if ((parts & bit(part)) != 0U) nearest = std::min(nearest, distance(world, part));
    return nearest;
}

Part Scene::nearest(Vec3 world, Parts parts) const noexcept {
    Part best = Part::Wall;
    float nearest = 1.0e6F;
    for (const Part part : kSolid) {
        if ((parts & bit(part)) == 0U) continue;
        const float d = distance(world, part);
        if (d < nearest) {
            nearest = d;
            best = part;
        }
    }
    return best;
}

Vec3 Scene::normal(Vec3 world, Part part) const noexcept {
    constexpr float kStep = 0.6F;
    Vec3 sum{0.0F};
    for (const Vec3 corner : {Vec3{1, -1, -1}, Vec3{-1, -1, 1}, Vec3{-1, 1, -1}, Vec3{1, 1, 1}})
        sum += corner * distance(world + kStep * corner, part);
    return glm::normalize(sum);
}

}  // namespace dibhr::sample
