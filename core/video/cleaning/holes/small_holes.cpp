// Finds the nearest levels on all four sides of each pixel of a hole.
#include "core/video/cleaning/holes/small_holes.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace dibhr {

namespace {

constexpr int kSlopeOver_px = 3;  ///< length over which a rim's slope is taken
constexpr float kNone = std::numeric_limits<float>::quiet_NaN();

}  // namespace

void SmallHoleFiller::fill(DepthImage& image) {
    find_small_runs(image);
    if (runs_.empty()) return;
    outline_ = outline_levels(image);
    find_levels_above(image);
    estimate(image);
    std::size_t k = 0;
    for (const Run& run : runs_)
        for (int i = run.begin; i < run.end; ++i, ++k) image.at(i, run.row) = estimates_[k];
}

void SmallHoleFiller::find_small_runs(const DepthImage& image) {
    patches_.find_holes(image);
    runs_.clear();
    const int most = std::max(2, image.columns / kSmallInWidth);
    for (const Run& run : patches_.runs()) {
        const Patches::Patch& patch = patches_.patch(run.patch);
        if (patch.right - patch.left <= most && patch.bottom - patch.top <= most)
            runs_.push_back(run);
    }
}

/// Updates the nearest level of this column against `step` (1: above the pixel, -1: below). If the
/// pixel before has no data it is in the same hole: the nearest level is only one pixel farther.
void SmallHoleFiller::update_column(const DepthImage& image, int column, int row, int step) {
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

void SmallHoleFiller::find_levels_above(const DepthImage& image) {
    in_column_.assign(static_cast<std::size_t>(image.columns), {});
    above_.clear();
    for (const Run& run : runs_) {
        for (int i = run.begin; i < run.end; ++i) {
            update_column(image, i, run.row, 1);
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
            update_column(image, i, run->row, -1);
            --k;
            if (left.away > 0) left.away = i - run->begin + 1;
            if (right.away > 0) right.away = run->end - i;
            const Side& below = in_column_[static_cast<std::size_t>(i)];
            const Estimate all = behind(between(left, right), between(above_[k], below));
            estimates_[k] = all.weight > 0.0F ? all.level : kNone;
        }
    }
}

/// Both sides count if they can be one surface, level or by the slope of either; else only the
/// farther one, as the background of the nearer one.
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
    return {std::clamp(level, lowest, highest), weight};  // against rounding
}

SmallHoleFiller::Estimate SmallHoleFiller::behind(const Estimate& one,
                                                  const Estimate& other) const noexcept {
    const bool apart =
        one.weight > 0.0F && other.weight > 0.0F && std::fabs(one.level - other.level) > outline_;
    if (!apart) return mean(one, other);
    return one.level < other.level ? one : other;
}

}  // namespace dibhr
