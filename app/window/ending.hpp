// Shutdown by a signal, or because the display is lost: the force goes off, whatever the window's
// thread does.
#pragma once

#include <atomic>
#include <chrono>
#include <optional>
#include <thread>

#include "app/window/last_words.hpp"
#include "app/window/signals.hpp"

namespace dibhr {

/// Requests to shut down, from the times of their signals.
class EndRequests {
  public:
    using Time = std::chrono::steady_clock::time_point;

    /// Less than a second, together with the last tick, the last transaction and the crash note.
    static constexpr std::chrono::milliseconds kPatience{600};
    /// A terminal that closes, or `timeout`, sends two signals for one request.
    static constexpr std::chrono::milliseconds kOneRequest{200};

    /// To be called at each signal. True: it is a second request.
    [[nodiscard]] bool is_repeated(Time now) noexcept;
    /// The rest of kPatience after the first request, at least 0; no value: no request yet.
    [[nodiscard]] std::optional<std::chrono::milliseconds> patience_left(Time now) const noexcept;

  private:
    std::optional<Time> first_{};
};

/// During its life a thread of its own takes SIGINT, SIGTERM, SIGHUP and SIGQUIT as requests to
/// shut down. If the program still runs after EndRequests::kPatience, or at a second request, the
/// thread prints the crash note and exits with status 1. Ctrl+Z is blocked. Construct it before any
/// thread starts.
class Ending {
  public:
    /// `words` must outlive it. Throws DeviceError when the system has no descriptor left.
    explicit Ending(LastWords& words);
    ~Ending();
    Ending(const Ending&) = delete;
    Ending& operator=(const Ending&) = delete;

    /// For any thread to poll: once true, the window closes.
    [[nodiscard]] const std::atomic<bool>& asked() const noexcept { return asked_; }
    /// For any thread to poll: once true, no force is sent. Set by a signal, and by the loss of the
    /// display, which the drawing thread notices only after its picture.
    [[nodiscard]] const std::atomic<bool>& without_force() const noexcept { return without_force_; }
    /// `connection`: the display server's socket, watched from now on; -1: none.
    void watch_display(int connection);
    [[nodiscard]] LastWords& words() noexcept { return words_; }

  private:
    void run();

    LastWords& words_;
    EndingSignals signals_{};
    std::atomic<bool> asked_{false};
    std::atomic<bool> without_force_{false};
    std::atomic<bool> over_{false};
    std::atomic<int> display_{-1};
    int told_;  // an eventfd: wakes the thread when one of the two above has changed
    std::thread thread_{};
};

}  // namespace dibhr
