// Which way of cleaning a trial on a clip's first frames takes, and what it says.
#include "core/video/playing/clip_trial.hpp"

#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "tests/support/catch.hpp"

using namespace dibhr;

namespace {

constexpr int kWide = 200;
constexpr int kHigh = 150;
constexpr double kLevelsPerPx = 257.0;  // 16 bits over 255 px
constexpr CleaningSteps kSmooth{.steady = true, .smooth_noise = true};
constexpr CleaningSteps kNothing{};

using Height = std::function<double(int frame, int i, int j)>;  // [px]

double plane_px(int, int i, int j) {
    return 80.0 + 0.1 * i + 0.05 * j;
}

double ridged_px(int frame, int i, int j) {
    return plane_px(frame, i, j) + 1.6 * std::sin(2.0 * std::numbers::pi * i / 6.0);
}

/// Frames of a surface, through white noise.
ClipTrial trial_of(const Height& height_px, double noise_px, int frames = 10) {
    std::mt19937 random(3);
    std::normal_distribution<double> normal;
    ClipTrial trial;
    for (int frame = 0; frame < frames; ++frame)
        trial.add(image_of(kWide, kHigh, 65535.0, [&](int i, int j) {
            return kLevelsPerPx * (height_px(frame, i, j) + noise_px * normal(random));
        }));
    return trial;
}

DepthNoise noise_of(double px) {
    return {.constant = static_cast<float>(px / 255.0)};
}

}  // namespace

TEST_CASE("of ways that feel alike the first is taken", "[cleaning]") {
    const std::array ways{kNothing, kSmooth};
    const auto felt = trial_of(plane_px, 0.05).best_of(ways, noise_of(0.05));
    REQUIRE(felt);
    CHECK(felt->steps == kNothing);
    CHECK(felt->buzz_N == felt->raw_N);
    CHECK(felt->relief == std::nullopt);
}

TEST_CASE("noise that a finger feels is cleaned away", "[cleaning]") {
    const std::array ways{kNothing, kSmooth};
    const auto felt = trial_of(plane_px, 0.8).best_of(ways, noise_of(0.8));
    REQUIRE(felt);
    CHECK(felt->steps == kSmooth);
    // 0.8 px at 0.5 N/mm and 0.141 mm a pixel.
    CHECK(std::fabs(felt->raw_N - 0.056) < 0.01);
    CHECK(felt->buzz_N < 0.4 * felt->raw_N);
}

TEST_CASE("steps that take more detail than noise are not taken", "[cleaning]") {
    constexpr CleaningSteps kOfOnePicture{.smooth_noise = true};
    // In one picture ridges of 1.6 px may be noise of 0.9 px, in all frames they are not.
    const std::array ways{kOfOnePicture, kNothing};
    const auto felt = trial_of(ridged_px, 0.2).best_of(ways, noise_of(0.9));
    REQUIRE(felt);
    CHECK(felt->steps == kNothing);
    CHECK(felt->relief.value_or(0.0) > 0.95);
    const std::array in_time{kSmooth, kNothing};
    const auto felt_in_time = trial_of(ridged_px, 0.2).best_of(in_time, noise_of(0.9));
    REQUIRE(felt_in_time);
    CHECK(felt_in_time->steps == kSmooth);
    CHECK(felt_in_time->relief.value_or(0.0) > 0.95);
}

TEST_CASE("no way is taken that feels worse than none of them", "[cleaning]") {
    const std::array ways{kSmooth, kNothing};
    const double noise_px = GENERATE(0.0, 0.1, 0.3, 1.0, 2.0);
    const bool has_ridges = GENERATE(false, true);
    CAPTURE(noise_px, has_ridges);
    const auto felt =
        trial_of(has_ridges ? ridged_px : plane_px, noise_px).best_of(ways, noise_of(noise_px));
    REQUIRE(felt);
    constexpr double kNotFelt_N = 0.005;
    CHECK(felt->buzz_N <= std::hypot(felt->raw_N, kNotFelt_N));
}

TEST_CASE("what stands still is relief only where it stands out of the noise", "[cleaning]") {
    const std::array ways{kNothing};
    const auto has_relief = [&](const ClipTrial& trial, const DepthNoise& noise) {
        const auto felt = trial.best_of(ways, noise);
        REQUIRE(felt);
        return felt->relief.has_value();
    };
    CHECK(has_relief(trial_of(ridged_px, 0.3), noise_of(0.3)));
    CHECK_FALSE(has_relief(trial_of(ridged_px, 1.5), noise_of(1.5)));
    // Known grain and steps are none.
    DepthNoise noise = noise_of(0.3);
    noise.character.fixed = static_cast<float>(1.2 / 255.0);
    CHECK_FALSE(has_relief(trial_of(ridged_px, 0.3), noise));
    noise = noise_of(0.3);
    noise.step.constant = static_cast<float>(3.0 / 255.0);
    CHECK_FALSE(has_relief(trial_of(ridged_px, 0.3), noise));
}

TEST_CASE("nothing is tried on few frames, on what moves, or without data", "[cleaning]") {
    const std::array ways{kNothing, kSmooth};
    CHECK_FALSE(trial_of(plane_px, 0.5, 4).best_of(ways, noise_of(0.5)));
    const auto moving_px = [](int frame, int i, int j) {
        return plane_px(frame, i + 60 * frame, j);
    };
    CHECK_FALSE(trial_of(moving_px, 0.5).best_of(ways, noise_of(0.5)));
    const auto unseen_px = [](int, int, int) { return std::nan(""); };
    CHECK_FALSE(trial_of(unseen_px, 0.5).best_of(ways, noise_of(0.5)));
    DepthNoise scaled = noise_of(0.5);
    scaled.per_frame_scale = true;
    CHECK_FALSE(trial_of(plane_px, 0.5).best_of(ways, scaled));
}

TEST_CASE("the line says what was chosen and why", "[cleaning]") {
    const FeltCleaning felt{
        .steps = ways_of_automatic(1000).at(1), .buzz_N = 0.0123, .raw_N = 0.071, .relief = 0.93};
    const CleaningPlan plan = plan_of({}, noise_of(0.9), 1000, false, felt);
    CHECK(plan.steps == kSensorSteps);
    CHECK(in_words({}, plan) ==
          "auto: sensor, noise 0.9 px; a slide buzzes by 0.012 N, 0.071 raw, 93 % of relief kept");
    // Only `auto` asks what was felt.
    CHECK(plan_of({.preset = CleaningPreset::gentle}, noise_of(0.9), 1000, false, felt).steps ==
          kGentleSteps);
    // More pixels than there is time for.
    for (const CleaningSteps& steps : ways_of_automatic(kMostPixelsForSensor + 1))
        CHECK_FALSE(steps.smooth_noise);
}
