// The shape of the head: blended ellipsoids; lips, lids and strands are small relief on them.
#include "assets/sample/head.hpp"

namespace dibhr::sample {
namespace {

constexpr float kFeatureReach = 34.0F;  // no feature stands further out of the bare head than this
constexpr float kMouthHalfWidth = 31.0F;

Vec3 mirrored(Vec3 head) noexcept {
    return {std::abs(head.x), head.y, head.z};
}

/// How far hanging hair waves towards the neck at this height.
float hair_sway(float y) noexcept {
    return 7.0F * std::sin(y * 0.034F + 0.6F) * smooth_step(0.0F, -70.0F, y);
}

float bare_head(Vec3 head, Vec3 side) noexcept {
    const float skull = ellipsoid(head - Vec3{0.0F, 38.0F, -8.0F}, {77.0F, 88.0F, 88.0F});
    const float jaw = ellipsoid(head - Vec3{0.0F, -38.0F, 16.0F}, {58.0F, 70.0F, 64.0F});
    const float face = smooth_min(skull, jaw, 26.0F);
    const float cheek = ellipsoid(side - Vec3{36.0F, -25.0F, 47.0F}, {28.0F, 25.0F, 27.0F});
    // Before the ears the head widens to them, or nobody would know what is between face and ear.
    const float temple = ellipsoid(side - Vec3{50.0F, -20.0F, 3.0F}, {27.0F, 48.0F, 38.0F});
    return smooth_min(smooth_min(face, cheek, 26.0F), temple, 14.0F);
}

float nose(Vec3 head, Vec3 side) noexcept {
    const float bridge = rod(head, {0.0F, 10.0F, 72.0F}, {0.0F, -31.0F, 92.0F}, 7.5F, 8.5F);
    const float tip = ellipsoid(head - Vec3{0.0F, -34.0F, 95.0F}, {11.5F, 10.0F, 11.0F});
    const float wing = ellipsoid(side - Vec3{11.5F, -37.0F, 86.0F}, {7.5F, 7.5F, 10.0F});
    const float nostril = ellipsoid(side - Vec3{6.0F, -45.5F, 93.0F}, {4.2F, 3.4F, 6.0F});
    const float body = smooth_min(smooth_min(bridge, tip, 10.0F), wing, 7.0F);
    return smooth_max(body, -nostril, 4.0F);
}

float ear(Vec3 side) noexcept {
    Vec3 p = side - Vec3{75.5F, -10.0F, 0.0F};
    constexpr float kCos = 0.87F, kSin = 0.4931F;
    p = {kCos * p.x + kSin * p.z, p.y,
         -kSin * p.x + kCos * p.z};  // x now out of the ear's flat side
    const float lobe_shift = 0.12F * p.y;
    const float shell = ellipsoid(p - Vec3{0.0F, 0.0F, lobe_shift - 4.0F}, {7.0F, 22.5F, 14.5F});
    const float bowl = ellipsoid(p - Vec3{8.0F, 3.5F, lobe_shift - 2.5F}, {8.0F, 14.0F, 9.0F});
    const float flap = ellipsoid(p - Vec3{1.5F, -3.0F, lobe_shift + 7.0F}, {4.0F, 6.0F, 4.0F});
    return smooth_min(smooth_max(shell, -bowl, 4.0F), flap, 4.0F);
}

/// The hair of one side, from behind the ear over the shoulder to the chest: a round lock around a
/// curve.
float falling_hair(Vec3 side) noexcept {
    const float down = std::clamp((10.0F - side.y) / 196.0F, 0.0F, 1.0F);
    const float out =
        50.0F + 29.0F * smooth_step(0.25F, 0.8F, down) - 14.0F * smooth_step(0.6F, 1.0F, down);
    const Vec2 middle{out - hair_sway(side.y), -22.0F + 70.0F * down * (0.45F + 0.55F * down)};
    const float taper = (0.75F + 0.25F * smooth_step(0.0F, 0.25F, down)) *
                        (1.0F - 0.85F * smooth_step(0.45F, 1.05F, down));
    const float radius = (34.0F - 3.0F * down) * taper;
    const float lock = glm::length(Vec2{side.x, side.z} - middle) - radius;
    return smooth_max(0.8F * lock, std::abs(side.y + 88.0F) - 100.0F, 12.0F);
}

/// Relief of lips, the groove under the nose, smile lines and the fold of the lids: height over the
/// skin [px].
float skin_relief(Vec3 head, Vec3 side, float opening) noexcept {
    if (head.z < 30.0F) return 0.0F;
    float height = 0.0F;
    if (head.y < -30.0F) {
        const Mouth mouth = mouth_at(head.x);
        const float above = (head.y - mouth.line) / std::max(mouth.upper - mouth.line, 1.0F);
        const float below = (mouth.line - head.y) / std::max(mouth.line - mouth.lower, 1.0F);
        if (above > 0.0F && above < 1.6F)
            height += 3.7F * mouth.presence * smooth_step(0.0F, 0.35F, above) *
                      smooth_step(1.6F, 0.45F, above);
        if (below > 0.0F && below < 1.5F)
            height += 5.6F * mouth.presence * smooth_step(0.0F, 0.45F, below) *
                      smooth_step(1.5F, 0.5F, below);
        height -= 1.3F * hill(head.y - mouth.line, 2.6F) * smooth_step(36.0F, 26.0F, side.x);
        height -= 2.2F * hill(side.x - 35.0F, 5.0F) * hill(head.y + 55.0F, 6.0F);
        height -= 1.2F * hill(head.x, 3.5F) * hill(head.y + 51.0F, 5.0F);
        height -= 1.6F * hill(head.y + 81.0F, 5.0F) * hill(head.x, 20.0F);
    }
    const float fold = side.x - (22.0F + 0.33F * (-40.0F - head.y));
    height -= 0.9F * hill(fold, 5.0F) * smooth_step(-58.0F, -48.0F, head.y) *
              smooth_step(-30.0F, -40.0F, head.y);
    const float out = side.x - kEyeCentre.x;
    if (std::abs(out) < 26.0F && std::abs(head.y) < 30.0F) {
        const EyeOpening edge = eye_opening(out, head.y, std::max(opening, 0.35F));
        const float fade = hill(out, 17.0F);
        height -= 1.5F * fade * hill(head.y - edge.upper_edge - 6.5F, 2.2F);
        height -= 0.8F * fade * hill(head.y - edge.lower_edge + 7.0F, 3.0F);
    }
    return height;
}

}  // namespace

Mouth mouth_at(float x) noexcept {
    const float side = std::abs(x);
    const float t = std::min(side / kMouthHalfWidth, 1.0F);
    Mouth mouth;
    mouth.line = -65.0F + 0.0080F * x * x - 0.9F * hill(x, 5.0F) + 0.6F * hill(side - 9.0F, 5.0F);
    mouth.upper =
        mouth.line + 8.2F * std::sqrt(1.0F - t * t * t) * (1.0F - 0.35F * t) - 1.9F * hill(x, 4.5F);
    mouth.lower = mouth.line - 10.5F * std::sqrt(1.0F - t * t) * (1.0F - 0.12F * t);
    mouth.presence = smooth_step(1.0F, 0.55F, t);
    return mouth;
}

EyeOpening eye_opening(float out, float up, float opening) noexcept {
    constexpr float kHalfWidth = 20.0F;
    const float t = out / kHalfWidth;
    const float arch = 1.0F - t * t;
    const float skewed = arch * (1.0F + 0.22F * t);  // the highest point lies a little outwards
    const float tilt = 0.10F * out;
    EyeOpening eye;
    eye.lower_edge = tilt - 7.6F * arch * (1.0F + 0.15F * t);
    const float open_upper = tilt + 10.2F * skewed;
    eye.upper_edge = eye.lower_edge + opening * (open_upper - eye.lower_edge);
    const float beyond_corner = std::max(std::abs(out) - kHalfWidth, 0.0F);
    const float shut = 3.0F * smooth_step(0.5F, 0.0F, opening);  // lids that touch leave no slit
    eye.inside = std::min(eye.upper_edge - up, up - eye.lower_edge) * 0.75F - beyond_corner - shut;
    return eye;
}

HairFlow hair_flow(Vec3 head) noexcept {
    // Two ellipses whose overlap is bare: a pointed arch over the forehead, its point at the
    // parting.
    const Vec2 p{head.x, head.y};
    const float right =
        (glm::length((p - Vec2{-32.0F, -30.0F}) / Vec2{103.0F, 107.0F}) - 1.0F) * 104.0F;
    const float left =
        (glm::length((p - Vec2{-2.0F, -30.0F}) / Vec2{71.0F, 105.0F}) - 1.0F) * 80.0F;
    const float edge = smooth_max(right, left, 5.0F);
    const float depth = 0.42F * (head.z - 60.0F);
    const float side = std::abs(head.x) + hair_sway(head.y);
    const float hanging = smooth_step(10.0F, -70.0F, head.y);
    const float from_parting = head.x + 16.0F + 0.6F * (head.y - 78.0F);
    const float combed = edge - depth;
    const float across = combed + hanging * (side - 60.0F + 0.12F * head.y - combed);
    const bool on_right = head.y > 40.0F ? from_parting > 0.0F : head.x > 0.0F;
    const float below =
        40.0F * smooth_step(60.0F, 20.0F, head.y);  // the parting ends at the forehead
    return {across + (on_right ? 0.0F : 300.0F), edge, 0.85F * std::abs(from_parting) + below};
}

float face_distance(Vec3 head, float opening) noexcept {
    const Vec3 side = mirrored(head);
    float d = bare_head(head, side);
    if (d > kFeatureReach + 12.0F) return d - kFeatureReach;
    const float ears = side.x > 50.0F ? ear(side) : 1.0e3F;
    if (head.z < 0.0F) return smooth_min(d, ears, 6.0F);

    d = smooth_min(d, ellipsoid(head - Vec3{0.0F, -90.0F, 55.0F}, {21.0F, 17.0F, 19.0F}), 22.0F);
    d = smooth_min(d, ellipsoid(head - Vec3{0.0F, -60.0F, 66.0F}, {27.0F, 21.0F, 16.0F}), 18.0F);
    d = smooth_min(d, ellipsoid(side - Vec3{27.0F, 22.0F, 62.0F}, {26.0F, 9.0F, 13.0F}), 14.0F);
    d = smooth_max(d, -ellipsoid(side - Vec3{33.0F, 2.0F, 84.0F}, {23.0F, 14.0F, 17.0F}), 12.0F);
    d = smooth_min(d, nose(head, side), 10.0F);
    d = smooth_min(d, ears, 6.0F);

    const Vec3 eye = side - kEyeCentre;
    const float opened = eye_opening(eye.x, eye.y, opening).inside;
    const float lid = smooth_max(sphere(eye, kEyeRadius + 2.4F), opened, 1.6F);
    d = smooth_min(smooth_max(d, opened - 1.0F, 2.0F), lid, 5.0F);
    return d - skin_relief(head, side, opening);
}

float eye_distance(Vec3 head) noexcept {
    return sphere(mirrored(head) - kEyeCentre, kEyeRadius);
}

float hair_distance(Vec3 head) noexcept {
    const Vec3 side = mirrored(head);
    const float cap = ellipsoid(head - Vec3{0.0F, 41.0F, -14.0F}, {87.0F, 98.0F, 97.0F});
    const float fall = falling_hair(side);
    if (std::min(cap, fall) > 24.0F) return std::min(cap, fall) - 10.0F;

    const HairFlow flow = hair_flow(head);
    const float ear_room = ellipsoid(side - Vec3{91.0F, -4.0F, 16.0F}, {24.0F, 24.0F, 26.0F});
    float d = smooth_max(cap, -flow.edge, 16.0F);
    d = smooth_min(d, fall, 14.0F);
    d = smooth_max(d, -ear_room, 14.0F);
    const float whole = smooth_step(0.0F, 14.0F, flow.parting);
    const float lock = noise(flow.across * 0.085F, head.y * 0.006F + 3.0F) - 0.5F;
    const float strand = noise(flow.across * 0.28F + 4.0F * lock, head.y * 0.012F) - 0.5F;
    const float groove = 2.5F * hill(flow.parting, 4.0F) * smooth_step(20.0F, 60.0F, head.y);
    // Locks that stood out at the outline would be a second outline beside it.
    const float seen = smooth_step(0.0F, 60.0F, head.z) + smooth_step(-20.0F, -60.0F, head.y);
    return d - (5.0F * lock + 1.4F * strand) * whole * std::min(seen, 1.0F) + groove;
}

}  // namespace dibhr::sample
