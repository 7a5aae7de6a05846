// What is live as it is felt: pictures come over loopback, at a time that the test makes.
#include "core/video/playing/live_playback.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/haptics/safety.hpp"
#include "core/video/sources/media.hpp"
#include "tests/core/video/clips.hpp"
#include "tests/core/video/live/live_bench.hpp"
#include "tests/core/video/live/senders.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/eventually.hpp"

using namespace dibhr;
using namespace dibhr::test;
using Catch::Matchers::WithinAbs;

namespace {

/// What passes on a bench, millisecond by millisecond.
struct Course {
    std::function<double(int k)> sent_s{};                  ///< picture 0, 1, 2 ... from now on
    std::function<void(int number, double time_s)> sent{};  ///< by the sender's numbers
    std::function<void(double time_s)> each{};              ///< after that
};

void pass(LiveBench& bench, double seconds, const Course& course) {
    const LiveTime begin = bench.now();
    int next = 0;
    for (int k = 0; 0.001 * k < seconds; ++k) {
        for (; course.sent_s(next) <= 0.001 * k; ++next) {
            const int number = bench.send_at(after_s(begin, course.sent_s(next)));
            if (course.sent) course.sent(number, course.sent_s(next));
        }
        bench.take_at(after_s(begin, 0.001 * k));
        if (course.each) course.each(0.001 * k);
    }
}

double in_time(int k) {
    return k * kLiveInterval_s;
}

}  // namespace

TEST_CASE("a step in the depth is felt two frames and 10 ms after it is sent, at most", "[live]") {
    const int uneven_ms = GENERATE(12, 0);
    CAPTURE(uneven_ms);
    LiveBench bench(flashing());
    std::vector<double> delays_s;
    bool was_high = true;
    double flashed_s = -1.0;
    Course course;
    course.sent_s = [uneven_ms](int k) {
        return in_time(k) + (uneven_ms > 0 ? 0.001 * (k * 7 % uneven_ms) : 0.0);
    };
    course.sent = [&](int number, double time_s) {
        if (number % 20 == 10) flashed_s = time_s;
    };
    course.each = [&](double time_s) {
        const bool high = bench.felt().value_or(0.0) >= 37000.0;  // nine tenths of it
        if (high && !was_high && flashed_s > 0.8) delays_s.push_back(time_s - flashed_s);
        was_high = high;
    };
    pass(bench, 3.2, course);
    REQUIRE(delays_s.size() >= 3);
    const auto [least, most] = std::minmax_element(delays_s.begin(), delays_s.end());
    CHECK(*most <= 2.0 * kLiveInterval_s + 0.010);
    CHECK(*least >= 0.8 * kLiveInterval_s);
    CHECK(bench.playback.status(bench.now()).dropped == 0);
}

TEST_CASE("pictures that come unevenly move the surface evenly, and it never goes back", "[live]") {
    LiveBench bench(flat([](int k) { return 50 * k; }));
    std::vector<double> levels;
    std::uint64_t begun = 0;
    Course course;
    course.sent_s = [](int k) {
        return in_time(k) / 1.002 + 0.001 * (k * 11 % 15);  // by a clock that is too quick
    };
    course.each = [&](double time_s) {
        if (levels.empty()) begun = bench.playback.window().discontinuity;
        if (time_s >= 1.0) levels.push_back(bench.felt().value_or(-1.0));
    };
    pass(bench, 3.0, course);
    CHECK(std::is_sorted(levels.begin(), levels.end()));
    CHECK_THAT(levels.back() - levels.front(), WithinAbs(2.0 * 1500.0 * 1.002, 50.0));
    double most = 0.0;
    for (std::size_t k = 1; k < levels.size(); ++k)
        most = std::max(most, levels[k] - levels[k - 1]);
    CHECK(most < 2.0);  // 1.5 in a millisecond, and never a frame at once
    CHECK(bench.playback.status(bench.now()).dropped == 0);
    CHECK(bench.playback.window().discontinuity == begun);
}

