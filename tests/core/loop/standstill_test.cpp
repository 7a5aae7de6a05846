// While window, video or recorder stands still the force is off; then it returns by the ramp.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/loop/haptic_tick.hpp"
#include "core/replay/session_replay.hpp"
#include "core/session/recorder.hpp"
#include "core/session/session.hpp"
#include "tests/core/loop/loop_bench.hpp"
#include "tests/support/allocations.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace dibhr;
using namespace dibhr::test;
using Catch::Matchers::WithinAbs;

namespace {

/// A hand that presses with 3.8 N, while three heartbeats are monitored.
struct ListeningBench : Bench {
    ListeningBench() {
        hand.described.limits.max_stiffness_newton_per_mm = 10.0;
        handed.parameters.coupling.stiffness_newton_per_mm =
            3.8 / (10.0 * handed.parameters.coupling.pixel_pitch_mm);
        hand_over();
        frames.publish(flat_window(64, 48, 0));
        press(*this, tick);
        for (Heartbeat* heart : {&window, &video, &recorder}) heart->beat(bench_time());
    }
    HapticConnections listening() {
        HapticConnections all = connections();
        all.hearts = {&window, &video, &recorder};
        all.without_force = &without_force;
        return all;
    }
    /// Ticks of a millisecond, with the force that each sent.
    std::vector<double> run(int count) {
        std::vector<double> sent;
        for (int k = 0; k < count; ++k) {
            run_ticks(tick, 1);
            sent.push_back(hand.sent.z);
        }
        return sent;
    }
    /// All heartbeats are idle: none is expected.
    void set_idle() {
        for (Heartbeat* heart : {&window, &video, &recorder}) heart->set_idle();
    }

    Heartbeat window{}, video{}, recorder{};
    std::atomic<bool> without_force{false};
    HapticTick tick{listening()};
};

}  // namespace

TEST_CASE(
    "250 ms after the last beat of window, video or recorder the force is zero, straight down",
    "[loop]") {
    const int silent = GENERATE(0, 1, 2);
    CAPTURE(silent);
    ListeningBench bench;
    REQUIRE_THAT(bench.hand.sent.z, WithinAbs(3.8, 1e-6));
    Heartbeat* const hearts[]{&bench.window, &bench.video, &bench.recorder};
    for (int k = 0; k < 3; ++k) {
        if (k != silent) hearts[k]->set_idle();
    }
    CHECK(allocations_in([&] { run_ticks(bench.tick, 1); }) == 0);
    const std::vector<double> sent = bench.run(299);
    for (std::size_t k = 1; k < sent.size(); ++k) {
        CAPTURE(k);
        CHECK(sent[k] <= sent[k - 1]);
        CHECK(sent[k - 1] - sent[k] <= 3.8 / 40.0 + 1e-9);
    }
    CHECK_THAT(sent[190], WithinAbs(3.8, 1e-6));
    CHECK_THAT(sent[220], WithinAbs(3.8 / 2.0, 0.4));
    CHECK_THAT(sent[248], WithinAbs(0.0, 0.0));
    CHECK(bench.state.front().touch.cut == SafetyCut::standstill);
    CHECK(bench.state.front().standstill.count == 0);  // it is not over
    bench.set_idle();
    const std::vector<double> back = bench.run(700);
    CHECK(back.front() < 0.01);
    for (std::size_t k = 1; k < back.size(); ++k) CHECK(back[k] >= back[k - 1]);
    CHECK_THAT(back[250], WithinAbs(3.8 / 2.0, 0.1));
    CHECK_THAT(back.back(), WithinAbs(3.8, 1e-6));
    const Standstill& last = bench.state.front().standstill;
    CHECK(last.count == 1);
    CHECK(static_cast<int>(last.thread) == silent);
    CHECK_THAT(last.seconds, WithinAbs(0.3, 0.05));
}

