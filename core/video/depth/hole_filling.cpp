// What stands where a depth image has no data.
#include "core/video/depth/hole_filling.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>

namespace dibhr {

namespace {

/// Of the highest level: beyond the noise of any sensor, below the thickness of a hand.
constexpr float kOutline = 0.04F;
constexpr int kSmallInWidth = 20;  ///< a small hole is at most this part of the image's width
constexpr int kSlopeOver_px = 3;   ///< over which a rim's slope is taken
constexpr int kSquare_px = 4;      ///< of the finest grid

/// Nothing a fingertip rests on may fall away so near to data.
constexpr int kReach_px = 10;
/// Of the highest level: what lies so much lower than all around is felt as a pit (4 of 255 px).
constexpr float kPit = 0.015F;
constexpr float kReach_squares = 3.25F;  ///< no less between the centres of two squares
/// A disc whose radius is this part of the width finds room only where nothing is to be bridged.
constexpr double kOpenInWidth = 16.0;

constexpr float kToTheRim = 2.0F;  ///< squares: so far a wide hole goes beyond its discs

constexpr std::size_t kChunk = 64;  ///< pixels of a row that are looked at together
constexpr std::size_t kDiscRows = 2 * kReach_px + 1;
constexpr std::size_t kReaches = kReach_px + 1;
/// How far a disc's rows reach to both sides, from its middle one on.
constexpr std::array<int, kReaches> kReachOfRow{10, 9, 9, 9, 9, 8, 8, 7, 6, 4, 0};

constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
constexpr float kAbove = std::numeric_limits<float>::infinity();

/// The mean of the farther levels in a rectangle: of the lowest, and of those on one surface with
/// it. NaN: no data there.
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
    return std::clamp(sum / count, lowest, highest);  // rounding leads out of them
}

/// One level a square of `side` pixels, the farther where there are two.
DepthImage thinned(const DepthImage& fine, int side) {
    DepthImage coarse{
        (fine.columns + side - 1) / side, (fine.rows + side - 1) / side, fine.highest_level, {}};
    coarse.levels.reserve(static_cast<std::size_t>(coarse.columns) *
                          static_cast<std::size_t>(coarse.rows));
    for (int y = 0; y < fine.rows; y += side)
        for (int x = 0; x < fine.columns; x += side)
            coarse.levels.push_back(mean_behind(fine, x, std::min(x + side, fine.columns), y,
                                                std::min(y + side, fine.rows)));
    return coarse;
}

/// Where the centre of one of many pixels lies between the centres of two squares, of which `count`
/// are in a row; held at the border.
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

/// Values of the grid's squares, between two of its rows.
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

/// What has no data becomes as high as the coarser squares around.
void fill_from(const DepthImage& coarse, DepthImage& fine) {
    std::vector<float> row;
    for (int j = 0; j < fine.rows; ++j) {
        mix_rows(coarse, coarse.levels, Place(j, 2, coarse.rows), row);
        for (int i = 0; i < fine.columns; ++i)
            if (float& level = fine.at(i, j); !is_data(level))
                level = between(row, Place(i, 2, coarse.columns));
    }
}

/// Above 0 where discs of this radius find room that hold no data, and `more` around; between two
/// squares it can be interpolated.
void room_for_discs(const cv::Mat1f& to_data, float radius, float more, std::vector<float>& room) {
    // A square's distance to data is from centre to centre: half a square more than to its rim.
    cv::Mat1b no_centre;
    cv::compare(to_data, radius + 0.5, no_centre, cv::CMP_LE);
    room.assign(to_data.total(), -1.0F);
    if (cv::countNonZero(no_centre) == static_cast<int>(no_centre.total())) return;
    cv::Mat1f to_centre(to_data.rows, to_data.cols, room.data());
    cv::distanceTransform(no_centre, to_centre, cv::DIST_L2, cv::DIST_MASK_5);
    to_centre = radius + more - to_centre;
}

/// Everywhere in the row.
bool has_data(const DepthImage& image, int row) {
    const float* levels = image.levels.data() + image.index(0, row);
    return std::all_of(levels, levels + image.columns, is_data);
}

void lowest_of(const float* a, const float* b, const float* c, float* __restrict lowest,
               std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) lowest[i] = std::min(a[i], std::min(b[i], c[i]));
}

