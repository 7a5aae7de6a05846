// The loop's timing: deadlines stand on a fixed grid, late ticks are counted and never made up for.
#include "core/realtime/tick_timer.hpp"

#include <algorithm>
#include <chrono>

#include "tests/support/catch.hpp"

namespace {

using namespace std::chrono_literals;
using Catch::Matchers::WithinAbs;
using dibhr::LatenessHistogram;
using dibhr::TickSchedule;
using dibhr::TickTimer;

const TickSchedule::TimePoint kStart{std::chrono::hours(5)};

TickSchedule started_schedule() {
    TickSchedule schedule(1ms);
    schedule.start(kStart);
    return schedule;
}

}  // namespace

TEST_CASE("deadlines stand on the grid of the first one, however unsteady the ticks", "[timer]") {
    TickSchedule schedule = started_schedule();
    for (int k = 1; k <= 1000; ++k) {
        REQUIRE(schedule.next_deadline() == kStart + k * 1ms);
        schedule.begin_tick(schedule.next_deadline() + (k * 37 % 900) * 1us);
    }
    CHECK(schedule.ticks() == 1000);
    CHECK(schedule.late_ticks() == 0);
}

TEST_CASE("a tick's dt is the true time since the last tick began", "[timer]") {
    TickSchedule schedule = started_schedule();
    CHECK_THAT(schedule.begin_tick(kStart + 1100us).dt_s, WithinAbs(0.0011, 1e-12));
    CHECK_THAT(schedule.begin_tick(kStart + 2000us).dt_s, WithinAbs(0.0009, 1e-12));
    CHECK_THAT(schedule.begin_tick(kStart + 9000us).dt_s, WithinAbs(0.0070, 1e-12));
}

TEST_CASE("a tick is late when it begins a whole period after its deadline, not before",
          "[timer]") {
    const auto after = GENERATE(0us, 1us, 999us, 1000us, 1001us, 5300us);
    TickSchedule schedule = started_schedule();
    const auto timing = schedule.begin_tick(kStart + 1ms + after);
    CHECK(timing.lateness == after);
    CHECK(timing.late == (after >= 1ms));
    CHECK(schedule.late_ticks() == (after >= 1ms ? 1U : 0U));
}

TEST_CASE("deadlines missed by a late tick are not made up for", "[timer]") {
    TickSchedule schedule = started_schedule();
    schedule.begin_tick(kStart + 6300us);  // meant for 1 ms
    CHECK(schedule.ticks() == 1);
    CHECK(schedule.late_ticks() == 1);
    CHECK(schedule.next_deadline() == kStart + 7ms);
    CHECK_FALSE(schedule.begin_tick(kStart + 7ms).late);
}

TEST_CASE("after any tick the next deadline is on the grid, a period ahead at most", "[timer]") {
    TickSchedule schedule = started_schedule();
    auto now = kStart;
    for (int k = 0; k < 500; ++k) {
        now = std::max(now + (k * 613 % 4100) * 1us, schedule.next_deadline());
        schedule.begin_tick(now);
        REQUIRE(schedule.next_deadline() > now);
        REQUIRE(schedule.next_deadline() <= now + 1ms);
        REQUIRE((schedule.next_deadline() - kStart) % 1ms == 0ns);
    }
    CHECK(schedule.ticks() == 500);
}

TEST_CASE("ticks that are some periods apart keep the grid of deadlines", "[timer]") {
    TickSchedule schedule = started_schedule();
    for (const int periods : {1, 8, 8, 1, 3}) {
        const auto last = schedule.next_deadline(0);
        CHECK(schedule.next_deadline(periods) == last + periods * 1ms);
        const auto timing = schedule.begin_tick(last + periods * 1ms + 400us, periods);
        CHECK(timing.lateness == 400us);
        CHECK_FALSE(timing.late);
        CHECK(timing.periods == periods);
    }
    CHECK(schedule.next_deadline() == kStart + 22ms);
}

TEST_CASE("the timer never begins a tick before its deadline", "[timer]") {
    TickTimer timer(200us);
    const auto before = std::chrono::steady_clock::now();
    for (int k = 1; k <= 50; ++k) {
        const auto timing = timer.wait();
        REQUIRE(timing.begin >= before + k * 200us);
        REQUIRE(timing.lateness >= 0ns);
        REQUIRE(timing.dt_s > 0.0);
    }
    CHECK(timer.schedule().ticks() == 50);
    CHECK(timer.schedule().lateness().count() == 50);
}

TEST_CASE("a tick that overran is followed by a late one with the true dt", "[timer]") {
    TickTimer timer(10us);
    const auto last = timer.wait().begin;
    while (std::chrono::steady_clock::now() < last + 200us) {
    }
    const auto timing = timer.wait();
    CHECK(timing.late);
    CHECK(timing.dt_s >= 200e-6);
    CHECK(timer.schedule().late_ticks() >= 1);
    CHECK(timer.schedule().next_deadline() > timing.begin);
}

TEST_CASE("lateness falls into bins that double", "[timer]") {
    LatenessHistogram histogram;
    histogram.add(-5us);
    histogram.add(999ns);
    histogram.add(1us);
    histogram.add(2us);
    histogram.add(3us);
    histogram.add(1024us);
    CHECK(histogram.count() == 6);
    for (const double lateness : {1.0, 2.0}) CHECK(histogram.quantile(lateness / 6.0) == 1us);
    CHECK(histogram.quantile(3.0 / 6.0) == 2us);
    for (const double lateness : {4.0, 5.0}) CHECK(histogram.quantile(lateness / 6.0) == 4us);
    CHECK(histogram.quantile(1.0) == 2048us);
    CHECK(histogram.worst() == 1024us);
}

TEST_CASE("an absurd lateness stays in the last bin", "[timer]") {
    LatenessHistogram histogram;
    histogram.add(std::chrono::hours(100));
    CHECK(histogram.quantile(1.0) == std::chrono::hours(100));
}

TEST_CASE("a quantile is the upper end of the bin that holds it", "[timer]") {
    LatenessHistogram histogram;
    CHECK(histogram.quantile(0.5) == 0ns);
    for (int k = 0; k < 99; ++k) histogram.add(5us);
    histogram.add(700us);
    CHECK(histogram.quantile(0.0) == 8us);
    CHECK(histogram.quantile(0.5) == 8us);
    CHECK(histogram.quantile(0.99) == 8us);
    CHECK(histogram.quantile(1.0) == 1024us);
}
