// Outlines lose their teeth; shapes, thin bars and ramps stay.
#include "core/video/cleaning/outlines.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <numbers>
#include <random>

#include "core/video/cleaning/cleaning_chain.hpp"
#include "core/video/frames/frame_window.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr;

namespace {

constexpr int kColumns = 160;
constexpr int kRows = 120;
constexpr double kNear = 180.0;
constexpr double kFar = 60.0;
constexpr std::size_t kAnyNumber = std::numeric_limits<std::size_t>::max();

using Inside = std::function<double(double, double)>;  // distance to the outline [px], within it

Inside disc(double radius_px) {
    return [=](double x, double y) { return radius_px - std::hypot(x - 80.3, y - 60.1); };
}
Inside half_plane(double degrees) {
    const double angle_rad = degrees * std::numbers::pi / 180.0;
    return [=](double x, double y) {
        return (x - 80.3) * std::cos(angle_rad) + (y - 60.1) * std::sin(angle_rad);
    };
}
Inside bar(double width_px, double degrees) {
    return [=, across = half_plane(degrees)](double x, double y) {
        return 0.5 * width_px - std::fabs(across(x, y) + 0.3);
    };
}

DepthImage seen(
    const Inside& inside, const Inside& near = [](double, double) { return kNear; }) {
    return image_of(kColumns, kRows, 255.0,
                    [&](int i, int j) { return inside(i, j) > 0.0 ? near(i, j) : kFar; });
}

DepthImage smoothed(DepthImage image, std::size_t recorded_teeth = kAnyNumber) {
    OutlineSmoother().smooth(image, recorded_teeth);
    return image;
}

/// Pixels that have changed by more than this.
int changed(const DepthImage& before, const DepthImage& after, double levels = 0.0) {
    int count = 0;
    for (std::size_t k = 0; k < before.levels.size(); ++k)
        count += std::fabs(before.levels[k] - after.levels[k]) > levels ? 1 : 0;
    return count;
}

/// Each pixel within 1.5 px of the outline changes sides one time in six.
DepthImage ragged(const Inside& inside, unsigned seed) {
    std::mt19937 random(seed);
    return image_of(kColumns, kRows, 255.0, [&](int i, int j) {
        const double way_px = inside(i, j);
        const bool turns = std::fabs(way_px) < 1.5 && random() % 6 == 0;
        return (way_px > 0.0) != turns ? kNear : kFar;
    });
}

/// Steps, lines, ramps and noise without any order.
DepthImage shattered(unsigned seed, int columns, int rows) {
    std::mt19937 random(seed);
    return image_of(columns, rows, 255.0, [&](int i, int j) {
        const double level = (i / 5 + j / 7) % 3 == 0 ? 200.0 : 40.0 + 2.0 * i;
        return random() % 4 == 0 ? static_cast<double>(random() % 256) : std::min(level, 255.0);
    });
}

}  // namespace

TEST_CASE("pixels of a ragged outline go back to their sides, whichever way it runs",
          "[cleaning]") {
    const double degrees = GENERATE(0.0, 17.0, 45.0, 68.0, 90.0);
    const Inside inside = GENERATE_COPY(half_plane(degrees), disc(20.0 + 0.3 * degrees));
    CAPTURE(degrees);
    const DepthImage truth = seen(inside);
    const DepthImage recorded = ragged(inside, 3);
    REQUIRE(teeth_of(recorded) > 10);
    const DepthImage smooth = smoothed(recorded);
    CHECK(teeth_of(smooth) == 0);
    CHECK(2 * changed(truth, smooth) < changed(truth, recorded));
}

TEST_CASE("an outline without teeth keeps its place, also before a steep face", "[cleaning]") {
    const double degrees = GENERATE(0.0, 30.0, 45.0, 60.0, 90.0);
    CAPTURE(degrees);
    const DepthImage straight = seen(half_plane(degrees));
    CHECK(changed(straight, smoothed(straight)) == 0);
    const DepthImage round = seen(disc(40.0));
    CHECK(changed(round, smoothed(round)) <= 8);
    // The rim of a ball rises steeply from its outline.
    const DepthImage ball = seen(disc(40.0), [](double x, double y) {
        const double way_px = std::hypot(x - 80.3, y - 60.1);
        return 90.0 + 3.0 * std::sqrt(std::max(1600.0 - way_px * way_px, 0.0));
    });
    CHECK(changed(ball, smoothed(ball), 90.0 - kFar) <= 20);
}

