// Tries motions from coarse to fine.
#include "core/video/cleaning/even_motion.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

namespace dibhr {

namespace {

constexpr int kReachInWidth = 40;  ///< a frame's motion is at most this part of the image's width
constexpr int kCoarse_px = 2;
// A motion by which more of the first samples are missed is not tried any further.
constexpr std::size_t kFirstSamples = 8;
constexpr std::size_t kFirstMisses = 4;
constexpr double kFoundShare = 0.6;

}  // namespace

EvenMotionSearch::EvenMotionSearch(const DepthImage& here, const NeighbourFrame& a,
                                   const NeighbourFrame& b)
    : here_(here), a_(a), b_(b), reach_px_(std::max(here.columns / kReachInWidth, 1)) {}

std::optional<EvenMotion> EvenMotionSearch::found() const {
    Best best{};
    try_around(best, {0, 0}, reach_px_, kCoarse_px);
    if (best.count == 0) return {};
    try_around(best, best.motion, kCoarse_px - 1, 1);
    const double wanted = kFoundShare * static_cast<double>(samples_.size());
    if (static_cast<double>(best.count) < wanted) return {};
    return best.motion;
}

std::optional<float> EvenMotionSearch::level_along(const EvenMotion& motion, int i, int j,
                                                   const NoiseBound& bound) const {
    if (!is_inside(motion, i, j)) return {};
    const float now = here_.at(i, j);
    const float a = level_in(a_, motion, i, j);
    const float b = level_in(b_, motion, i, j);
    const float level = std::clamp(now, std::min(a, b), std::max(a, b));
    const float above = std::max({a, now, b}) - level;
    const float below = level - std::min({a, now, b});
    if (std::min(above, below) > bound(level)) return {};
    return level;
}

void EvenMotionSearch::try_around(Best& best, const EvenMotion& middle, int reach_px,
                                  int step_px) const {
    for (int down = -reach_px; down <= reach_px; down += step_px) {
        for (int right = -reach_px; right <= reach_px; right += step_px) {
            if (best.count == samples_.size()) return;
            const EvenMotion motion{middle.right + right, middle.down + down};
            const std::size_t count = count_found(motion, best.count);
            if (count > best.count) best = {motion, count};
        }
    }
}

/// How many samples are found; 0 if not more than `least`.
std::size_t EvenMotionSearch::count_found(const EvenMotion& motion, std::size_t least) const {
    const std::ptrdiff_t to_a = away(a_, motion);
    const std::ptrdiff_t to_b = away(b_, motion);
    std::size_t missed = 0;
    std::size_t may_miss = kFirstMisses;
    for (std::size_t k = 0; k < samples_.size(); ++k) {
        if (k == kFirstSamples) may_miss = samples_.size() - least - 1;
        const Sample& sample = samples_[k];
        const bool found = is_inside(motion, sample.i, sample.j) &&
                           std::fabs(a_.levels[sample.at + to_a] - sample.level) <= sample.alike &&
                           std::fabs(b_.levels[sample.at + to_b] - sample.level) <= sample.alike;
        if (!found && ++missed > may_miss) return 0;
    }
    return samples_.size() - missed;
}

std::ptrdiff_t EvenMotionSearch::away(const NeighbourFrame& frame, const EvenMotion& motion) const {
    return std::ptrdiff_t{frame.later} *
           (std::ptrdiff_t{motion.down} * here_.columns + motion.right);
}

bool EvenMotionSearch::is_inside(const EvenMotion& motion, int i, int j) const {
    const auto is_in = [&](const NeighbourFrame& frame) {
        const int x = i + frame.later * motion.right;
        const int y = j + frame.later * motion.down;
        return x >= 0 && y >= 0 && x < here_.columns && y < here_.rows;
    };
    return is_in(a_) && is_in(b_);
}

float EvenMotionSearch::level_in(const NeighbourFrame& frame, const EvenMotion& motion, int i,
                                 int j) const {
    return frame.levels[static_cast<std::ptrdiff_t>(here_.index(i, j)) + away(frame, motion)];
}

}  // namespace dibhr
