// Paint of the sweater: knitted stitches, a patterned yoke, ribbed collar and cuffs.
#include <cmath>
#include <numbers>

#include "assets/sample/body.hpp"
#include "assets/sample/paint.hpp"

namespace dibhr::sample {
namespace {

const Vec3 kWool = colour(0xd9ccb0);
const Vec3 kRust = colour(0xa8452f);
const Vec3 kNavy = colour(0x2d4560);
constexpr float kStitchWidth = 8.0F;
constexpr float kStitchHeight = 6.5F;

/// One stitch of plain knitting: two legs that meet in a V.
struct Stitch {
    Vec2 centre{};   ///< in the cloth's own coordinates [px]
    float height{};  ///< 0 between the yarns, 1 on top of one
    Vec2 slope{};    ///< of the height along the cloth
};

Stitch stitch_at(Vec2 cloth) noexcept {
    const float column = std::floor(cloth.x / kStitchWidth);
    const float x = cloth.x / kStitchWidth - column - 0.5F;
    const float y = cloth.y / kStitchHeight - 1.1F * std::abs(x);
    const float row = std::floor(y);
    const float leg = std::sin(2.0F * std::numbers::pi_v<float> * std::abs(x));
    const float yarn = std::sin(std::numbers::pi_v<float> * (y - row));
    Stitch stitch;
    stitch.centre = {(column + 0.5F) * kStitchWidth, (row + 0.5F) * kStitchHeight};
    stitch.height = std::sqrt(std::max(leg * yarn, 0.0F));
    const float outward = x < 0.0F ? -1.0F : 1.0F;
    stitch.slope = {outward * std::cos(2.0F * std::numbers::pi_v<float> * std::abs(x)),
                    std::cos(std::numbers::pi_v<float> * (y - row))};
    return stitch;
}

Vec3 yoke_colour(Vec2 place) noexcept {
    const Vec2 from_neck{place.x * 0.92F, place.y + 62.0F};
    const float ring = glm::length(from_neck);
    const float turn =
        std::atan2(from_neck.x, -from_neck.y) * (18.0F / (2.0F * std::numbers::pi_v<float>));
    const float motif =
        std::abs(turn - std::floor(turn) - 0.5F) * 2.0F;  // 1 between motifs, 0 in their middle
    const float half = std::abs(2.0F * turn - std::floor(2.0F * turn) - 0.5F) * 2.0F;
    if (ring > 66.0F && ring < 79.0F) return half < 0.5F ? kRust : kWool;
    if (ring > 85.0F && ring < 96.0F) return kNavy;
    if (ring >= 96.0F && ring < 137.0F) {
        const float diamond = std::abs(ring - 116.5F) / 20.5F + motif;
        if (diamond < 0.55F) return kRust;
        return diamond > 1.05F ? kNavy : kWool;
    }
    if (ring >= 137.0F && ring < 148.0F) return kNavy;
    if (ring > 156.0F && ring < 168.0F) return half < 0.5F ? kRust : kWool;
    return kWool;
}

Vec3 sleeve_colour(float from_cuff) noexcept {
    if (from_cuff > 52.0F && from_cuff < 59.0F) return kRust;
    if (from_cuff > 65.0F && from_cuff < 72.0F) return kNavy;
    return kWool;
}

Paint knitted(Stitch stitch, Vec3 wool, Vec3 right, Vec3 up) noexcept {
    const float marl =
        lattice(static_cast<int>(stitch.centre.x), static_cast<int>(stitch.centre.y)) - 0.5F;
    Paint paint;
    paint.albedo = wool * (0.56F + 0.44F * stitch.height) * (1.0F + 0.08F * marl);
    paint.tilt = -0.16F * stitch.slope.x * right - 0.16F * stitch.slope.y * up;
    paint.sheen = 0.35F;
    paint.wrap = {0.22F, 0.22F, 0.22F};
    return paint;
}

Paint ribbed(float wave, Vec3 wool) noexcept {
    Paint paint;
    paint.albedo = wool * (0.62F + 0.38F * wave);
    paint.sheen = 0.35F;
    paint.wrap = {0.2F, 0.2F, 0.2F};
    return paint;
}

}  // namespace

Paint paint_sweater(const Scene& scene, Vec3 world) noexcept {
    const Vec3 rest = without_breath(world, scene.pose().breath);
    const CollarPlace collar = collar_at(rest);
    if (collar.ring < 10.5F) return ribbed(0.5F + 0.5F * std::cos(collar.angle_rad * 44.0F), kRust);
    const float x = std::clamp(rest.x / 265.0F, -0.98F, 0.98F);
    const Stitch stitch = stitch_at({265.0F * std::asin(x), rest.y - 0.12F * rest.z});
    return knitted(stitch,
                   yoke_colour({265.0F * std::sin(stitch.centre.x / 265.0F),
                                stitch.centre.y + 0.12F * rest.z}),
                   {1.0F, 0.0F, 0.0F}, {0.0F, 1.0F, 0.0F});
}

Paint paint_sleeve(const Scene& scene, Vec3 world) noexcept {
    const SleevePlace place = sleeve_at(world, scene.pose());
    if (place.along_px < kCuffLength)
        return ribbed(0.5F + 0.5F * std::cos(place.angle_rad * 26.0F), kRust);
    const Stitch stitch = stitch_at({place.angle_rad * 38.0F, -place.along_px});
    return knitted(stitch, sleeve_colour(-stitch.centre.y), {1.0F, 0.0F, 0.0F}, {0.0F, 1.0F, 0.0F});
}

}  // namespace dibhr::sample
