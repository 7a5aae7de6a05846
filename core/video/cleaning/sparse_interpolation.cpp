// Finds each pixel's nearest seen pixel along paths of one colour, then balances joined levels.
#include "core/video/cleaning/sparse_interpolation.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "core/video/cleaning/patches.hpp"
#include "core/video/frames/colour_image.hpp"
#include "core/video/frames/vector_clones.hpp"

namespace dibhr {

namespace {

constexpr double kReachOfSpacings = 3.0;
constexpr double kWidestReach = 1.0 / 16.0;  ///< of the width

// Costs of a step of a path: tenths of a pixel.
constexpr std::int32_t kStraightStep = 10;
constexpr std::int32_t kSlantingStep = 14;
constexpr std::int32_t kStepPerColour = 5;  ///< two shades of 255 are as far as a pixel
constexpr std::int32_t kNoPath = 1 << 29;

/// A rise that goes on as one surface is this many times the rise before it.
constexpr float kLeastNextRise = 0.5F;
constexpr float kMostNextRise = 2.0F;

// Rounds of balancing. Measured on planes: after these the median error is below 0.15 % of the
// range.
constexpr double kRoundsPerSpacing = 2.5;
constexpr double kRoundsAtLeast = 4.0;
constexpr double kLongestWave = 3.0;  ///< half of it, in spacings: what the weights are made for

constexpr std::uint8_t kJoined = 1;
constexpr std::uint8_t kTooFarApart = 2;

// Bits of a pixel's joins.
constexpr std::uint8_t kJoinsLeft = 1;
constexpr std::uint8_t kJoinsRight = 2;
constexpr std::uint8_t kJoinsAbove = 4;
constexpr std::uint8_t kJoinsBelow = 8;
constexpr std::uint8_t kFreeLevel = 16;  ///< not a seen pixel

constexpr int kMostResized_px = 1 << 15;  ///< OpenCV resizes pictures with shorter sides

/// Whether each of two rows' pixels are on one surface: 0 out of reach, kJoined or kTooFarApart.
DIBHR_VECTOR_CLONES void compare_levels(const float* one, const float* other,
                                        const std::uint8_t* one_in_reach,
                                        const std::uint8_t* other_in_reach, float outline,
                                        std::uint8_t* __restrict joined, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
        const int both = (one_in_reach[i] != 0 ? 1 : 0) & (other_in_reach[i] != 0 ? 1 : 0);
        const int found = std::fabs(other[i] - one[i]) <= outline ? kJoined : kTooFarApart;
        joined[i] = static_cast<std::uint8_t>(both * found);
    }
}

/// `right`, `left` and so on: 1 where the pixel is joined with that neighbour.
DIBHR_VECTOR_CLONES void combine_joins(const std::uint8_t* left, const std::uint8_t* right,
                                       const std::uint8_t* above, const std::uint8_t* below,
                                       const std::uint8_t* unseen, std::uint8_t* __restrict joins,
                                       std::size_t count) {
    for (std::size_t i = 0; i < count; ++i)
        joins[i] = static_cast<std::uint8_t>(left[i] * kJoinsLeft | right[i] * kJoinsRight |
                                             above[i] * kJoinsAbove | below[i] * kJoinsBelow |
                                             unseen[i] * kFreeLevel);
}

/// The next levels of a row, over those before: each free one towards the mean of its neighbours.
/// A neighbour that is not joined counts with the pixel's own level.
DIBHR_VECTOR_CLONES void balance_row(const float* level, const float* left, const float* right,
                                     const float* above, const float* below,
                                     const std::uint8_t* joins, float weight,
                                     float* __restrict before, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
        const int joined = joins[i];
        const float here = level[i];
        const float a = (joined & kJoinsLeft) != 0 ? left[i] : here;
        const float b = (joined & kJoinsRight) != 0 ? right[i] : here;
        const float c = (joined & kJoinsAbove) != 0 ? above[i] : here;
        const float d = (joined & kJoinsBelow) != 0 ? below[i] : here;
        const float mean = 0.25F * ((a + b) + (c + d));
        const float next = before[i] + weight * (mean - before[i]);
        before[i] = (joined & kFreeLevel) != 0 ? next : here;
    }
}

