// Hands: traces resampled, a modelled one, and the goals they make over a moving surface.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "core/error.hpp"
#include "core/experiment/hand_motion.hpp"
#include "tests/core/haptics/surfaces.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using Catch::Matchers::WithinAbs;
using dibhr::test::contains;

namespace {

std::vector<TraceSample> traced(const std::string& text) {
    const test::TemporaryFolder folder;
    const auto file = folder / "pen.csv";
    std::ofstream(file) << text;
    return read_trace(file);
}

/// The error of read_trace for a text; empty: none.
std::string refusal(const std::string& text) {
    try {
        static_cast<void>(traced(text));
        return {};
    } catch (const InputError& error) {
        return error.what();
    }
}

Frame frame_of(DepthImage image, double time_s) {
    return {.depth = std::make_shared<const DepthImage>(std::move(image)), .time_s = time_s};
}

/// A person in the middle of a dark image, who comes 10 levels nearer every frame.
DepthClip small_clip() {
    std::vector<Frame> frames;
    for (int k = 0; k < 3; ++k) {
        frames.push_back(frame_of(test::image_of(60, 40, 255.0,
                                                 [k](int i, int j) {
                                                     const bool front =
                                                         i >= 20 && i < 45 && j >= 10;
                                                     return front ? 100.0 + 10.0 * k : 10.0;
                                                 }),
                                  0.5 * k));
    }
    return {std::move(frames), SurfaceShape{}};
}

double largest_step(const std::vector<Vec2>& places) {
    double largest = 0.0;
    for (std::size_t k = 1; k < places.size(); ++k) {
        largest = std::max(largest, glm::length(places[k] - places[k - 1]));
    }
    return largest;
}

}  // namespace

TEST_CASE("a clip blends its frames in time and comes round without a seam", "[clip]") {
    const DepthClip clip = small_clip();
    CHECK_THAT(clip.duration_s(), WithinAbs(1.5, 1e-12));
    const auto height = [&](double t_s) { return clip.at(t_s).elevation(30, 20); };
    CHECK_THAT(height(0.0), WithinAbs(100.0, 1e-9));
    CHECK_THAT(height(0.25), WithinAbs(105.0, 1e-9));
    CHECK_THAT(height(1.25), WithinAbs(110.0, 1e-9));
    CHECK_THAT(height(1.5), WithinAbs(100.0, 1e-9));
    CHECK_THAT(height(1.75), WithinAbs(105.0, 1e-9));
    for (int k = 1; k < 4000; ++k) {
        REQUIRE(std::abs(height(0.001 * k) - height(0.001 * (k - 1))) < 0.05);
    }
    CHECK_THAT(clip.time_of(1, 0.5), WithinAbs(0.75, 1e-12));
    CHECK_THAT(clip.time_of(2, 1.0), WithinAbs(1.5, 1e-12));
    CHECK_THAT(clip.time_of(99, 0.0), WithinAbs(1.0, 1e-12));
}

TEST_CASE("a clip of nothing, of one pixel or of different sizes is refused", "[clip]") {
    const auto clip_of = [](std::vector<DepthImage> images) {
        std::vector<Frame> frames;
        for (DepthImage& image : images) {
            const double time_s = static_cast<double>(frames.size());
            frames.push_back(frame_of(std::move(image), time_s));
        }
        return DepthClip(std::move(frames), SurfaceShape{});
    };
    CHECK_THROWS_AS(clip_of({}), InputError);
    CHECK_THROWS_AS(clip_of({test::flat(1, 1, 9.0)}), InputError);
    CHECK_THROWS_AS(clip_of({test::flat(4, 4, 9.0), test::flat(4, 5, 9.0)}), InputError);
    CHECK(clip_of({test::flat(4, 4, 9.0)}).duration_s() == 0.0);
}

