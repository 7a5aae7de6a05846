// Shutdown by a signal, or because the display is lost: the force goes off, whatever the window's
// thread does.
#pragma once

#include <atomic>
#include <chrono>
#include <optional>
#include <thread>

#include "app/window/crash_note.hpp"
#include "app/window/signals.hpp"
#include "core/realtime/wake.hpp"

namespace dibhr {

/// Requests to shut down, from the times of their signals.
class ShutdownRequests {
  public:
    using Time = std::chrono::steady_clock::time_point;

    /// Less than a second, together with the last tick, the last transaction and the crash note.
    static constexpr std::chrono::milliseconds kShutdownTimeout{600};
    /// A terminal that closes, or `timeout`, sends two signals for one request.
    static constexpr std::chrono::milliseconds kRepeatWindow{200};

    /// To be called at each signal. True: it is a second request.
    [[nodiscard]] bool is_repeated(Time now) noexcept;
    /// The rest of kShutdownTimeout after the first request, at least 0; no value: no request yet.
    [[nodiscard]] std::optional<std::chrono::milliseconds> time_left(Time now) const noexcept;

  private:
    std::optional<Time> first_{};
};

/// During its life a thread of its own takes SIGINT, SIGTERM, SIGHUP and SIGQUIT as requests to
/// shut down. If the program still runs after ShutdownRequests::kShutdownTimeout, or at a second
/// request, the thread prints the crash note and exits with status 1. Ctrl+Z is blocked. Construct
/// it before any thread starts.
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
    std::atomic<bool> requested_{false};
    std::atomic<bool> without_force_{false};
    std::atomic<bool> stopping_{false};
    std::atomic<int> display_{-1};
    Wake wake_{};  // when one of the two above has changed
    std::thread thread_{};
};

}  // namespace dibhr
