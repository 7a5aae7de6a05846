// The haptic tick and its thread: which force is rendered, and when it is switched off.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/geometric.hpp>
#include <memory>
#include <new>
#include <vector>

#include "core/loop/haptic_tick.hpp"
#include "tests/core/loop/loop_bench.hpp"
#include "tests/support/allocations.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/eventually.hpp"

using namespace dibhr;
using namespace dibhr::test;
using Catch::Matchers::WithinAbs;

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
    PressingBench bench;
    HapticTick& tick = bench.tick;
    REQUIRE(bench.state.front().touch.proxy.contact);
    bench.handed.parameters.friction.static_coefficient = 0.9;
    bench.hand_over();
    bench.frames.publish(flat_window(64, 48, 1));
    CHECK(allocations_in([&] { run_ticks(tick, 100); }) == 0);
    // The count does count.
    CHECK(allocations_in([] { ::operator delete(::operator new(1)); }) == 1);
}

TEST_CASE("a changed parameter takes the force straight to what it will be, in a tenth of a second",
          "[loop]") {
    PressingBench bench;
    HapticTick& tick = bench.tick;
    const double spring = bench.state.front().touch.spring_force_newton.z;
    REQUIRE_THAT(bench.hand.sent.z, WithinAbs(spring, 1e-9));
    bench.handed.parameters.coupling.stiffness_newton_per_mm *= 2.0;
    bench.hand_over();
    for (int k = 1; k <= 100; ++k) {
        CAPTURE(k);
        run_ticks(tick, 1);
        CHECK_THAT(bench.hand.sent.z, WithinAbs(spring * (1.0 + 0.01 * k), 1e-9));
    }
    run_ticks(tick, 100);
    CHECK_THAT(bench.hand.sent.z, WithinAbs(2.0 * spring, 1e-12));
}

TEST_CASE("the window is told the shape that is felt, which is on its way to what is set",
          "[loop]") {
    PressingBench bench;
    HapticTick& tick = bench.tick;
    bench.handed.parameters.shape.relief_px += 10.0;
    bench.hand_over();
    for (const double way : {5.0, 10.0}) {
        run_ticks(tick, 50);
        const HapticState& state = bench.state.front();
        CHECK_THAT(state.shape.relief_px, WithinAbs(255.0 + way, 1e-9));
        CHECK_THAT(state.touch.proxy.position.z,
                   WithinAbs(100.0 * state.shape.relief_px / 255.0, 1e-9));
    }
}

TEST_CASE("whatever is changed in contact, no tick's force is off the line from old to new",
          "[loop]") {
    const auto change = GENERATE(
        as<void (*)(HapticSettings&)>{},
        [](HapticSettings& s) {
            s.parameters.friction = {0.9, 0.1};
        },
        [](HapticSettings& s) { s.parameters.coupling.stiffness_newton_per_mm = 0.2; },
        [](HapticSettings& s) { s.parameters.coupling.damping_newton_s_per_m = 5.0; },
        [](HapticSettings& s) { s.parameters.shape.relief_px = 257.0; },
        [](HapticSettings& s) { s.parameters.shape.roughness_px = 2.0; });
    Bench bench;
    HapticTick tick(bench.connections());
    bench.handed.bump = std::make_shared<const BumpMap>(BumpMap{2, 1, {0.0F, 1.0F}});
    bench.hand_over();
    bench.frames.publish(flat_window(64, 48, 0));
    press(bench, tick);
    const double before = bench.hand.sent.z;
    REQUIRE(before > 0.5);
    change(bench.handed);
    bench.hand_over();
    std::vector<double> sent{before};
    for (int k = 0; k < 200; ++k) {
        run_ticks(tick, 1);
        sent.push_back(bench.hand.sent.z);
    }
    const double after = sent.back();
    CHECK_THAT(sent[102], WithinAbs(after, 1e-9));
    const auto [lowest, highest] = std::minmax(before, after);
    for (std::size_t k = 1; k < sent.size(); ++k) {
        CAPTURE(k, before, after, sent[k - 1], sent[k]);
        CHECK(sent[k] >= lowest - 1e-9);
        CHECK(sent[k] <= highest + 1e-9);
        CHECK(std::abs(sent[k] - sent[k - 1]) <= 0.05);  // a tenth of what the safety stage lets
    }
}

