// From a motion to goals.
#include "core/experiment/hand_motion.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/error.hpp"

namespace dibhr {

namespace {

constexpr double kUpdate_s = 1e-3;
constexpr double kRoundOff = 1e-9;

constexpr int kMoments = 10;
constexpr double kThreshold = 0.25;
constexpr double kInside = 0.9;

/// Marks, row-major, what is in front at one moment.
std::vector<char> foreground_of(const DepthSurface& surface) {
    std::vector<double> elevations;
    for (int j = 0; j < surface.rows(); ++j) {
        for (int i = 0; i < surface.columns(); ++i) elevations.push_back(surface.elevation(i, j));
    }
    const auto [lowest, highest] = std::minmax_element(elevations.begin(), elevations.end());
    const double threshold = *lowest + kThreshold * (*highest - *lowest);
    std::vector<char> mask(elevations.size());
    std::transform(elevations.begin(), elevations.end(), mask.begin(),
                   [threshold](double z) { return static_cast<char>(z > threshold ? 1 : 0); });
    return mask;
}

struct Rectangle {
    int left{0}, top{0}, width{0}, height{0};
    [[nodiscard]] long area() const { return static_cast<long>(width) * height; }
};

/// The largest rectangle that stands on `row`, of columns `heights` high there.
Rectangle largest_on_row(const std::vector<int>& heights, int row) {
    Rectangle best;
    std::vector<std::size_t> rising;  // columns whose rectangles are still growing
    for (std::size_t i = 0; i <= heights.size(); ++i) {
        const int height = i < heights.size() ? heights[i] : 0;
        while (!rising.empty() && heights[rising.back()] >= height) {
            const int top = heights[rising.back()];
            rising.pop_back();
            const std::size_t left = rising.empty() ? 0 : rising.back() + 1;
            const Rectangle found{static_cast<int>(left), row - top + 1, static_cast<int>(i - left),
                                  top};
            if (found.area() > best.area()) best = found;
        }
        rising.push_back(i);
    }
    return best;
}

Rectangle largest_rectangle(const std::vector<char>& mask, int columns, int rows) {
    Rectangle best;
    std::vector<int> heights(static_cast<std::size_t>(columns), 0);
    for (int j = 0; j < rows; ++j) {
        const std::size_t row = static_cast<std::size_t>(j) * heights.size();
        for (std::size_t i = 0; i < heights.size(); ++i) {
            heights[i] = mask[row + i] != 0 ? heights[i] + 1 : 0;
        }
        const Rectangle found = largest_on_row(heights, j);
        if (found.area() > best.area()) best = found;
    }
    return best;
}

}  // namespace

void fit_into(HandMotion& motion, const ImageArea& area) {
    Vec2 low = motion.places.at(0);
    Vec2 high = low;
    for (const Vec2& place : motion.places) {
        low = {std::min(low.x, place.x), std::min(low.y, place.y)};
        high = {std::max(high.x, place.x), std::max(high.y, place.y)};
    }
    const Vec2 half = 0.5 * (high - low);
    // Round-off of a place that stays is no motion: it is not to be magnified.
    const double furthest = std::max(std::max(std::abs(low.x), std::abs(low.y)),
                                     std::max(std::abs(high.x), std::abs(high.y)));
    const double least = kRoundOff * furthest;
    const double fits_x = half.x > least ? area.half_size.x / half.x : INFINITY;
    const double fits_y = half.y > least ? area.half_size.y / half.y : INFINITY;
    const double scale = std::min(fits_x, fits_y);
    if (!std::isfinite(scale) || scale <= 0.0) {
        throw InputError("the hand does not move; record it again while it moves");
    }
    const Vec2 centre = low + half;
    for (Vec2& place : motion.places) place = area.centre + scale * (place - centre);
}

PathRun human_path(const HandMotion& motion, const DepthClip& clip, double mu) {
    PathRun path;
    path.name = "human";
    path.source = motion.source;
    path.mu = mu;
    for (std::size_t k = 0; k < motion.places.size(); ++k) {
        const Vec2& place = motion.places[k];
        const double z = clip.at(kUpdate_s * static_cast<double>(k)).elevation_at(place.x, place.y);
        path.goals.emplace_back(place.x, place.y, z - motion.penetrations_px[k]);
    }
    survey_path(path, clip);
    return path;
}

ImageArea foreground_area(const DepthClip& clip) {
    std::vector<char> always;
    for (int k = 0; k < kMoments; ++k) {
        const auto mask = foreground_of(clip.at(clip.duration_s() * k / kMoments));
        if (always.empty()) always = mask;
        std::transform(always.begin(), always.end(), mask.begin(), always.begin(),
                       [](char a, char b) { return static_cast<char>(a & b); });
    }
    const Rectangle found = largest_rectangle(always, clip.columns(), clip.rows());
    const Vec2 whole{0.5 * (clip.columns() - 1), 0.5 * (clip.rows() - 1)};
    if (found.width < 2 || found.height < 2) return {whole, whole};
    const Vec2 half{0.5 * (found.width - 1), 0.5 * (found.height - 1)};
    return {Vec2(found.left, found.top) + half, kInside * half};
}

}  // namespace dibhr
