// Compares each way's middle frame with the mean of all, without what is wider than a finger feels.
#include "core/video/playing/clip_trial.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/haptics/parameters.hpp"

namespace dibhr {

namespace {

/// Of the picture's middle rows, whole ones, as steps measure by its width: enough ground, and
/// quick.
constexpr int kPixelsOfTrial = 76'800;
constexpr int kLeastRows = 64;
constexpr std::size_t kLeastOfTrial = 5;    ///< frames
constexpr std::size_t kLeastGround = 2000;  ///< pixels that are compared, along rows and columns
constexpr double kStill = 4.0;  ///< deviations of the noise by which both halves' means may differ

constexpr double kRelief_px = 255.0;
constexpr double kNewtonPerPx = 0.5 * kPaperPitch_mm;  ///< of the default spring
constexpr double kPerceptible_N = 0.005;
constexpr double kReliefOverNoise = 2.0;  ///< of variances
constexpr double kStepsToVariance = 6.0;  ///< of rounding to steps that are found too small
constexpr float kCliff_px = 3.0F;         ///< a higher step between neighbours is an outline
constexpr float kSmoothSlope = 0.8F;      ///< ground is no steeper, over kWidest_px
constexpr int kBesideOutline_px = 4;      ///< nearer to an outline or a steep face is no ground
/// A point at 100 mm/s passes 23.6 px in a thirtieth of a second. Less the mean over this, a wave
/// as long has half its power.
constexpr int kWidest_px = 13;
constexpr int kHalfWidest_px = kWidest_px / 2;

/// The mean of all frames: NaN where a frame has no data, or where it moves.
DepthImage standing_mean(const std::vector<DepthImage>& frames, const DepthNoise& noise) {
    DepthImage mean = frames.front();
    const std::size_t half = frames.size() / 2;
    const auto all = static_cast<float>(frames.size());
    for (std::size_t k = 0; k < mean.levels.size(); ++k) {
        float first = 0.0F;
        float last = 0.0F;
        for (std::size_t n = 0; n < frames.size(); ++n)
            (n < half ? first : last) += frames[n].levels[k];
        const float level = (first + last) / all;
        const double apart =
            std::fabs(static_cast<double>(first) / static_cast<double>(half) -
                      static_cast<double>(last) / (all - static_cast<double>(half)));
        const double deviation = noise.at(level / static_cast<float>(mean.highest_level)) +
                                 kPerceptible_N / (kNewtonPerPx * kRelief_px);
        const bool stands =
            apart <= kStill * deviation * mean.highest_level / std::sqrt(0.25 * all);
        mean.levels[k] =
            stands ? level : std::numeric_limits<float>::quiet_NaN();  // no data: not `stands`
    }
    return mean;
}

/// Sums over what is shorter than a finger feels, of a cleaned frame and of the mean.
struct FeltSums {
    double cleaned{0.0};     ///< squares
    double means{0.0};       ///< squares of the mean
    double both{0.0};        ///< products
    double difference{0.0};  ///< squares
    std::size_t count{0};

    [[nodiscard]] double mean_of(double sum) const { return sum / static_cast<double>(count); }

