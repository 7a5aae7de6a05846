// Terraces of any coding become slopes; what is more than a step stays.
#include "core/video/cleaning/step_smoothing.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "core/video/cleaning/cleaning_chain.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr;

namespace {

constexpr double kHighest = 65535.0;
constexpr int kColumns = 320;
constexpr int kRows = 240;

/// How a file holds depth: a level, coded and decoded again, and the step there.
struct Coding {
    std::string name;
    std::function<double(double)> decoded;
    std::function<double(double)> step;
};

Coding even_steps(const std::string& name, double count) {
    const double step = kHighest / count;
    return {name, [=](double level) { return step * std::round(level / step); },
            [=](double) { return step; }};
}

/// Kinect v1: 348 disparities times metres, seen from 0.8 to 4 m.
Coding disparities() {
    constexpr double kNear_m = 0.8;
    constexpr double kFar_m = 4.0;
    constexpr double kDisparities_m = 348.0;
    constexpr double kLevelsPerMetre = kHighest / (kFar_m - kNear_m);
    const auto metres = [](double level) { return kFar_m - level / kLevelsPerMetre; };
    return {"disparities",
            [=](double level) {
                const double disparity = std::round(kDisparities_m / metres(level));
                return kLevelsPerMetre * (kFar_m - kDisparities_m / disparity);
            },
            [=](double level) {
                return kLevelsPerMetre * metres(level) * metres(level) / kDisparities_m;
            }};
}

std::vector<Coding> codings() {
    return {even_steps("hue", 1530.0), disparities(), even_steps("8 bits in 16", 255.0)};
}

DepthImage coded(const Coding& coding, const std::function<double(int, int)>& level) {
    return image_of(kColumns, kRows, kHighest,
                    [&](int i, int j) { return coding.decoded(level(i, j)); });
}

DepthNoise measured(const DepthImage& still) {
    NoiseMeter meter;
    for (std::size_t k = 0; k < NoiseMeter::kEnoughFrames; ++k) meter.add(still);
    return meter.noise();
}

DepthImage smoothed(DepthImage image, const DepthNoise& noise) {
    StepSmoother().smooth_measured(image, noise);
    return image;
}

/// Root mean square of how far slopes along rows are from the plane's [levels per px].
double slope_error(const DepthImage& image, double slope) {
    double sum = 0.0;
    for (int j = 0; j < image.rows; ++j)
        for (int i = 0; i + 1 < image.columns; ++i) {
            const double rise = static_cast<double>(image.at(i + 1, j) - image.at(i, j)) - slope;
            sum += rise * rise;
        }
    return std::sqrt(sum / (image.rows * (image.columns - 1)));
}

}  // namespace

TEST_CASE("the terraces of a plane in any coding become a slope within half a step", "[cleaning]") {
    const Coding coding = GENERATE(from_range(codings()));
    const double steps_per_px = GENERATE(0.05, 0.1, 0.3);
    CAPTURE(coding.name, steps_per_px);
    constexpr double kMiddle = 0.6 * kHighest;
    const double slope = steps_per_px * coding.step(kMiddle);
    const auto plane = [&](int i, int j) {
        return kMiddle + slope * (i - kColumns / 2) + 0.4 * slope * (j - kRows / 2);
    };
    const DepthImage stepped = coded(coding, plane);
    const DepthImage smooth = smoothed(stepped, measured(stepped));
    CHECK(slope_error(smooth, slope) < 0.25 * slope_error(stepped, slope));
    double farthest = 0.0;  // steps
    for (int j = 0; j < kRows; ++j)
        for (int i = 0; i < kColumns; ++i)
            farthest =
                std::max(farthest, std::fabs(static_cast<double>(smooth.at(i, j)) - plane(i, j)) /
                                       coding.step(plane(i, j)));
    CHECK(farthest <= 0.5);
}

TEST_CASE("a cliff and a ledge of three steps keep their place and height", "[cleaning]") {
    const Coding coding = GENERATE(from_range(codings()));
    const double steps = GENERATE(2.0, 3.0, 40.0);
    CAPTURE(coding.name, steps);
    constexpr double kLow = 0.5 * kHighest;
    const DepthImage ledge = coded(coding, [&](int i, int j) {
        return kLow + (i + j / 3 < 200 ? 0.0 : steps * coding.step(kLow));
    });
    DepthNoise noise;
    noise.step.constant = static_cast<float>(coding.step(kLow) / kHighest);
    CHECK(smoothed(ledge, noise).levels == ledge.levels);
}

TEST_CASE("levels that noise carries from step to step, and those without steps, stay",
          "[cleaning]") {
    const Coding coding = even_steps("8 bits in 16", 255.0);
    const DepthImage stepped = coded(coding, [](int i, int j) { return 20000.0 + 40.0 * i + j; });
    DepthNoise noise = measured(stepped);
    CHECK_FALSE(smoothed(stepped, noise).levels == stepped.levels);
    noise.constant = 0.05F * noise.step.at(0.4F);
    CHECK_FALSE(smoothed(stepped, noise).levels == stepped.levels);
    noise.constant = 0.15F * noise.step.at(0.4F);
    CHECK(smoothed(stepped, noise).levels == stepped.levels);
    CHECK(smoothed(stepped, {}).levels == stepped.levels);
}

TEST_CASE(
    "a smoother that has smoothed 8 bits smooths measured steps as a new one, and the reverse",
    "[cleaning]") {
    const Coding coding = even_steps("hue", 1530.0);
    const DepthImage stepped = coded(coding, [](int i, int j) { return 30000.0 + 4.0 * i + j; });
    const DepthImage eight = image_of(
        kColumns, kRows, 255.0, [](int i, int j) { return std::floor(50.0 + 0.1 * i + 0.02 * j); });
    const DepthNoise noise = measured(stepped);
    StepSmoother used;
    for (int k = 0; k < 2; ++k) {
        DepthImage first = eight;
        DepthImage alone = eight;
        used.smooth(first);
        StepSmoother().smooth(alone);
        CHECK(first.levels == alone.levels);
        DepthImage second = stepped;
        used.smooth_measured(second, noise);
        CHECK(second.levels == smoothed(stepped, noise).levels);
    }
}

TEST_CASE("the chain smooths measured steps where its steps depend on the noise", "[cleaning]") {
    const DepthImage stepped =
        coded(even_steps("8 bits in 16", 255.0), [](int i, int) { return 20000.0 + 30.0 * i; });
    CleaningPlan plan{.steps = {.sharpen_silhouettes = true, .smooth_steps = true},
                      .noise = measured(stepped)};
    CHECK(CleaningChain().clean_and_finish(stepped, plan).depth->levels ==
          smoothed(stepped, plan.noise).levels);
    plan.steps = kGentleSteps;  // the same whether the noise was measured or not
    CHECK(CleaningChain().clean_and_finish(stepped, plan).depth->levels == stepped.levels);
}
