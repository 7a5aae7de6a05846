// The end that somebody asks for by a signal, or that a display makes that goes away: the force is
// off whatever the window's thread does.
#pragma once

#include <atomic>
#include <chrono>
#include <optional>
#include <thread>

#include "app/window/last_words.hpp"
#include "app/window/signals.hpp"

namespace dibhr {

/// The requests to end, by the times of their signals.
class EndRequests {
  public:
    using Time = std::chrono::steady_clock::time_point;

    /// With the last tick, the recorder's last transaction and the line, less than a second.
    static constexpr std::chrono::milliseconds kPatience{600};
    /// A terminal that closes, or `timeout`, sends two signals for one request.
    static constexpr std::chrono::milliseconds kOneRequest{200};

    /// A signal has come: whether it is another request than the first one.
    [[nodiscard]] bool is_repeated(Time now) noexcept;
    /// What is left of kPatience since the first request, or nothing of it; no value: there was
    /// none.
    [[nodiscard]] std::optional<std::chrono::milliseconds> patience_left(Time now) const noexcept;

  private:
    std::optional<Time> first_{};
};

/// While it lives, SIGINT, SIGTERM, SIGHUP and SIGQUIT are taken by a thread of their own: they ask
/// for the end, and if the program still lives after EndRequests::kPatience, or another one comes,
/// that thread says what hangs and ends it with status 1. Ctrl+Z is held back. Made before any
/// thread is started.
class Ending {
  public:
    /// `words` outlives it. Throws DeviceError when the system has no descriptor left.
    explicit Ending(LastWords& words);
    ~Ending();
    Ending(const Ending&) = delete;
    Ending& operator=(const Ending&) = delete;

    /// To be looked at by any thread: once true, the window closes.
    [[nodiscard]] const std::atomic<bool>& asked() const noexcept { return asked_; }
    /// To be looked at by any thread: once true, no force is sent any more. A signal does it, and
    /// the display's end, of which the thread that draws hears only after its picture.
    [[nodiscard]] const std::atomic<bool>& without_force() const noexcept { return without_force_; }
    /// `connection`: the display server's socket, from here on; -1: none any more.
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
    int told_;  // a descriptor that tells the thread to look at the two above
    std::thread thread_{};
};

}  // namespace dibhr
