// A session reads back every bit of every tick.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "core/session/recorder.hpp"
#include "core/session/session.hpp"
#include "tests/core/session/exploration.hpp"
#include "tests/core/session/session_folder.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr;
using namespace dibhr::test;
using Catch::Matchers::WithinAbs;

namespace {

/// Random reals, and special ones that are easily lost.
class AnyReal {
  public:
    double operator()() {
        constexpr double kAwkward[] = {0.0, -0.0, 1.0, -1.0, 255.0, 1e9, -1e-310, 1e300, 0.1};
        const auto n = bits_();
        if (n % 4 == 0) return kAwkward[n / 4 % std::size(kAwkward)];
        const auto real = std::bit_cast<double>(n);
        return std::isfinite(real) ? real : -0.0;
    }

  private:
    std::mt19937_64 bits_{7};
};

TickRecord any_tick(std::int64_t number, AnyReal& real) {
    TickRecord tick;
    tick.tick = number;
    tick.t_s = static_cast<double>(number) * 0.0010001;
    tick.dt_s = real();
    tick.lateness_us = real();
    tick.update_us = static_cast<double>(number) / 1e3;
    tick.settings = 3;
    tick.frames = {{2, true, false, true}, number / 30, number / 30 + 1, real(), real(), real()};
    tick.blend = real();
    for (auto* vector : {&tick.goal, &tick.spring_newton, &tick.own_newton}) {
        for (int axis = 0; axis < 3; ++axis) (*vector)[axis] = real();
    }
    // Often the same as something else, which is then not stored.
    for (int axis = 0; axis < 3; ++axis) {
        tick.proxy[axis] = number % 3 == 0 ? tick.goal[axis] : real();
        const double wanted = tick.spring_newton[axis] + tick.own_newton[axis];
        const double often[]{tick.spring_newton[axis], wanted, 0.0, 0.37 * wanted};
        const auto which = static_cast<std::size_t>(number % 5);
        tick.sent_newton[axis] = which < std::size(often) ? often[which] : real();
    }
    tick.moves = static_cast<std::int32_t>(number % 5);
    tick.i = static_cast<std::int32_t>(number % 7) - 1;
    tick.j = 40000;
    const auto bit = [number](int k) { return (number >> k & 1) != 0; };
    tick.contact = bit(0);
    tick.primitive = static_cast<std::uint8_t>(number % 4);
    tick.buttons = static_cast<std::uint8_t>(number % 256);
    tick.cut = static_cast<std::uint8_t>(number % 6);
    tick.device_ready = bit(1);
    tick.mouse_fallback = bit(2);
    tick.from_zero = bit(3);
    tick.releases_contact = bit(4);
    tick.goal_refused = bit(5);
    tick.catching_up = bit(6);
    tick.gliding = bit(7);
    tick.standstill = bit(8);
    return tick;
}

}  // namespace

TEST_CASE("whatever reals a tick holds come back bit by bit, with and without its parameters",
          "[session]") {
    const bool known = GENERATE(false, true);
    const SessionFolder folder;
    AnyReal real;
    std::vector<TickRecord> ticks;
    for (std::int64_t n = 0; n < 3000; ++n) ticks.push_back(any_tick(n, real));
    {
        const auto ring = std::make_unique<TickRing>();
        Recorder recorder(folder.file(), *ring, {});
        if (known) recorder.parameters({.version = 3, .touch = {}, .limits = {}, .bump = {}});
        for (const TickRecord& tick : ticks) push(*ring, tick);
    }
    const Session session(folder.file());
    Session::Ticks read(session);
    for (const TickRecord& tick : ticks) {
        TickRecord back;
        REQUIRE(read.next(back));
        CAPTURE(tick.tick);
        REQUIRE(same_record(tick, back));
    }
    TickRecord none;
    CHECK_FALSE(read.next(none));
}

TEST_CASE("what the real loop computes comes back bit by bit, and little of it is stored",
          "[session]") {
    const SessionFolder folder;
    MovingSurface surface;
    Exploration hand(surface);
    hand.tremor_px = 0.5;
    hand.own_force_newton = {0.1 / 3.0, -0.2 / 3.0, 0.1 / 7.0};
    hand.parameters.touch.coupling.damping_newton_s_per_m = GENERATE(0.0, 2.0);
    hand.parameters.touch.coupling.stiffness_newton_per_mm = GENERATE(0.2, 20.0);  // or limited
    std::vector<TickRecord> ticks;
    {
        const auto ring = std::make_unique<TickRing>();
        Recorder recorder(folder.file(), *ring, {});
        recorder.parameters(hand.parameters);
        for (int k = 0; k < 4000; ++k) {
            hand.surface = k / 100 != 20;
            hand.parameters.force_enabled = k / 100 != 22;
            ticks.push_back(hand.next());
            if (k % 1000 != 999) push(*ring, ticks.back());  // some are missing
        }
    }
    const Session session(folder.file());
    Session::Ticks read(session);
    for (const TickRecord& tick : ticks) {
        if (tick.tick % 1000 == 999) continue;
        TickRecord back;
        REQUIRE(read.next(back));
        CAPTURE(tick.tick);
        TickRecord expected = tick;
        if (!tick.surface) expected.frames = back.frames;
        REQUIRE(same_record(expected, back));
    }
    const std::string stored = answer(folder.file(),
                                      "SELECT avg(dt IS NULL) > 0.99 AND avg(i IS NULL) > 0.5 "
                                      "AND avg(typeof(cx) != 'real') > 0.99 FROM tick_data");
    CHECK(stored == "1");
}

TEST_CASE("what is no number is recorded as infinity", "[session]") {
    const SessionFolder folder;
    {
        const auto ring = std::make_unique<TickRing>();
        const Recorder recorder(folder.file(), *ring, {});
        TickRecord tick;
        tick.own_newton[1] = std::numeric_limits<double>::quiet_NaN();
        tick.goal[2] = -std::numeric_limits<double>::infinity();
        push(*ring, tick);
    }
    const Session session(folder.file());
    Session::Ticks read(session);
    TickRecord back;
    REQUIRE(read.next(back));
    CHECK(back.own_newton[1] == std::numeric_limits<double>::infinity());
    CHECK(back.goal[2] == -std::numeric_limits<double>::infinity());
    CHECK_THAT(back.own_newton[0], WithinAbs(0.0, 0.0));
}
