// The 1 kHz loop's timing: absolute deadlines, how late each tick was, never waiting to catch up;
// and what makes its thread punctual.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>

#include "core/realtime/priority_broker.hpp"

namespace dibhr {

/// Lateness of ticks: how long after its deadline each began. Fixed memory.
class LatenessHistogram {
  public:
    /// A negative lateness counts as none.
    void add(std::chrono::nanoseconds lateness) noexcept;
    [[nodiscard]] std::uint64_t count() const noexcept { return count_; }
    [[nodiscard]] std::chrono::nanoseconds worst() const noexcept { return worst_; }
    /// The upper end of the bin that holds quantile q in [0, 1]; zero while nothing was added.
    [[nodiscard]] std::chrono::nanoseconds quantile(double q) const noexcept;

  private:
    static constexpr std::size_t kBins = 32;  // bin k: [2^(k-1), 2^k) microseconds; bin 0: < 1 us

    std::array<std::uint64_t, kBins> bins_{};  // the last one also holds everything later
    std::uint64_t count_{0};
    std::chrono::nanoseconds worst_{0};
};

/// One tick as the timer saw it.
struct TickTiming {
    std::chrono::steady_clock::time_point begin{};
    double dt_s{0.001};  ///< since the last tick began, the true one
    std::chrono::nanoseconds lateness{0};
    bool late{false};  ///< began a whole period or more after its deadline
    int periods{1};    ///< from the deadline before to this one
};

/// The deadlines of a periodic loop and the lateness of its ticks, without a clock of its own.
/// After a late tick the next deadline is the next one in the future.
class TickSchedule {
  public:
    using TimePoint = std::chrono::steady_clock::time_point;

    explicit TickSchedule(std::chrono::nanoseconds period) noexcept : period_(period) {}

    /// Sets the first deadline to one period after `now`; keeps the counts.
    void start(TimePoint now) noexcept;
    /// `periods`, here and below: after the last deadline.
    [[nodiscard]] TimePoint next_deadline(int periods = 1) const noexcept {
        return deadline_ + periods * period_;
    }
    /// Counts the tick that began at `begin` for the next deadline.
    TickTiming begin_tick(TimePoint begin, int periods = 1) noexcept;

    [[nodiscard]] std::uint64_t ticks() const noexcept { return ticks_; }
    [[nodiscard]] std::uint64_t late_ticks() const noexcept { return late_ticks_; }
    [[nodiscard]] const LatenessHistogram& lateness() const noexcept { return histogram_; }

  private:
    std::chrono::nanoseconds period_;
    TimePoint deadline_{};  // the last one met or skipped
    TimePoint last_begin_{};
    std::uint64_t ticks_{0};
    std::uint64_t late_ticks_{0};
    LatenessHistogram histogram_{};
};

/// Sleeps to absolute deadlines (clock_nanosleep on CLOCK_MONOTONIC). Deadlines that pass during a
/// late tick are not made up for.
class TickTimer {
  public:
    explicit TickTimer(std::chrono::nanoseconds period = std::chrono::milliseconds(1)) noexcept;

    /// Waits for the next deadline; the only wait of a haptic thread. The clock starts with the
    /// first call.
    TickTiming wait(int periods = 1) noexcept;

    /// Its counts, and how late ticks were.
    [[nodiscard]] const TickSchedule& schedule() const noexcept { return schedule_; }

  private:
    TickSchedule schedule_;
    bool started_{false};
};

struct RealtimeGrants {
    std::shared_ptr<SharedGrant> priority{std::make_shared<SharedGrant>()};
    Grant memory_lock{};
};

/// Names the calling thread (15 characters are kept), makes its sleeps exact, requests SCHED_FIFO,
/// and locks the process's memory when the limit allows it without starving other threads. Where
/// SCHED_FIFO is refused, PriorityBroker is asked, without waiting for it. Threads made by the
/// caller do not inherit the priority. A refusal is no error.
[[nodiscard]] RealtimeGrants become_realtime(const char* thread_name);

}  // namespace dibhr
