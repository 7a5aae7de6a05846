// Deadlines by clock_nanosleep, real-time priority and memory lock.
#include "core/realtime/tick_timer.hpp"

#include <pthread.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <ctime>
#include <string>
#include <utility>

#include "core/realtime/memory.hpp"
#include "core/realtime/time_slice.hpp"

namespace dibhr {

namespace {

using std::chrono::nanoseconds;

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

// Above ordinary real-time services (50 is the kernel's interrupt threads), below the watchdogs
// at 99.
constexpr int kPriority = 80;
constexpr std::size_t kLongestThreadName = 15;       // the kernel's limit
constexpr std::size_t kStackTouched_bytes = 131072;  // 128 KiB

// Threads made by this one must not inherit the priority: SCHED_RESET_ON_FORK.
bool set_fifo(int priority) {
    sched_param parameters{};
    parameters.sched_priority = priority;
    return sched_setscheduler(0, SCHED_FIFO | SCHED_RESET_ON_FORK, &parameters) == 0;
}

Grant ask_for_priority() {
    const int wanted = std::min(kPriority, sched_get_priority_max(SCHED_FIFO));
    if (set_fifo(wanted)) return {true, "SCHED_FIFO " + std::to_string(wanted)};
    const int error = errno;
    rlimit allowed{};
    getrlimit(RLIMIT_RTPRIO, &allowed);
    const int lower = static_cast<int>(std::min(allowed.rlim_cur, static_cast<rlim_t>(wanted)));
    if (lower > 0 && set_fifo(lower)) return {true, "SCHED_FIFO " + std::to_string(lower)};
    if (error == EPERM) return {false, "refused: needs rtprio in /etc/security/limits.conf"};
    return {false, std::string("refused: ") + std::strerror(error)};
}

// Avoids page faults in the first deep call of a tick.
[[gnu::noinline]] void touch_stack() {
    std::array<volatile std::byte, kStackTouched_bytes> pages;
    for (std::size_t k = 0; k < pages.size(); k += 1024) pages[k] = std::byte{0};
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
        if (seen >= wanted && seen > 0.0) return std::chrono::microseconds(std::int64_t{1} << k);
    }
    return worst_;  // the last bin has no upper end of its own
}

void TickSchedule::start(TimePoint now) noexcept {
    deadline_ = now;
    last_begin_ = now;
}

TickTiming TickSchedule::begin_tick(TimePoint begin, int periods) noexcept {
    deadline_ = next_deadline(periods);
    TickTiming timing;
    timing.begin = begin;
    timing.periods = periods;
    timing.dt_s = std::chrono::duration<double>(begin - last_begin_).count();
    timing.lateness = std::max(nanoseconds(begin - deadline_), nanoseconds(0));
    timing.late = timing.lateness >= period_;
    if (timing.late) {
        deadline_ += timing.lateness / period_ * period_;
        ++late_ticks_;
    }
    last_begin_ = begin;
    ++ticks_;
    histogram_.add(timing.lateness);
    return timing;
}

TickTimer::TickTimer(nanoseconds period) noexcept : schedule_(period) {}

TickTiming TickTimer::wait(int periods) noexcept {
    if (!started_) schedule_.start(std::chrono::steady_clock::now());
    started_ = true;
    sleep_until(schedule_.next_deadline(periods));
    return schedule_.begin_tick(std::chrono::steady_clock::now(), periods);
}

RealtimeGrants become_realtime(const char* thread_name) {
    const std::string name = std::string(thread_name).substr(0, kLongestThreadName);
    pthread_setname_np(pthread_self(), name.c_str());
    prctl(PR_SET_TIMERSLACK, 1UL);  // 1 ns instead of 50 us, should the priority be refused
    RealtimeGrants grants;
    Grant priority = ask_for_priority();
    const bool is_refused = !priority.granted;
    grants.priority->set(std::move(priority));
    if (is_refused) {
        (void)set_time_slice(kPromptSlice);
        PriorityBroker::request(gettid(), grants.priority);
    }
    grants.memory_lock = ask_for_memory_lock();
    touch_stack();
    return grants;
}

}  // namespace dibhr
