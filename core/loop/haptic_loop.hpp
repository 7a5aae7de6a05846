// The 1 kHz thread of the haptic ticks.
#pragma once

#include <atomic>
#include <optional>
#include <thread>

#include "core/loop/haptic_tick.hpp"
#include "core/realtime/thread_setup.hpp"
#include "core/realtime/tick_timer.hpp"

namespace dibhr {

/// Runs ticks on their own real-time thread from construction until stop().
class HapticLoop {
  public:
    explicit HapticLoop(const HapticConnections& connections);
    ~HapticLoop() { stop(); }
    HapticLoop(const HapticLoop&) = delete;
    HapticLoop& operator=(const HapticLoop&) = delete;

    /// Ends the thread after it has sent zero force. May be called twice.
    void stop() noexcept;

    /// What the system answered; nothing until the thread has asked.
    [[nodiscard]] std::optional<RealtimeGrants> grants() const;

    /// The thread's timer and its lateness; to be read after stop().
    [[nodiscard]] const TickTimer& timer() const noexcept { return timer_; }

  private:
    void run();

    HapticTick tick_;
    TickTimer timer_{};        // the thread's until it has ended
    RealtimeGrants grants_{};  // the thread's until `granted_`
    std::atomic<bool> granted_{false};
    std::atomic<bool> stopping_{false};
    std::thread thread_{};
};

}  // namespace dibhr