TEST_CASE("a beat that comes back while the force goes down lets it rise again, without a jump",
          "[loop]") {
    ListeningBench bench;
    std::vector<double> sent = bench.run(220);
    REQUIRE(sent.back() > 0.5);
    REQUIRE(sent.back() < 3.7);
    bench.set_idle();
    for (const double force : bench.run(700)) sent.push_back(force);
    for (std::size_t k = 1; k < sent.size(); ++k) {
        CHECK(std::abs(sent[k] - sent[k - 1]) <= SafetyLimits{}.max_change_newton_per_ms + 1e-9);
    }
    CHECK_THAT(sent.back(), WithinAbs(3.8, 1e-6));
}

TEST_CASE("a standstill in which nothing was touched is not told", "[loop]") {
    ListeningBench bench;
    bench.hand.goal.z += 50.0;
    bench.run(300);
    bench.set_idle();
    bench.run(10);
    CHECK(bench.state.front().standstill.count == 0);
}

TEST_CASE("a hand without motors waits two seconds, and its standstill is not told", "[loop]") {
    ListeningBench bench;
    bench.hand.harmless = true;
    CHECK(bench.run(1900).back() > 3.7);
    CHECK(bench.run(300).back() < 1e-12);
    CHECK(bench.state.front().touch.cut == SafetyCut::standstill);
    bench.set_idle();
    bench.run(10);
    CHECK(bench.state.front().standstill.count == 0);
}

TEST_CASE("once the program is to end no tick sends a force", "[loop]") {
    ListeningBench bench;
    bench.set_idle();
    REQUIRE(bench.run(10).back() > 3.7);
    bench.without_force = true;
    for (const double force : bench.run(50)) CHECK_THAT(force, WithinAbs(0.0, 0.0));
}

namespace {

class FlatFrames final : public RecordedFrames {
  public:
    [[nodiscard]] Frame frame(const FrameSource&, double) override {
        return flat_frame(64, 48, 100.0F);
    }
    [[nodiscard]] std::shared_ptr<const BumpMap> bump(const SessionParameters&) override {
        return nullptr;
    }
};

}  // namespace

TEST_CASE("a recording of standstills replays to the same bits", "[loop]") {
    const TemporaryFolder folder;
    const auto file = folder / "still.dibhr";
    ListeningBench bench;
    bench.set_idle();
    TickRecord before;
    while (bench.ticks->pop(before)) continue;
    bench.handed.recording = false;
    bench.hand_over();
    bench.run(1);
    {
        Recorder recorder(file, *bench.ticks, {});
        bench.handed.recording = true;
        bench.hand_over();
        recorder.parameters(as_recorded(bench.handed));
        bench.run(600);
        for (const int length : {220, 300, 205, 450}) {
            bench.window.beat(bench_time());
            bench.run(length);
            bench.set_idle();
            bench.run(length == 205 ? 3 : 400);
        }
    }
    const Session session(file);
    FlatFrames frames;
    SessionReplay replay(session, frames, {{}});
    int still = 0;
    double least = 4.0;
    while (replay.next()) {
        const TickRecord& recorded = replay.recorded();
        CAPTURE(recorded.tick);
        REQUIRE(same_bits(replay.touch(0), recorded));
        if (recorded.standstill) least = std::min(least, recorded.sent_newton.z);
        still += recorded.standstill ? 1 : 0;
    }
    CHECK(still > 300);  // or this would prove little
    CHECK_THAT(least, WithinAbs(0.0, 0.0));
}

TEST_CASE(
    "a live surface whose signal is lost takes the force off in 40 ms, and ramps when it is back",
    "[loop]") {
    ListeningBench bench;
    bench.set_idle();
    FrameWindow window = flat_window(64, 48, 0);
    window.silent = true;
    bench.frames.publish(window);
    const std::vector<double> sent = bench.run(42);
    CHECK_THAT(sent.front(), WithinAbs(3.8, 0.2));
    CHECK(std::is_sorted(sent.rbegin(), sent.rend()));
    CHECK_THAT(sent.back(), WithinAbs(0.0, 0.0));
    bench.frames.publish(flat_window(64, 48, 1));
    const std::vector<double> back = bench.run(700);
    CHECK(back.front() < 0.01);
    CHECK(std::is_sorted(back.begin(), back.end()));
    CHECK_THAT(back.back(), WithinAbs(3.8, 1e-6));
}
