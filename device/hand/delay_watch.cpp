// Mean delay of a device's answers.
#include "device/hand/delay_watch.hpp"

#include <algorithm>
#include <cmath>

namespace dibhr {

namespace {

// ../inverse3/README.md, Safety numbers.
constexpr double kMeanOver_s = 0.25;
constexpr double kLongest_s = 0.02;      // a longer delay counts as this
constexpr double kMostSkipped_s = 0.01;  // most time that one delay stands for: a stall is no delay
constexpr double kFirst_s = 1e9;         // the first delay sets the mean
constexpr double kRecoverShare = 0.8;    // hysteresis: the limit falls once the mean is below this
constexpr std::chrono::milliseconds kRecoverAfter{1000};

}  // namespace

void DelayWatch::add(Time sent, Time answered) noexcept {
    using Seconds = std::chrono::duration<double>;
    const double took_s = std::clamp(Seconds(answered - sent).count(), 0.0, kLongest_s);
    const double passed_s =
        last_ ? std::min(Seconds(answered - *last_).count(), kMostSkipped_s) : kFirst_s;
    last_ = answered;
    mean_s_ += passed_s / (kMeanOver_s + passed_s) * (took_s - mean_s_);
    const auto needed_ms = [this](double share) {
        return std::max(1, static_cast<int>(std::ceil(mean_ms() / share)));
    };
    within_ms_ = std::max(within_ms_, needed_ms(1.0));
    if (needed_ms(kRecoverShare) >= within_ms_)
        better_since_.reset();
    else if (!better_since_)
        better_since_ = answered;
    if (better_since_ && answered - *better_since_ >= kRecoverAfter) {
        within_ms_ = needed_ms(kRecoverShare);
        better_since_.reset();
    }
}

}  // namespace dibhr