/// Unseen pixels in reach take their level.
DIBHR_VECTOR_CLONES void give_row(const float* filled, const std::uint8_t* unseen,
                                  const std::uint8_t* in_reach, float lowest, float highest,
                                  float* __restrict levels, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
        const float level = std::min(std::max(filled[i], lowest), highest);
        const int takes = (unseen[i] != 0 ? 1 : 0) & (in_reach[i] != 0 ? 1 : 0);
        levels[i] = takes != 0 ? level : levels[i];
    }
}

/// Whether a surface that rose by `rise` goes on with the rise `next`.
bool rises_on(float rise, float next) {
    const float ratio = next / rise;
    return ratio >= kLeastNextRise && ratio <= kMostNextRise;
}

/// Three channels of the size of the depth; empty: none that can be used.
cv::Mat fitted_colours(const ColourImage* colour, cv::Size size) {
    if (colour == nullptr || colour->rgb.empty()) return {};
    const cv::Mat recorded(colour->rows, colour->columns, CV_8UC3,
                           const_cast<std::uint8_t*>(colour->rgb.data()));  // only read
    if (recorded.size() == size) return recorded;
    if (std::max({recorded.cols, recorded.rows, size.width, size.height}) >= kMostResized_px)
        return {};
    cv::Mat fitted;
    cv::resize(recorded, fitted, size, 0.0, 0.0, cv::INTER_AREA);
    return fitted;
}

}  // namespace

void SparseInterpolator::fill(DepthImage& image, const ColourImage* colour) {
    rounds_ = 0;
    const std::size_t seen = take(image);
    if (seen == 0 || seen == image.levels.size()) return;
    const double spacing_px =
        std::sqrt(static_cast<double>(image.levels.size()) / static_cast<double>(seen));
    find_reach(image, std::min(kReachOfSpacings * spacing_px, kWidestReach * image.columns));
    find_colour_steps(colour);
    find_nearest();
    find_joins(outline_levels(image));
    balance(spacing_px);
    give(image);
}

/// Starts the planes of an image. Returns the number of its pixels with data.
std::size_t SparseInterpolator::take(const DepthImage& image) {
    columns_ = image.columns;
    rows_ = image.rows;
    stride_ = columns_ + 2;
    const auto size = static_cast<std::size_t>(stride_ * (rows_ + 2));
    path_cost_.assign(size, kNoPath);
    nearest_.assign(size, 0);
    levels_.assign(size, 0.0F);
    lowest_ = std::numeric_limits<float>::infinity();
    highest_ = -lowest_;
    std::size_t seen = 0;
    for (int j = 0; j < rows_; ++j) {
        const float* const row = image.levels.data() + image.index(0, j);
        for (int i = 0; i < columns_; ++i) {
            if (!is_data(row[i])) continue;
            const auto pixel = static_cast<std::size_t>(at(i, j));
            path_cost_[pixel] = 0;
            nearest_[pixel] = static_cast<std::int32_t>(pixel);
            levels_[pixel] = row[i];
            lowest_ = std::min(lowest_, row[i]);
            highest_ = std::max(highest_, row[i]);
            ++seen;
        }
    }
    return seen;
}

void SparseInterpolator::find_reach(const DepthImage& image, double reach_px) {
    unseen_.resize(image.levels.size());
    (void)mark_holes(image.levels.data(), unseen_.data(), image.levels.size());
    const cv::Mat1b unseen(rows_, columns_, unseen_.data());
    cv::Mat1f away_px;
    cv::distanceTransform(unseen, away_px, cv::DIST_L2, cv::DIST_MASK_5);
    in_reach_.assign(levels_.size(), 0);
    cv::Mat1b bordered(rows_ + 2, columns_ + 2, in_reach_.data());
    cv::Mat in_reach = bordered(cv::Rect(1, 1, columns_, rows_));
    cv::compare(away_px, reach_px, in_reach, cv::CMP_LE);
}

