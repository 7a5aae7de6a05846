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

    /// How long the window's thread may be silent after the first request, neither computing nor
    /// waiting for threads that do: with the last tick, the last transaction and the crash note
    /// less than a second.
    static constexpr std::chrono::milliseconds kLongestSilence{600};
    /// How long the program may take in all: a busy machine closes a large video in seconds.
    static constexpr std::chrono::seconds kLongestShutdown{5};
    /// A terminal that closes, or `timeout`, sends two signals for one request.
    static constexpr std::chrono::milliseconds kRepeatWindow{200};

    /// To be called at each signal. True: it is a second request.
    [[nodiscard]] bool is_repeated(Time now) noexcept;
    [[nodiscard]] bool any() const noexcept { return first_.has_value(); }
    /// Whether the program hangs: after a request, when the window's thread has been silent for
    /// `silence`.
    [[nodiscard]] bool is_hung(Time now, Time::duration silence) const noexcept;

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

  private:
    void run();

    CrashNote& crash_note_;
    ShutdownSignals signals_{};
    Heartbeat heart_{};  // of the window's thread, from the first request on
    std::atomic<bool> requested_{false};
    std::atomic<bool> without_force_{false};
    std::atomic<bool> stopping_{false};
    std::atomic<int> display_{-1};
    Wake wake_{};  // when one of the two above has changed
    std::thread thread_{};
};

}  // namespace dibhr
