// When live frames are shown, and how clocks of sources are compared: plain numbers, by a time of
// the test's own.
#include "core/video/playing/live_clock.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <deque>
#include <functional>
#include <optional>
#include <vector>

#include "core/video/live/live_join.hpp"
#include "core/video/motion/motion_throttle.hpp"
#include "tests/core/video/live/live_bench.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr;
using namespace dibhr::test;
using Catch::Matchers::WithinAbs;

namespace {

constexpr LiveTime kBegin{std::chrono::hours(5)};

/// Frames of a source, shown by a LiveClock: frame k is ready when the source says.
struct ClockBench {
    std::function<double(int k)> ready_s{};

    LiveClock clock{};
    std::deque<Frame> frames{};
    int next{0};
    int begun{0};  ///< how often the timeline began anew

    /// The frame, and the part of the way to the next one, that is shown at that time.
    [[nodiscard]] std::optional<double> shown_at(double time_s) {
        for (; ready_s(next) <= time_s; ++next) {
            Frame frame;
            frame.index = next;
            const LiveTime ready = after_s(kBegin, ready_s(next));
            begun += clock.add(std::move(frame), next * kLiveInterval_s, ready, frames) ? 1 : 0;
        }
        const double moment_s = clock.clock().playback_s(after_s(kBegin, time_s));
        while (frames.size() > 1 && frames[1].time_s <= moment_s) frames.pop_front();
        if (frames.empty()) return std::nullopt;
        if (frames.size() < 2) return static_cast<double>(frames[0].index);
        const double blend = (moment_s - frames[0].time_s) / (frames[1].time_s - frames[0].time_s);
        return static_cast<double>(frames[0].index) +
               std::clamp(blend, 0.0, 1.0) * static_cast<double>(frames[1].index - frames[0].index);
    }
};

}  // namespace

TEST_CASE("a source whose clock is quicker or slower is followed for ten minutes", "[live]") {
    const double rate = GENERATE(1.0003, 0.9997, 1.002);  // as bad as they come
    CAPTURE(rate);
    ClockBench bench;
    bench.ready_s = [rate](int k) { return k * kLiveInterval_s / rate + 0.001 * (k * 13 % 9); };
    double most_s = 0.0;
    double least_s = 1.0;
    for (double time_s = 2.0; time_s < 600.0; time_s += 0.010) {
        const auto shown = bench.shown_at(time_s);
        REQUIRE(shown);
        const double behind_s = time_s - *shown * kLiveInterval_s / rate;
        most_s = std::max(most_s, behind_s);
        least_s = std::min(least_s, behind_s);
    }
    CHECK(bench.begun == 1);
    CHECK(most_s <= 2.0 * kLiveInterval_s + 0.010);
    CHECK(least_s > kLiveInterval_s - 0.001);  // or it would be shown before it is there
}

TEST_CASE("frames that come unevenly are shown in even time, and time never goes back", "[live]") {
    const int uneven_ms = GENERATE(0, 5, 12, 30);
    CAPTURE(uneven_ms);
    ClockBench bench;
    bench.ready_s = [uneven_ms](int k) {
        return k * kLiveInterval_s + (uneven_ms > 0 ? 0.001 * (k * 11 % uneven_ms) : 0.0);
    };
    constexpr double kBegin_s = 3.0;
    constexpr double kEnd_s = 8.0;
    double first = -1.0;
    double last = 0.0;
    double most = 0.0;
    double least = 1.0;
    for (double time_s = 0.0; time_s < kEnd_s; time_s += 0.001) {
        const double shown = bench.shown_at(time_s).value_or(0.0);
        if (time_s > kBegin_s) {
            if (first < 0.0) first = last;
            most = std::max(most, shown - last);
            least = std::min(least, shown - last);
        }
        last = shown;
    }
    // Of a frame, in a millisecond: its speed differs by two parts in a hundred; a few frames in a
    // hundred may be late for that, and what was held for them is made good in half a frame.
    CHECK(most <= 0.030 * (uneven_ms <= 12 ? 1.021 : 2.0));
    CHECK(least >= 0.0);
    CHECK_THAT(last - first, WithinAbs((kEnd_s - kBegin_s) / kLiveInterval_s, 1.0));
    CHECK(bench.begun == 1);
}