TEST_CASE("the foreground is a rectangle wholly on the person", "[area]") {
    const ImageArea area = foreground_area(small_clip());
    CHECK(area.centre.x - area.half_size.x >= 20.0);
    CHECK(area.centre.x + area.half_size.x <= 44.0);
    CHECK(area.centre.y - area.half_size.y >= 10.0);
    CHECK(area.centre.y + area.half_size.y <= 39.0);
    CHECK(area.half_size.x > 10.0);
    CHECK(area.half_size.y > 12.0);
    const DepthClip flat({frame_of(test::flat(9, 5, 100.0), 0.0)}, {});
    CHECK(foreground_area(flat).half_size == Vec2{4.0, 2.0});
}

TEST_CASE("a smooth curve meets its samples and stays between them", "[curve]") {
    const std::vector<double> times{0.0, 0.1, 0.4, 0.5, 2.0};
    const std::vector<double> values{1.0, 3.0, 3.0, -2.0, 4.0};
    const SmoothCurve curve(times, values);
    for (std::size_t k = 0; k < times.size(); ++k) {
        CHECK_THAT(curve.at(times[k]), WithinAbs(values[k], 1e-12));
    }
    CHECK(curve.at(-5.0) == 1.0);
    CHECK(curve.at(5.0) == 4.0);
    for (std::size_t k = 1; k < times.size(); ++k) {
        const auto [low, high] = std::minmax(values[k - 1], values[k]);
        for (double u = 0.0; u <= 1.0; u += 0.05) {
            const double value = curve.at(times[k - 1] + u * (times[k] - times[k - 1]));
            REQUIRE(value >= low - 1e-12);
            REQUIRE(value <= high + 1e-12);
        }
    }
}

TEST_CASE("a trace's columns are found by name, in any order", "[trace]") {
    const auto samples = traced(
        "pen_down,y_mm,x_mm,extra,time_ms,pressure01\n"
        "1,2,1,foo,0,0.25\n0,4,3,bar,500,1.5\n");
    REQUIRE(samples.size() == 2);
    CHECK(samples[0].place == Vec2{1.0, 2.0});
    CHECK(samples[1].t_s == 0.5);
    CHECK(samples[0].pressure == 0.25);
    CHECK(samples[1].pressure == 1.0);
    CHECK(samples[0].down);
    CHECK_FALSE(samples[1].down);
    CHECK(traced("t,x,y\r\n0,1,2\r\n1,3,4\r\n").size() == 2);
    CHECK(traced("time,x01,y01\n0,0.1,0.2\n1,0.3,0.4").size() == 2);
}

TEST_CASE("a trace that cannot be used is refused in one line that says where", "[trace]") {
    CHECK(contains(refusal(""), "no column of times"));
    CHECK(contains(refusal("t_s,x_mm\n0,1\n1,2\n"), "no columns of places"));
    CHECK(contains(refusal("t,x,y\n0,1,2\n"), "fewer than two rows"));
    CHECK(contains(refusal("t,x,y\n1,1,2\n1,2,3\n"), "fewer than two rows"));
    CHECK(contains(refusal("t,x,y\n0,1,2\n1,nan,3\n"), ":3: column x: 'nan'"));
    CHECK(contains(refusal("t,x,y\n0,1,2\n1,5\n"), ":3: column y: no value"));
    CHECK(contains(refusal("t,x,y\n1,1,2\n0,2,3\n"), "time falls"));
    CHECK_THROWS_AS(read_trace("/nowhere/pen.csv"), InputError);
    CHECK_THROWS_AS(read_trace("/"), InputError);
}

