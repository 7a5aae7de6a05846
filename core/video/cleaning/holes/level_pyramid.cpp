// Means of the farther levels of squares, and interpolation from their centres back to pixels.
#include "core/video/cleaning/holes/level_pyramid.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

#include "core/video/cleaning/patches.hpp"
#include "core/video/frames/vector_clones.hpp"

namespace dibhr {

namespace {

constexpr int kSquare_px = LevelPyramid::kSquare_px;
constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
constexpr float kAbove = std::numeric_limits<float>::infinity();

/// The mean of the lowest level in a rectangle and of those on one surface with it. NaN: no data.
float mean_behind(const DepthImage& image, int left, int right, int top, int bottom) {
    float lowest = kAbove;
    for (int j = top; j < bottom; ++j)
        for (int i = left; i < right; ++i)
            if (const float level = image.at(i, j); level < lowest) lowest = level;
    if (!(lowest < kAbove)) return kNone;
    const float most = lowest + outline_levels(image);
    float sum = 0.0F;
    float count = 0.0F;
    float highest = lowest;
    for (int j = top; j < bottom; ++j)
        for (int i = left; i < right; ++i)
            if (const float level = image.at(i, j); level <= most) {
                sum += level;
                count += 1.0F;
                highest = std::max(highest, level);
            }
    return std::clamp(sum / count, lowest, highest);  // against rounding
}

constexpr std::size_t kTogether = 64;  ///< squares that are computed together
/// Levels by pixel of a square, then by square: the first pixels of all squares, the second ones.
using Pixels = std::array<std::array<float, kTogether>, std::size_t{kSquare_px} * kSquare_px>;

DIBHR_VECTOR_CLONES void deinterleave(const float* row, float* __restrict first,
                                      float* __restrict second, float* __restrict third,
                                      float* __restrict fourth, std::size_t squares) {
    static_assert(kSquare_px == 4);
    for (std::size_t x = 0; x < squares; ++x) {
        first[x] = row[4 * x];
        second[x] = row[4 * x + 1];
        third[x] = row[4 * x + 2];
        fourth[x] = row[4 * x + 3];
    }
}

/// mean_behind of kTogether squares.
DIBHR_VECTOR_CLONES void means_behind(const Pixels& pixels, float outline,
                                      float* __restrict means) {
    std::array<float, kTogether> lowest{};
    std::array<float, kTogether> highest{};
    std::array<float, kTogether> sum{};
    std::array<float, kTogether> count{};
    lowest.fill(kAbove);
    for (const auto& levels : pixels)
        for (std::size_t x = 0; x < kTogether; ++x)
            lowest[x] = levels[x] < lowest[x] ? levels[x] : lowest[x];
    highest = lowest;
    for (const auto& levels : pixels)
        for (std::size_t x = 0; x < kTogether; ++x) {
            const float level = levels[x];
            const bool behind = level <= lowest[x] + outline;
            const float higher = highest[x] < level ? level : highest[x];
            sum[x] += behind ? level : 0.0F;
            count[x] += behind ? 1.0F : 0.0F;
            highest[x] = behind ? higher : highest[x];
        }
    for (std::size_t x = 0; x < kTogether; ++x) {
        const float mean = sum[x] / count[x];
        const float not_below = mean < lowest[x] ? lowest[x] : mean;
        const float clamped = highest[x] < not_below ? highest[x] : not_below;
        means[x] = lowest[x] < kAbove ? clamped : kNone;
    }
}

/// mean_behind of `squares` side by side, from the upper left pixel `corner` on.
void means_behind(const float* corner, std::ptrdiff_t columns, float outline, float* means,
                  std::size_t squares) {
    Pixels pixels{};
    std::array<float, kTogether> together{};
    for (std::size_t x = 0; x < squares; x += kTogether) {
        const std::size_t count = std::min(kTogether, squares - x);
        for (std::size_t j = 0; j < kSquare_px; ++j)
            deinterleave(corner + static_cast<std::ptrdiff_t>(j) * columns + kSquare_px * x,
                         pixels[4 * j].data(), pixels[4 * j + 1].data(), pixels[4 * j + 2].data(),
                         pixels[4 * j + 3].data(), count);
        means_behind(pixels, outline, together.data());
        std::copy_n(together.data(), count, means + x);
    }
}

/// One level for each square of `side` pixels: of the farther surface where there are two.
DepthImage thinned(const DepthImage& fine, int side) {
    DepthImage coarse{
        (fine.columns + side - 1) / side, (fine.rows + side - 1) / side, fine.highest_level, {}};
    coarse.levels.reserve(static_cast<std::size_t>(coarse.columns) *
                          static_cast<std::size_t>(coarse.rows));
    const float outline = outline_levels(fine);
    for (int y = 0; y < fine.rows; y += side) {
        int x = 0;
        if (side == kSquare_px && y + side <= fine.rows) {
            const auto whole = static_cast<std::size_t>(fine.columns / side);
            const std::size_t at = coarse.levels.size();
            coarse.levels.resize(at + whole);
            means_behind(fine.levels.data() + fine.index(0, y), fine.columns, outline,
                         coarse.levels.data() + at, whole);
            x = static_cast<int>(whole) * side;
        }
        for (; x < fine.columns; x += side)
            coarse.levels.push_back(mean_behind(fine, x, std::min(x + side, fine.columns), y,
                                                std::min(y + side, fine.rows)));
    }
    return coarse;
}

/// Where a pixel's centre lies between the centres of two of `count` squares in a row; beyond the
/// outermost centres it is at these.
struct Place {
    Place(int pixel, int side, int count) {
        const float at = (static_cast<float>(pixel) + 0.5F) / static_cast<float>(side) - 0.5F;
        const float held = std::clamp(at, 0.0F, static_cast<float>(count - 1));
        first = static_cast<int>(held);
        second = std::min(first + 1, count - 1);
        share = held - static_cast<float>(first);
    }
    int first{0};
    int second{0};
    float share{0.0F};
};

/// Interpolates values of the grid's squares between two rows.
void mix_rows(const DepthImage& grid, const std::vector<float>& values, const Place& y,
              std::vector<float>& mixed) {
    mixed.resize(static_cast<std::size_t>(grid.columns));
    const float* above = values.data() + grid.index(0, y.first);
    const float* below = values.data() + grid.index(0, y.second);
    for (std::size_t i = 0; i < mixed.size(); ++i)
        mixed[i] = above[i] + y.share * (below[i] - above[i]);
}

float between(const std::vector<float>& row, const Place& x) {
    const float before = row[static_cast<std::size_t>(x.first)];
    return before + x.share * (row[static_cast<std::size_t>(x.second)] - before);
}

/// Squares without data take the interpolated level of the coarser squares.
void fill_from(const DepthImage& coarse, DepthImage& fine) {
    std::vector<float> row;
    for (int j = 0; j < fine.rows; ++j) {
        mix_rows(coarse, coarse.levels, Place(j, 2, coarse.rows), row);
        for (int i = 0; i < fine.columns; ++i)
            if (float& level = fine.at(i, j); !is_data(level))
                level = between(row, Place(i, 2, coarse.columns));
    }
}

/// Interpolates between the centres of squares, from the middle of the first one on.
DIBHR_VECTOR_CLONES void spread(const float* squares, float* __restrict out, std::size_t count) {
    for (std::size_t x = 0; x + 1 < count; ++x) {
        const float from = squares[x];
        const float rise = squares[x + 1] - from;
        for (std::size_t k = 0; k < kSquare_px; ++k)
            out[x * kSquare_px + k] = from + (0.25F * static_cast<float>(k) + 0.125F) * rise;
    }
}

/// Interpolates at each pixel of a row, as Place does.
void spread_row(const std::vector<float>& squares, std::vector<float>& pixels) {
    constexpr std::size_t kHalf = kSquare_px / 2;
    pixels.resize(squares.size() * kSquare_px);
    std::fill_n(pixels.begin(), kHalf, squares.front());
    spread(squares.data(), pixels.data() + kHalf, squares.size());
    std::fill_n(pixels.end() - kHalf, kHalf, squares.back());
}

}  // namespace

bool LevelPyramid::build(const DepthImage& image) {
    images_.clear();
    images_.push_back(thinned(image, kSquare_px));
    while (images_.back().levels.size() > 1) images_.push_back(thinned(images_.back(), 2));
    return is_data(images_.back().levels.front());
}

void LevelPyramid::fill() {
    for (std::size_t k = images_.size() - 1; k > 0; --k) fill_from(images_[k], images_[k - 1]);
}

void LevelPyramid::spread(const std::vector<float>& values, int row, std::vector<float>& pixels) {
    mix_rows(squares(), values, Place(row, kSquare_px, squares().rows), square_row_);
    spread_row(square_row_, pixels);
}

}  // namespace dibhr
