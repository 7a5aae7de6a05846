// A session's numbers: from the recorded file to sums, places and ranges.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <vector>

#include "core/report/session_numbers.hpp"
#include "tests/core/report/made_session.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace dibhr;
using namespace dibhr::test;
using Catch::Matchers::WithinAbs;

TEST_CASE("a distribution knows mean, peak and quantiles by time, and leaves out what is no number",
          "[report]") {
    Distribution values(0.001);
    for (int k = 0; k < 1000; ++k) values.add(0.001 * k, 0.5);
    values.add(std::numeric_limits<double>::infinity(), 1.0);
    values.add(std::numeric_limits<double>::quiet_NaN(), 1.0);
    values.add(-1.0, 1.0);
    CHECK_THAT(values.total_s(), WithinAbs(500.0, 1e-9));
    CHECK_THAT(values.mean(), WithinAbs(0.4995, 1e-9));
    CHECK_THAT(values.peak(), WithinAbs(0.999, 1e-12));
    CHECK_THAT(values.quantile(0.5), WithinAbs(0.5, 0.001));
    CHECK_THAT(values.quantile(0.95), WithinAbs(0.95, 0.001));
}

TEST_CASE("bars hold all of the time, are not too many and of a round width", "[report]") {
    const double highest = GENERATE(0.0004, 0.02, 1.7, 3.9, 1e6);
    const double upto_share = GENERATE(1.0, 0.3);
    CAPTURE(highest, upto_share);
    Distribution values(0.001);
    for (int k = 0; k <= 1000; ++k) values.add(highest * k / 1000.0, 0.25);
    const Bars bars = values.bars(upto_share * highest, 40);
    CHECK(bars.seconds.size() <= 40);
    const double sum = std::accumulate(bars.seconds.begin(), bars.seconds.end(), bars.beyond_s);
    CHECK_THAT(sum, WithinAbs(values.total_s(), 1e-6));
    const double digit = bars.width / std::pow(10.0, std::floor(std::log10(bars.width) + 1e-9));
    CHECK((std::abs(digit - 1) < 1e-6 || std::abs(digit - 2) < 1e-6 || std::abs(digit - 5) < 1e-6));
}

TEST_CASE("a peak of one tick is still there in an hour", "[report]") {
    TimeLine line(10.0, 3610.0);
    for (int k = 0; k < 36000; ++k) line.piece_at(10.0 + 0.1 * k).sent_newton.add(0.1, 0.001);
    line.piece_at(1234.567).sent_newton.add(3.5, 0.001);
    double highest = 0.0;
    for (const TimePiece& piece : line.pieces())
        highest = std::fmax(highest, piece.sent_newton.high);
    CHECK_THAT(highest, WithinAbs(3.5, 1e-12));
    CHECK(line.pieces().size() < 10000);
    line.piece_at(-5.0).sent_newton.add(1.0, 0.001);  // and no time is out of reach
    line.piece_at(std::numeric_limits<double>::quiet_NaN()).sent_newton.add(1.0, 0.001);
    line.piece_at(1e300).sent_newton.add(1.0, 0.001);
    CHECK_THAT(line.pieces().front().sent_newton.high, WithinAbs(1.0, 1e-12));
}

TEST_CASE("smoothing keeps the time and spreads it evenly", "[report]") {
    const double sigma_px = GENERATE(1.0, 2.5, 4.0);
    TouchedPlaces places;
    places.add({50.2, 39.8}, 0.0, 2.0);
    places.add({20.0, 60.0}, 0.0, 1.0);
    const PixelValues map = places.smoothed(100, 80, sigma_px);
    const double sum = std::accumulate(map.values.begin(), map.values.end(), 0.0);
    CHECK_THAT(sum, WithinAbs(3.0, 1e-4));
    CHECK_THAT(map.at(50 - 3, 40), WithinAbs(map.at(50 + 3, 40), 1e-6));
    CHECK_THAT(map.at(50, 40 - 3), WithinAbs(map.at(50 + 3, 40), 1e-6));
    const double peak = 2.0 / (2.0 * 3.14159265358979 * sigma_px * sigma_px);
    CHECK_THAT(map.at(50, 40), WithinAbs(peak, 0.1 * peak));
}

