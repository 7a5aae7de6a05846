// Noise is removed, shapes stay.
#include "core/video/cleaning/noise_smoothing.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/video/cleaning/temporal_filter.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/noisy_scene.hpp"

using namespace dibhr;
using namespace dibhr::test;
using Catch::Matchers::WithinAbs;

namespace {

DepthNoise noise_of(double levels) {
    return {.constant = static_cast<float>(levels / 255.0)};
}

DepthImage smoothed(DepthImage image, double noise) {
    NoiseSmoother().smooth(image, noise_of(noise));
    return image;
}

/// Filters in time and smooths, as the chain does.
DepthImage steadied_and_smoothed(const NoisyScene& scene, double noise) {
    std::vector<SingleFrameDepth> frames;
    for (DepthImage& frame : scene.frames(41)) frames.push_back({std::move(frame), {}, {}});
    std::vector<const SingleFrameDepth*> all;
    for (const SingleFrameDepth& frame : frames) all.push_back(&frame);
    TemporalFilter filter;
    DepthImage image = filter.filtered(all, 20, noise_of(noise));
    NoiseSmoother().smooth(image, noise_of(noise), filter.evidence());
    return image;
}

/// Round bumps of 1 px, 8 px wide, every 40 px.
double bump(int i, int j) {
    const double away = std::hypot(i % 40 - 20, j % 40 - 20);
    return away < 4.0 ? 0.5 * (1.0 + std::cos(3.14159265 * away / 4.0)) : 0.0;
}

}  // namespace

TEST_CASE("noise on slopes becomes a fifth of it, however steep they are", "[smoothing]") {
    const double slope = GENERATE(0.0, 0.3, 1.0, 2.0);
    const Scene plane = [slope](int, int i, int j) { return 10.0 + slope * (0.5 * i + 0.5 * j); };
    const NoisyScene scene{plane, [](double) { return 0.5; }, 120, 120};
    CHECK(rms_error(smoothed(scene.frames(1)[0], 0.5), scene.truth(0)) < 0.1);
}

TEST_CASE("a bump as high as twice the noise keeps seven tenths of itself", "[smoothing]") {
    const Scene bumps = [](int, int i, int j) { return 60.0 + 0.15 * i + 0.1 * j + bump(i, j); };
    const NoisyScene scene{bumps, [](double) { return 0.5; }, 320, 240};
    const DepthImage done = steadied_and_smoothed(scene, 0.5);
    double kept = 0.0;
    int count = 0;
    for (int j = 20; j < 240; j += 40)
        for (int i = 20; i < 320; i += 40, ++count)
            kept += static_cast<double>(done.at(i, j)) - (60.0 + 0.15 * i + 0.1 * j);
    CHECK(kept / count >= 0.7);
    CHECK(rms_error(done, scene.truth(10)) < 0.06);
}

TEST_CASE("ridges lower than the noise stay where time tells of them, and the ground is even",
          "[smoothing]") {
    const double period_px = GENERATE(6.0, 12.0, 24.0);
    const auto ridge = [period_px](int i) {
        return i < 160 ? 0.5 * std::sin(2.0 * 3.14159265 * i / period_px) : 0.0;
    };
    const Scene ridges = [ridge](int, int i, int j) { return 60.0 + 0.1 * j + ridge(i); };
    const NoisyScene scene{ridges, [](double) { return 0.8; }, 320, 240};
    const DepthImage done = steadied_and_smoothed(scene, 0.8);
    double products = 0.0;
    double squares = 0.0;
    double even = 0.0;
    for (int j = 20; j < 220; ++j) {
        for (int i = 24; i < 144; ++i) {
            products += ridge(i) * (static_cast<double>(done.at(i, j)) - 60.0 - 0.1 * j);
            squares += ridge(i) * ridge(i);
        }
        for (int i = 190; i < 300; ++i)
            even += std::pow(static_cast<double>(done.at(i, j)) - 60.0 - 0.1 * j, 2.0);
    }
    CHECK(products / squares > 0.8);
    CHECK(products / squares < 1.05);
    CHECK(std::sqrt(even / (200.0 * 110.0)) < 0.12);
}

TEST_CASE("noise that stands still is smoothed, too", "[smoothing]") {
    DepthNoise noise = noise_of(0.5);
    noise.character.standing = {0.9F, 0.05F, 0.01F, 0.002F, 0.001F};
    const Scene plane = [](int, int i, int j) { return 60.0 + 0.1 * i + 0.1 * j; };
    const NoisyScene scene{plane, [](double) { return 0.5; }};
    // As if the noise were the same in all of 27 frames.
    TimeEvidence evidence;
    evidence.near_frames = 11;
    evidence.weights.assign(std::size_t{160} * 120, 27.0F);
    evidence.variances.assign(std::size_t{20} * 15, 0.25F);
    DepthImage image = scene.frames(1)[0];
    NoiseSmoother().smooth(image, noise, evidence);
    CHECK(rms_error(image, scene.truth(0)) < 0.13);
}

