// Which frames are shown and how fast the clock runs, for any cost of a frame.
#include "core/video/playing/frame_plan.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "tests/support/catch.hpp"

using namespace dibhr;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

constexpr double kInterval_s = 1.0 / 30.0;
const std::vector<double> kSpeeds{0.1, 0.5, 0.65, 0.8, 1.0, 1.1, 1.5, 2.0, 3.0, 4.0};

double shown_per_s(const FramePlan& plan) {
    return plan.speed / (plan.every * kInterval_s);
}

FramePlan plan_at(const FrameCosts& costs, double speed, const FramePlan& last = {}) {
    return plan_of(costs, kInterval_s, speed, last);
}

/// Any machine: from far too fast to far too slow for the video.
FrameCosts any_costs() {
    return {.decoding_s = GENERATE(0.0, 0.0005, 0.012, 0.033, 0.2),
            .conversion_s = GENERATE(0.001, 0.02, 0.09),
            .cleaning_s = GENERATE(0.001, 0.031, 0.1),
            .side_by_side = GENERATE(false, true)};
}

}  // namespace

TEST_CASE("the frames shown per second never fall while the requested speed rises", "[plan]") {
    const FrameCosts costs = any_costs();
    CAPTURE(costs.decoding_s, costs.conversion_s, costs.cleaning_s, costs.side_by_side);
    double most_per_s = 0.0;
    for (const double speed : kSpeeds) {
        CAPTURE(speed);
        const double per_s = shown_per_s(plan_at(costs, speed));
        CHECK(per_s >= (1.0 - kMostLost) * most_per_s - 1e-9);
        most_per_s = std::max(most_per_s, per_s);
    }
}

TEST_CASE("a plan is never more than the machine can do, nor slower than it must be", "[plan]") {
    const FrameCosts costs = any_costs();
    const double speed = GENERATE(0.5, 1.0, 2.0);
    CAPTURE(costs.decoding_s, costs.conversion_s, costs.cleaning_s, costs.side_by_side, speed);
    const FramePlan plan = plan_at(costs, speed);
    CHECK(plan.every >= 1.0);
    CHECK(plan.speed <= speed);
    const double time_s = frame_time_s(costs, plan.every);
    CHECK(time_s <= plan.every * kInterval_s / plan.speed + 1e-9);
    CHECK(plan.overloaded == (frame_time_s(costs, 1.0) > kInterval_s / speed));
    if (!plan.overloaded) CHECK(plan == FramePlan{.every = 1.0, .speed = speed});
    if (plan.speed < speed) CHECK_THAT(shown_per_s(plan), WithinRel(1.0 / time_s, 1e-9));
}

TEST_CASE("the clock keeps its time where frames left out cost little", "[plan]") {
    const FramePlan cleans = plan_at(
        {.decoding_s = 0.012, .conversion_s = 0.01, .cleaning_s = 0.04, .side_by_side = true}, 1.0);
    CHECK_THAT(cleans.speed, WithinAbs(1.0, 0.0));
    CHECK_THAT(shown_per_s(cleans), WithinRel(1.0 / 0.04, kMostLost));
    const FramePlan decodes = plan_at({.decoding_s = 0.05, .cleaning_s = 0.001}, 1.0);
    CHECK_THAT(decodes.every, WithinAbs(1.0, 0.0));
    CHECK_THAT(decodes.speed, WithinRel(kInterval_s / 0.051, 1e-9));
}

TEST_CASE("where threads share the processors, frames that are left out cost shown ones",
          "[plan]") {
    FrameCosts costs{.decoding_s = 0.03, .conversion_s = 0.03, .cleaning_s = 0.07};
    const FramePlan shared = plan_at(costs, 1.0);
    CHECK_THAT(shared.every, WithinAbs(1.0, 0.0));
    CHECK_THAT(shared.speed, WithinRel(kInterval_s / 0.13, 1e-9));
    costs.side_by_side = true;
    CHECK(plan_at(costs, 1.0).every > 1.2);
}

TEST_CASE("a plan stays while the costs of frames scatter, and follows what lasts", "[plan]") {
    double cleaning_s = 0.0;
    FramePlan plan;
    int changes = 0;
    const auto add = [&](double newest_s) {
        cleaning_s = steady_mean(cleaning_s, newest_s);
        const FramePlan next = plan_at({.decoding_s = 0.004,
                                        .conversion_s = 0.01,
                                        .cleaning_s = cleaning_s,
                                        .side_by_side = true},
                                       1.0, plan);
        changes += next == plan ? 0 : 1;
        plan = next;
    };
    for (int k = 0; k < 40; ++k) add(k % 2 == 0 ? 0.047 : 0.053);
    changes = 0;
    for (int k = 0; k < 400; ++k) add(k % 2 == 0 ? 0.047 : 0.053);
    CHECK(changes == 0);
    const FramePlan before = plan;
    add(2.0);  // a single slow frame
    CHECK(plan.every < 1.3 * before.every);
    for (int k = 0; k < 15; ++k) add(k % 2 == 0 ? 0.047 : 0.053);
    CHECK_THAT(plan.every, WithinRel(before.every, 0.08));
    for (int k = 0; k < 40; ++k) add(0.1);
    CHECK_THAT(plan.every, WithinRel(2.0 * before.every, 0.1));
    for (int k = 0; k < 40; ++k) add(0.01);
    CHECK(plan == FramePlan{});
}

TEST_CASE("shown frames are even, to one frame of the video", "[plan]") {
    const double every = GENERATE(1.3, 1.5, 2.0, 2.06, 3.7, 12.0);
    const double interval_s = GENERATE(1.0 / 30.0, 1.0 / 59.94, 0.04);
    CAPTURE(every, interval_s);
    // Containers round times to milliseconds.
    const auto time_s = [&](int k) { return std::round(1000.0 * k * interval_s) / 1000.0; };
    std::vector<int> shown{0};
    for (int k = 1; k < 3000; ++k)
        if (time_s(k) >= next_shown_s(time_s(shown.back()), every * interval_s)) shown.push_back(k);
    for (std::size_t n = 2; n < shown.size(); ++n)
        REQUIRE(std::abs(shown[n] - shown[n - 1] - every) < 1.0 + 0.04);
    CHECK_THAT(static_cast<double>(shown.size()), WithinRel(3000.0 / every, 0.01));
}

TEST_CASE("all frames are shown where no spacing is given, or no interval is known", "[plan]") {
    CHECK(next_shown_s(0.5, 0.0) > 0.5);
    CHECK(next_shown_s(0.5, 0.0) < 0.502);
    CHECK(plan_of({.cleaning_s = 9.0}, 0.0, 2.0) == FramePlan{.every = 1.0, .speed = 2.0});
}

TEST_CASE("the plan says in words what it drops and which step takes the time", "[plan]") {
    const FrameCosts cleans{
        .decoding_s = 0.002, .conversion_s = 0.008, .cleaning_s = 0.065, .side_by_side = true};
    CHECK(in_words(plan_at(cleans, 1.0), cleans, 30.0, 1.0) ==
          "Shown 15 of 30 frames a second: cleaning takes 65 ms a frame.");
    const FrameCosts decodes{.decoding_s = 0.05, .cleaning_s = 0.001};
    CHECK(in_words(plan_at(decodes, 1.0), decodes, 30.0, 1.0) ==
          "All frames are shown, at 0.65 of the video's speed: decoding and cleaning take 51 ms a "
          "frame.");
    CHECK(in_words({}, cleans, 30.0, 1.0).empty());
}