TEST_CASE("places outside every image are not shown, and the longest frame is found", "[report]") {
    TouchedPlaces places;
    places.add({10.0, 5.0}, 1.5, 0.2);
    places.add({11.0, 7.0}, 2.5, 0.3);
    for (const double far : {-1.0, 1e9, std::numeric_limits<double>::infinity()}) {
        places.add({far, 3.0}, 0.5, 0.01);
    }
    CHECK_THAT(places.longest_frame_s(), WithinAbs(2.5, 0.0));
    const PixelBounds bounds = places.bounds();
    CHECK(std::vector<int>{bounds.left, bounds.top, bounds.right, bounds.bottom} ==
          std::vector<int>{10, 5, 12, 8});
}

TEST_CASE("a recorded session comes to its numbers", "[report]") {
    const TemporaryFolder folder;
    MadeSession made;
    made.ticks = ticks_touching(1000, 200, 700);
    made.ticks[3].lateness_us = 2500.0;
    made.ticks[4].surface = false;
    made.ticks[5].cut = static_cast<std::uint8_t>(SafetyCut::late_tick);
    made.ticks[6].device_ready = false;
    made.ticks.erase(made.ticks.begin() + 800, made.ticks.begin() + 810);
    record(folder / "a.dibhr", made);
    const Session session(folder / "a.dibhr");
    double done = 0.0;
    const SessionNumbers numbers = numbers_of(session, [&done](double share) { done = share; });
    CHECK_THAT(numbers.duration_s, WithinAbs(1.0, 1e-9));
    CHECK_THAT(numbers.contact_s, WithinAbs(0.5, 1e-9));
    CHECK_THAT(numbers.contact_share(), WithinAbs(500.0 / 990.0, 1e-12));
    REQUIRE(numbers.episodes.size() == 1);
    CHECK_THAT(numbers.sent_newton.mean(), WithinAbs(0.5, 1e-9));
    CHECK_THAT(numbers.places.at(1).total_s(), WithinAbs(0.5, 1e-9));
    CHECK(numbers.ticks.all == 990);
    CHECK(numbers.ticks.missing == 10);
    CHECK(numbers.ticks.in_contact == 500);
    CHECK(numbers.ticks.late == 1);
    CHECK(numbers.ticks.without_surface == 1);
    CHECK(numbers.ticks.device_not_ready == 1);
    CHECK(numbers.ticks.cut[static_cast<std::size_t>(SafetyCut::late_tick)] == 1);
    CHECK(done <= 1.0);
}

TEST_CASE("a program that was stopped did not touch meanwhile", "[report]") {
    const TemporaryFolder folder;
    MadeSession made;
    made.ticks = ticks_touching(200, 0, 200);
    for (std::size_t k = 100; k < 200; ++k) made.ticks[k].t_s += 60.0;
    record(folder / "a.dibhr", made);
    const SessionNumbers numbers = numbers_of(Session(folder / "a.dibhr"));
    CHECK_THAT(numbers.duration_s, WithinAbs(60.2, 1e-9));
    CHECK_THAT(numbers.contact_s, WithinAbs(0.2 - 0.001 + kLongestTick_s, 1e-9));
}

TEST_CASE("of two frames that are blended the nearer one counts as touched", "[report]") {
    const double blend = GENERATE(0.2, 0.8);
    const TemporaryFolder folder;
    MadeSession made;
    made.ticks = ticks_touching(100, 0, 100);
    for (TickRecord& tick : made.ticks) tick.blend = blend;
    record(folder / "a.dibhr", made);
    const SessionNumbers numbers = numbers_of(Session(folder / "a.dibhr"));
    const FramePair& frames = made.ticks.front().frames;
    CHECK(numbers.places.at(1).longest_frame_s() == (blend < 0.5 ? frames.from_s : frames.to_s));
}
