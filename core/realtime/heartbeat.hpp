// How a thread shows that it goes on, and how another one listens to it. A beat is wait-free;
// a listener asks the kernel where it has heard nothing for long.
#pragma once

#include <atomic>
#include <chrono>

namespace dibhr {

/// One thread's: it beats while it has something to do, and rests while it has not.
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
    /// Nothing is to be heard until the next beat.
    void rest() noexcept { last_.store(kResting, std::memory_order_relaxed); }
    /// The calling thread goes on, too, while it computes without a beat, or waits for threads that
    /// do, as in decoding, for two seconds at most: where it waits for a disk, itself or through
    /// another thread, nothing is heard of it. (Where the kernel does not tell on what a thread
    /// waits, beats are all that counts.)
    void also_computes() noexcept;

  private:
    friend class HeartbeatListener;
    static constexpr Clock::time_point kResting = Clock::time_point::max();

    enum class Doing { computes, waits_for_threads, waits };
    [[nodiscard]] Doing doing() const noexcept;

    std::atomic<Clock::time_point> last_{kResting};
    std::atomic<int> system_call_{-1};  // a descriptor: what the kernel says of the thread
};

/// One listening thread's end.
class HeartbeatListener {
  public:
    /// `heart` outlives it; null: nobody is missed.
    explicit HeartbeatListener(const Heartbeat* heart) noexcept : heart_(heart) {}

    /// How long nothing has been heard; zero while the heart rests. To be called about once a
    /// millisecond; asks the kernel, which may take a millisecond, only after kPatience and then
    /// every kBetweenLooks.
    [[nodiscard]] Heartbeat::Clock::duration silence(Heartbeat::Clock::time_point now) noexcept;

  private:
    static constexpr std::chrono::milliseconds kPatience{100};
    static constexpr std::chrono::milliseconds kBetweenLooks{20};
    static constexpr std::chrono::seconds kLongestWaitForThreads{2};

    const Heartbeat* heart_;
    Heartbeat::Clock::time_point computed_{};  // when it was last seen to compute
    Heartbeat::Clock::time_point looked_{};
};

}  // namespace dibhr
