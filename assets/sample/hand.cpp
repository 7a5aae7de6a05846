// The shape of the sample's raised hand: rods with pads for fingers, mounds around a hollow palm.
#include "assets/sample/hand.hpp"

#include <cmath>

namespace dibhr::sample {
namespace {

struct FingerPlan {
    Vec3 base;
    std::array<float, 3> bone;
    float base_radius;
    float tip_radius;
    float lean_rad;  // away from the middle finger when spread, positive to the little one's side
};

constexpr std::array<FingerPlan, 4> kPlans{{
    {{-30.0F, 36.0F, 0.0F}, {34.0F, 21.0F, 15.0F}, 12.0F, 9.0F, -0.20F},
    {{-9.5F, 40.0F, 0.0F}, {38.0F, 24.0F, 16.0F}, 12.2F, 9.2F, -0.04F},
    {{10.0F, 37.0F, 0.0F}, {35.0F, 23.0F, 16.0F}, 11.6F, 8.8F, 0.12F},
    {{29.5F, 27.0F, 0.0F}, {28.0F, 18.0F, 14.0F}, 10.4F, 7.8F, 0.34F},
}};

Finger bend(const FingerPlan& plan, const Pose& pose, float more_curl) {
    Finger finger{{}, plan.base_radius, plan.tip_radius};
    finger.joint[0] = plan.base;
    const float lean = plan.lean_rad * (0.35F + 0.65F * pose.finger_spread);
    float curl = 0.5F * pose.finger_curl_rad;
    for (std::size_t i = 0; i < plan.bone.size(); ++i) {
        const Vec3 direction{std::sin(lean) * std::cos(curl), std::cos(lean) * std::cos(curl),
                             std::sin(curl)};
        finger.joint[i + 1] = finger.joint[i] + plan.bone[i] * direction;
        curl += pose.finger_curl_rad + more_curl;
    }
    return finger;
}

Finger bend_thumb(const Pose& pose) {
    const float out = 3.0F * (pose.finger_spread - 0.75F);
    return {{Vec3{-24.0F, -36.0F, 6.0F}, Vec3{-46.0F - out, -10.0F, 15.0F},
             Vec3{-60.0F - 2.0F * out, 16.0F, 19.0F}, Vec3{-65.0F - 3.0F * out, 36.0F, 21.0F}},
            15.0F,
            9.0F};
}

float finger_distance(Vec3 p, const Finger& finger) noexcept {
    const float reach = glm::length(p - finger.joint[2]);
    if (reach > 95.0F) return reach - 75.0F;
    const float r0 = finger.base_radius, r3 = finger.tip_radius;
    const float r1 = r0 + (r3 - r0) * 0.40F, r2 = r0 + (r3 - r0) * 0.70F;
    const float d0 = rod(p, finger.joint[0], finger.joint[1], r0, r1);
    const float d1 = rod(p, finger.joint[1], finger.joint[2], r1, r2);
    const float d2 = rod(p, finger.joint[2], finger.joint[3], r2, r3);
    float d = smooth_min(smooth_min(d0, d1, 3.0F), d2, 3.0F);
    for (std::size_t i = 0; i < 3; ++i) {  // the soft pad of each bone, towards the viewer
        const Vec3 middle = 0.5F * (finger.joint[i] + finger.joint[i + 1]) + Vec3{0.0F, 0.0F, 2.8F};
        const float half = 0.42F * glm::length(finger.joint[i + 1] - finger.joint[i]);
        d = smooth_min(d, ellipsoid(p - middle, {r2 * 0.86F, half + 2.0F, r2 * 0.76F}), 8.0F);
    }
    return d;
}

float rounded_box(Vec3 p, Vec3 half, float radius) noexcept {
    const Vec3 q = glm::abs(p) - half + radius;
    return glm::length(glm::max(q, 0.0F)) + std::min(std::max({q.x, q.y, q.z}), 0.0F) - radius;
}

float palm_distance(Vec3 p) noexcept {
    const float taper = 1.0F + 0.0026F * (30.0F - p.y);  // narrower towards the wrist
    const Vec3 squeezed{p.x * taper - 1.0F, p.y + 0.0035F * p.x * p.x, p.z + 0.003F * p.x * p.x};
    float d = rounded_box(squeezed - Vec3{0.0F, -6.0F, -2.0F}, {41.0F, 46.0F, 14.0F}, 13.0F) * 0.9F;
    d = smooth_min(d, ellipsoid(p - Vec3{-22.0F, -22.0F, 9.0F}, {19.0F, 30.0F, 14.0F}), 20.0F);
    d = smooth_min(d, ellipsoid(p - Vec3{24.0F, -22.0F, 6.0F}, {15.0F, 31.0F, 13.0F}), 12.0F);
    d = smooth_min(d, ellipsoid(p - Vec3{0.0F, 26.0F, 6.0F}, {34.0F, 11.0F, 9.0F}), 10.0F);
    d = smooth_max(d, -ellipsoid(p - Vec3{2.0F, 0.0F, 30.0F}, {18.0F, 24.0F, 18.0F}), 16.0F);
    return d;
}

/// Distance in the picture plane to the piece from a to b.
float line_distance(Vec3 p, Vec2 a, Vec2 b) noexcept {
    const Vec2 q{p.x, p.y};
    const Vec2 ab = b - a;
    const float t = std::clamp(glm::dot(q - a, ab) / glm::dot(ab, ab), 0.0F, 1.0F);
    return glm::length(q - a - t * ab);
}

}  // namespace

Fingers bend_fingers(const Pose& pose) {
    return {bend(kPlans[0], pose, 0.02F), bend(kPlans[1], pose, 0.0F), bend(kPlans[2], pose, 0.03F),
            bend(kPlans[3], pose, 0.06F), bend_thumb(pose)};
}

float hand_distance(Vec3 hand, const Fingers& fingers, Vec3 forearm) noexcept {
    const float reach = glm::length(hand) - 150.0F;
    if (reach > 20.0F) return reach;
    float d = palm_distance(hand);
    constexpr Vec3 kWrist{2.0F, -50.0F, -3.0F};
    d = smooth_min(d, rod(hand, kWrist, kWrist + 60.0F * forearm, 21.0F, 22.0F), 16.0F);
    float together = 1.0e3F;
    for (std::size_t i = 0; i < 4; ++i)
        together = smooth_min(together, finger_distance(hand, fingers[i]), 3.0F);
    d = smooth_min(d, together, 9.0F);
    d = smooth_min(d, finger_distance(hand, fingers[4]), 14.0F);
    return d + 0.6F * hand_crease(hand, fingers);
}

float hand_crease(Vec3 hand, const Fingers& fingers) noexcept {
    if (hand.z < -4.0F) return 0.0F;
    float crease = 0.0F;
    if (hand.y < 34.0F) {
        const float life =
            std::abs(glm::length(Vec2{hand.x + 34.0F, hand.y + 34.0F} / Vec2{36.0F, 50.0F}) -
                     1.0F) *
            40.0F;
        if (hand.x > -26.0F)
            crease = std::max(crease, hill(life, 1.6F) * smooth_step(-60.0F, -35.0F, hand.y));
        const float head = line_distance(hand, {-30.0F, 14.0F}, {22.0F, -8.0F});
        const float heart = line_distance(hand, {-8.0F, 22.0F}, {36.0F, 10.0F});
        crease = std::max({crease, 0.8F * hill(head, 1.6F), 0.8F * hill(heart, 1.6F)});
    } else {
        for (std::size_t i = 0; i < 4; ++i) {
            const Finger& finger = fingers[i];
            for (std::size_t j = 1; j < 3; ++j) {
                const Vec3 axis = glm::normalize(finger.joint[j + 1] - finger.joint[j - 1]);
                const Vec3 offset = hand - finger.joint[j];
                const float off = glm::dot(offset, axis);
                const float aside =
                    glm::length(Vec2{offset.x, offset.y} - off * Vec2{axis.x, axis.y});
                const float fade = smooth_step(0.95F, 0.55F, aside / finger.base_radius);
                crease = std::max(crease, fade * hill(off, 1.7F));
            }
        }
    }
    return crease * smooth_step(-4.0F, 4.0F, hand.z);
}

}  // namespace dibhr::sample