namespace {

/// Two sources of 30 pictures a second. The colour's clock and way differ from the depth's.
struct JoinBench {
    double colour_zero_s{0.0};  ///< its stamp when the depth's is 0
    double depth_way_s{0.010};  ///< so long a picture is under way
    double colour_way_s{0.002};

    LiveJoin join{};

    [[nodiscard]] LivePicture picture(int k, double zero_s, double way_s) const {
        LivePicture made;
        made.stamp_s = k * kLiveInterval_s + zero_s;
        made.bits = k;  // by which it is known
        made.arrived = after_s(kBegin, k * kLiveInterval_s + way_s);
        return made;
    }
    [[nodiscard]] LivePicture depth(int k) const { return picture(k, 0.0, depth_way_s); }
    [[nodiscard]] LivePicture colour(int k) const {
        return picture(k, colour_zero_s, colour_way_s);
    }
    [[nodiscard]] std::optional<LivePair> at(double time_s) {
        return join.take(after_s(kBegin, time_s));
    }
};

}  // namespace

TEST_CASE("two streams are joined by their times, whatever their clocks say and their ways take",
          "[live]") {
    JoinBench bench;
    bench.colour_zero_s = GENERATE(0.0, 500.0, -3.0);
    bench.colour_way_s = GENERATE(0.002, 0.025);
    // Of clocks with another zero, ways of other lengths are not told from times.
    bench.depth_way_s = bench.colour_zero_s == 0.0 ? 0.010 : bench.colour_way_s;
    CAPTURE(bench.colour_zero_s, bench.colour_way_s);
    int next_depth = 0;
    int next_colour = 0;
    int joined = 0;
    for (double time_s = 0.0; time_s < 3.0; time_s += 0.001) {
        if (next_depth * kLiveInterval_s + bench.depth_way_s <= time_s)
            bench.join.add_depth(bench.depth(next_depth++));
        if (next_colour * kLiveInterval_s + bench.colour_way_s <= time_s)
            bench.join.add_colour(bench.colour(next_colour++));
        const auto pair = bench.at(time_s);
        if (!pair) continue;
        ++joined;
        CHECK(pair->depth.bits == pair->colour.bits);
    }
    CHECK(joined >= 89);
}

TEST_CASE("pictures that piled up while a stream was opened are not joined by when they come",
          "[live]") {
    JoinBench bench;
    bench.colour_zero_s = GENERATE(0.0, 500.0);
    bench.depth_way_s = bench.colour_way_s;
    const int piled_up = GENERATE(2, 10, 20);
    const double decoding_s = GENERATE(0.001, 0.020);
    const bool colour_first = GENERATE(true, false);
    CAPTURE(bench.colour_zero_s, piled_up, decoding_s, colour_first);
    const auto came_s = [&](int k, double opened_s) {
        return std::max(k * kLiveInterval_s + bench.colour_way_s, opened_s + k * decoding_s);
    };
    const double opened_s = piled_up * kLiveInterval_s;
    int next_depth = 0;
    int next_colour = 0;
    int joined = 0;
    for (double time_s = 0.0; time_s < 4.0; time_s += 0.001) {
        while (came_s(next_depth, opened_s) <= time_s) {
            LivePicture depth = bench.depth(next_depth++);
            depth.arrived = after_s(kBegin, time_s);
            bench.join.add_depth(std::move(depth));
        }
        while (came_s(next_colour, colour_first ? 0.0 : opened_s + 0.100) <= time_s) {
            LivePicture colour = bench.colour(next_colour++);
            colour.arrived = after_s(kBegin, time_s);
            bench.join.add_colour(std::move(colour));
        }
        const auto pair = bench.at(time_s);
        if (!pair) continue;
        ++joined;
        CHECK(pair->depth.bits == pair->colour.bits);
    }
    CHECK(joined >= 90 - 2 * piled_up);
    CHECK(joined >= 50);
}

