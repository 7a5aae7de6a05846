// The times that a person is promised, by the clock on the wall. What is asserted of each way out
// besides its time is in ways_out_test.cpp and standstill_test.cpp, the promised 250 ms themselves
// on a clock of the test's own in tests/core/loop/standstill_test.cpp.
#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "tests/app/program/falcon_scene.hpp"
#include "tests/app/program/stall.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;

namespace {

using Clock = std::chrono::steady_clock;

/// Three times the promised time, so that other work of the machine does not fail the test.
constexpr double kSpare = 3.0;

double seconds_since(Clock::time_point moment) {
    return std::chrono::duration<double>(Clock::now() - moment).count();
}

struct WayOut {
    const char* name;
    bool dies;  ///< the program does
    double promised_s;
    std::function<void(const FalconScene&, const Stall&)> act;
};

const std::vector<WayOut>& ways_out() {
    static const std::vector<WayOut> all{
        {"the display stops", false, 0.25, [](const auto& at, const auto&) { at.desk.stop(); }},
        {"the window's thread loops", false, 0.25,
         [](const auto& at, const auto&) { at.viewer.hang(); }},
        // It writes ten times a second.
        {"the disk of the recording stops", false, 0.35,
         [](const auto&, const auto& stall) { stall.begin(); }},
        {"the X server dies", true, 0.1, [](const auto& at, const auto&) { at.desk.kill(); }},
        {"the program is killed", true, 0.1,
         [](const auto& at, const auto&) { at.viewer.signal_program(SIGKILL); }},
        {"the program crashes", true, 0.1,
         [](const auto& at, const auto&) { at.viewer.signal_program(SIGSEGV); }},
    };
    return all;
}

}  // namespace

TEST_CASE("each way out takes the force off in the time that is promised", "[ways out][realtime]") {
    const WayOut& way = GENERATE(from_range(ways_out()));
    CAPTURE(way.name);
    std::vector<std::string> commands = kHomedFalcon;
    commands.insert(commands.end(), {"hold 0", "realtime on"});
    const Stall stall("hand.dibhr");
    FalconScene at({.commands = commands,
                    .host = stall.host(),
                    .keeps_packets = true,
                    .desk = Desk::of_its_own()});
    at.press_in();
    const auto moment = Clock::now();
    way.act(at, stall);
    if (way.dies) {
        at.viewer.wait();
    } else {
        at.falcon.wait_for_zeros(200.0);
    }
    const double taken_s = at.seconds_to_zero(moment);
    WARN("viewer, " << way.name << ": zero force after " << taken_s << " s");
    CHECK(taken_s < kSpare * way.promised_s);
    stall.end();
}

TEST_CASE("a signal ends the program within a second, in order or not", "[ways out][realtime]") {
    const bool hangs = GENERATE(false, true);
    FalconScene at;
    at.press_in();
    if (hangs) {
        at.viewer.hang();
        at.falcon.wait_for_zeros(200.0);
    }
    const auto moment = Clock::now();
    at.viewer.send(SIGTERM);
    CHECK(at.viewer.wait() == (hangs ? 1 : 0));
    const double taken_s = seconds_since(moment);
    WARN("SIGTERM to exit" << (hangs ? " of a program that hangs: " : ": ") << taken_s << " s");
    CHECK(taken_s < kSpare);
}

TEST_CASE("a second signal ends a program that hangs at once", "[ways out][realtime]") {
    FalconScene at;
    at.press_in();
    at.viewer.hang();
    at.falcon.wait_for_zeros(200.0);
    at.viewer.interrupt();
    // From 200 ms on it counts as a second request; from 600 ms on none would be needed.
    const auto moment = Clock::now();
    FalconOnUsb::wait_until([&] { return seconds_since(moment) > 0.25; });
    at.viewer.interrupt();
    CHECK(at.viewer.wait() == 1);
    CHECK(contains(at.errors(), "asked twice to end"));
}
