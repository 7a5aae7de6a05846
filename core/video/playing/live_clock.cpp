// Steers the shown moment by the times at which frames were ready.
#include "core/video/playing/live_clock.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "core/realtime/moving_mean.hpp"
#include "core/realtime/now.hpp"

namespace dibhr {

namespace {

constexpr double kJump_s = 0.001;             ///< from all that was shown to a restarted timeline
constexpr double kStampJump_s = 1.0;          ///< stamps farther apart: the source's clock was set
constexpr std::size_t kRemembered = 64;       ///< frames: two seconds
constexpr double kLateShare = 0.05;           ///< share of the frames that may come too late
constexpr double kMostJitterIntervals = 1.0;  ///< the longest added delay for jitter, in intervals
constexpr double kSlowDown_s = 0.3, kSpeedUp_s = 2.0;     ///< time constants of the correction
constexpr double kMostSlower = 0.05, kMostFaster = 0.02;  ///< most that the speed differs from 1
constexpr double kDeadband_s = 0.0005;

/// The value below which `share` of them lie.
double quantile(std::vector<double>& values, double share) {
    const auto at = values.begin() +
                    static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

}  // namespace

void LiveClock::begin_with(Frame frame, double stamp_s, Time now, std::deque<Frame>& frames) {
    frame.time_s =
        frames.empty() ? 0.0 : std::max(clock_.playback_s(now), frames.back().time_s) + kJump_s;
    offset_s_ = frame.time_s - stamp_s;
    clock_ = {now, frame.time_s, 0.0};
    frames.clear();
    frames.push_back(std::move(frame));
    ahead_s_.clear();
    restarts_ = false;
    waits_for_second_ = true;
}

bool LiveClock::continues_with(double stamp_s, const std::deque<Frame>& frames) const noexcept {
    const double since_s = stamp_s - last_stamp_s_;
    return !restarts_ && !frames.empty() && since_s > 0.0 && since_s < kStampJump_s;
}

bool LiveClock::add(Frame frame, double stamp_s, Time now, std::deque<Frame>& frames) {
    const bool goes_on = continues_with(stamp_s, frames);
    const double since_s = stamp_s - std::exchange(last_stamp_s_, stamp_s);
    if (!goes_on) {
        begin_with(std::move(frame), stamp_s, now, frames);
        return true;
    }
    interval_s_ = moving_mean(interval_s_, std::min(since_s, 2.0 * interval_s_));
    frame.time_s = stamp_s + offset_s_;
    if (std::exchange(waits_for_second_, false)) {  // also holds it where frames were missing
        Frame& held = frames.back();
        held.time_s = std::max(held.time_s, frame.time_s - interval_s_);
        clock_ = {now, held.time_s, 1.0};
    }
    steer(frame.time_s, now);
    const double moment_s = clock_.playback_s(now);
    Frame& newest = frames.back();
    if (moment_s > newest.time_s) {  // too late: the surface was held and moves on now
        newest.time_s = moment_s;
        while (frames.size() > 1) frames.pop_front();
        frame.time_s = std::max(frame.time_s, moment_s + 0.5 * interval_s_);
    }
    frame.time_s = std::max(frame.time_s, frames.back().time_s + kJump_s);
    if (frames.size() < FrameWindow::kFrames) frames.push_back(std::move(frame));
    return false;
}

/// Aims at all but a few frames being ready one interval before they are fully shown.
void LiveClock::steer(double time_s, Time now) {
    const double moment_s = clock_.playback_s(now);
    ahead_s_.push_back(time_s - seconds_of(now));
    if (ahead_s_.size() > kRemembered) ahead_s_.pop_front();
    std::vector<double> ahead(ahead_s_.begin(), ahead_s_.end());
    const double behind_s = moment_s - seconds_of(now);
    const double late_reserve_s = quantile(ahead, kLateShare) - behind_s - interval_s_;
    const double median_reserve_s =
        quantile(ahead, 0.5) - behind_s - (1.0 + kMostJitterIntervals) * interval_s_;
    const double early_s = std::max(late_reserve_s, median_reserve_s);
    double speed = 1.0;
    if (early_s < -kDeadband_s) speed -= std::min(kMostSlower, -early_s / kSlowDown_s);
    if (early_s > kDeadband_s) speed += std::min(kMostFaster, early_s / kSpeedUp_s);
    clock_ = {now, moment_s, speed};
}

}  // namespace dibhr