TEST_CASE("bars of two pixels and straight lines of one stay, but for their ends", "[cleaning]") {
    const DepthImage bars = seen(bar(2.0, GENERATE(0.0, 23.0, 45.0, 90.0)));
    CHECK(changed(bars, smoothed(bars)) <= 4);
    const DepthImage line = image_of(kColumns, kRows, 255.0, [](int i, int j) {
        return i == 80 && j >= 20 && j < 100 ? kNear : kFar;
    });
    const DepthImage shorter = smoothed(line);
    CHECK(changed(line, shorter) == 6);
    CHECK(shorter.at(80, 23) == line.at(80, 23));
    CHECK(shorter.at(80, 96) == line.at(80, 96));
}

TEST_CASE("ramps and slopes are no outlines", "[cleaning]") {
    const double px = GENERATE(8.0, 13.0, 30.0);
    const Inside inside = half_plane(GENERATE(0.0, 31.0, 90.0));
    const DepthImage ramp = image_of(kColumns, kRows, 255.0, [&](int i, int j) {
        return kFar + (kNear - kFar) * std::clamp(0.5 + inside(i, j) / px, 0.0, 1.0);
    });
    CHECK(changed(ramp, smoothed(ramp)) == 0);
}

TEST_CASE("there are never more teeth than before, and no levels that were not there",
          "[cleaning]") {
    const unsigned seed = GENERATE(range(1U, 9U));
    CAPTURE(seed);
    const DepthImage image = shattered(seed, 97, 61);
    const DepthImage smooth = smoothed(image);
    CHECK(teeth_of(smooth) < teeth_of(image));
    const auto [low, high] = std::minmax_element(image.levels.begin(), image.levels.end());
    CHECK(*std::min_element(smooth.levels.begin(), smooth.levels.end()) >= *low);
    CHECK(*std::max_element(smooth.levels.begin(), smooth.levels.end()) <= *high);
}

TEST_CASE("where other steps have made teeth, lines of one pixel go until there are no more",
          "[cleaning]") {
    // Each line has a tooth at either end.
    const DepthImage lines = image_of(kColumns, kRows, 255.0, [](int i, int j) {
        return i % 10 == 5 && j >= 20 && j < 60 ? kNear : kFar;
    });
    REQUIRE(teeth_of(lines) == 32);
    CHECK(teeth_of(smoothed(lines, 32)) == 32);
    CHECK(teeth_of(smoothed(lines, 31)) <= 31);
    CHECK(teeth_of(smoothed(lines, 0)) == 0);
}

TEST_CASE("pixels without data are on no side of an outline", "[cleaning]") {
    DepthImage image = seen(half_plane(0.0));
    image.at(80, 50) = static_cast<float>(kNear);
    REQUIRE(teeth_of(image) == 1);
    image.at(80, 49) = std::nanf("");
    CHECK(teeth_of(image) == 0);
}

TEST_CASE("outlines of any size are smoothed by one that has seen others as by a new one",
          "[cleaning]") {
    OutlineSmoother used;
    for (const int columns : {2, 3, 4, 5, 33, 97, 6}) {
        for (const int rows : {2, 3, 5, 40, 4}) {
            DepthImage image = shattered(7, columns, rows);
            const DepthImage other = smoothed(image, 0);
            used.smooth(image, 0);
            CAPTURE(columns, rows);
            CHECK(image.levels == other.levels);
        }
    }
}

TEST_CASE("every preset but raw leaves outlines no rougher than recorded", "[cleaning]") {
    const auto preset =
        GENERATE(CleaningPreset::automatic, CleaningPreset::gentle, CleaningPreset::sensor);
    const double noise = GENERATE(0.0, 1.0);
    std::mt19937 random(5);
    std::normal_distribution<double> normal;
    const Inside inside = disc(35.0);
    // A ramp with holes, as cameras see it.
    const DepthImage recorded = image_of(kColumns, kRows, 255.0, [&](int i, int j) {
        const double part = std::clamp(0.5 + inside(i, j) / 4.0, 0.0, 1.0);
        const bool is_ramp = part > 0.0 && part < 1.0;
        if (is_ramp && random() % 3 == 0) return std::nan("");
        return kFar + part * (kNear - kFar) + noise * normal(random);
    });
    const CleaningPlan plan =
        plan_of({.preset = preset}, {.constant = static_cast<float>(noise / 255.0)});
    REQUIRE(plan.steps.smooth_outlines);
    CHECK(teeth_of(*CleaningChain().clean_and_finish(recorded, plan).depth) <= teeth_of(recorded));
    CHECK_FALSE(plan_of({.preset = CleaningPreset::raw}, {}).steps.smooth_outlines);
}