/// The largest difference of three channels, in four directions.
void SparseInterpolator::find_colour_steps(const ColourImage* colour) {
    for (std::vector<std::uint8_t>& steps : colour_steps_) steps.assign(levels_.size(), 0);
    const cv::Mat colours = fitted_colours(colour, {columns_, rows_});
    if (colours.empty()) return;
    std::array<cv::Mat, 3> channels{};
    cv::split(colours, channels.data());
    constexpr std::array<std::pair<int, int>, 4> kDirections{{{1, 0}, {0, 1}, {1, 1}, {-1, 1}}};
    cv::Mat difference;
    for (std::size_t k = 0; k < kDirections.size(); ++k) {
        const auto [right, down] = kDirections[k];
        const cv::Rect from(std::max(-right, 0), 0, columns_ - std::abs(right), rows_ - down);
        const cv::Rect to(from.x + right, down, from.width, from.height);
        cv::Mat1b bordered(rows_ + 2, columns_ + 2, colour_steps_[k].data());
        cv::Mat steps = bordered(cv::Rect(from.x + 1, 1, from.width, from.height));
        for (const cv::Mat& channel : channels) {
            cv::absdiff(channel(from), channel(to), difference);
            cv::max(steps, difference, steps);
        }
    }
}

/// The shortest paths to seen pixels, in two passes over the image (as G. Borgefors, Distance
/// transformations in digital images, CVGIP 34, 1986, with costs of P. Toivanen's kind).
void SparseInterpolator::find_nearest() {
    const std::uint8_t* const right = colour_steps_[0].data();
    const std::uint8_t* const below = colour_steps_[1].data();
    const std::uint8_t* const below_right = colour_steps_[2].data();
    const std::uint8_t* const below_left = colour_steps_[3].data();
    std::int32_t* const cost = path_cost_.data();
    std::int32_t* const nearest = nearest_.data();
    const auto take_over = [&](std::ptrdiff_t pixel, std::ptrdiff_t from, std::int32_t step,
                               std::int32_t colours) {
        const std::int32_t along = cost[from] + step + kStepPerColour * colours;
        if (along >= cost[pixel]) return;
        cost[pixel] = along;
        nearest[pixel] = nearest[from];
    };
    for (int j = 0; j < rows_; ++j) {
        for (std::ptrdiff_t p = at(0, j); p <= at(columns_ - 1, j); ++p) {
            const std::ptrdiff_t up = p - stride_;
            take_over(p, up - 1, kSlantingStep, below_right[up - 1]);
            take_over(p, up, kStraightStep, below[up]);
            take_over(p, up + 1, kSlantingStep, below_left[up + 1]);
            take_over(p, p - 1, kStraightStep, right[p - 1]);
        }
    }
    for (int j = rows_ - 1; j >= 0; --j) {
        for (std::ptrdiff_t p = at(columns_ - 1, j); p >= at(0, j); --p) {
            const std::ptrdiff_t down = p + stride_;
            take_over(p, down + 1, kSlantingStep, below_right[p]);
            take_over(p, down, kStraightStep, below[p]);
            take_over(p, down - 1, kSlantingStep, below_left[p]);
            take_over(p, p + 1, kStraightStep, right[p]);
        }
    }
}

/// Gives each pixel the level of its nearest seen one, and joins neighbours on one surface.
void SparseInterpolator::find_joins(float outline) {
    const auto columns = static_cast<std::size_t>(columns_);
    for (int j = 0; j < rows_; ++j)
        for (std::ptrdiff_t p = at(0, j); p <= at(columns_ - 1, j); ++p)
            levels_[static_cast<std::size_t>(p)] =
                levels_[static_cast<std::size_t>(nearest_[static_cast<std::size_t>(p)])];
    right_.assign(levels_.size(), 0);
    below_.assign(levels_.size(), 0);
    for (int j = 0; j < rows_; ++j) {
        const std::ptrdiff_t row = at(0, j);
        const float* const levels = levels_.data() + row;
        const std::uint8_t* const in_reach = in_reach_.data() + row;
        compare_levels(levels, levels + 1, in_reach, in_reach + 1, outline, right_.data() + row,
                       columns);
        compare_levels(levels, levels + stride_, in_reach, in_reach + stride_, outline,
                       below_.data() + row, columns);
    }
    require_even_rises(right_, 1);
    require_even_rises(below_, stride_);
    joins_.assign(levels_.size(), 0);
    for (int j = 0; j < rows_; ++j) {
        const std::ptrdiff_t row = at(0, j);
        combine_joins(right_.data() + row - 1, right_.data() + row, below_.data() + row - stride_,
                      below_.data() + row,
                      unseen_.data() + static_cast<std::ptrdiff_t>(j) * columns_,
                      joins_.data() + row, columns);
    }
}