    /// A row or column: every `stride`-th of the levels.
    void add_line(const float* frame, const float* mean, std::ptrdiff_t stride, int pixels,
                  float cliff) {
        const float steep = kSmoothSlope / kCliff_px * cliff * (kWidest_px - 1);
        int run = 0;       // of ground, below 0 beside an outline
        double sum = 0.0;  // of the last kWidest_px
        double sum_of_mean = 0.0;
        for (int i = 0; i < pixels; ++i) {
            const std::ptrdiff_t at = i * stride;
            const bool goes_on = i > 0 && std::fabs(mean[at] - mean[at - stride]) <= cliff;
            const bool is_steep =
                run >= kWidest_px &&
                std::fabs(mean[at] - mean[at - (kWidest_px - 1) * stride]) > steep;
            if (!goes_on || is_steep) {
                run = -kBesideOutline_px;
                sum = sum_of_mean = 0.0;
            }
            if (++run < 1) continue;
            sum += frame[at];
            sum_of_mean += mean[at];
            if (run > kWidest_px) {
                sum -= frame[at - kWidest_px * stride];
                sum_of_mean -= mean[at - kWidest_px * stride];
            }
            if (run < kWidest_px) continue;
            const std::ptrdiff_t middle = at - kHalfWidest_px * stride;
            const double felt = frame[middle] - sum / kWidest_px;
            const double felt_of_mean = mean[middle] - sum_of_mean / kWidest_px;
            cleaned += felt * felt;
            means += felt_of_mean * felt_of_mean;
            both += felt * felt_of_mean;
            difference += (felt - felt_of_mean) * (felt - felt_of_mean);
            ++count;
        }
    }
};

FeltSums compared(const DepthImage& frame, const DepthImage& mean) {
    FeltSums sums;
    const auto cliff = static_cast<float>(kCliff_px * mean.highest_level / kRelief_px);
    const auto add = [&](std::size_t begin, std::ptrdiff_t stride, int count) {
        sums.add_line(frame.levels.data() + begin, mean.levels.data() + begin, stride, count,
                      cliff);
    };
    for (int j = 0; j < mean.rows; ++j) add(mean.index(0, j), 1, mean.columns);
    for (int i = 0; i < mean.columns; ++i) add(mean.index(i, 0), mean.columns, mean.rows);
    return sums;
}

/// Whether what stands still is the thing's: cameras and codecs leave patterns that stand, too, but
/// hardly more of them than of noise that moves. `raw`: of `frames` frames.
bool is_relief(const FeltSums& raw, const DepthNoise& noise, double highest_level,
               std::size_t frames) {
    const double of_mean = raw.mean_of(raw.difference) / static_cast<double>(frames - 1);
    const double moves =  // what a codec repeats does not
        static_cast<double>(frames) * of_mean / (1.0 - static_cast<double>(noise.character.kept));
    const double grain = noise.character.fixed * highest_level;
    const double step = noise.step.at(0.5F) * highest_level;
    const double stands =
        raw.mean_of(raw.means) - of_mean - grain * grain - step * step / kStepsToVariance;
    return stands > kReliefOverNoise * moves;
}

/// Frame `now`, cleaned with those around it where the steps look at them.
DepthImage cleaned_frame(const std::vector<DepthImage>& frames, std::size_t now,
                         const CleaningPlan& plan) {
    CleaningChain chain;
    if (!plan.steps.steady) return *chain.clean_and_finish(frames[now], plan).depth;
    const std::size_t begin = now - std::min(now, kReachInTime);
    const std::size_t end = std::min(now + kReachInTime + 1, frames.size());
    std::vector<SingleFrameDepth> single_frames;
    for (std::size_t k = begin; k < end; ++k)
        single_frames.push_back(chain.clean_frame(frames[k], plan));
    std::vector<const SingleFrameDepth*> pointers;
    for (const SingleFrameDepth& frame : single_frames) pointers.push_back(&frame);
    return *chain.finish_frame(pointers, now - begin, plan).depth;
}

}  // namespace

void ClipTrial::add(const DepthImage& frame) {
    const int rows =
        std::min(frame.rows, std::max(kPixelsOfTrial / std::max(frame.columns, 1), kLeastRows));
    const int top = (frame.rows - rows) / 2;
    DepthImage middle = image_of(frame.columns, rows, frame.highest_level,
                                 [&](int i, int j) { return frame.at(i, top + j); });
    if (frames_.empty() || are_alike(frames_.front(), middle)) frames_.push_back(std::move(middle));
}

std::optional<FeltCleaning> ClipTrial::best_of(std::span<const CleaningSteps> ways,
                                               const DepthNoise& noise) const {
    // Frames of a scale each have no mean.
    if (frames_.size() < kLeastOfTrial || noise.per_frame_scale || ways.empty())
        return std::nullopt;
    const std::size_t now = frames_.size() / 2;
    const DepthImage mean = standing_mean(frames_, noise);
    const FeltSums raw = compared(frames_[now], mean);
    if (raw.count < kLeastGround) return std::nullopt;
    const double newton_per_level = kNewtonPerPx * kRelief_px / mean.highest_level;
    const bool has_relief = is_relief(raw, noise, mean.highest_level, frames_.size()) &&
                            newton_per_level * std::sqrt(raw.mean_of(raw.means)) > kPerceptible_N;
    const auto buzz_of = [&](const FeltSums& sums) {
        return newton_per_level *
               std::sqrt(sums.mean_of(has_relief ? sums.difference : sums.cleaned));
    };
    const double without = buzz_of(raw);

    std::vector<FeltCleaning> tried;
    double least = without;
    for (const CleaningSteps& steps : ways) {
        const FeltSums sums = compared(cleaned_frame(frames_, now, {steps, {}, noise, {}}), mean);
        tried.push_back({steps, buzz_of(sums), without,
                         has_relief ? std::optional(sums.both / sums.means) : std::nullopt});
        least = std::min(least, tried.back().buzz_N);
    }
    for (const FeltCleaning& way : tried)
        if (std::hypot(least, kPerceptible_N) >= way.buzz_N) return way;
    return tried.back();
}

}  // namespace dibhr
