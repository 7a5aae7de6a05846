// The 1 kHz loop's timing: absolute deadlines, how late each tick was, never waiting to catch up.
#include "core/realtime/tick_timer.hpp"

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cmath>
#include <ctime>

namespace dibhr {

namespace {

using std::chrono::nanoseconds;

nanoseconds upper_end_of_bin(std::size_t k) noexcept {
    return std::chrono::microseconds(std::int64_t{1} << k);
}

// libstdc++'s steady_clock is CLOCK_MONOTONIC, so its time points are the kernel's deadlines.
void sleep_until(std::chrono::steady_clock::time_point deadline) noexcept {
    const auto since_epoch = deadline.time_since_epoch();
    const auto whole_seconds = std::chrono::duration_cast<std::chrono::seconds>(since_epoch);
    timespec until{};
    until.tv_sec = static_cast<std::time_t>(whole_seconds.count());
    until.tv_nsec = static_cast<long>(nanoseconds(since_epoch - whole_seconds).count());
    while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) == EINTR) {
    }
}

}  // namespace

void LatenessHistogram::add(nanoseconds lateness) noexcept {
    const auto ns = std::max<std::int64_t>(lateness.count(), 0);
    const auto bin =
        static_cast<std::size_t>(std::bit_width(static_cast<std::uint64_t>(ns) / 1000));
    ++bins_[std::min(bin, kBins - 1)];
    ++count_;
    worst_ = std::max(worst_, nanoseconds(ns));
}

nanoseconds LatenessHistogram::quantile(double q) const noexcept {
    if (count_ == 0) return nanoseconds(0);
    const double wanted = std::ceil(std::clamp(q, 0.0, 1.0) * static_cast<double>(count_));
    double seen = 0.0;
    for (std::size_t k = 0; k + 1 < kBins; ++k) {
        seen += static_cast<double>(bins_[k]);
        if (seen >= wanted && seen > 0.0) return upper_end_of_bin(k);
    }
    return worst_;  // the last bin has no upper end of its own
}

void TickSchedule::start(TimePoint now) noexcept {
    deadline_ = now;
    last_begin_ = now;
}

TickTiming TickSchedule::begin_tick(TimePoint begin) noexcept {
    deadline_ += period_;
    TickTiming timing;
    timing.begin = begin;
    timing.dt_s = std::chrono::duration<double>(begin - last_begin_).count();
    timing.lateness = std::max(nanoseconds(begin - deadline_), nanoseconds(0));
    timing.late = timing.lateness >= period_;
    if (timing.late) {
        const auto missed = timing.lateness / period_;
        deadline_ += missed * period_;
        skipped_ += static_cast<std::uint64_t>(missed);
        ++late_ticks_;
    }
    last_begin_ = begin;
    ++ticks_;
    histogram_.add(timing.lateness);
    return timing;
}

TickTimer::TickTimer(nanoseconds period) noexcept : schedule_(period) {}

TickTiming TickTimer::wait() noexcept {
    if (!started_) schedule_.start(std::chrono::steady_clock::now());
    started_ = true;
    sleep_until(schedule_.next_deadline());
    return schedule_.begin_tick(std::chrono::steady_clock::now());
}

}  // namespace dibhr
