// The depth of a scene: a thick ray for each tile finds where its thin rays may start.
#include "assets/sample/relief.hpp"

namespace dibhr::sample {
namespace {

constexpr float kTop = 262.0F;  // nothing of the scene is nearer
constexpr int kTile = 16;
constexpr int kSmallTile = 4;

/// The lowest level above which a ray as thick as `radius` meets nothing.
float clear_down_to(const Scene& scene, Vec2 place, float from, float radius,
                    Parts parts) noexcept {
    const float wall = Scene::kWallLevel;
    float level = from;
    while (level > wall) {
        const float free = scene.distance({place.x, place.y, level}, parts) * 0.9F - radius;
        if (free < 0.5F) return std::min(level + 2.0F, from);
        level -= free;
    }
    return wall;
}

void march_small_tile(const Scene& scene, Relief& relief, int column, int row, float from,
                      Parts parts) {
    for (int y = row; y < row + kSmallTile; ++y) {
        for (int x = column; x < column + kSmallTile; ++x) {
            const Hit hit =
                cast(scene, place_of(static_cast<float>(x), static_cast<float>(y)), from, parts);
            relief.level[relief.at(x, y)] = hit.level;
            relief.part[relief.at(x, y)] = hit.part;
        }
    }
}

void march_tile(const Scene& scene, Relief& relief, int column, int row) {
    const auto middle = [](int corner, int size) {
        return static_cast<float>(corner) + 0.5F * static_cast<float>(size - 1);
    };
    const Vec2 place = place_of(middle(column, kTile), middle(row, kTile));
    const Parts parts = scene.parts_near(place, 0.75F * kTile);
    const float from = clear_down_to(scene, place, kTop, 0.75F * kTile, parts);
    for (int y = row; y < row + kTile; y += kSmallTile) {
        for (int x = column; x < column + kTile; x += kSmallTile) {
            const Vec2 small = place_of(middle(x, kSmallTile), middle(y, kSmallTile));
            const float start = clear_down_to(scene, small, from, 0.75F * kSmallTile, parts);
            march_small_tile(scene, relief, x, y, start, parts);
        }
    }
}

}  // namespace

Hit cast(const Scene& scene, Vec2 place, float from_level, Parts parts) noexcept {
    constexpr int kMaxSteps = 160;
    constexpr float kClose = 0.01F;
    constexpr float kCareful = 1.25F;  // the small relief makes distances inexact: trust none fully
    const float wall = Scene::kWallLevel;
    float level = from_level, before = 0.0F, went = 0.0F;
    for (int step = 0; step < kMaxSteps && level > wall; ++step) {
        const float d = scene.distance({place.x, place.y, level}, parts);
        if (std::abs(d) < kClose) break;
        // Near the surface, the last step shows how fast the distance shrinks along the ray.
        const bool close = std::abs(d) < 1.5F && std::abs(went) > 0.005F;
        const float slope = close ? std::clamp((before - d) / went, 0.3F, 1.25F) : kCareful;
        went = d / slope;
        before = d;
        level -= went;
    }
    if (level <= wall) return {wall, Part::Wall};
    return {level, scene.nearest({place.x, place.y, level}, parts)};
}

Relief march(const Scene& scene) {
    const auto pixels = static_cast<std::size_t>(kColumns) * static_cast<std::size_t>(kRows);
    Relief relief{kColumns, kRows, std::vector<float>(pixels), std::vector<Part>(pixels)};
    for (int row = 0; row < kRows; row += kTile)
        for (int column = 0; column < kColumns; column += kTile)
            march_tile(scene, relief, column, row);
    return relief;
}

}  // namespace dibhr::sample
