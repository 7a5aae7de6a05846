// The rows that the haptic tick pushes to the recorder replay to the same bits.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>

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

/// Two frames a second apart: rough ground that rises.
FrameWindow rising_window(int columns, int rows, float step = 1.0F) {
    FrameWindow window;
    for (std::size_t k = 0; k < 2; ++k) {
        auto image = std::make_shared<DepthImage>();
        image->columns = columns;
        image->rows = rows;
        for (int j = 0; j < rows; ++j) {
            for (int i = 0; i < columns; ++i) {
                const auto steps = static_cast<float>((i * i + 7 * j) % 11);
                image->levels.push_back(90.0F + step * steps + 5.0F * static_cast<float>(k));
            }
        }
        Frame& frame = window.frames.at(k);
        frame.depth = std::move(image);
        frame.time_s = static_cast<double>(k);
        frame.media_s = 10.0 + static_cast<double>(k);
        frame.index = 300 + static_cast<std::int64_t>(k);
        frame.media = 1;
        frame.cleaning = {{.remove_spikes = true, .steady = true}, {3.0, 255.0}};
    }
    window.count = 2;
    window.clock = {bench_time(), 0.0, 1.0};
    return window;
}

/// Finds the window's frames by their times.
class WindowFrames final : public RecordedFrames {
  public:
    explicit WindowFrames(const FrameWindow& window) : window_(window) {}
    [[nodiscard]] Frame frame(const FrameSource& source, double media_s) override {
        CHECK(source == FrameSource{.media = 1,
                                    .remove_spikes = true,
                                    .steady = true,
                                    .finger_px = 3.0,
                                    .finger_relief_px = 255.0});
        return window_.frames.at(media_s > 10.5 ? 1 : 0);
    }
    [[nodiscard]] std::shared_ptr<const BumpMap> bump(const SessionParameters&) override {
        return nullptr;
    }

  private:
    const FrameWindow& window_;
};

/// The hand goes to and fro, in and out of the surface.
void explore(Bench& bench, HapticTick& tick, int count) {
    for (int k = 0; k < count; ++k) {
        bench.hand.goal = {20.0 + 15.0 * std::sin(0.02 * k), 15.0 + 9.0 * std::sin(0.013 * k),
                           88.0 + 14.0 * std::sin(0.03 * k)};
        run_ticks(tick, 1);
    }
}

/// The hand jumps from corner to corner, under the surface, faster than the proxy can follow.
void jump_about(Bench& bench, HapticTick& tick, int columns, int rows) {
    for (int k = 0; k < 12; ++k) {
        bench.hand.goal = {k % 2 == 0 ? 3.0 : columns - 4.0, k % 4 < 2 ? 5.0 : rows - 6.0, 80.0};
        run_ticks(tick, 4);
    }
}

/// Replays a session to the same bits, tick by tick; returns the number of ticks with `flag`.
std::uint64_t replayed(const Session& session, const FrameWindow& window, bool TickRecord::*flag) {
    WindowFrames frames(window);
    SessionReplay replay(session, frames, {{}});
    std::uint64_t flagged = 0;
    while (replay.next()) {
        const TickRecord& recorded = replay.recorded();
        CAPTURE(recorded.tick);
        REQUIRE(same_bits(replay.touch(0), recorded));
        REQUIRE(replay.touch(0).proxy.bound_met == recorded.catching_up);
        flagged += recorded.*flag ? 1 : 0;
    }
    return flagged;
}

/// With stability control: a device that a force moves, and whose energy is controlled.
void watch(Bench& bench, bool stable) {
    bench.handed.limits.stability = stable;
    bench.hand.described.limits.dynamics = {
        .mass_kg = 0.1, .friction_newton_s_per_m = 0.5, .resolution_mm = 0.05, .delay_s = 0.002};
}

}  // namespace

TEST_CASE("every tick is recorded, in order", "[loop]") {
    Bench bench;
    HapticTick tick(bench.connections());
    bench.hand_over();
    bench.frames.publish(flat_window(64, 48, 0));
    run_ticks(tick, 500);
    TickRecord row;
    for (std::int64_t k = 0; k < 500; ++k) {
        REQUIRE(bench.ticks->pop(row));
        REQUIRE(row.tick == k);
    }
    CHECK_FALSE(bench.ticks->pop(row));
}

TEST_CASE("recording can begin and end while the loop runs, and begins as at the start", "[loop]") {
    Bench bench;
    bench.handed.recording = false;
    bench.hand_over();
    bench.frames.publish(flat_window(64, 48, 0));
    HapticTick tick(bench.connections());
    press(bench, tick);
    TickRecord row;
    CHECK_FALSE(bench.ticks->pop(row));
    REQUIRE(bench.hand.sent.z > 0.3);
    bench.handed.recording = true;
    bench.settings.publish(bench.handed);  // the same version
    CHECK(allocations_in([&] { run_ticks(tick, 1500); }) == 0);
    bench.handed.recording = false;
    bench.settings.publish(bench.handed);
    run_ticks(tick, 3);
    double strongest = 0.0;
    for (int k = 0; k < 1500; ++k) {
        REQUIRE(bench.ticks->pop(row));
        if (k == 0) {
            CHECK(row.from_zero);
            CHECK_THAT(row.sent_newton[2], WithinAbs(0.0, 0.0));
        }
        CHECK(row.sent_newton[2] >= strongest);  // it rises again as after any start
        strongest = row.sent_newton[2];
    }
    CHECK(strongest > 0.3);
    CHECK_FALSE(bench.ticks->pop(row));
}

