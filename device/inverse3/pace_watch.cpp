// How promptly the service answers.
#include "device/inverse3/pace_watch.hpp"

#include <algorithm>

namespace dibhr::inverse3 {

namespace {

// README.md, Safety numbers.
constexpr double kPaceTime_s = 0.25;
constexpr double kLongest_s = 0.02;     // one that takes longer counts as this,
constexpr double kMostPassed_s = 0.01;  // and no more than one after so long: a stall is no pace
constexpr double kFirst_s = 1e9;        // the first one counts for all before it
constexpr double kPrompt_s = 0.002;
constexpr double kSlow_s = 0.005;
constexpr double kBackAt = 0.8;  // of these, for so long: it does not change to and fro
constexpr std::chrono::milliseconds kBackAfter{1000};

}  // namespace

void PaceWatch::add(Time sent, Time answered) noexcept {
    using Seconds = std::chrono::duration<double>;
    const double took_s = std::clamp(Seconds(answered - sent).count(), 0.0, kLongest_s);
    const double passed_s =
        last_ ? std::min(Seconds(answered - *last_).count(), kMostPassed_s) : kFirst_s;
    last_ = answered;
    mean_s_ += passed_s / (kPaceTime_s + passed_s) * (took_s - mean_s_);
    const auto within = [this](double limit_s, Pace pace) {
        return mean_s_ <= (pace_ > pace ? kBackAt : 1.0) * limit_s;
    };
    const Pace now = within(kPrompt_s, Pace::prompt) ? Pace::prompt
                     : within(kSlow_s, Pace::slow)   ? Pace::slow
                                                     : Pace::too_slow;
    if (now >= pace_) better_since_.reset();
    if (now < pace_ && !better_since_) better_since_ = answered;
    if (now > pace_) pace_ = now;
    if (better_since_ && answered - *better_since_ >= kBackAfter) {
        pace_ = pace_ == Pace::too_slow ? Pace::slow : Pace::prompt;
        better_since_.reset();
    }
}

}  // namespace dibhr::inverse3
