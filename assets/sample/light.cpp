// Studio light on a relief: shadows by walking towards the light, sky from blurred heights.
#include "assets/sample/light.hpp"

#include <algorithm>
#include <cmath>

namespace dibhr::sample {
namespace {

const Vec3 kToKey = glm::normalize(Vec3{-0.50F, 0.58F, 0.72F});
constexpr Vec3 kKeyColour{1.95F, 1.78F, 1.58F};
constexpr Vec3 kSkyColour{0.60F, 0.64F, 0.70F};
constexpr Vec3 kFrontColour{0.50F, 0.47F, 0.45F};
constexpr Vec3 kRimColour{0.40F, 0.44F, 0.50F};

/// Of the sky's light: what other surfaces reflect reaches the wall behind a hand, too.
constexpr float kLeastSky = 0.35F;

using Grid = std::vector<float>;

float read(const Grid& grid, int columns, int rows, float x, float y) noexcept {
    x = std::clamp(x, 0.0F, static_cast<float>(columns - 1));
    y = std::clamp(y, 0.0F, static_cast<float>(rows - 1));
    const int x0 = std::min(static_cast<int>(x), columns - 2),
              y0 = std::min(static_cast<int>(y), rows - 2);
    const float u = x - static_cast<float>(x0), v = y - static_cast<float>(y0);
    const float* p =
        grid.data() + static_cast<std::size_t>(y0) * static_cast<std::size_t>(columns) + x0;
    const float* q = p + columns;
    return (p[0] * (1.0F - u) + p[1] * u) * (1.0F - v) + (q[0] * (1.0F - u) + q[1] * u) * v;
}

/// Mean over 2 * radius + 1 places along one line of `count` places `stride` apart; the ends
/// repeat.
void blur_line(const float* in, float* out, int count, int stride, int radius) {
    const auto value = [&](int i) { return in[std::clamp(i, 0, count - 1) * stride]; };
    float sum = 0.0F;
    for (int i = -radius; i <= radius; ++i) sum += value(i);
    const float scale = 1.0F / static_cast<float>(2 * radius + 1);
    for (int i = 0; i < count; ++i) {
        out[i * stride] = sum * scale;
        sum += value(i + radius + 1) - value(i - radius);
    }
}

Grid blurred(Grid grid, int columns, int rows, int radius, int passes) {
    Grid other(grid.size());
    for (int pass = 0; pass < passes; ++pass) {
        for (int y = 0; y < rows; ++y)
            blur_line(&grid[static_cast<std::size_t>(y * columns)],
                      &other[static_cast<std::size_t>(y * columns)], columns, 1, radius);
        for (int x = 0; x < columns; ++x)
            blur_line(&other[static_cast<std::size_t>(x)], &grid[static_cast<std::size_t>(x)], rows,
                      columns, radius);
    }
    return grid;
}

/// How much two levels look like one surface: light is not carried over a cliff.
float alike(float a, float b) noexcept {
    const float apart = (a - b) * 0.12F;
    return 1.0F / (1.0F + apart * apart * apart * apart) + 1.0e-6F;
}

/// Mean over 5 x 5 places of the same surface.
Grid softened(const Grid& grid, const Grid& heights, int columns, int rows) {
    Grid soft(grid.size());
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x) {
            const auto here = static_cast<std::size_t>(y * columns + x);
            float sum = 0.0F, total = 0.0F;
            for (int v = std::max(y - 2, 0); v <= std::min(y + 2, rows - 1); ++v)
                for (int u = std::max(x - 2, 0); u <= std::min(x + 2, columns - 1); ++u) {
                    const auto there = static_cast<std::size_t>(v * columns + u);
                    const float weight = alike(heights[here], heights[there]);
                    sum += weight * grid[there];
                    total += weight;
                }
            soft[here] = sum / total;
        }
    return soft;
}

/// 1 in the light, 0 in the shadow of something towards the key light; softer further from what
/// casts it.
float key_reach(const Grid& heights, int columns, int rows, int x, int y) noexcept {
    const float flat = std::hypot(kToKey.x, kToKey.y);
    const Vec2 step{kToKey.x / flat, -kToKey.y / flat};
    const float rise = kToKey.z / flat * 2.0F;  // levels a step of one half-resolution pixel
    const float own = heights[static_cast<std::size_t>(y * columns + x)];
    float open = 1.0F;
    for (float t = 2.0F; t < 110.0F; t += 1.0F + 0.06F * t) {
        const float ray = own + 1.0F + t * rise;
        if (ray > 262.0F) break;
        const float height = read(heights, columns, rows, static_cast<float>(x) + step.x * t,
                                  static_cast<float>(y) + step.y * t);
        open = std::min(open, (ray - height) / (t * 2.0F) * 2.6F + 0.35F);
        if (open <= 0.0F) return 0.0F;
    }
    return smooth_step(0.0F, 1.0F, open);
}

Vec3 power(Vec3 base, float exponent) noexcept {
    return {std::pow(base.x, exponent), std::pow(base.y, exponent), std::pow(base.z, exponent)};
}

float highlight(const Paint& paint, Vec3 normal, Vec3 to_light) noexcept {
    const Vec3 half = glm::normalize(to_light + Vec3{0.0F, 0.0F, 1.0F});
    if (!paint.strands)
        return paint.gloss * std::pow(std::max(glm::dot(normal, half), 0.0F), paint.sharpness);
    const float along =
        glm::dot(paint.strand, half);  // Kajiya and Kay: a hair shines across itself
    return paint.gloss *
           std::pow(std::sqrt(std::max(1.0F - along * along, 0.0F)), paint.sharpness) *
           smooth_step(-0.1F, 0.6F, glm::dot(normal, to_light));
}

}  // namespace

