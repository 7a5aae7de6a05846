// The noise of a clip is measured, whatever moves in the clip.
#include "core/video/cleaning/depth_noise.hpp"

#include <cmath>
#include <limits>

#include "tests/support/catch.hpp"
#include "tests/support/noisy_scene.hpp"

using namespace dibhr;
using namespace dibhr::test;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

DepthNoise measured(const std::vector<DepthImage>& frames) {
    NoiseMeter meter;
    for (const DepthImage& frame : frames) meter.add(frame);
    return meter.noise();
}

double tilted(int /*frame*/, int i, int j) {
    return 20.0 + 1.3 * i + 0.2 * j;
}

/// In levels of 255.
double deviation_at(const DepthNoise& noise, double level) {
    return 255.0 * static_cast<double>(noise.at(static_cast<float>(level / 255.0)));
}

}  // namespace

TEST_CASE("noise that is the same everywhere is measured within a tenth", "[noise]") {
    const double sigma = GENERATE(0.1, 0.5, 3.0);
    const DepthNoise noise =
        measured(NoisyScene{tilted, [sigma](double) { return sigma; }}.frames(10));
    for (const double level : {30.0, 120.0, 220.0})
        CHECK_THAT(deviation_at(noise, level), WithinRel(sigma, 0.1));
    CHECK(noise.correlation < 0.1F);
}

TEST_CASE("noise that grows with the square of the distance is measured within 0.15 levels",
          "[noise]") {
    const auto sigma = [](double level) { return 0.3 + 4.0 * std::pow(1.0 - level / 255.0, 2.0); };
    const DepthNoise noise = measured(NoisyScene{tilted, sigma, 320, 240}.frames(10));
    for (const double level : {40.0, 120.0, 220.0})
        CHECK_THAT(deviation_at(noise, level), WithinAbs(sigma(level), 0.15));
}

TEST_CASE("a clean clip has no noise, still or in even motion", "[noise]") {
    const double step = GENERATE(0.0, 1.5);
    const auto moving = [step](int frame, int i, int j) { return tilted(0, i, j) + step * frame; };
    CHECK_THAT(
        deviation_at(measured(NoisyScene{moving, [](double) { return 0.0; }}.frames(10)), 100.0),
        WithinAbs(0.0, 1e-3));
}

TEST_CASE("something that passes before a wall is no noise of the wall", "[noise]") {
    const auto passing = [](int frame, int i, int j) {
        const int left = 10 + 9 * frame;
        return i >= left && i < left + 40 && j > 30 && j < 54 ? 200.0 : 60.0;
    };
    const DepthNoise noise = measured(NoisyScene{passing, [](double) { return 0.5; }}.frames(10));
    CHECK_THAT(deviation_at(noise, 60.0), WithinRel(0.5, 0.2));
}

TEST_CASE("blotches are told from grain", "[noise]") {
    NoisyScene coarse{[](int, int, int) { return 0.0; }, [](double) { return 2.0; }, 40, 30};
    std::vector<DepthImage> frames;
    for (const DepthImage& few : coarse.frames(10)) {
        frames.push_back(image_of(160, 120, 255.0, [&](int i, int j) {
            const double u = i / 4.0;
            const double v = j / 4.0;
            const int x = std::min(static_cast<int>(u), 38);
            const int y = std::min(static_cast<int>(v), 28);
            const double top = std::lerp(few.at(x, y), few.at(x + 1, y), u - x);
            const double low = std::lerp(few.at(x, y + 1), few.at(x + 1, y + 1), u - x);
            return 100.0 + std::lerp(top, low, v - y);
        }));
    }
    CHECK(measured(frames).correlation > 0.7F);
}

TEST_CASE("of a still picture the grain is its noise, and of nothing there is none", "[noise]") {
    const NoisyScene scene{tilted, [](double) { return 0.5; }};
    CHECK_THAT(deviation_at(measured(scene.frames(1)), 100.0), WithinRel(0.5, 0.15));
    CHECK(measured({}) == DepthNoise{});
    const float none = std::numeric_limits<float>::quiet_NaN();
    CHECK(measured({image_of(40, 40, 255.0, [none](int, int) { return none; })}) == DepthNoise{});
}
