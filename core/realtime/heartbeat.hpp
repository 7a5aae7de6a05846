// A thread beats to show that it is running, and another thread monitors the beats. A beat is
// wait-free. After a long silence the monitor reads the thread's state from the kernel.
#pragma once

#include <atomic>
#include <chrono>

namespace dibhr {

/// The heartbeat of one thread, which beats while it has work, and is idle while it has none.
class Heartbeat {
  public:
    using Clock = std::chrono::steady_clock;

    Heartbeat() = default;
    ~Heartbeat();
    Heartbeat(const Heartbeat&) = delete;
    Heartbeat& operator=(const Heartbeat&) = delete;

    void beat(Clock::time_point now = Clock::now()) noexcept {
        last_.store(now, std::memory_order_relaxed);
    }
    /// The thread is idle: no beat is expected until the next one.
    void set_idle() noexcept { last_.store(kIdle, std::memory_order_relaxed); }
    /// For the calling thread computing counts as beating, and so does waiting for threads that
    /// compute, as in decoding, for two seconds at most. Waiting for a disk, itself or through
    /// another thread, does not count. (Where the kernel does not show on what a thread waits, only
    /// beats count.)
    void count_computing_as_beat() noexcept;

  private:
    friend class HeartbeatMonitor;
    static constexpr Clock::time_point kIdle = Clock::time_point::max();

    enum class Activity { computes, waits_for_threads, waits };
    [[nodiscard]] Activity activity() const noexcept;

    std::atomic<Clock::time_point> last_{kIdle};
    std::atomic<int> system_call_{-1};  // descriptor of the kernel's file on the thread
};

/// Monitors a heartbeat, for one thread.
class HeartbeatMonitor {
  public:
    /// `heart` outlives the monitor; null: never silent.
    explicit HeartbeatMonitor(const Heartbeat* heart) noexcept : heart_(heart) {}

    /// Time since the last beat; zero while the thread is idle. To be called about once a
    /// millisecond. Reads the thread's state from the kernel, which may take a millisecond, only
    /// after kKernelCheckAfter and then every kKernelCheckInterval.
    [[nodiscard]] Heartbeat::Clock::duration silence(Heartbeat::Clock::time_point now) noexcept;

  private:
    static constexpr std::chrono::milliseconds kKernelCheckAfter{100};
    static constexpr std::chrono::milliseconds kKernelCheckInterval{20};
    static constexpr std::chrono::seconds kLongestWaitForThreads{2};

    const Heartbeat* heart_;
    Heartbeat::Clock::time_point computed_{};  // when the thread was last found computing
    Heartbeat::Clock::time_point checked_{};
};

}  // namespace dibhr