void lower(float* __restrict level, const float* other, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) level[i] = std::min(level[i], other[i]);
}

}  // namespace

float outline_levels(const DepthImage& image) noexcept {
    return kOutline * static_cast<float>(image.highest_level);
}

void SmallHoleFiller::fill(DepthImage& image) {
    keep_small(image);
    if (runs_.empty()) return;
    outline_ = outline_levels(image);
    look_up(image);
    estimate(image);
    std::size_t k = 0;
    for (const Run& run : runs_)
        for (int i = run.begin; i < run.end; ++i, ++k) image.at(i, run.row) = estimates_[k];
}

void SmallHoleFiller::keep_small(const DepthImage& image) {
    patches_.find_holes(image);
    runs_.clear();
    const int most = std::max(2, image.columns / kSmallInWidth);
    for (const Run& run : patches_.runs()) {
        const Patches::Patch& patch = patches_.patch(run.patch);
        if (patch.right - patch.left <= most && patch.bottom - patch.top <= most)
            runs_.push_back(run);
    }
}

/// What a pixel in this column sees against `step` (1: above it, -1: below it). Where the one
/// before is no data it is of the same patch, and what it saw is one pixel farther away.
void SmallHoleFiller::enter_column(const DepthImage& image, int column, int row, int step) {
    Side& side = in_column_[static_cast<std::size_t>(column)];
    const int rim = row - step;
    if (rim < 0 || rim >= image.rows) {
        side = {};
    } else if (const float level = image.at(column, rim); is_data(level)) {
        const int behind = rim - kSlopeOver_px * step;
        const bool known = behind >= 0 && behind < image.rows && is_data(image.at(column, behind));
        side = {level, known ? (level - image.at(column, behind)) / kSlopeOver_px : 0.0F, 1};
    } else if (side.away > 0) {
        ++side.away;
    }
}

void SmallHoleFiller::look_up(const DepthImage& image) {
    in_column_.assign(static_cast<std::size_t>(image.columns), {});
    above_.clear();
    for (const Run& run : runs_) {
        for (int i = run.begin; i < run.end; ++i) {
            enter_column(image, i, run.row, 1);
            above_.push_back(in_column_[static_cast<std::size_t>(i)]);
        }
    }
}

void SmallHoleFiller::estimate(const DepthImage& image) {
    const auto side_at = [&image](int rim, int row, int step) -> Side {
        if (rim < 0 || rim >= image.columns) return {};
        const float level = image.at(rim, row);
        const int behind = rim - kSlopeOver_px * step;
        const bool known = behind >= 0 && behind < image.columns && is_data(image.at(behind, row));
        return {level, known ? (level - image.at(behind, row)) / kSlopeOver_px : 0.0F, 1};
    };
    in_column_.assign(static_cast<std::size_t>(image.columns), {});
    estimates_.resize(above_.size());
    std::size_t k = above_.size();
    for (auto run = runs_.rbegin(); run != runs_.rend(); ++run) {
        Side left = side_at(run->begin - 1, run->row, 1);
        Side right = side_at(run->end, run->row, -1);
        for (int i = run->end - 1; i >= run->begin; --i) {
            enter_column(image, i, run->row, -1);
            --k;
            if (left.away > 0) left.away = i - run->begin + 1;
            if (right.away > 0) right.away = run->end - i;
            const Side& below = in_column_[static_cast<std::size_t>(i)];
            const Estimate all = behind(between(left, right), between(above_[k], below));
            estimates_[k] = all.weight > 0.0F ? all.level : kNone;
        }
    }
}