LightMap::LightMap(const Relief& relief) : columns_{relief.columns / 2}, rows_{relief.rows / 2} {
    heights_.resize(static_cast<std::size_t>(columns_ * rows_));
    for (int y = 0; y < rows_; ++y)
        for (int x = 0; x < columns_; ++x)
            heights_[static_cast<std::size_t>(y * columns_ + x)] =
                relief.level[relief.at(2 * x, 2 * y)];

    key_.resize(heights_.size());
    for (int y = 0; y < rows_; ++y)
        for (int x = 0; x < columns_; ++x)
            key_[static_cast<std::size_t>(y * columns_ + x)] =
                key_reach(heights_, columns_, rows_, x, y);
    key_ = softened(key_, heights_, columns_, rows_);

    sky_.assign(heights_.size(), 1.0F);
    struct Ring {
        int radius;
        float weight;
    };
    for (const Ring ring : {Ring{1, 0.50F}, Ring{3, 0.55F}, Ring{9, 0.42F}, Ring{22, 0.30F}}) {
        const Grid mean = blurred(heights_, columns_, rows_, ring.radius, 3);
        const float reach = 2.5F * static_cast<float>(ring.radius) + 1.5F;
        for (std::size_t i = 0; i < sky_.size(); ++i) {
            const float sunk = std::max((mean[i] - heights_[i]) / reach, 0.0F);
            sky_[i] /= 1.0F + ring.weight * 3.2F * sunk / (1.0F + sunk);
        }
    }
    for (float& sky : sky_) sky = std::max(sky, kLeastSky);
}

Reach LightMap::at(float column, float row, float level) const noexcept {
    const float x = std::clamp(0.5F * column, 0.0F, static_cast<float>(columns_) - 1.001F);
    const float y = std::clamp(0.5F * row, 0.0F, static_cast<float>(rows_) - 1.001F);
    const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
    const float u = x - static_cast<float>(x0), v = y - static_cast<float>(y0);
    Reach sum;
    float total = 0.0F;
    for (int dy = 0; dy < 2; ++dy)
        for (int dx = 0; dx < 2; ++dx) {
            const auto i = static_cast<std::size_t>((y0 + dy) * columns_ + x0 + dx);
            const float near = (dx == 1 ? u : 1.0F - u) * (dy == 1 ? v : 1.0F - v);
            const float weight = (near + 0.001F) * alike(level, heights_[i]);
            sum.key += weight * key_[i];
            sum.sky += weight * sky_[i];
            total += weight;
        }
    return {sum.key / total, sum.sky / total};
}

Vec3 shade(const Paint& paint, Vec3 normal, Reach reach) noexcept {
    const float facing = glm::dot(normal, kToKey);
    const Vec3 lit = glm::clamp((Vec3{facing} + paint.wrap) / (1.0F + paint.wrap), 0.0F, 1.0F);
    // Light that enters the skin leaves redder: shadows' edges are warm.
    const Vec3 shadow =
        reach.key * (1.0F - paint.wrap * 0.5F) + paint.wrap * 0.5F * std::sqrt(reach.key);
    const float up = 0.5F + 0.5F * normal.y;
    Vec3 light = kKeyColour * lit * shadow;
    light += kSkyColour * (0.45F + 0.55F * up) * reach.sky;
    light += kFrontColour * std::max(normal.z, 0.0F) * reach.sky;
    const float rim = std::pow(1.0F - std::clamp(normal.z, 0.0F, 1.0F), 3.0F) *
                      smooth_step(-0.5F, 0.8F, normal.x);
    const Vec3 sheen =
        (kRimColour * rim +
         Vec3{paint.sheen} * std::pow(1.0F - std::clamp(normal.z, 0.0F, 1.0F), 2.0F)) *
        reach.sky;
    const Vec3 shine = kKeyColour * paint.shine * highlight(paint, normal, kToKey) * reach.key;
    return paint.albedo * (light + sheen) + shine + Vec3{paint.glint};
}

Vec3 developed(Vec3 linear) noexcept {
    const Vec3 x = glm::max(linear, 0.0F) * 0.50F;
    const Vec3 film = (x * (2.51F * x + 0.03F)) / (x * (2.43F * x + 0.59F) + 0.14F);
    return power(glm::clamp(film, 0.0F, 1.0F), 1.0F / 2.2F);
}

}  // namespace dibhr::sample
