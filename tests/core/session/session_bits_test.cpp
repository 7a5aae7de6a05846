// Every bit of every tick that a session gives back.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <memory>
#include <random>
#include <vector>

#include "core/session/recorder.hpp"
#include "core/session/same_bits.hpp"
#include "core/session/session.hpp"
#include "tests/core/session/session_folder.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr;
using namespace dibhr::test;
using Catch::Matchers::WithinAbs;

namespace {

/// Any real there is, and the ones that are easily lost.
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
        for (double& value : *vector) value = real();
    }
    // Often the same as something else, which is then not stored.
    for (int axis = 0; axis < 3; ++axis) {
        tick.proxy[axis] = number % 3 == 0 ? tick.goal[axis] : real();
        tick.sent_newton[axis] = number % 2 == 0 ? tick.spring_newton[axis] : real();
    }
    tick.moves = static_cast<std::int32_t>(number % 5);
    tick.i = static_cast<std::int32_t>(number) - 1;
    tick.j = 40000;
    const auto bit = [number](int k) { return (number >> k & 1) != 0; };
    tick.contact = bit(0);
    tick.primitive = static_cast<std::uint8_t>(number % 4);
    tick.buttons = static_cast<std::uint8_t>(number % 256);
    tick.cut = static_cast<std::uint8_t>(number % 6);
    tick.device_ready = bit(1);
    tick.stand_in = bit(2);
    tick.restart = bit(3);
    tick.lets_go = bit(4);
    tick.goal_refused = bit(5);
    return tick;
}

template <std::size_t N>
bool same(const double (&a)[N], const double (&b)[N]) {
    return std::equal(std::begin(a), std::end(a), std::begin(b), same_bits);
}

bool same(const TickRecord& a, const TickRecord& b) {
    return a.tick == b.tick && same_bits(a.t_s, b.t_s) && same_bits(a.dt_s, b.dt_s) &&
           same_bits(a.lateness_us, b.lateness_us) && same_bits(a.update_us, b.update_us) &&
           a.settings == b.settings && a.frames == b.frames && same_bits(a.blend, b.blend) &&
           same(a.goal, b.goal) && same(a.proxy, b.proxy) &&
           same(a.spring_newton, b.spring_newton) && same(a.sent_newton, b.sent_newton) &&
           same(a.own_newton, b.own_newton) && a.moves == b.moves && a.i == b.i && a.j == b.j &&
           a.contact == b.contact && a.primitive == b.primitive && a.buttons == b.buttons &&
           a.cut == b.cut && a.surface == b.surface && a.device_ready == b.device_ready &&
           a.stand_in == b.stand_in && a.restart == b.restart && a.lets_go == b.lets_go &&
           a.goal_refused == b.goal_refused;
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
        REQUIRE(same(tick, back));
    }
    TickRecord none;
    CHECK_FALSE(read.next(none));
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
