// The named regions of the sample: parts of the scene, the face divided in the head's own frame.
#include "assets/sample/regions.hpp"

#include <cmath>
#include <cstddef>

#include "assets/sample/body.hpp"
#include "assets/sample/head.hpp"
#include "assets/sample/relief.hpp"
#include "assets/sample/scene.hpp"

namespace dibhr::sample {
namespace {

bool on_eye(Vec3 head) noexcept {
    const Vec2 away{std::abs(head.x) - kEyeCentre.x, head.y - 1.0F};
    return glm::length(away / Vec2{25.0F, 15.0F}) < 1.0F;
}

/// The bridge, wider towards the wings, down to below the nostrils.
bool on_nose(Vec3 head) noexcept {
    if (head.y > 8.0F || head.y < -49.0F) return false;
    const float down = (8.0F - head.y) / 57.0F;
    return std::abs(head.x) < 9.0F + 13.0F * smooth_step(0.2F, 0.8F, down);
}

bool on_mouth(Vec3 head) noexcept {
    constexpr float kLipsEnd = 33.0F;
    constexpr float kAround = 2.0F;
    const Mouth mouth = mouth_at(head.x);
    return std::abs(head.x) < kLipsEnd && head.y < mouth.upper + kAround &&
           head.y > mouth.lower - kAround;
}

/// A place on the skin of face, ears or neck.
SampleRegion region_of_skin(const Scene& scene, Vec3 world) noexcept {
    const Vec3 head = scene.to_head(world);
    const Pose& pose = scene.pose();
    const float neck = neck_distance(without_breath(world, pose.breath), pose.head_origin);
    if (neck < face_distance(head, pose.eye_opening)) return SampleRegion::neck;
    if (std::abs(head.x) > 69.0F && head.y < 25.0F) return SampleRegion::ear;
    if (on_eye(head)) return SampleRegion::eye;
    if (on_nose(head)) return SampleRegion::nose;
    if (on_mouth(head)) return SampleRegion::mouth;
    if (head.y > 8.0F) return SampleRegion::forehead;
    return head.y < -80.0F ? SampleRegion::chin : SampleRegion::cheek;
}

SampleRegion region_at(const Scene& scene, Vec2 place, Hit hit) noexcept {
    switch (hit.part) {
        case Part::Face:
            return region_of_skin(scene, {place.x, place.y, hit.level});
        case Part::Eye:
            return SampleRegion::eye;
        case Part::Hair:
            return SampleRegion::hair;
        case Part::Sweater:
        case Part::Sleeve:
            return SampleRegion::jumper;
        case Part::Hand:
            return SampleRegion::hand;
        case Part::Wall:
            break;
    }
    return SampleRegion::wall;
}

}  // namespace

int frame_of_labels(int picture) {
    constexpr int kFramesEach = kFrames / kLabelPictures;
    return picture * kFramesEach + kFramesEach / 2;
}

std::vector<std::uint8_t> labels_of(int frame) {
    const Scene scene{pose_at(static_cast<float>(frame))};
    const Relief relief = march(scene);
    std::vector<std::uint8_t> labels;
    labels.reserve(relief.level.size() / (kLabelStep * kLabelStep));
    for (int row = 0; row < kRows; row += kLabelStep) {
        for (int column = 0; column < kColumns; column += kLabelStep) {
            const std::size_t i = relief.at(column, row);
            const Vec2 place = place_of(static_cast<float>(column), static_cast<float>(row));
            const SampleRegion region = region_at(scene, place, {relief.level[i], relief.part[i]});
            labels.push_back(
                static_cast<std::uint8_t>(kRegionStep * (1 + static_cast<int>(region))));
        }
    }
    return labels;
}

}  // namespace dibhr::sample
