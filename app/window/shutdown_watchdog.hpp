// Shutdown by a signal, or because the display is lost: the force goes off, whatever the window's
// thread does.
#pragma once

#include <atomic>
#include <chrono>
#include <optional>
#include <thread>

#include "app/window/crash_note.hpp"
#include "app/window/signals.hpp"
#include "core/realtime/heartbeat.hpp"
#include "core/realtime/wake.hpp"

namespace dibhr {

/// Requests to shut down, from the times of their signals.
class ShutdownRequests {
  public:
    using Time = std::chrono::steady_clock::time_point;

    /// With the last tick, the last transaction and the crash note less than a second.
    static constexpr std::chrono::milliseconds kPatience{600};
    /// A busy machine takes seconds to draw a picture, or to close a large video.
    static constexpr std::chrono::seconds kLongestPatience{5};
    /// A terminal that closes, or `timeout`, sends two signals for one request.
    static constexpr std::chrono::milliseconds kRepeatWindow{200};

    /// To be called at each signal. True: it is a second request.
    [[nodiscard]] bool is_repeated(Time now) noexcept;
    [[nodiscard]] bool any() const noexcept { return first_.has_value(); }
    /// Whether the program hangs, after a request. In the window's loop, whose turns take up to
    /// `turn`: after two turns, at least kPatience. Outside the loop: when the window's thread
    /// has neither computed nor waited for threads that compute for `silence`.
    [[nodiscard]] bool is_hung(Time now, Time::duration turn,
                               Time::duration silence) const noexcept;

  private:
    std::optional<Time> first_{};
};

/// During its life a thread of its own takes SIGINT, SIGTERM, SIGHUP and SIGQUIT as requests to
/// shut down. If the program then hangs, or at a second request, the thread prints the crash note
/// and exits with status 1. Ctrl+Z is blocked. Construct it in the window's thread before any
/// other starts.
class ShutdownWatchdog {
  public:
    /// `crash_note` must outlive it. Throws DeviceError when the system has no descriptor left.
    explicit ShutdownWatchdog(CrashNote& crash_note);
    ~ShutdownWatchdog();
    ShutdownWatchdog(const ShutdownWatchdog&) = delete;
    ShutdownWatchdog& operator=(const ShutdownWatchdog&) = delete;

    /// For any thread to poll: once true, the window closes.
    [[nodiscard]] const std::atomic<bool>& requested() const noexcept { return requested_; }
    /// For any thread to poll: once true, no force is sent. Set by a signal, and by the loss of the
    /// display, which the drawing thread notices only after its picture.
    [[nodiscard]] const std::atomic<bool>& without_force() const noexcept { return without_force_; }
    /// `connection`: the display server's socket, watched from now on; -1: none.
    void watch_display(int connection);
    [[nodiscard]] CrashNote& crash_note() noexcept { return crash_note_; }
    /// For the window's thread: at each turn of its loop, which ends once requested() is true; and
    /// after the loop.
    void begin_turn() noexcept;
    void end_loop() noexcept { turn_ = ShutdownRequests::Time::duration::zero(); }

  private:
    void run();
    /// Of the window's loop, or of its turn that has run for `running`; 0: outside the loop.
    [[nodiscard]] ShutdownRequests::Time::duration longest_turn(
        ShutdownRequests::Time::duration running) const noexcept;

    CrashNote& crash_note_;
    ShutdownSignals signals_{};
    Heartbeat heart_{};  // of the window's thread, from the first request on
    std::atomic<bool> requested_{false};
    std::atomic<bool> without_force_{false};
    std::atomic<bool> stopping_{false};
    std::atomic<int> display_{-1};
    /// How long turns of the window's loop take, the last ones more than others; 0: outside it.
    std::atomic<ShutdownRequests::Time::duration> turn_{};
    std::atomic<ShutdownRequests::Time> turn_began_{};
    Wake wake_{};  // when one of the two above has changed
    std::thread thread_{};
};

}  // namespace dibhr