/// A surface goes on from one side to the other, level or as its slope says; else the farther side
/// is behind the nearer one.
SmallHoleFiller::Estimate SmallHoleFiller::between(const Side& one,
                                                   const Side& other) const noexcept {
    const auto alone = [](const Side& side) -> Estimate {
        return {side.level, side.away > 0 ? 1.0F / static_cast<float>(side.away) : 0.0F};
    };
    if (one.away == 0 || other.away == 0) return mean(alone(one), alone(other));
    const auto gap = static_cast<float>(one.away + other.away);
    const float rise = other.level - one.level;
    const bool goes_on = std::fabs(rise) <= outline_ ||
                         std::fabs(rise - one.slope * gap) <= outline_ ||
                         std::fabs(rise + other.slope * gap) <= outline_;
    if (goes_on) return mean(alone(one), alone(other));
    return alone(rise > 0.0F ? one : other);
}

SmallHoleFiller::Estimate SmallHoleFiller::mean(const Estimate& one,
                                                const Estimate& other) noexcept {
    if (!(one.weight > 0.0F)) return other;
    if (!(other.weight > 0.0F)) return one;
    const float weight = one.weight + other.weight;
    const float level = (one.level * one.weight + other.level * other.weight) / weight;
    const auto [lowest, highest] = std::minmax(one.level, other.level);
    return {std::clamp(level, lowest, highest), weight};  // rounding leads out of them
}

SmallHoleFiller::Estimate SmallHoleFiller::behind(const Estimate& one,
                                                  const Estimate& other) const noexcept {
    const bool apart =
        one.weight > 0.0F && other.weight > 0.0F && std::fabs(one.level - other.level) > outline_;
    if (!apart) return mean(one, other);
    return one.level < other.level ? one : other;
}

void LargeHoleFiller::fill(DepthImage& image, const DepthImage& seen,
                           std::span<const std::size_t> refused,
                           std::vector<std::uint8_t>& unseen) {
    if (std::all_of(seen.levels.begin(), seen.levels.end(), is_data)) return;
    grids_.clear();
    grids_.push_back(thinned(image, kSquare_px));
    while (grids_.back().levels.size() > 1) grids_.push_back(thinned(grids_.back(), 2));
    if (!is_data(grids_.back().levels.front())) {  // no data at all
        std::fill(image.levels.begin(), image.levels.end(), 0.0F);
        std::fill(unseen.begin(), unseen.end(), std::uint8_t{1});
        return;
    }
    find_wide_and_open(image.columns);
    for (std::size_t k = grids_.size() - 1; k > 0; --k) fill_from(grids_[k], grids_[k - 1]);
    widened_ = 0;
    for (int j = 0; j < image.rows; ++j) {
        if (has_data(seen, j)) continue;
        find_farthest(seen, j);
        fill_row(image, j, unseen);
        lift_row(image, seen, j);
    }
    lift_beside(image, seen, refused);
}

/// Where discs that hold no data find room, in squares and a little more, so that it can be told
/// between them: discs too wide for a small hole, and those too wide for anything to be bridged.
void LargeHoleFiller::find_wide_and_open(int columns) {
    const DepthImage& grid = grids_.front();
    cv::Mat1b empty(grid.rows, grid.columns);
    std::transform(grid.levels.begin(), grid.levels.end(), empty.begin(),
                   [](float level) { return is_data(level) ? 0 : 255; });
    cv::Mat1f to_data;
    cv::distanceTransform(empty, to_data, cv::DIST_L2, cv::DIST_MASK_5);
    const auto squares = [columns](double part) {
        return static_cast<float>(columns / part / kSquare_px);
    };
    room_for_discs(to_data, squares(2.0 * kSmallInWidth), kToTheRim, wide_);
    room_for_discs(to_data, squares(kOpenInWidth), 0.0F, open_);
    // Nor is open what a fingertip reaches from data.
    std::transform(to_data.begin(), to_data.end(), open_.begin(), open_.begin(),
                   [](float away, float room) { return std::min(away - kReach_squares, room); });
}

