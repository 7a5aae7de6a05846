// A loop whose hand rests: its ticks may be farther apart until something happens.
#include <chrono>
#include <vector>

#include "tests/core/loop/loop_bench.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr;
using namespace dibhr::test;

namespace {

/// A hand that says that it rests, 10 px above the surface.
struct RestingBench : Bench {
    RestingBench() {
        hand.goal.z = 110.0;
        hand.resting = true;
        handed.recording = false;
        hand_over();
        frames.publish(flat_window(64, 48, 0));
    }
    HapticTick tick{connections()};
};

/// A second video frame is under way.
FrameWindow playing_window() {
    FrameWindow window = flat_window(64, 48, 0);
    window.frames[1] = flat_frame(64, 48, 100.0F);
    window.frames[1].time_s = 10.0;
    window.count = 2;
    window.clock = {bench_time(), 0.0, 1.0};
    return window;
}

}  // namespace

TEST_CASE("a hand that rests above the surface for half a second lets the loop rest", "[loop]") {
    RestingBench bench;
    run_ticks(bench.tick, 490);
    CHECK_FALSE(bench.tick.rests());
    run_ticks(bench.tick, 20);
    CHECK(bench.tick.rests());
    CHECK(bench.state.front().rests);
    CHECK(bench.state.front().touchable);
}

TEST_CASE("the tick that sees that something happens ends the loop's rest", "[loop]") {
    const auto happens = GENERATE(
        as<void (*)(Bench&)>{}, [](Bench& bench) { bench.hand.resting = false; },
        [](Bench& bench) { bench.hand.goal.z = 90.0; },
        [](Bench& bench) { bench.hand.hand_changed = true; },
        [](Bench& bench) {
            bench.handed.parameters.friction.static_coefficient = 0.9;
            bench.hand_over();
        },
        [](Bench& bench) {
            bench.handed.recording = true;
            bench.hand_over();
        },
        [](Bench& bench) { bench.frames.publish(flat_window(64, 48, 1)); },
        [](Bench& bench) { bench.frames.publish(playing_window()); },
        [](Bench& bench) { bench.frames.publish({}); });
    RestingBench bench;
    run_ticks(bench.tick, 600);
    REQUIRE(bench.tick.rests());
    happens(bench);
    run_ticks(bench.tick, 1);
    CHECK_FALSE(bench.tick.rests());
    CHECK_FALSE(bench.state.front().rests);
}

TEST_CASE("a tick of several periods leaves a strip for each, and its work once", "[loop]") {
    RestingBench bench;
    run_ticks(bench.tick, 1);
    TickStrip strip;
    while (bench.strips->pop(strip)) continue;
    bench_time() += std::chrono::milliseconds(kRestingPeriods);
    bench.hand.goal.x += 1.0;
    bench.tick.run({bench_time(), 0.001 * kRestingPeriods, {}, false, kRestingPeriods}, 0);
    std::vector<TickStrip> strips;
    while (bench.strips->pop(strip)) strips.push_back(strip);
    REQUIRE(strips.size() == kRestingPeriods);
    CHECK(strips.back().speed_mm_per_s == strips.front().speed_mm_per_s);
    for (std::size_t k = 1; k < strips.size(); ++k) CHECK(strips[k].work_millijoule == 0.0F);
}