TEST_CASE("a lowered limit of the force holds in the same tick, however often it is changed",
          "[loop]") {
    PressingBench bench;
    REQUIRE(bench.hand.sent.z > 0.5);
    for (int k = 0; k < 200; ++k) {
        bench.handed.limits.max_force_newton = k % 2 == 0 ? 0.3 : 0.29;
        bench.hand_over();
        run_ticks(bench.tick, 1);
        CHECK(bench.hand.sent.z <= bench.handed.limits.max_force_newton + 1e-12);
    }
    const double low = bench.hand.sent.z;
    bench.handed.limits.max_force_newton = 4.0;  // a raised one glides
    bench.hand_over();
    run_ticks(bench.tick, 1);
    CHECK(bench.hand.sent.z <= low + 0.05);
}

namespace {

/// A hand that holds a device lightly against the force: a mass on a spring and a damper. Two ticks
/// pass between a pose and its force.
class HeldDevice final : public Device {
  public:
    explicit HeldDevice(double pressed_newton) : pressed_newton_(pressed_newton) {}

    [[nodiscard]] const DeviceSpecification& specification() const noexcept override {
        return specification_;
    }
    HandReading read(const HandContext& context) noexcept override {
        return {.goal_in_grid = {20.3, 10.2, 100.0 + z_m * 1e3 / context.pixel_pitch_mm}};
    }
    void send(Vec3 force_newton) noexcept override {
        constexpr int kSteps = 50;
        constexpr double kStep_s = 0.001 / kSteps;
        constexpr double kMass_kg = 0.2;
        constexpr double kSpring_newton_per_m = 300.0;
        constexpr double kDamper_newton_s_per_m = 4.0;  // 3 of the grip, 1 of the device
        for (int k = 0; k < kSteps; ++k) {
            const double newton = on_its_way_[0] - pressed_newton_ - kSpring_newton_per_m * z_m -
                                  kDamper_newton_s_per_m * speed_m_per_s_;
            speed_m_per_s_ += newton / kMass_kg * kStep_s;
            z_m += speed_m_per_s_ * kStep_s;
        }
        on_its_way_ = {on_its_way_[1], force_newton.z};
        sent_newton = force_newton.z;
    }

    double z_m{0.02};
    double sent_newton{0.0};

  private:
    DeviceSpecification specification_{};
    double pressed_newton_;
    double speed_m_per_s_{0.0};
    std::array<double, 2> on_its_way_{};
};

}  // namespace

TEST_CASE("a hand that presses with 3.8 N is not moved by a millimetre when parameters change",
          "[loop]") {
    const bool dragged = GENERATE(false, true);
    Bench bench;
    HeldDevice held(6.0);
    HapticTick tick({held, bench.frames, bench.settings, bench.state, *bench.strips, *bench.ticks});
    bench.handed.limits.max_force_newton = 8.0;
    bench.hand_over();
    bench.frames.publish(flat_window(64, 48, 0));
    run_ticks(tick, 4000);
    REQUIRE_THAT(held.sent_newton, WithinAbs(3.8, 0.1));
    const double before_m = held.z_m;
    double farthest_m = 0.0;
    for (int k = 0; k < 1500; ++k) {
        if (k == 0 || (dragged && k < 1000 && k % 17 == 0)) {
            bench.handed.parameters.friction = {0.3 + 0.0001 * k, 0.3};
            bench.handed.parameters.coupling.stiffness_newton_per_mm = 0.5 + 0.00003 * k;
            bench.hand_over();
        }
        run_ticks(tick, 1);
        farthest_m = std::max(farthest_m, std::abs(held.z_m - before_m));
    }
    CHECK(farthest_m < 1e-3);
}

TEST_CASE("another scale, algorithm, bump map or size of it lets the force rise again from zero",
          "[loop]") {
    const auto change = GENERATE(
        as<void (*)(HapticSettings&)>{},
        [](HapticSettings& s) { s.parameters.coupling.pixel_pitch_mm *= 1.5; },
        [](HapticSettings& s) { s.parameters.algorithm = Algorithm::pga; },
        [](HapticSettings& s) {
            s.bump = std::make_shared<const BumpMap>(BumpMap{2, 1, {0.0F, 1.0F}});
        },
        [](HapticSettings& s) { s.parameters.shape.bump_size_px = 32.0; });
    PressingBench bench;
    HapticTick& tick = bench.tick;
    const double before = bench.hand.sent.z;
    change(bench.handed);
    bench.hand_over();
    run_ticks(tick, 1);
    CHECK_THAT(bench.hand.sent.z, WithinAbs(0.0, 1e-9));
    run_ticks(tick, 10);
    CHECK(bench.hand.sent.z < 0.5 * before);
}