TEST_CASE("what the loop records replays to the same bits, whenever the recording began",
          "[loop]") {
    const TemporaryFolder folder;
    const auto file = folder / "loop.dibhr";
    Bench bench;
    watch(bench, GENERATE(false, true));
    bench.handed.recording = false;
    bench.hand_over();
    FrameWindow window = rising_window(48, 32);
    bench.frames.publish(window);
    HapticTick tick(bench.connections());
    bench.hand.goal = {20.0, 10.0, 90.0};
    press(bench, tick);
    {
        Recorder recorder(file, *bench.ticks, {});
        const auto hand_over = [&] {
            bench.handed.recording = true;
            bench.hand_over();
            recorder.parameters(as_recorded(bench.handed));
        };
        hand_over();
        explore(bench, tick, 400);
        for (const Algorithm algorithm : all_algorithms()) {
            bench.handed.parameters.algorithm = algorithm;
            bench.handed.parameters.friction.static_coefficient += 0.1;
            hand_over();
            explore(bench, tick, 300);
        }
        bench.frames.publish(FrameWindow{});
        run_ticks(tick, 20);
        ++window.discontinuity;
        bench.frames.publish(window);
        explore(bench, tick, 300);
        bench.hand.lifted = true;
        run_ticks(tick, 5);
        bench.hand.lifted = false;
        bench.hand.hand_changed = true;
        explore(bench, tick, 300);
        bench.hand.goal.x = NAN;
        run_ticks(tick, 5);
        bench.hand.goal.x = 20.0;
        bench.hand.own_force_newton = {0.5, NAN, 0.0};
        run_ticks(tick, 5);
        bench.hand.own_force_newton = {0.5, -0.25, 0.1};
        explore(bench, tick, 300);
        bench.hand.limits_now = DeviceLimits{1.0, 0.05, 0.2, 20.0};  // another hand, unannounced
        explore(bench, tick, 300);
        bench.hand.limits_now.reset();
        explore(bench, tick, 300);
    }
    const Session session(file);
    CHECK(session.rows() == 3135);
    CHECK(session.missing() == 0);
    CHECK(replayed(session, window, &TickRecord::contact) > 1000);
}

TEST_CASE("parameters that change in contact, and again on their way, replay to the same bits",
          "[loop]") {
    const TemporaryFolder folder;
    const auto file = folder / "dragged.dibhr";
    Bench bench;
    watch(bench, GENERATE(false, true));
    bench.hand_over();
    const FrameWindow window = rising_window(64, 48, 0.05F);
    bench.frames.publish(window);
    HapticTick tick(bench.connections());
    {
        Recorder recorder(file, *bench.ticks, {});
        for (int k = 0; k < 60; ++k) {
            ++bench.handed.version;
            bench.handed.parameters.coupling.stiffness_newton_per_mm = 0.2 + 0.01 * k;
            bench.handed.parameters.friction = {0.8 - 0.01 * k, 0.2};
            bench.handed.parameters.shape.relief_px = 255.0 + k % 3;
            recorder.parameters(as_recorded(bench.handed));
            bench.settings.publish(bench.handed);
            bench.hand.goal.x = 20.0 + 0.1 * k;
            run_ticks(tick, k % 20 == 0 ? 300 : 17);
        }
    }
    CHECK(replayed(Session(file), window, &TickRecord::gliding) > 1000);
}

TEST_CASE("ticks that end before the proxy has caught up are counted, and replay to the same bits",
          "[loop]") {
    const Algorithm algorithm = GENERATE(from_range(all_algorithms()));
    CAPTURE(name_of(algorithm));
    const TemporaryFolder folder;
    const auto file = folder / "jumps.dibhr";
    Bench bench;
    bench.handed.parameters.algorithm = algorithm;
    bench.hand_over();
    const FrameWindow window = rising_window(640, 480, 0.05F);
    bench.frames.publish(window);
    HapticTick tick(bench.connections());
    {
        Recorder recorder(file, *bench.ticks, {});
        recorder.parameters(as_recorded(bench.handed));
        jump_about(bench, tick, 640, 480);
    }
    const HapticState& last = bench.state.front();
    const std::uint64_t catching_up = replayed(Session(file), window, &TickRecord::catching_up);
    CHECK(catching_up > 12);  // or this would prove little
    CHECK(catching_up < 48);
    CHECK(last.bounds_met == catching_up);
}
