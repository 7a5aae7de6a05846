// The thread waits for a signal or the loss of the display, then for the end of the program.
#include "app/window/shutdown_watchdog.hpp"

#include <poll.h>
#include <pthread.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>

namespace dibhr {

bool ShutdownRequests::is_repeated(Time now) noexcept {
    if (first_) return now - *first_ >= kRepeatWindow;
    first_ = now;
    return false;
}

bool ShutdownRequests::is_hung(Time now, Time::duration turn,
                               Time::duration silence) const noexcept {
    if (!first_) return false;
    const auto waited = now - *first_;
    if (waited >= kLongestPatience) return true;
    if (turn > Time::duration::zero())
        return waited >= std::max<Time::duration>(kPatience, 2 * turn);
    return silence >= kPatience;
}

ShutdownWatchdog::ShutdownWatchdog(CrashNote& crash_note) : crash_note_(crash_note) {
    heart_.count_computing_as_beat();
    thread_ = std::thread([this] { run(); });
}

ShutdownWatchdog::~ShutdownWatchdog() {
    stopping_ = true;
    wake_.signal();
    thread_.join();
}

void ShutdownWatchdog::watch_display(int connection) {
    display_ = connection;
    wake_.signal();
}

void ShutdownWatchdog::begin_turn() noexcept {
    const auto now = ShutdownRequests::Time::clock::now();
    const auto began = turn_began_.exchange(now);
    if (began != ShutdownRequests::Time())
        turn_ = std::max(now - began, turn_.load() - turn_.load() / 8);
}

ShutdownRequests::Time::duration ShutdownWatchdog::longest_turn(
    ShutdownRequests::Time::duration running) const noexcept {
    const auto turn = turn_.load();
    return turn > ShutdownRequests::Time::duration::zero() ? std::max(turn, running) : turn;
}

void ShutdownWatchdog::run() {
    using Clock = std::chrono::steady_clock;
    constexpr int kCheck_ms = 20;
    pthread_setname_np(pthread_self(), "dibhr-signals");
    ShutdownRequests requests;
    HeartbeatMonitor monitor(&heart_);
    // The turn at the first request may be the longest one: the first relief takes a second.
    Clock::duration running{};
    bool again = false;
    while (!again) {
        const auto now = Clock::now();
        if (requests.is_hung(now, longest_turn(running), monitor.silence(now))) break;
        int display = display_;
        std::array<pollfd, 3> ready{{{wake_.descriptor(), POLLIN, 0},
                                     {signals_.descriptor(), POLLIN, 0},
                                     {display, POLLRDHUP, 0}}};
        poll(ready.data(), ready.size(), requests.any() ? kCheck_ms : -1);
        if (stopping_) return;
        if (ready[0].revents != 0) wake_.clear();
        // Unless watch_display() has replaced the display meanwhile.
        if (ready[2].revents != 0 && display_.compare_exchange_strong(display, -1))
            without_force_ = true;
        if (!signals_.arrived()) continue;
        if (!requests.any()) {
            heart_.beat();
            running = Clock::now() - turn_began_.load();
        }
        again = requests.is_repeated(Clock::now());
        without_force_ = true;
        requested_ = true;
    }
    crash_note_.keep_clip();
    crash_note_.print({again ? "asked twice to end" : "asked to end", ", but hung while ",
                       crash_note_.activity(), "; the force is off, ended at once"});
    _exit(EXIT_FAILURE);
}

}  // namespace dibhr