TEST_CASE("a seek or a new file lets the force rise again from zero", "[loop]") {
    PressingBench bench;
    HapticTick& tick = bench.tick;
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
    bench.hand.hand_changed = true;
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

TEST_CASE("force off is zero on the next tick", "[loop]") {
    PressingBench bench;
    HapticTick& tick = bench.tick;
    REQUIRE(bench.hand.sent.z > 0.1);
    bench.handed.force_enabled = false;
    bench.hand_over();
    run_ticks(tick, 1);
    CHECK_THAT(glm::length(bench.hand.sent), WithinAbs(0.0, 0.0));
}

TEST_CASE("a loop that ends in contact has sent zero force last", "[loop]") {
    Bench bench;
    bench.hand_over();
    bench.frames.publish(flat_window(64, 48, 0));
    bench.hand.goal.z = 90.0;
    double strongest_newton = 0.0;
    {
        HapticLoop loop(bench.connections());
        CHECK(eventually([&] {
            for (TickRecord row; bench.ticks->pop(row);)
                strongest_newton = std::max(strongest_newton, row.sent_newton[2]);
            return strongest_newton >= 0.1;
        }));
        CHECK(loop.grants().has_value());
    }
    CHECK_THAT(glm::length(bench.hand.sent), WithinAbs(0.0, 0.0));
}

TEST_CASE(
    "while the proxy catches up it is on the surface, and the force changes no faster than ever",
    "[loop]") {
    const double jump_mm_per_ms = GENERATE(10.0, 1e9);  // beyond it, the force is taken off
    const Algorithm algorithm = GENERATE(from_range(all_algorithms()));
    CAPTURE(jump_mm_per_ms, name_of(algorithm));
    Bench bench;
    bench.hand.limits_now = DeviceLimits{.max_goal_speed_mm_per_ms = jump_mm_per_ms};
    bench.handed.parameters.algorithm = algorithm;
    bench.hand_over();
    FrameWindow window = flat_window(900, 600, 0);
    auto rough = std::make_shared<DepthImage>(*window.frames[0].depth);
    for (int j = 0; j < 600; ++j) {
        for (int i = 0; i < 900; ++i) {
            rough->at(i, j) += 0.05F * static_cast<float>((i * i + 7 * j) % 11);
        }
    }
    window.frames[0].depth = rough;
    bench.frames.publish(window);
    HapticTick tick(bench.connections());
    press(bench, tick);
    const DepthSurface ground(*rough, *rough, 0.0, bench.handed.parameters.shape);
    const double most_newton = bench.handed.limits.max_change_newton_per_ms + 1e-9;
    std::uint64_t catching_up = 0;
    for (int k = 0; k < 600; ++k) {
        const Vec3 before_newton = bench.hand.sent;
        if (k % 50 == 0) bench.hand.goal = {k % 100 == 0 ? 890.0 : 20.0, 590.0 - k, 90.0};
        run_ticks(tick, 1);
        const HapticState& state = bench.state.front();
        const Vec3 at = state.touch.proxy.position;
        CAPTURE(k, at.x, at.y, at.z);
        const double height_px = at.z - ground.elevation_at(at.x, at.y);
        REQUIRE(height_px >= -1e-9);
        if (state.touch.proxy.contact) REQUIRE(height_px <= 1e-8);
        if (state.touch.cut == SafetyCut::goal_jump) {
            REQUIRE_THAT(glm::length(bench.hand.sent), WithinAbs(0.0, 0.0));
        } else {
            REQUIRE(glm::length(bench.hand.sent - before_newton) <= most_newton);
        }
        catching_up += state.catching_up() ? 1 : 0;
    }
    CHECK(catching_up > 12);
    CHECK(bench.state.front().bounds_met == catching_up);
    CHECK_FALSE(bench.state.front().catching_up());  // it has arrived
}
