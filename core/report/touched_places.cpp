// Where a video was touched, and for how long.
#include "core/report/touched_places.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace dibhr {

namespace {

constexpr double kMostPixels = 65536.0;  // along a side; larger images are not read

int column_of(std::uint64_t pixel) {
    return static_cast<int>(pixel & 0xffffU);
}

int row_of(std::uint64_t pixel) {
    return static_cast<int>(pixel >> 16U);
}

/// Weights that sum to one, the middle first.
std::vector<float> gaussian(double sigma_px) {
    constexpr double kReach = 3.0;
    const int reach = std::max(0, static_cast<int>(std::ceil(kReach * sigma_px)));
    std::vector<double> weights;
    double sum = 0.0;
    for (int k = 0; k <= reach; ++k) {
        weights.push_back(reach == 0 ? 1.0 : std::exp(-0.5 * k * k / (sigma_px * sigma_px)));
        sum += (k == 0 ? 1.0 : 2.0) * weights.back();
    }
    std::vector<float> shares;
    for (const double weight : weights) shares.push_back(static_cast<float>(weight / sum));
    return shares;
}

/// Spreads every value along a line of `count` values that are `step` apart.
void spread_line(float* line, int count, std::size_t step, const std::vector<float>& weights,
                 std::vector<float>& spread) {
    const int reach = static_cast<int>(weights.size()) - 1;
    spread.assign(static_cast<std::size_t>(count), 0.0F);
    for (int k = 0; k < count; ++k) {
        const float value = line[static_cast<std::size_t>(k) * step];
        if (value == 0.0F) continue;
        const int last = std::min(count - 1, k + reach);
        for (int to = std::max(0, k - reach); to <= last; ++to) {
            spread[static_cast<std::size_t>(to)] +=
                value * weights[static_cast<std::size_t>(std::abs(to - k))];
        }
    }
    for (int k = 0; k < count; ++k) {
        line[static_cast<std::size_t>(k) * step] = spread[static_cast<std::size_t>(k)];
    }
}

}  // namespace

void TouchedPlaces::add(Vec2 place_px, double media_s, double seconds) {
    total_s_ += seconds;
    frame_s_[media_s] += seconds;
    const double column = std::round(place_px.x);
    const double row = std::round(place_px.y);
    if (!(column >= 0.0 && row >= 0.0 && column < kMostPixels && row < kMostPixels)) return;
    pixel_s_[static_cast<std::uint64_t>(row) << 16U | static_cast<std::uint64_t>(column)] +=
        seconds;
}

double TouchedPlaces::longest_frame_s() const {
    const auto longest =
        std::max_element(frame_s_.begin(), frame_s_.end(),
                         [](const auto& a, const auto& b) { return a.second < b.second; });
    return longest == frame_s_.end() ? 0.0 : longest->first;
}

PixelBounds TouchedPlaces::bounds() const {
    if (pixel_s_.empty()) return {};
    constexpr int kFar = static_cast<int>(kMostPixels);
    PixelBounds bounds{kFar, kFar, 0, 0};
    for (const auto& [pixel, seconds] : pixel_s_) {
        bounds.left = std::min(bounds.left, column_of(pixel));
        bounds.top = std::min(bounds.top, row_of(pixel));
        bounds.right = std::max(bounds.right, column_of(pixel) + 1);
        bounds.bottom = std::max(bounds.bottom, row_of(pixel) + 1);
    }
    return bounds;
}

bool TouchedPlaces::touches(int columns, int rows) const {
    return std::any_of(pixel_s_.begin(), pixel_s_.end(), [&](const auto& touched) {
        return column_of(touched.first) < columns && row_of(touched.first) < rows;
    });
}

PixelValues TouchedPlaces::smoothed(int columns, int rows, double sigma_px) const {
    PixelValues map{columns, rows, {}};
    const auto width = static_cast<std::size_t>(columns);
    map.values.resize(width * static_cast<std::size_t>(rows), 0.0F);
    for (const auto& [pixel, seconds] : pixel_s_) {
        if (column_of(pixel) >= columns || row_of(pixel) >= rows) continue;
        map.values[static_cast<std::size_t>(row_of(pixel)) * width +
                   static_cast<std::size_t>(column_of(pixel))] += static_cast<float>(seconds);
    }
    const std::vector<float> weights = gaussian(sigma_px);
    std::vector<float> line;
    for (int row = 0; row < rows; ++row) {
        spread_line(&map.values[static_cast<std::size_t>(row) * width], columns, 1, weights, line);
    }
    for (int column = 0; column < columns; ++column) {
        spread_line(&map.values[static_cast<std::size_t>(column)], rows, width, weights, line);
    }
    return map;
}

}  // namespace dibhr