/// The lowest levels of the rows that row `row` needs: of each pixel's neighbours left and right,
/// within each distance that a row of the disc around it has.
void LargeHoleFiller::widen(const DepthImage& seen, int row) {
    const auto columns = static_cast<std::size_t>(seen.columns);
    spans_.resize(kDiscRows * kReaches * columns);
    padded_.assign(columns + 2 * std::size_t{kReach_px}, kAbove);
    widened_ = std::max(widened_, row - kReach_px);
    for (; widened_ < std::min(row + kReach_px + 1, seen.rows); ++widened_) {
        const float* levels = seen.levels.data() + seen.index(0, widened_);
        for (std::size_t i = 0; i < columns; ++i)
            padded_[kReach_px + i] = is_data(levels[i]) ? levels[i] : kAbove;
        const float* centre = padded_.data() + kReach_px;
        const float* inner = centre;
        for (int reach = 0; reach <= kReach_px; ++reach) {
            float* span = span_of(widened_, reach, columns);
            lowest_of(inner, centre - reach, centre + reach, span, columns);
            inner = span;
        }
    }
}

float* LargeHoleFiller::span_of(int row, int reach, std::size_t columns) {
    const auto line = static_cast<std::size_t>(row % static_cast<int>(kDiscRows)) * kReaches +
                      static_cast<std::size_t>(reach);
    return spans_.data() + line * columns;
}

void LargeHoleFiller::find_farthest(const DepthImage& seen, int row) {
    widen(seen, row);
    const auto columns = static_cast<std::size_t>(seen.columns);
    farthest_.assign(columns, kAbove);
    const int first = std::max(row - kReach_px, 0);
    const int last = std::min(row + kReach_px, seen.rows - 1);
    const float* levels = seen.levels.data() + seen.index(0, row);
    for (std::size_t begin = 0; begin < columns; begin += kChunk) {
        const std::size_t count = std::min(kChunk, columns - begin);
        if (std::all_of(levels + begin, levels + begin + count, is_data)) continue;
        for (int j = first; j <= last; ++j) {
            const int reach = kReachOfRow[static_cast<std::size_t>(std::abs(j - row))];
            lower(farthest_.data() + begin, span_of(j, reach, columns) + begin, count);
        }
    }
}

void LargeHoleFiller::fill_row(DepthImage& image, int row, std::vector<std::uint8_t>& unseen) {
    const float outline = outline_levels(image);
    const DepthImage& grid = grids_.front();
    const Place y(row, kSquare_px, grid.rows);
    mix_rows(grid, grid.levels, y, level_row_);
    mix_rows(grid, wide_, y, wide_row_);
    mix_rows(grid, open_, y, open_row_);
    for (int i = 0; i < image.columns; ++i) {
        float& level = image.at(i, row);
        if (is_data(level)) continue;
        const Place x(i, kSquare_px, grid.columns);
        unseen[image.index(i, row)] = between(wide_row_, x) > 0.0F ? 1 : 0;
        level = between(open_row_, x) > 0.0F ? 0.0F : between(level_row_, x);
        level = std::min(level, farthest_[static_cast<std::size_t>(i)] + outline);
    }
}

void LargeHoleFiller::lift_row(DepthImage& image, const DepthImage& seen, int row) const {
    const float pit = kPit * static_cast<float>(image.highest_level);
    for (int i = 0; i < image.columns; ++i) {
        const float farthest = farthest_[static_cast<std::size_t>(i)];
        float& level = image.at(i, row);
        if (!is_data(seen.at(i, row)) && farthest < kAbove) level = std::max(level, farthest - pit);
    }
}

/// Pixels whose data was refused stand as high as was found for them; beside them, too, nothing
/// falls away.
void LargeHoleFiller::lift_beside(DepthImage& image, const DepthImage& seen,
                                  std::span<const std::size_t> refused) {
    if (refused.empty()) return;
    given_ = seen;
    for (const std::size_t pixel : refused) given_.levels[pixel] = image.levels[pixel];
    widened_ = 0;
    for (int j = 0; j < image.rows; ++j) {
        if (has_data(seen, j)) continue;
        find_farthest(given_, j);
        lift_row(image, seen, j);
    }
}

}  // namespace dibhr
