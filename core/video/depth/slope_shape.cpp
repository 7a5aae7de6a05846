// Takes slopes along rows, columns and both diagonals of smoothed levels.
#include "core/video/depth/slope_shape.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <utility>

namespace dibhr {

namespace {

constexpr int kSlopesPerSide = 16;    ///< lengths of slopes in the shorter side
constexpr double kLeastRise = 0.016;  ///< of the levels' span, from a to d
constexpr double kMostUneven = 2.0;   ///< ratio of a slope's steepest quarter to its flattest
constexpr double kAlike = 0.3;        ///< of the bend that distances would have
constexpr double kOutermost = 0.01;
constexpr std::size_t kMostSlopes = 40000;  ///< of one picture

struct Lattice {
    int columns, rows;
    std::vector<float> of{};

    [[nodiscard]] float at(int i, int j) const {
        return of[static_cast<std::size_t>(j) * static_cast<std::size_t>(columns) +
                  static_cast<std::size_t>(i)];
    }
};

/// Means of 3 x 3 pixels; NaN where one of them has no data, and at the border.
Lattice smoothed(const Lattice& levels) {
    constexpr float kUnseen = std::numeric_limits<float>::quiet_NaN();
    Lattice means{levels.columns, levels.rows, std::vector<float>(levels.of.size(), kUnseen)};
    for (int j = 1; j + 1 < levels.rows; ++j)
        for (int i = 1; i + 1 < levels.columns; ++i) {
            float sum = 0.0F;
            for (int y = -1; y <= 1; ++y)
                for (int x = -1; x <= 1; ++x) sum += levels.at(i + x, j + y);
            means.of[static_cast<std::size_t>(j) * static_cast<std::size_t>(levels.columns) +
                     static_cast<std::size_t>(i)] = sum / 9.0F;
        }
    return means;
}

/// From the lowest to the highest level, without the outermost hundredths.
float span_of(const std::vector<float>& levels) {
    std::vector<float> all;
    std::copy_if(levels.begin(), levels.end(), std::back_inserter(all),
                 [](float level) { return std::isfinite(level); });
    if (all.size() < 2) return 0.0F;
    const auto cut = static_cast<std::ptrdiff_t>(kOutermost * static_cast<double>(all.size() - 1));
    std::nth_element(all.begin(), all.begin() + cut, all.end());
    const float lowest = all[static_cast<std::size_t>(cut)];
    std::nth_element(all.begin(), all.end() - 1 - cut, all.end());
    return *(all.end() - 1 - cut) - lowest;
}

/// Five levels in a row over one smooth surface that rises or falls by enough.
bool is_slope(const std::array<float, 5>& levels, float least_rise) {
    float flattest = std::numeric_limits<float>::infinity();
    float steepest = 0.0F;
    const float sign = levels[4] > levels[0] ? 1.0F : -1.0F;
    for (std::size_t k = 0; k < 4; ++k) {
        const float rise = sign * (levels[k + 1] - levels[k]);
        if (!(rise > 0.0F)) return false;  // also of NaN
        flattest = std::min(flattest, rise);
        steepest = std::max(steepest, rise);
    }
    return steepest < static_cast<float>(kMostUneven) * flattest &&
           sign * (levels[4] - levels[0]) > least_rise;
}

}  // namespace

void SlopeMeter::add(int columns, int rows, const std::vector<float>& levels) {
    const Lattice means = smoothed({columns, rows, levels});
    const float least_rise = static_cast<float>(kLeastRise) * span_of(means.of);
    const int quarter = std::max(2, std::min(columns, rows) / (2 * kSlopesPerSide));
    const int reach = 2 * quarter;
    std::vector<Slope> found;
    for (const auto& [x, y] : {std::pair{1, 0}, {0, 1}, {1, 1}, {1, -1}})
        for (int j = reach; j + reach < rows; ++j)
            for (int i = reach; i + reach < columns; ++i) {
                std::array<float, 5> row{};
                for (int k = 0; k < 5; ++k)
                    row[static_cast<std::size_t>(k)] =
                        means.at(i + (k - 2) * quarter * x, j + (k - 2) * quarter * y);
                if (!is_slope(row, least_rise)) continue;
                const float sum = std::fabs(row[0] + row[4]);
                const float rise = std::fabs(row[4] - row[0]);
                if (sum > 0.0F)
                    found.push_back(
                        {row[0] + row[4] - 2.0F * row[2], rise * rise / sum, rise / sum});
            }
    const std::size_t step = 1 + found.size() / kMostSlopes;
    for (std::size_t k = 0; k < found.size(); k += step) slopes_.push_back(found[k]);
}

SlopeShape SlopeMeter::shape() const {
    SlopeShape shape;
    shape.slopes = slopes_.size();
    if (slopes_.empty()) return shape;
    double convex = 0.0;
    double all = 0.0;
    for (const Slope& slope : slopes_) {
        const double weight = static_cast<double>(slope.of_distance);
        const double bend = static_cast<double>(slope.bend);
        convex += bend > 0.0 ? 1.0 : 0.0;
        all += weight;
        if (std::fabs(bend) < kAlike * weight) shape.straight += weight;
        if (std::fabs(bend - weight) < kAlike * weight) shape.proportional += weight;
    }
    shape.convex = convex / static_cast<double>(slopes_.size());
    shape.straight /= all;
    shape.proportional /= all;
    std::vector<float> perspectives;
    for (const Slope& slope : slopes_) perspectives.push_back(slope.perspective);
    const auto middle = perspectives.begin() + static_cast<std::ptrdiff_t>(perspectives.size() / 2);
    std::nth_element(perspectives.begin(), middle, perspectives.end());
    shape.perspective = static_cast<double>(*middle);
    return shape;
}

}  // namespace dibhr