TEST_CASE("a trace becomes a motion of a millisecond a place without a jump", "[trace]") {
    // Two rows at one time, a pause of 4 s, and shorter than what is asked for.
    const std::vector<TraceSample> samples{{0.0, {0, 0}, 0.0, true},
                                           {0.1, {10, 0}, 0.4, true},
                                           {0.1, {12, 0}, 0.6, true},
                                           {4.1, {20, 30}, 1.0, true},
                                           {4.2, {25, 30}, 0.2, false}};
    const HandMotion motion = motion_of_trace(samples, "pen.csv", 3000);
    REQUIRE(motion.places.size() == 3000);
    REQUIRE(motion.penetrations_px.size() == 3000);
    CHECK_THAT(motion.places[100].x, WithinAbs(11.0, 1e-9));
    CHECK_THAT(motion.penetrations_px[100], WithinAbs(12.5, 1e-9));
    CHECK_THAT(motion.places[600].y, WithinAbs(30.0, 1e-9));
    CHECK_THAT(motion.penetrations_px[600], WithinAbs(25.0, 1e-9));
    CHECK_THAT(motion.penetrations_px[700], WithinAbs(-3.0, 1e-9));
    CHECK_THAT(motion.places[1400].x, WithinAbs(0.0, 1e-9));
    CHECK(largest_step(motion.places) < 0.3);
    CHECK(contains(motion.source, "pen.csv"));
}

TEST_CASE("a motion fills the area and keeps its aspect", "[motion]") {
    HandMotion motion;
    motion.places = {{5.0, 1.0}, {9.0, 2.0}, {7.0, 3.0}};
    fit_into(motion, {{100.0, 50.0}, {10.0, 40.0}});
    CHECK_THAT(motion.places[0].x, WithinAbs(90.0, 1e-9));
    CHECK_THAT(motion.places[1].x, WithinAbs(110.0, 1e-9));
    CHECK_THAT(motion.places[0].y, WithinAbs(45.0, 1e-9));
    CHECK_THAT(motion.places[2].y, WithinAbs(55.0, 1e-9));
    // A pen that stays does not move, whatever round-off resampling leaves.
    HandMotion still = motion_of_trace(
        {{0.0, {0.1, 0.7}, 0.5, true}, {0.3, {0.1, 0.7}, 0.5, true}, {1.0, {0.1, 0.7}, 0.5, true}},
        "pen.csv", 2000);
    CHECK_THROWS_AS(fit_into(still, {{100.0, 50.0}, {10.0, 40.0}}), InputError);
}

TEST_CASE("the goals of a hand are as deep below the moving surface as it presses", "[motion]") {
    const DepthClip clip = small_clip();
    HandMotion motion;
    motion.places.assign(1000, Vec2{30.0, 20.0});
    motion.penetrations_px.assign(1000, 12.0);
    const PathRun path = human_path(motion, clip, 0.4);
    CHECK_THAT(path.goals[0].z, WithinAbs(88.0, 1e-9));
    CHECK_THAT(path.goals[500].z, WithinAbs(98.0, 1e-9));
    CHECK_THAT(path.depth_px, WithinAbs(12.0, 1e-9));
    CHECK(path.exact_proxies.empty());
    CHECK(path.reversal.size() == path.goals.size());
}

TEST_CASE("the modelled hand is the same every time and stays in its area", "[hand]") {
    const ImageArea area{{300.0, 200.0}, {80.0, 50.0}};
    const HandMotion motion = modelled_hand(area);
    REQUIRE(motion.places.size() == std::size_t{kExperimentUpdates});
    CHECK(modelled_hand(area).places == motion.places);
    CHECK(modelled_hand(area, kExperimentUpdates, 2).places != motion.places);
    CHECK(contains(motion.source, "modelled"));
    for (const Vec2& place : motion.places) {
        REQUIRE(std::abs(place.x - area.centre.x) <= area.half_size.x + 0.5);
        REQUIRE(std::abs(place.y - area.centre.y) <= area.half_size.y + 0.5);
    }
    // Slower than the device's fastest, 4.961 px an update, but a hand that moves.
    CHECK(largest_step(motion.places) < 4.961);
    CHECK(largest_step(motion.places) > 0.2);
    const auto [lightest, deepest] =
        std::minmax_element(motion.penetrations_px.begin(), motion.penetrations_px.end());
    CHECK(*lightest < 0.0);
    CHECK(*deepest > 15.0);
    CHECK(*deepest < 25.0);
}
