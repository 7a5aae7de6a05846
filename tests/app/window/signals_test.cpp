// Signals that shut the viewer down in order, whichever thread they reach.
#include "app/window/signals.hpp"

#include <unistd.h>

#include <condition_variable>
#include <csignal>
#include <mutex>
#include <stop_token>
#include <thread>

#include "tests/support/catch.hpp"
#include "tests/support/eventually.hpp"

using namespace dibhr;
using dibhr::test::eventually;

namespace {

/// Sleeps until a stop is requested.
void idle(const std::stop_token& stop) {
    std::mutex mutex;
    std::condition_variable_any never;
    std::unique_lock lock(mutex);
    never.wait(lock, stop, [] { return false; });
}

/// Whether a signal is pending for this process.
bool is_pending(int signal) {
    sigset_t pending;
    return sigpending(&pending) == 0 && sigismember(&pending, signal) == 1;
}

}  // namespace

TEST_CASE("a wish to end arrives even when a thread that was there before takes the signal",
          "[signals]") {
    const std::jthread foreign(idle);  // blocks no signal
    ShutdownSignals signals;
    const int signal = GENERATE(as<int>{}, SIGTERM, SIGINT, SIGHUP, SIGQUIT);
    CAPTURE(signal);
    for (int k = 0; k < 3; ++k) {
        REQUIRE(::kill(::getpid(), signal) == 0);
        CHECK(eventually([&signals] { return signals.arrived(); }));
    }
}

TEST_CASE("Ctrl+Z neither stops the viewer nor ends it", "[signals]") {
    ShutdownSignals signals;
    REQUIRE(::kill(::getpid(), SIGTSTP) == 0);
    REQUIRE(is_pending(SIGTSTP));
    CHECK_FALSE(signals.arrived());
    CHECK_FALSE(is_pending(SIGTSTP));
}
