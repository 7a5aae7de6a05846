// The haptic tick and its thread, with a hand that the test moves.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <memory>
#include <new>
#include <thread>

#include "app/haptic_loop.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr;
using Catch::Matchers::WithinAbs;

namespace {

thread_local bool counting = false;  // allocations of this thread are counted
thread_local int allocations = 0;

/// A hand at a place the test gives; remembers what it was sent.
class TestHand final : public Device {
  public:
    [[nodiscard]] const DeviceSpecification& specification() const noexcept override {
        return specification_;
    }
    HandReading read(const HandContext&) noexcept override { return {goal, 1, true, lifted}; }
    void send(Vec3 force_newton) noexcept override {
        sent = force_newton;
        strongest = std::max(strongest, glm::length(force_newton));
    }

    Vec3 goal{20.0, 10.0, 90.0};
    bool lifted{false};
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
    std::unique_ptr<TickRing> recording{std::make_unique<TickRing>()};
    HapticSettings handed{};

    HapticConnections connections() {
        return {hand, frames, settings, state, *forces, recording.get()};
    }
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
    TickRecord row;
    CHECK_FALSE(bench.recording->pop(row));
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
        REQUIRE(bench.recording->pop(row));
        REQUIRE(row.tick == k);
    }
    CHECK_FALSE(bench.recording->pop(row));
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
            for (TickRecord row; bench.recording->pop(row);)
                strongest_newton = std::max(strongest_newton, row.sent_newton[2]);
        }
        CHECK(loop.grants().has_value());
    }
    CHECK(strongest_newton >= 0.1);
    CHECK_THAT(glm::length(bench.hand.sent), WithinAbs(0.0, 0.0));
}
