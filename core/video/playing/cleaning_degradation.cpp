// Weighs the steps of the cleaning against the frames that are shown.
#include "core/video/playing/cleaning_degradation.hpp"

#include <algorithm>
#include <utility>

namespace dibhr {

namespace {

constexpr int kSettled = 8;             ///< frames until costs tell whether there is time
constexpr int kSettledFarAway = 3;      ///< where they are far from it
constexpr int kSettledBeyond = 2;       ///< where they are beyond it
constexpr double kFarAway = 2.0;        ///< times as long as there is time
constexpr double kBeyond = 4.0;         ///< likewise
constexpr int kLongestPatience = 4096;  ///< frames
constexpr int kSoon = 8;  ///< times the patience: before that, steps had come back too early
constexpr double kRoomToReturn = 1.3;  ///< of a frame's time before steps come back

}  // namespace

CleaningSteps degraded(CleaningSteps steps, std::size_t level) noexcept {
    if (level >= 1) steps.steady = false;
    if (level >= 2) steps.sharpen_silhouettes = steps.colour_edges = false;
    if (level >= 3) steps.smooth_noise = false;
    if (level >= 4) steps.smooth_outlines = false;
    if (level >= 5) steps.smooth_steps = false;
    return steps;
}

std::string left_out_in_words(const CleaningSteps& steps, std::size_t level) {
    std::string words;
    const auto add = [&words](bool is_left_out, const char* what) {
        if (is_left_out) words += (words.empty() ? "" : ", ") + std::string(what);
    };
    const CleaningSteps left = degraded(steps, level);
    add(steps.steady && !left.steady, "the filter in time");
    add(steps.sharpen_silhouettes && !left.sharpen_silhouettes, "sharp silhouettes");
    add(steps.smooth_noise && !left.smooth_noise, "smoothing of noise");
    add(steps.smooth_outlines && !left.smooth_outlines, "smooth outlines");
    add(steps.smooth_steps && !left.smooth_steps, "smoothing of depth steps");
    return words.empty() ? words : "Cleaning leaves out " + words + ".";
}

void CleaningDegradation::change_to(std::size_t level) noexcept {
    const bool soon = frames_ < kSoon * patience_;
    if (!soon) patience_ = kPatience;
    if (soon && returned_ && level > level_) patience_ = std::min(2 * patience_, kLongestPatience);
    returned_ = level < level_;
    level_ = level;
    frames_ = fitting_ = 0;
}

/// The present level where no step is left to leave out.
std::size_t CleaningDegradation::next_above(const CleaningSteps& steps) const noexcept {
    std::size_t level = level_ + 1;
    while (level < kDegradationLevels && degraded(steps, level) == degraded(steps, level_)) ++level;
    return level < kDegradationLevels ? level : level_;
}

/// The level from which update() came here; the present one where nothing is left out.
std::size_t CleaningDegradation::next_below(const CleaningSteps& steps) const noexcept {
    for (std::size_t level = level_; level-- > 0;)
        if (times_as_long_[level] > 0.0 && !(degraded(steps, level) == degraded(steps, level_)))
            return level;
    return level_;
}

bool CleaningDegradation::update(const CleaningSteps& steps, const FrameCosts& costs,
                                 double interval_s, double speed) noexcept {
    const double frame_s = frame_time_s(costs, 1.0);
    if (!(interval_s > 0.0) || !(frame_s > 0.0)) return false;
    const double free_s = interval_s / speed;
    const int settled = frame_s > kBeyond * free_s    ? kSettledBeyond
                        : frame_s > kFarAway * free_s ? kSettledFarAway
                                                      : kSettled;
    if (++frames_ < settled) return false;
    if (before_s_ > 0.0) times_as_long_[raised_from_] = std::exchange(before_s_, 0.0) / frame_s;
    const std::size_t above = next_above(steps);
    if (frame_s > free_s && above != level_) {
        before_s_ = frame_s;
        raised_from_ = level_;
        change_to(above);
        return true;
    }
    const std::size_t below = next_below(steps);
    const bool fits = below != level_ && times_as_long_[below] * frame_s * kRoomToReturn <= free_s;
    fitting_ = fits ? fitting_ + 1 : 0;
    if (fitting_ < patience_) return false;
    change_to(below);
    return true;
}

}  // namespace dibhr