TEST_CASE("a depth picture waits for its colour half an interval, and goes without", "[live]") {
    JoinBench bench;
    bench.join.add_depth(bench.depth(0));
    CHECK_FALSE(bench.join.due());
    CHECK_FALSE(bench.at(10.0));  // before the first colour nothing is shown
    bench.join.add_colour(bench.colour(1));
    bench.join.add_depth(bench.depth(2));
    CHECK_FALSE(bench.at(2 * kLiveInterval_s + 0.010 + 0.49 * kLiveInterval_s));
    const LiveTime due = after_s(kBegin, 2.5 * kLiveInterval_s + 0.010);
    REQUIRE(bench.join.due());
    CHECK(std::chrono::abs(*bench.join.due() - due) < std::chrono::microseconds(1));
    const auto pair = bench.at(2 * kLiveInterval_s + 0.010 + 0.51 * kLiveInterval_s);
    REQUIRE(pair);
    CHECK(pair->depth.bits == 2);
    CHECK(pair->colour.bits == 1);
    CHECK_FALSE(bench.join.due());
    for (const int k : {3, 4}) bench.join.add_depth(bench.depth(k));
    bench.join.add_colour(bench.colour(4));
    const auto newest = bench.at(4 * kLiveInterval_s + 0.011);
    REQUIRE(newest);
    CHECK(newest->depth.bits == 4);  // of those that may go
}

TEST_CASE("stamps are compared by when pictures come that come quickly", "[live]") {
    ClockOffset line;
    CHECK(line.offset_s() == 0.0);
    for (int k = 0; k < 90; ++k)
        line.add(k * kLiveInterval_s, 500.0 + k * kLiveInterval_s + 0.001 * (k % 7));
    CHECK_THAT(line.offset_s(), WithinAbs(500.0, 1e-9));
    line.add(3.0, 503.4);  // one that was held up on its way counts for nothing
    CHECK_THAT(line.offset_s(), WithinAbs(500.0, 1e-9));
    line.add(3.1, 903.1);  // its clock was set
    CHECK_THAT(line.offset_s(), WithinAbs(900.0, 1e-9));
    CHECK(line.count() == 1);
}

TEST_CASE("stamps of a clock that goes otherwise are compared by the last three seconds",
          "[live]") {
    ClockOffset line;
    for (int k = 0; k < 3000; ++k) line.add(k * kLiveInterval_s, 1.001 * k * kLiveInterval_s);
    CHECK_THAT(line.offset_s(), WithinAbs(0.001 * 2900 * kLiveInterval_s, 1e-9));
    CHECK(line.count() == 100);
}

TEST_CASE("where there is no time for motion in-betweens rest first, then all of it, and longer",
          "[live]") {
    constexpr MotionRequest kAll{true, true};
    MotionThrottle throttle(1920);
    const auto frames_until = [&](const MotionRequest& wanted, double busy_s, auto changed) {
        for (int k = 0; k < 10'000; ++k) {
            const MotionRequest done = throttle.affordable(wanted);
            if (changed(done)) return k;
            throttle.add_cost(done, busy_s, kLiveInterval_s);
        }
        return -1;
    };
    const auto less = [&](const MotionRequest& done) { return !(done == kAll); };
    const auto none = [](const MotionRequest& done) { return !done.any(); };
    const auto all = [&](const MotionRequest& done) { return done == kAll; };
    CHECK(frames_until(kAll, 0.5 * kLiveInterval_s, less) == -1);  // there is time
    const int begin = frames_until(kAll, 2.0 * kLiveInterval_s, less);
    CHECK(begin > 0);
    CHECK(begin < 10);
    CHECK(throttle.in_betweens_paused());
    CHECK_FALSE(throttle.motion_paused());  // it may fit alone
    CHECK(frames_until(kAll, 2.0 * kLiveInterval_s, none) < 10);
    CHECK(throttle.motion_paused());
    const int first = frames_until(kAll, 0.5 * kLiveInterval_s, all);
    REQUIRE(first > 30);
    CHECK(frames_until(kAll, 2.0 * kLiveInterval_s, none) < 20);
    CHECK(frames_until(kAll, 0.5 * kLiveInterval_s, all) > first);
    CHECK(frames_until(kAll, 0.5 * kLiveInterval_s, less) == -1);
}
