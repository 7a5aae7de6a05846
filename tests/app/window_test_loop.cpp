// The haptic tick and its thread, with a hand that the test moves.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <memory>
#include <new>
#include <thread>
#include <utility>

#include "app/haptic_loop.hpp"
#include "core/session/recorder.hpp"
#include "core/session/session.hpp"
#include "core/session/session_replay.hpp"
#include "tests/app/window_test_desk.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr;
using Catch::Matchers::WithinAbs;
using dibhr::test::TemporaryFolder;

namespace {

thread_local bool counting = false;  // allocations of this thread are counted
thread_local int allocations = 0;

/// A hand at a place the test gives; remembers what it was sent.
class TestHand final : public Device {
  public:
    [[nodiscard]] const DeviceSpecification& specification() const noexcept override {
        return specification_;
    }
    HandReading read(const HandContext&) noexcept override {
        return {.goal_in_grid = goal,
                .buttons = 1,
                .lifted = lifted,
                .taken_over = std::exchange(taken_over, false),
                .force_off = force_off,
                .own_force_newton = own_force_newton};
    }
    void send(Vec3 force_newton) noexcept override {
        sent = force_newton;
        strongest = std::max(strongest, glm::length(force_newton));
    }

    Vec3 goal{20.0, 10.0, 90.0};
    bool lifted{false};
    bool taken_over{false};  // by the next reading
    bool force_off{false};
    Vec3 own_force_newton{0.0};
    Vec3 sent{-1.0};
    double strongest{0.0};

  private:
    DeviceSpecification specification_{};
};

Frame flat_frame(int columns, int rows, float level) {
    auto image = std::make_shared<DepthImage>();
    image->columns = columns;
    image->rows = rows;
    image->levels.assign(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), level);
    Frame frame;
    frame.depth = image;
    return frame;
}

FrameWindow flat_window(int columns, int rows, std::uint64_t discontinuity) {
    FrameWindow window;
    window.frames[0] = flat_frame(columns, rows, 100.0F);
    window.count = 1;
    window.discontinuity = discontinuity;
    return window;
}

/// A tick with all it is connected to. The surface is flat at 100 px; the hand is 10 px under it.
struct Bench {
    TestHand hand{};
    TripleBuffer<FrameWindow> frames{};
    TripleBuffer<HapticSettings> settings{};
    TripleBuffer<HapticState> state{};
    std::unique_ptr<ForceRing> forces{std::make_unique<ForceRing>()};
    std::unique_ptr<TickRing> ticks{std::make_unique<TickRing>()};
    HapticSettings handed{.recording = true};

    HapticConnections connections() { return {hand, frames, settings, state, *forces, *ticks}; }
    void hand_over() {
        ++handed.version;
        settings.publish(handed);
    }
};

void run_ticks(HapticTick& tick, int count) {
    for (int k = 0; k < count; ++k)
        tick.run({std::chrono::steady_clock::now(), 0.001, {}, false}, 0);
}

/// Lets the hand come from above, so that it is in contact and the force has risen.
void press(Bench& bench, HapticTick& tick) {
    const Vec3 pressed = bench.hand.goal;
    for (double z = pressed.z + 15.0; z > pressed.z; z -= 0.5) {
        bench.hand.goal.z = z;
        run_ticks(tick, 1);
    }
    bench.hand.goal = pressed;
    run_ticks(tick, 1500);
}

/// Two frames that a second lies between: a slope that rises.
FrameWindow rising_window(int columns, int rows) {
    FrameWindow window;
    for (std::size_t k = 0; k < 2; ++k) {
        auto image = std::make_shared<DepthImage>();
        image->columns = columns;
        image->rows = rows;
        for (int j = 0; j < rows; ++j) {
            for (int i = 0; i < columns; ++i) {
                image->levels.push_back(90.0F + static_cast<float>((i * i + 7 * j) % 11) +
                                        5.0F * static_cast<float>(k));
            }
        }
        Frame& frame = window.frames.at(k);
        frame.depth = std::move(image);
        frame.time_s = static_cast<double>(k);
        frame.media_s = 10.0 + static_cast<double>(k);
        frame.index = 300 + static_cast<std::int64_t>(k);
        frame.media = 1;
        frame.cleaning = {false, true, false};
    }
    window.count = 2;
    window.clock = {std::chrono::steady_clock::now(), 0.0, 1.0};
    return window;
}

