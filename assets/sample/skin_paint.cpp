// Paint of skin, lips, brows, lashes, eyes and hair.
#include <cmath>

#include "assets/sample/head.hpp"
#include "assets/sample/paint.hpp"

namespace dibhr::sample {
namespace {

const Vec3 kSkin = colour(0xdb9f7c);
const Vec3 kBlush = colour(0xc9685a);
const Vec3 kLip = colour(0xad4a4f);
const Vec3 kBrow = colour(0x432a1e);
const Vec3 kLash = colour(0x1d1310);
constexpr Vec3 kSkinWrap{0.42F, 0.22F, 0.16F};

Vec3 mixed(Vec3 a, Vec3 b, float t) noexcept {
    return a + (b - a) * std::clamp(t, 0.0F, 1.0F);
}

float freckles(float x, float y) noexcept {
    const float u = x * 0.22F, v = y * 0.22F;
    const int i = static_cast<int>(std::floor(u)), j = static_cast<int>(std::floor(v));
    if (lattice(i + 91, j) < 0.55F) return 0.0F;
    const Vec2 spot{static_cast<float>(i) + 0.3F + 0.4F * lattice(i, j + 50),
                    static_cast<float>(j) + 0.3F + 0.4F * lattice(i, j + 17)};
    return hill(glm::length(Vec2{u, v} - spot), 0.22F) * lattice(i + 7, j + 3);
}

float brow_at(float out_from_middle, float y) noexcept {
    const float t = (out_from_middle - 13.0F) / 42.0F;  // 0 at the nose, 1 at the temple
    if (t < -0.15F || t > 1.15F) return 0.0F;
    const float middle = 21.5F + 9.0F * std::sin(std::clamp(t, 0.0F, 1.0F) * 2.5F) - 3.0F * t;
    const float half = 5.8F * (1.0F - 0.70F * t * t);
    const float body = smooth_step(half + 1.0F, half - 2.2F, std::abs(y - middle)) *
                       smooth_step(-0.12F, 0.10F, t) * smooth_step(1.1F, 0.85F, t);
    const float hairs =
        noise(out_from_middle * 0.9F - (y - middle) * (0.5F - 0.5F * t), y * 0.25F + 20.0F * t);
    return body * (0.84F + 0.16F * hairs);
}

/// Lashes and the dark edge of the upper lid.
float lash_at(float out, float y, float opening) noexcept {
    const EyeOpening edge = eye_opening(std::clamp(out, -20.0F, 20.0F), y, opening);
    const float within = smooth_step(24.0F, 20.0F, out) * smooth_step(-21.0F, -17.0F, out);
    const float wing = 0.30F * std::max(out - 14.0F, 0.0F);
    const float thick = 2.0F + 1.0F * smooth_step(-10.0F, 16.0F, out);
    const float above = y - edge.upper_edge - wing;
    const float upper = smooth_step(thick, thick - 1.6F, above) * smooth_step(-2.2F, -1.0F, above);
    const float lower =
        0.35F * hill(y - edge.lower_edge + 0.8F, 1.2F) * smooth_step(-4.0F, 12.0F, out);
    return std::max(upper, lower) * within;
}

Vec3 direction_to_world(const Scene& scene, Vec3 head) noexcept {
    return glm::transpose(scene.pose().head_from_world) * head;
}

}  // namespace

Paint paint_face(const Scene& scene, Vec3 world) noexcept {
    const Vec3 head = scene.to_head(world);
    const float side = std::abs(head.x);
    Paint paint;
    paint.wrap = kSkinWrap;
    paint.gloss = 0.045F;
    paint.sharpness = 18.0F;

    const float mottle = noise(head.x * 0.05F + 9.0F, head.y * 0.05F) - 0.5F;
    Vec3 skin = kSkin * (1.0F + 0.06F * mottle);
    float blush = 0.75F * hill(glm::length(Vec2{side - 44.0F, (head.y + 26.0F) * 1.15F}), 25.0F);
    blush += 0.45F * hill(glm::length(Vec2{side, head.y + 36.0F}), 15.0F);
    blush += 0.25F * hill(glm::length(Vec2{side, head.y + 95.0F}), 16.0F);
    blush += 0.55F * smooth_step(70.0F, 82.0F, side) *
             smooth_step(60.0F, 20.0F, std::abs(head.y + 10.0F));
    blush += 0.22F * hill(glm::length(Vec2{side - 33.0F, (head.y - 9.0F) * 1.5F}), 18.0F);
    skin = mixed(skin, kBlush, blush * 0.72F);
    if (head.z > 20.0F && std::abs(head.y + 22.0F) < 26.0F && side < 66.0F)
        skin *= 1.0F - 0.22F * freckles(head.x, head.y) * smooth_step(66.0F, 40.0F, side) *
                           smooth_step(26.0F, 12.0F, std::abs(head.y + 22.0F));

    if (head.z > 30.0F) {
        const Mouth mouth = mouth_at(head.x);
        const float lip =
            smooth_step(-1.2F, 1.2F, std::min(mouth.upper - head.y, head.y - mouth.lower)) *
            smooth_step(31.5F, 27.0F, side);
        skin =
            mixed(skin, kLip * (1.0F + 0.10F * (noise(head.x * 0.8F, 1.0F) - 0.5F)), 0.85F * lip);
        const float seam = hill(head.y - mouth.line, 1.5F) * smooth_step(33.0F, 27.0F, side);
        skin *= 1.0F - 0.72F * seam;
        paint.gloss = (paint.gloss + 0.10F * lip) * (1.0F - seam);
        paint.sharpness += 14.0F * lip;
        const float nostril = hill(glm::length(Vec2{side - 6.5F, (head.y + 44.5F) * 1.3F}), 3.2F);
        skin *= 1.0F - 0.75F * nostril;
        const float out = side - kEyeCentre.x;
        const float crease = hill(head.y -
                                      eye_opening(std::clamp(out, -18.0F, 18.0F), 0.0F,
                                                  std::max(scene.pose().eye_opening, 0.35F))
                                          .upper_edge -
                                      6.5F,
                                  2.0F) *
                             hill(out, 15.0F);
        skin *= 1.0F - 0.22F * crease;
        skin = mixed(skin, kBrow, 0.92F * brow_at(side, head.y));
        skin = mixed(skin, kLash, 0.95F * lash_at(out, head.y, scene.pose().eye_opening));
    }
    paint.albedo = skin;
    return paint;
}

Paint paint_eye(const Scene& scene, Vec3 world) noexcept {
    const Vec3 head = scene.to_head(world);
    const float mirror = head.x < 0.0F ? -1.0F : 1.0F;
    const Vec3 eye = Vec3{head.x * mirror, head.y, head.z} - kEyeCentre;
    const Vec2 gaze = scene.pose().gaze;
    const Vec2 offset{eye.x - kEyeRadius * gaze.x * mirror + 0.8F, eye.y - kEyeRadius * gaze.y};
    const float r = glm::length(offset);
    const float angle = std::atan2(offset.y, offset.x);

    const EyeOpening edge = eye_opening(eye.x, eye.y, scene.pose().eye_opening);
    Vec3 white =
        mixed(colour(0xe9e2dc), colour(0xc98a7c),
              0.7F * smooth_step(-13.0F, -19.0F, eye.x) + 0.25F * smooth_step(13.0F, 19.0F, eye.x));
    const float fibres = noise(angle * 9.0F + 40.0F, r * 0.5F);
    Vec3 iris =
        mixed(colour(0x9a6428), colour(0x686b42), smooth_step(3.8F, 7.4F, r + 1.2F * fibres));
    iris *= 0.65F + 0.5F * fibres;
    iris *= 1.0F - 0.65F * smooth_step(8.2F, 10.0F, r);
    iris *= 1.0F + 0.5F * hill(offset.y + 5.0F, 4.0F);
    Vec3 ball = mixed(iris, white, smooth_step(9.6F, 10.8F, r));
    ball = mixed(colour(0x0c0908), ball, smooth_step(4.0F, 5.0F, r));
    ball *=
        0.45F + 0.55F * smooth_step(0.0F, 6.5F, edge.upper_edge - eye.y);  // under the lid's shade
    ball *= 0.75F + 0.25F * smooth_step(0.0F, 2.0F, eye.y - edge.lower_edge);

    Paint paint;
    paint.albedo = ball;
    paint.wrap = {0.3F, 0.28F, 0.28F};
    // Catch-lights stay with the lamp, not with the eye: left in both eyes.
    const Vec2 from_iris{head.x - mirror * kEyeCentre.x - kEyeRadius * gaze.x, offset.y};
    paint.glint = 1.5F * smooth_step(2.5F, 1.3F, glm::length(from_iris - Vec2{-3.0F, 3.6F})) +
                  0.25F * smooth_step(2.6F, 0.6F, glm::length(from_iris - Vec2{3.4F, -3.6F}));
    return paint;
}

Paint paint_hair(const Scene& scene, Vec3 world, Vec3 normal) noexcept {
    const Vec3 head = scene.to_head(world);
    const HairFlow flow = hair_flow(head);
    const float here = flow.across;
    constexpr float kStep = 0.5F;
    Vec3 change{hair_flow(head + Vec3{kStep, 0, 0}).across - here,
                hair_flow(head + Vec3{0, kStep, 0}).across - here,
                hair_flow(head + Vec3{0, 0, kStep}).across - here};
    if (glm::length(change) > 4.0F || glm::length(change) < 1e-4F)
        change = {1.0F, 0.0F, 0.0F};  // at the parting
    const Vec3 strand = glm::cross(normal, direction_to_world(scene, change));

    const float lock = noise(here * 0.11F + 5.0F, head.y * 0.008F);
    const float fine = noise(here * 0.5F, head.y * 0.02F + 40.0F);
    Paint paint;
    const float light = std::clamp(0.15F + 0.5F * lock + 0.45F * (fine - 0.4F), 0.0F, 1.0F);
    paint.albedo = mixed(colour(0x3c2114), colour(0x9a5f34), light);
    paint.albedo = mixed(paint.albedo, kSkin * 0.55F, 0.8F * hill(flow.parting, 1.6F));
    paint.strands = true;
    paint.strand = glm::normalize(strand + 1e-6F);
    paint.gloss = 0.12F * (0.4F + 0.6F * fine);
    paint.sharpness = 60.0F;
    paint.shine = {1.0F, 0.68F, 0.42F};
    paint.wrap = {0.25F, 0.20F, 0.16F};
    return paint;
}

Paint paint_hand(const Scene& scene, Vec3 world) noexcept {
    const Vec3 hand = scene.to_hand(world);
    float pink = 0.22F + 0.16F * (noise(hand.x * 0.08F, hand.y * 0.08F) - 0.5F);
    for (const Finger& finger : scene.fingers()) {
        pink = std::max(pink, 0.85F * hill(glm::length(hand - finger.joint[3]), 15.0F));
        pink = std::max(
            pink,
            0.45F * hill(glm::length(hand - finger.joint[0] - Vec3{0.0F, -4.0F, 8.0F}), 15.0F));
    }
    pink = std::max(pink, 0.5F * hill(glm::length(Vec2{hand.x + 24.0F, hand.y + 22.0F}), 22.0F));
    pink = std::max(pink, 0.45F * hill(glm::length(Vec2{hand.x - 26.0F, hand.y + 22.0F}), 20.0F));
    Paint paint;
    paint.albedo = mixed(kSkin * 1.06F, kBlush * 1.05F, pink * 0.65F);
    paint.albedo *= Vec3{1.0F} - Vec3{0.12F, 0.20F, 0.22F} * hand_crease(hand, scene.fingers());
    paint.wrap = kSkinWrap;
    paint.gloss = 0.04F;
    paint.sharpness = 14.0F;
    return paint;
}

}  // namespace dibhr::sample