/// Of pixels whose levels differ by more than an outline, joins those on one steep surface.
void SparseInterpolator::require_even_rises(std::vector<std::uint8_t>& joined,
                                            std::ptrdiff_t step) const {
    const auto begin = joined.begin();
    for (auto pair = std::find(begin, joined.end(), kTooFarApart); pair != joined.end();
         pair = std::find(pair + 1, joined.end(), kTooFarApart)) {
        const auto pixel = static_cast<std::size_t>(pair - begin);
        const auto beside = static_cast<std::size_t>(pair - begin + step);
        *pair = rises_evenly(nearest_[pixel], nearest_[beside]) ? kJoined : 0;
    }
}

/// Whether the rise from one seen pixel to the other goes on beyond either of them, at the same
/// distance.
bool SparseInterpolator::rises_evenly(std::int32_t one, std::int32_t other) const {
    const std::ptrdiff_t right = other % stride_ - one % stride_;
    const std::ptrdiff_t down = other / stride_ - one / stride_;
    const auto level_of = [this](std::ptrdiff_t pixel) {
        return levels_[static_cast<std::size_t>(pixel)];
    };
    const auto level_beside = [&](std::int32_t pixel, std::ptrdiff_t sign) {
        const std::ptrdiff_t column = pixel % stride_ + sign * right;
        const std::ptrdiff_t row = pixel / stride_ + sign * down;
        return level_of(std::clamp<std::ptrdiff_t>(row, 1, rows_) * stride_ +
                        std::clamp<std::ptrdiff_t>(column, 1, columns_));
    };
    const float rise = level_of(other) - level_of(one);
    return rises_on(rise, level_beside(other, 1) - level_of(other)) ||
           rises_on(rise, level_of(one) - level_beside(one, -1));
}

/// Jacobi's method with Chebyshev's weights (G. Golub and R. Varga, Numerische Mathematik 3, 1961).
void SparseInterpolator::balance(double spacing_px) {
    const double radius = std::cos(std::numbers::pi / (kLongestWave * std::max(spacing_px, 1.0)));
    rounds_ = static_cast<int>(
        std::min(std::round(kRoundsPerSpacing * spacing_px + kRoundsAtLeast), 1.0 * kMostRounds));
    before_ = levels_;
    double weight = 1.0;
    for (int k = 0; k < rounds_; ++k) {
        if (k == 1) weight = 1.0 / (1.0 - 0.5 * radius * radius);
        if (k > 1) weight = 1.0 / (1.0 - 0.25 * radius * radius * weight);
        for (int j = 0; j < rows_; ++j) {
            const std::ptrdiff_t row = at(0, j);
            const float* const levels = levels_.data() + row;
            balance_row(levels, levels - 1, levels + 1, levels - stride_, levels + stride_,
                        joins_.data() + row, static_cast<float>(weight), before_.data() + row,
                        static_cast<std::size_t>(columns_));
        }
        std::swap(levels_, before_);
    }
}

void SparseInterpolator::give(DepthImage& image) const {
    for (int j = 0; j < rows_; ++j) {
        const std::size_t row = image.index(0, j);
        give_row(levels_.data() + at(0, j), unseen_.data() + row, in_reach_.data() + at(0, j),
                 lowest_, highest_, image.levels.data() + row, static_cast<std::size_t>(columns_));
    }
}

}  // namespace dibhr