TEST_CASE("a signal that is lost while it moves takes the force off within 250 ms", "[live]") {
    const bool moves = GENERATE(true, false);
    CAPTURE(moves);
    LiveBench bench(flat([moves](int k) { return moves ? 20000 + 800 * (k % 20) : 20000; }));
    const LiveTime last = after_s(bench.now(), in_time(11));
    pass(bench, in_time(11) + 0.002, {.sent_s = in_time});
    LivePlayback& playback = bench.playback;
    const std::uint64_t before = playback.window().discontinuity;
    CHECK(playback.status(bench.now()).signal);
    CHECK_FALSE(playback.window().silent);
    // Of 30 pictures a second. Then the force fades.
    const LiveTime lost = last + std::chrono::milliseconds(150);
    CHECK(0.150 + SafetyStage::kFade_s < 0.250);
    bench.take_at(lost - std::chrono::microseconds(1));
    CHECK(playback.status(bench.now()).signal);
    CHECK(playback.next_due(bench.now()) <= lost);
    CHECK(bench.take_at(lost + std::chrono::microseconds(1)));
    CHECK_FALSE(playback.status(bench.now()).signal);
    CHECK(playback.window().silent == moves);
    CHECK(playback.status(bench.now()).force_off == moves);
    const auto level = bench.felt();
    REQUIRE(level);
    bench.take_at(last + std::chrono::seconds(10));
    CHECK(bench.felt() == level);  // it is held
    const std::string words = in_words(playback.status(bench.now()));
    CHECK(contains(words, "No signal from"));
    CHECK(contains(words, "for 10 s"));
    CHECK(contains(words, "the force is off") == moves);
    LiveStatus ended = playback.status(bench.now());
    ended.permanent_error = true;
    ended.trouble = "'standard input' has ended";
    CHECK(in_words(ended).starts_with(ended.trouble));
    CHECK_FALSE(contains(in_words(ended), "waiting"));
    CHECK(contains(in_words(ended), "the force is off") == moves);
    pass(bench, 0.001, {.sent_s = in_time});
    CHECK(playback.status(bench.now()).signal);
    CHECK_FALSE(playback.window().silent);
    CHECK(playback.window().discontinuity > before);  // by which the force ramps
}

TEST_CASE("what is live is held by a pause, and goes on with what comes then", "[live]") {
    LiveBench bench(flat([](int k) { return 100 * k; }));
    pass(bench, 0.5, {.sent_s = in_time});
    LivePlayback& playback = bench.playback;
    playback.pause(bench.now());
    CHECK(playback.next_due(bench.now()) == LiveTime::max());
    const auto held = bench.felt();
    REQUIRE(held);
    pass(bench, 1.0, {.sent_s = in_time, .each = [&](double) { REQUIRE(bench.felt() == held); }});
    CHECK(playback.status(bench.now()).signal);
    CHECK_FALSE(playback.playing());
    playback.play();
    pass(bench, 0.5, {.sent_s = in_time});
    CHECK(bench.felt().value_or(0.0) > *held + 3000.0);  // a second of them was left out
}

TEST_CASE("how live frames move is known as they come, where it is wanted", "[live]") {
    // A relief that goes 3 px to the right from frame to frame.
    PictureSender::Asked asked;
    asked.level = [](int k, int column, int row) {
        const double x = column - 3.0 * k;
        return static_cast<std::uint16_t>(30000.0 +
                                          13000.0 * std::sin(0.31 * x) * std::cos(0.23 * row) +
                                          10000.0 * std::sin(0.13 * row + 0.17 * x));
    };
    LiveBench bench(asked);
    LivePlayback& playback = bench.playback;
    // The time stands still while the motion is computed: there is always enough of it.
    const auto after_three = [&] {
        pass(bench, 0.1, {.sent_s = in_time});
        REQUIRE(playback.window().count > 1);
        return playback.window().frames[0];
    };
    CHECK(after_three().motion == nullptr);
    playback.set_motion({.motion = true});
    const Frame moving = after_three();
    REQUIRE(moving.motion != nullptr);
    std::vector<float> rights;
    for (int j = 20; j < 100; j += 4)
        for (int i = 20; i < 140; i += 4) rights.push_back(moving.motion->at(i, j).right);
    std::sort(rights.begin(), rights.end());
    CHECK_THAT(static_cast<double>(rights[rights.size() / 2]), WithinAbs(3.0, 0.1));
    CHECK(moving.in_betweens == nullptr);
    playback.set_motion({.in_betweens = true});
    CHECK(after_three().in_betweens != nullptr);
    CHECK_FALSE(playback.status(bench.now()).motion_paused);
}