/// Gives the window's frames back by their times.
class WindowFrames final : public RecordedFrames {
  public:
    explicit WindowFrames(const FrameWindow& window) : window_(window) {}
    [[nodiscard]] std::shared_ptr<const DepthImage> depth(const FrameSource& source,
                                                          double media_s) override {
        CHECK(source == FrameSource{1, false, true, false});
        return window_.frames.at(media_s > 10.5 ? 1 : 0).depth;
    }
    [[nodiscard]] const BumpMap* bump(const SessionParameters&) override { return nullptr; }

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

}  // namespace

// Not inlined, or the compiler sees malloc's memory given to delete and warns.
[[gnu::noinline]] void* operator new(std::size_t size) {
    if (counting) ++allocations;
    if (void* memory = std::malloc(size > 0 ? size : 1)) return memory;
    throw std::bad_alloc{};
}
[[gnu::noinline]] void operator delete(void* memory) noexcept {
    std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept {
    std::free(memory);
}

TEST_CASE("without a surface the loop sends zero force and updates nothing", "[loop]") {
    Bench bench;
    HapticTick tick(bench.connections());
    bench.hand_over();
    run_ticks(tick, 3);
    CHECK_THAT(glm::length(bench.hand.sent), WithinAbs(0.0, 0.0));
    CHECK_FALSE(bench.state.front().touchable);
    for (std::int64_t k = 0; k < 3; ++k) {
        TickRecord row;
        REQUIRE(bench.ticks->pop(row));
        CHECK(row.tick == k);
        CHECK_FALSE(row.surface);
    }
}

TEST_CASE("a tick in contact allocates nothing, even when settings and surface change", "[loop]") {
    Bench bench;
    HapticTick tick(bench.connections());
    bench.hand_over();
    bench.frames.publish(flat_window(64, 48, 0));
    press(bench, tick);
    REQUIRE(bench.state.front().touch.proxy.contact);
    bench.handed.parameters.friction.static_coefficient = 0.9;
    bench.hand_over();
    bench.frames.publish(flat_window(64, 48, 1));
    allocations = 0;
    counting = true;
    run_ticks(tick, 100);
    counting = false;
    CHECK(allocations == 0);
    counting = true;
    ::operator delete(::operator new(1));
    counting = false;
    CHECK(allocations == 1);  // the count does count
}

TEST_CASE("a changed parameter acts on the next tick, and the force rises again from zero",
          "[loop]") {
    Bench bench;
    HapticTick tick(bench.connections());
    bench.hand_over();
    bench.frames.publish(flat_window(64, 48, 0));
    press(bench, tick);
    const double spring = bench.state.front().touch.spring_force_newton.z;
    REQUIRE_THAT(bench.hand.sent.z, WithinAbs(spring, 1e-9));
    bench.handed.parameters.coupling.stiffness_newton_per_mm *= 2.0;
    bench.hand_over();
    run_ticks(tick, 1);
    CHECK_THAT(bench.state.front().touch.spring_force_newton.z, WithinAbs(2.0 * spring, 1e-9));
    run_ticks(tick, 10);
    CHECK(bench.hand.sent.z < 0.5 * spring);
    run_ticks(tick, 1500);
    CHECK_THAT(bench.hand.sent.z, WithinAbs(2.0 * spring, 1e-9));
}

TEST_CASE("a seek or a new file lets the force rise again from zero", "[loop]") {
    Bench bench;
    HapticTick tick(bench.connections());
    bench.hand_over();
    bench.frames.publish(flat_window(64, 48, 0));
    press(bench, tick);
    const double before = bench.hand.sent.z;
    bench.frames.publish(flat_window(64, 48, 1));
    run_ticks(tick, 10);
    CHECK(bench.hand.sent.z < 0.5 * before);
}

TEST_CASE("a smaller film under a pressed hand leaves the proxy on the new surface", "[loop]") {
    Bench bench;
    HapticTick tick(bench.connections());
    bench.hand_over();
    bench.frames.publish(flat_window(64, 48, 0));
    bench.hand.goal = {60.0, 40.0, 90.0};
    press(bench, tick);
    bench.frames.publish(flat_window(16, 8, 1));
    run_ticks(tick, 5);
    const Proxy& proxy = bench.state.front().touch.proxy;
    CHECK(proxy.position.x <= 15.0);
    CHECK(proxy.position.y <= 7.0);
    CHECK_THAT(proxy.position.z, WithinAbs(100.0, 1e-9));
}

TEST_CASE("after a moment without a surface the force begins from zero", "[loop]") {
    Bench bench;
    bench.hand_over();
    bench.frames.publish(flat_window(64, 48, 0));
    HapticTick tick(bench.connections());
    run_ticks(tick, 700);
    REQUIRE(glm::length(bench.hand.sent) > 0.3);
    bench.frames.publish(FrameWindow{});
    run_ticks(tick, 1);
    CHECK_THAT(glm::length(bench.hand.sent), WithinAbs(0.0, 0.0));
    bench.frames.publish(flat_window(64, 48, 0));
    run_ticks(tick, 1);
    CHECK_THAT(glm::length(bench.hand.sent), WithinAbs(0.0, 1e-12));
}

TEST_CASE("a hand that is lifted lets go where its way out is barred", "[loop]") {
    // A wall between proxy and hand: the proxy pressed into its foot cannot follow over it.
    Bench bench;
    bench.hand_over();
    FrameWindow window = flat_window(64, 48, 0);
    auto wall = std::make_shared<DepthImage>(*window.frames[0].depth);
    for (int j = 0; j < 48; ++j) wall->at(30, j) = 250.0F;
    window.frames[0].depth = wall;
    bench.frames.publish(window);
    HapticTick tick(bench.connections());
    run_ticks(tick, 100);
    bench.hand.goal = {40.0, 10.0, 110.0};  // beyond the wall, above the ground there
    run_ticks(tick, 100);
    REQUIRE(bench.state.front().touch.proxy.contact);
    bench.hand.lifted = true;
    run_ticks(tick, 2);
    CHECK_FALSE(bench.state.front().touch.proxy.contact);
    CHECK_THAT(glm::length(bench.hand.sent),
               WithinAbs(0.0, 0.6));  // no more than a step of the slew limit
    run_ticks(tick, 20);
    CHECK_THAT(glm::length(bench.hand.sent), WithinAbs(0.0, 1e-12));
}

TEST_CASE(
    "a hand that takes over lets go of what the last one touched, and the force begins from zero",
    "[loop]") {
    Bench bench;
    bench.hand_over();
    bench.frames.publish(flat_window(64, 48, 0));
    HapticTick tick(bench.connections());
    press(bench, tick);
    REQUIRE(bench.hand.sent.z > 0.3);
    bench.hand.goal.z += 1.0;  // another hand, a little higher, under the surface too
    bench.hand.taken_over = true;
    run_ticks(tick, 1);
    CHECK_THAT(glm::length(bench.hand.sent), WithinAbs(0.0, 0.0));
    run_ticks(tick, 5);
    CHECK_THAT(glm::length(bench.hand.sent), WithinAbs(0.0, 0.05));
}

TEST_CASE("the hand's own button takes the force off in the same tick, until it is put on again",
          "[loop]") {
    Bench bench;
    bench.hand_over();
    bench.frames.publish(flat_window(64, 48, 0));
    HapticTick tick(bench.connections());
    press(bench, tick);
    REQUIRE(bench.hand.sent.z > 0.3);
    bench.hand.force_off = true;
    run_ticks(tick, 1);
    CHECK_THAT(glm::length(bench.hand.sent), WithinAbs(0.0, 0.0));
    bench.hand.force_off = false;  // let go before the window has seen it
    run_ticks(tick, 1000);
    CHECK_THAT(glm::length(bench.hand.sent), WithinAbs(0.0, 0.0));
    bench.handed.force_enabled = false;  // the window switches the force off, the person on again
    bench.hand_over();
    run_ticks(tick, 1);
    bench.handed.force_enabled = true;
    bench.hand_over();
    run_ticks(tick, 1000);
    CHECK(bench.hand.sent.z > 0.3);
}

TEST_CASE("what the device itself adds is limited like the rest and ends with the force",
          "[loop]") {
    Bench bench;
    bench.hand_over();
    bench.frames.publish(flat_window(64, 48, 0));
    HapticTick tick(bench.connections());
    bench.hand.goal.z = 150.0;  // in the air
    bench.hand.own_force_newton = {0.0, 0.0, -100.0};
    run_ticks(tick, 1500);
    const SafetyLimits limits;
    CHECK_THAT(glm::length(bench.state.front().touch.spring_force_newton), WithinAbs(0.0, 0.0));
    CHECK_THAT(bench.hand.sent.z, WithinAbs(-limits.max_force_newton, 1e-9));
    bench.handed.force_enabled = false;
    bench.hand_over();
    run_ticks(tick, 1);
    CHECK_THAT(glm::length(bench.hand.sent), WithinAbs(0.0, 0.0));
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
    allocations = 0;
    counting = true;
    run_ticks(tick, 1500);
    counting = false;
    CHECK(allocations == 0);
    bench.handed.recording = false;
    bench.settings.publish(bench.handed);
    run_ticks(tick, 3);
    double strongest = 0.0;
    for (int k = 0; k < 1500; ++k) {
        REQUIRE(bench.ticks->pop(row));
        if (k == 0) {
            CHECK(row.restart);
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
            recorder.parameters({.version = bench.handed.version,
                                 .touch = bench.handed.parameters,
                                 .limits = bench.handed.limits,
                                 .force_enabled = bench.handed.force_enabled,
                                 .bump = {}});
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
        bench.hand.taken_over = true;
        explore(bench, tick, 300);
        bench.hand.goal.x = NAN;
        run_ticks(tick, 5);
        bench.hand.goal.x = 20.0;
        bench.hand.own_force_newton = {0.5, NAN, 0.0};
        run_ticks(tick, 5);
        bench.hand.own_force_newton = {0.5, -0.25, 0.1};
        explore(bench, tick, 300);
    }
    const Session session(file);
    CHECK(session.rows() == 2535);
    CHECK(session.missing() == 0);
    WindowFrames frames(window);
    SessionReplay replay(session, frames, {{}});
    int in_contact = 0;
    while (replay.next()) {
        CAPTURE(replay.recorded().tick);
        REQUIRE(same_bits(replay.touch(0), replay.recorded()));
        in_contact += replay.recorded().contact ? 1 : 0;
    }
    CHECK(in_contact > 1000);
}

TEST_CASE("force off is zero on the next tick", "[loop]") {
    Bench bench;
    HapticTick tick(bench.connections());
    bench.hand_over();
    bench.frames.publish(flat_window(64, 48, 0));
    press(bench, tick);
    REQUIRE(bench.hand.sent.z > 0.1);
    bench.handed.force_enabled = false;
    bench.hand_over();
    run_ticks(tick, 1);
    CHECK_THAT(glm::length(bench.hand.sent), WithinAbs(0.0, 0.0));
}

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

TEST_CASE("a loop that ends in contact has sent zero force last", "[loop]") {
    Bench bench;
    bench.hand_over();
    bench.frames.publish(flat_window(64, 48, 0));
    bench.hand.goal.z = 90.0;
    double strongest_newton = 0.0;
    {
        HapticLoop loop(bench.connections());
        const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(20);
        while (strongest_newton < 0.1 && std::chrono::steady_clock::now() < give_up) {
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
            for (TickRecord row; bench.ticks->pop(row);)
                strongest_newton = std::max(strongest_newton, row.sent_newton[2]);
        }
        CHECK(loop.grants().has_value());
    }
    CHECK(strongest_newton >= 0.1);
    CHECK_THAT(glm::length(bench.hand.sent), WithinAbs(0.0, 0.0));
}
