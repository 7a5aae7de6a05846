// Weighs frames against the clock, by the time that each thread takes.
#include "core/video/playing/frame_plan.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/files/plain_text.hpp"
#include "core/realtime/moving_mean.hpp"
#include "core/video/frames/frame_window.hpp"

namespace dibhr {

namespace {

constexpr double kReserve = 1.03;        ///< of the time a frame takes, where the clock is kept
constexpr double kFewLeftOut = 1.2;      ///< below one of so many, leaving out is not worth it
constexpr double kSameEvery = 0.07;      ///< smaller changes of a plan are not worth a change
constexpr double kSameSpeed = 0.02;      ///< likewise
constexpr double kWeightOfNewest = 0.2;  ///< in the means
constexpr double kMostOfMean = 2.0;      ///< a newer value counts as so many means at most
constexpr double kEndless = std::numeric_limits<double>::infinity();

/// The smallest `every` for which `fixed_s + every * each_s` <= `every * interval_s`.
double least_every(double fixed_s, double each_s, double interval_s) noexcept {
    return each_s < interval_s ? fixed_s / (interval_s - each_s) : kEndless;
}

/// The smallest `every` for which frames are ready in time; `interval_s` between frames.
double every_in_time(const FrameCosts& costs, double interval_s) noexcept {
    const double free_s = interval_s / kReserve;
    if (!costs.side_by_side)
        return least_every(costs.conversion_s + costs.cleaning_s, costs.decoding_s, free_s);
    return std::max(least_every(costs.conversion_s, costs.decoding_s, free_s),
                    least_every(costs.cleaning_s, 0.0, free_s));
}

/// The largest `every` that costs at most kMostLost of the frames shown per second.
double every_without_loss(const FrameCosts& costs) noexcept {
    const double most_s = frame_time_s(costs, 1.0) / (kReserve * (1.0 - kMostLost));
    const double fixed_s = costs.conversion_s + (costs.side_by_side ? 0.0 : costs.cleaning_s);
    return costs.decoding_s > 0.0 ? (most_s - fixed_s) / costs.decoding_s : kEndless;
}

bool is_near(double a, double b, double share) noexcept {
    return std::fabs(a - b) <= share * b;
}

FramePlan newest_plan(const FrameCosts& costs, double interval_s, double speed) noexcept {
    if (!(frame_time_s(costs, 1.0) * speed > interval_s)) return {.every = 1.0, .speed = speed};
    const double most = std::max(every_without_loss(costs), 1.0);
    double every = std::clamp(every_in_time(costs, interval_s / speed), 1.0, most);
    if (every < kFewLeftOut) every = 1.0;
    const double sustained = every * interval_s / frame_time_s(costs, every);
    return {.every = every, .speed = std::min(speed, sustained), .overloaded = true};
}

}  // namespace

double frame_time_s(const FrameCosts& costs, double every) noexcept {
    const double decoding_s = every * costs.decoding_s + costs.conversion_s;
    return costs.side_by_side ? std::max(decoding_s, costs.cleaning_s)
                              : decoding_s + costs.cleaning_s;
}

FramePlan plan_of(const FrameCosts& costs, double interval_s, double speed,
                  const FramePlan& last) noexcept {
    if (!(interval_s > 0.0)) return {.every = 1.0, .speed = speed};
    const FramePlan newest = newest_plan(costs, interval_s, speed);
    const bool keeps_time = !(newest.speed < speed);
    const bool same =
        newest.overloaded == last.overloaded && is_near(newest.every, last.every, kSameEvery) &&
        (keeps_time ? last.speed == speed : is_near(newest.speed, last.speed, kSameSpeed));
    return same ? last : newest;
}

double steady_mean(double mean, double newest) noexcept {
    if (mean > 0.0) newest = std::min(newest, kMostOfMean * mean);
    return moving_mean_from_first(mean, newest, kWeightOfNewest);
}

std::string in_words(const FramePlan& plan, const FrameCosts& costs, double frames_per_s,
                     double speed) {
    if (!plan.overloaded) return {};
    std::string words = "All frames are shown";
    if (plan.every > 1.0)
        words = "Shown " + number_text(frames_per_s / plan.every, 0) + " of " +
                number_text(frames_per_s, 0) + " frames a second";
    if (plan.speed < speed) words += ", at " + number_text(plan.speed, 2) + " of the video's speed";
    const double decoding_s = costs.decoding_s + costs.conversion_s;
    const char* const step = !costs.side_by_side             ? "decoding and cleaning take "
                             : costs.cleaning_s > decoding_s ? "cleaning takes "
                                                             : "decoding takes ";
    return words + ": " + step + number_text(1000.0 * frame_time_s(costs, 1.0), 0) + " ms a frame.";
}

double next_shown_s(double media_s, double spacing_s) noexcept {
    if (!(spacing_s > 0.0)) return media_s + kTimeTolerance_s;
    const double slot = std::floor((media_s + 2.0 * kTimeTolerance_s) / spacing_s);
    return (slot + 1.0) * spacing_s - kTimeTolerance_s;
}

}  // namespace dibhr
