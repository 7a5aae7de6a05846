// One finished frame of the sample: march, light, paint, and smooth the edges between parts.
#include "assets/sample/picture.hpp"

#include <algorithm>
#include <cmath>

#include "assets/sample/light.hpp"
#include "assets/sample/paint.hpp"
#include "assets/sample/relief.hpp"

namespace dibhr::sample {
namespace {

// A light of the wall's own leaves only a faint shadow on it: the relief shows the wall from aside,
// where a dark shadow that the hand covers straight on would look like a hole.
constexpr float kLeastOnWall = 0.8F;

Reach reach_of(const LightMap& light, Vec2 pixel, Hit hit) {
    const Reach reach = light.at(pixel.x, pixel.y, hit.level);
    if (hit.part != Part::Wall) return reach;
    return {glm::mix(kLeastOnWall, 1.0F, reach.key), glm::mix(kLeastOnWall, 1.0F, reach.sky)};
}

Vec3 colour_at(const Scene& scene, const LightMap& light, Vec2 pixel, Hit hit, Vec3 shape) {
    const Vec2 place = place_of(pixel.x, pixel.y);
    const Vec3 world{place.x, place.y, hit.level};
    const Paint paint = paint_at(scene, world, hit.part, shape);
    return developed(shade(paint, glm::normalize(shape + paint.tilt), reach_of(light, pixel, hit)));
}

/// True where parts or levels change abruptly: one ray cannot stand for the whole pixel.
bool on_edge(const Relief& relief, int column, int row) noexcept {
    const std::size_t here = relief.at(column, row);
    for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
            const std::size_t there = relief.at(std::clamp(column + dx, 0, kColumns - 1),
                                                std::clamp(row + dy, 0, kRows - 1));
            if (relief.part[there] != relief.part[here] ||
                std::abs(relief.level[there] - relief.level[here]) > 6.0F)
                return true;
        }
    return false;
}

/// The normal of the relief itself, for places that are not on an edge.
Vec3 relief_normal(const Relief& relief, int column, int row) noexcept {
    const auto level = [&](int x, int y) {
        return relief.level[relief.at(std::clamp(x, 0, kColumns - 1), std::clamp(y, 0, kRows - 1))];
    };
    return glm::normalize(Vec3{level(column - 1, row) - level(column + 1, row),
                               level(column, row + 1) - level(column, row - 1), 2.0F});
}

float highest_around(const Relief& relief, int column, int row) noexcept {
    float highest = 0.0F;
    for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx)
            highest =
                std::max(highest, relief.level[relief.at(std::clamp(column + dx, 0, kColumns - 1),
                                                         std::clamp(row + dy, 0, kRows - 1))]);
    return highest;
}

Vec3 averaged_colour(const Scene& scene, const LightMap& light, const Relief& relief, int column,
                     int row) {
    const Vec2 pixel{static_cast<float>(column), static_cast<float>(row)};
    const Parts parts = scene.parts_near(place_of(pixel.x, pixel.y), 1.0F);
    const float from = highest_around(relief, column, row) + 6.0F;
    Vec3 sum{0.0F};
    for (const Vec2 offset : {Vec2{-0.125F, -0.375F}, Vec2{0.375F, -0.125F}, Vec2{-0.375F, 0.125F},
                              Vec2{0.125F, 0.375F}}) {
        const Vec2 sample = pixel + offset;
        const Vec2 place = place_of(sample.x, sample.y);
        const Hit hit = cast(scene, place, from, parts);
        const Vec3 shape = scene.normal({place.x, place.y, hit.level}, hit.part);
        sum += colour_at(scene, light, sample, hit, shape);
    }
    return sum * 0.25F;
}

}  // namespace

Picture picture_of(int frame) {
    const Scene scene{pose_at(static_cast<float>(frame))};
    Relief relief = march(scene);
    const LightMap light{relief};
    Picture picture;
    picture.bgr.resize(relief.level.size() * 3U);
    for (int row = 0; row < kRows; ++row) {
        for (int column = 0; column < kColumns; ++column) {
            const std::size_t i = relief.at(column, row);
            const Vec2 pixel{static_cast<float>(column), static_cast<float>(row)};
            const Vec3 rgb = on_edge(relief, column, row)
                                 ? averaged_colour(scene, light, relief, column, row)
                                 : colour_at(scene, light, pixel, {relief.level[i], relief.part[i]},
                                             relief_normal(relief, column, row));
            for (std::size_t c = 0; c < 3; ++c)
                picture.bgr[3U * i + c] =
                    static_cast<std::uint8_t>(std::lround(255.0F * rgb[static_cast<int>(2 - c)]));
        }
    }
    picture.level = std::move(relief.level);
    return picture;
}

std::vector<std::uint8_t> rounded(const std::vector<float>& level) {
    std::vector<std::uint8_t> bytes(level.size());
    std::transform(level.begin(), level.end(), bytes.begin(), [](float x) {
        return static_cast<std::uint8_t>(std::lround(std::clamp(x, 0.0F, 255.0F)));
    });
    return bytes;
}

}  // namespace dibhr::sample