TEST_CASE("what stands out alone by some deviations of the noise goes, what does by many stays",
          "[smoothing]") {
    // Blocks of 2 x 2 pixels, as codecs leave them, and lines.
    const auto patterned = [](double block_px, double line_px) {
        return Scene([block_px, line_px](int, int i, int j) {
            const bool block = i % 10 < 2 && j % 10 < 2 && i > 9 && j > 9 && i < 80;
            const bool line = i == 100;
            return 60.0 + 0.2 * i + 0.1 * j + (block ? block_px : 0.0) + (line ? line_px : 0.0);
        });
    };
    const auto off_at = [](const Scene& scene, int i, int j) {
        const NoisyScene shaken{scene, [](double) { return 0.1; }, 120, 90};
        return static_cast<double>(smoothed(shaken.frames(1)[0], 0.5).at(i, j)) -
               (60.0 + 0.2 * i + 0.1 * j);
    };
    CHECK(std::fabs(off_at(patterned(1.5, 0.0), 20, 20)) < 0.5);
    CHECK(std::fabs(off_at(patterned(-1.5, 0.0), 31, 41)) < 0.5);
    CHECK(off_at(patterned(30.0, 0.0), 40, 50) > 27.0);
    CHECK(off_at(patterned(0.0, 30.0), 100, 45) > 27.0);
}

TEST_CASE("an edge keeps its place and its height", "[smoothing]") {
    const Scene edge = [](int, int i, int j) { return i + 0.4 * j < 90.0 ? 60.0 : 100.0; };
    const NoisyScene scene{edge, [](double) { return 0.5; }};
    const DepthImage truth = scene.truth(0);
    const DepthImage done = smoothed(scene.frames(1)[0], 0.5);
    double most = 0.0;
    for (std::size_t k = 0; k < truth.levels.size(); ++k)
        most = std::max(most, static_cast<double>(std::fabs(done.levels[k] - truth.levels[k])));
    CHECK(most < 3.0);
}

TEST_CASE("a sphere stays a sphere", "[smoothing]") {
    const Scene sphere = [](int, int i, int j) {
        const double square = 3600.0 - std::pow(i - 80.0, 2.0) - std::pow(j - 60.0, 2.0);
        return square > 0.0 ? 40.0 + std::sqrt(square) : 40.0;
    };
    const NoisyScene scene{sphere, [](double) { return 0.5; }};
    const DepthImage truth = scene.truth(0);
    const DepthImage done = smoothed(scene.frames(1)[0], 0.5);
    double sum = 0.0;
    int count = 0;
    for (int j = 28; j < 92; ++j)  // up to a slope of 1.1
        for (int i = 48; i < 112; ++i, ++count)
            sum += std::pow(static_cast<double>(done.at(i, j) - truth.at(i, j)), 2.0);
    CHECK(std::sqrt(sum / count) < 0.25);
}

TEST_CASE("a plane without noise stays as it is, and levels stay in their range", "[smoothing]") {
    const DepthImage plane =
        image_of(90, 70, 255.0, [](int i, int j) { return 0.5 * i + 2.0 * j; });
    const DepthImage done = smoothed(plane, 1.0);
    CHECK(rms_error(done, plane, 0) < 1e-3);
    const NoisyScene rough{[](int, int i, int) { return i % 9 < 4 ? 1.0 : 254.0; },
                           [](double) { return 5.0; }};
    const DepthImage given = rough.frames(1)[0];
    const auto [lowest, highest] = std::minmax_element(given.levels.begin(), given.levels.end());
    for (const float level : smoothed(given, 5.0).levels)
        REQUIRE((level >= *lowest && level <= *highest));
}

TEST_CASE("images of any small size are smoothed without reading beside them", "[smoothing]") {
    NoiseSmoother smoother;
    for (int rows = 2; rows < 20; ++rows)
        for (int columns = 2; columns < 20; ++columns) {
            DepthImage image = image_of(columns, rows, 255.0,
                                        [](int i, int j) { return 100.0 + (i * 7 + j * 13) % 5; });
            smoother.smooth(image, noise_of(1.0));
            REQUIRE(std::all_of(image.levels.begin(), image.levels.end(),
                                [](float level) { return level >= 99.0F && level <= 105.0F; }));
        }
}

TEST_CASE("the same image gives the same bits, whatever was smoothed before", "[smoothing]") {
    const NoisyScene scene{[](int, int i, int j) { return 50.0 + 0.3 * i + 0.4 * j; },
                           [](double) { return 1.0; }};
    NoiseSmoother used;
    DepthImage other = scene.frames(1, 7)[0];
    used.smooth(other, noise_of(1.0));
    DepthImage image = scene.frames(1, 8)[0];
    used.smooth(image, noise_of(1.0));
    CHECK(image.levels == smoothed(scene.frames(1, 8)[0], 1.0).levels);
}
