// Signals that end the viewer in order, whichever thread they reach.
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <stop_token>
#include <thread>

#include "app/window/signals.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr;

namespace {

bool arrives(EndingSignals& signals, std::chrono::milliseconds patience) {
    const auto end = std::chrono::steady_clock::now() + patience;
    while (std::chrono::steady_clock::now() < end) {
        if (signals.arrived()) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return false;
}

}  // namespace

TEST_CASE("a wish to end arrives even when a thread that was there before takes the signal",
          "[signals]") {
    const std::jthread foreign([](const std::stop_token& stop) {  // holds nothing back
        while (!stop.stop_requested()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    });
    EndingSignals signals;
    const int signal = GENERATE(as<int>{}, SIGTERM, SIGINT, SIGHUP, SIGQUIT);
    CAPTURE(signal);
    for (int k = 0; k < 3; ++k) {
        REQUIRE(::kill(::getpid(), signal) == 0);
        CHECK(arrives(signals, std::chrono::seconds(5)));
    }
}

TEST_CASE("Ctrl+Z neither stops the viewer nor ends it", "[signals]") {
    EndingSignals signals;
    REQUIRE(::kill(::getpid(), SIGTSTP) == 0);
    CHECK_FALSE(arrives(signals, std::chrono::milliseconds(50)));
}
