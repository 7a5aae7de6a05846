// Looks at each pixel and those around it.
#include "tests/bench/blemishes.hpp"

#include <cmath>

namespace dibhr::bench {

namespace {

constexpr double kFullRelief_px = 255.0;
constexpr float kOutlineStep_px = static_cast<float>(0.05 * kFullRelief_px);
constexpr float kPimple_px = 0.5F;  ///< of a pimple
constexpr float kFlatSlope = 0.8F;
constexpr int kFitReach_px = 4;  ///< of the plane that fits, to each side

DepthImage in_pixels(const DepthImage& image) {
    DepthImage scaled = image;
    const auto px = static_cast<float>(kFullRelief_px / image.highest_level);
    for (float& level : scaled.levels) level *= px;
    return scaled;
}

/// Whether two pixels are on one other side of a step than the one between them.
bool are_across(float one, float between, float other) {
    const bool is_seen = one > 0.0F && between > 0.0F && other > 0.0F;
    return is_seen && ((one - between > kOutlineStep_px && other - between > kOutlineStep_px) ||
                       (between - one > kOutlineStep_px && between - other > kOutlineStep_px));
}

bool are_of_one_side(float one, float other) {
    return std::fabs(one - other) <= kOutlineStep_px;
}

bool is_tooth(const DepthImage& image, int i, int j) {
    const float here = image.at(i, j);
    const float left = image.at(i - 1, j);
    const float right = image.at(i + 1, j);
    const float above = image.at(i, j - 1);
    const float below = image.at(i, j + 1);
    // It hangs together with one side only: a line one pixel wide is none.
    return (are_across(above, here, below) &&
            are_of_one_side(here, left) != are_of_one_side(here, right)) ||
           (are_across(left, here, right) &&
            are_of_one_side(here, above) != are_of_one_side(here, below));
}

/// The plane that fits the pixels around one best.
struct Plane {
    float middle_px{0.0F}, right{0.0F}, down{0.0F};
};

template <typename Visit>
void each_around(Visit&& visit) {
    for (int down = -kFitReach_px; down <= kFitReach_px; ++down)
        for (int right = -kFitReach_px; right <= kFitReach_px; ++right) visit(right, down);
}

Plane plane_around(const DepthImage& image, int i, int j) {
    constexpr int kSide = 2 * kFitReach_px + 1;
    constexpr auto kSquares =  // of the way to the right, over all pixels
        static_cast<float>(kSide * kFitReach_px * (kFitReach_px + 1) * kSide / 3);
    Plane plane;
    each_around([&](int right, int down) {
        const float level = image.at(i + right, j + down);
        plane.middle_px += level;
        plane.right += level * static_cast<float>(right);
        plane.down += level * static_cast<float>(down);
    });
    plane.middle_px /= static_cast<float>(kSide * kSide);
    plane.right /= kSquares;
    plane.down /= kSquares;
    return plane;
}

bool is_flat_ground(const DepthImage& image, int i, int j, const Plane& plane) {
    if (!(std::hypot(plane.right, plane.down) <= kFlatSlope)) return false;
    int all = 0;
    int near = 0;
    each_around([&](int right, int down) {
        const float level = image.at(i + right, j + down);
        const float on_plane = plane.middle_px + plane.right * static_cast<float>(right) +
                               plane.down * static_cast<float>(down);
        ++all;
        near += level > 0.0F && std::fabs(level - on_plane) <= kPimple_px ? 1 : 0;
    });
    return 4 * near >= 3 * all;
}

/// 1: above the pixels around it and the plane, -1: below them, 0: neither.
int pimple_side(const DepthImage& image, int i, int j, const Plane& plane) {
    const float here = image.at(i, j);
    if (!(std::fabs(here - plane.middle_px) > kPimple_px)) return 0;
    const int side = here > plane.middle_px ? 1 : -1;
    for (int down = -1; down <= 1; ++down)
        for (int right = -1; right <= 1; ++right) {
            const float higher = static_cast<float>(side) * (here - image.at(i + right, j + down));
            // Of two alike the first one counts.
            const bool is_before = down < 0 || (down == 0 && right < 0);
            if (higher < 0.0F || (is_before && higher == 0.0F)) return 0;
        }
    return side;
}

bool has_pimple_near(const DepthImage& image, int i, int j, int side) {
    for (int y = j - 1; y <= j + 1; ++y)
        for (int x = i - 1; x <= i + 1; ++x) {
            const bool fits = x >= kFitReach_px && y >= kFitReach_px &&
                              x < image.columns - kFitReach_px && y < image.rows - kFitReach_px;
            if (fits && pimple_side(image, x, y, plane_around(image, x, y)) == side) return true;
        }
    return false;
}

double per(double factor, std::size_t part, std::size_t whole) {
    return whole > 0 ? factor * static_cast<double>(part) / static_cast<double>(whole) : 0.0;
}

}  // namespace

void BlemishMeter::add(const DepthImage& frame, const DepthImage& next) {
    const DepthImage now = in_pixels(frame);
    const DepthImage after = in_pixels(next);
    pixels_ += now.levels.size();
    for (int j = 1; j + 1 < now.rows; ++j)
        for (int i = 1; i + 1 < now.columns; ++i) teeth_ += is_tooth(now, i, j) ? 1 : 0;
    for (int j = kFitReach_px; j < now.rows - kFitReach_px; ++j)
        for (int i = kFitReach_px; i < now.columns - kFitReach_px; ++i) {
            ++ground_;
            const Plane plane = plane_around(now, i, j);
            if (!is_flat_ && !is_flat_ground(now, i, j, plane)) continue;
            ++flat_;
            const int side = pimple_side(now, i, j, plane);
            if (side == 0) continue;
            ++pimples_;
            again_ += has_pimple_near(after, i, j, side) ? 1 : 0;
        }
}

Blemishes BlemishMeter::blemishes() const {
    return {.teeth = per(1e5, teeth_, pixels_),
            .pimples = per(1e3, pimples_, flat_),
            .pimples_again = per(1e3, again_, flat_),
            .flat = per(1.0, flat_, ground_)};
}

}  // namespace dibhr::bench
