// The noise of a clip is measured, whatever moves in the clip.
#include "core/video/cleaning/depth_noise.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "core/video/cleaning/noise_bands.hpp"
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

namespace {

/// Noise of deviation 1 that is alike within a few pixels: grain through a binomial filter of 1, 2,
/// 1 in both directions, `rounds` times.
DepthImage correlated(unsigned seed, int rounds) {
    DepthImage noise = NoisyScene{[](int, int, int) { return 0.0; }, [](double) { return 1.0; }}
                           .frames(1, seed)
                           .front();
    for (int k = 0; k < rounds; ++k) {
        for (const auto& [right, down] : {std::pair{1, 0}, {0, 1}}) {
            const DepthImage before = noise;
            for (int j = 0; j < noise.rows; ++j)
                for (int i = 0; i < noise.columns; ++i)
                    noise.at(i, j) =
                        0.5F * before.at(i, j) +
                        0.25F * before.at(std::max(i - right, 0), std::max(j - down, 0)) +
                        0.25F * before.at(std::min(i + right, noise.columns - 1),
                                          std::min(j + down, noise.rows - 1));
        }
    }
    double squares = 0.0;
    for (const float level : noise.levels) squares += static_cast<double>(level * level);
    const double scale = std::sqrt(static_cast<double>(noise.levels.size()) / squares);
    for (float& level : noise.levels) level *= static_cast<float>(scale);
    return noise;
}

/// Frames of the tilted plane; `error(frame, pixel)` [levels].
template <typename Error>
std::vector<DepthImage> plane_with(int count, const Error& error) {
    const NoisyScene plane{tilted, [](double) { return 0.0; }};
    std::vector<DepthImage> frames;
    for (int k = 0; k < count; ++k) {
        DepthImage& frame = frames.emplace_back(plane.truth(k));
        for (std::size_t p = 0; p < frame.levels.size(); ++p) frame.levels[p] += error(k, p);
    }
    return frames;
}

double fixed_levels(const DepthNoise& noise) {
    return 255.0 * static_cast<double>(noise.character.fixed);
}

double mean_square(const std::vector<float>& values) {
    return std::inner_product(values.begin(), values.end(), values.begin(), 0.0) /
           static_cast<double>(values.size());
}

}  // namespace

TEST_CASE("white noise has the shares of the bands that are stated", "[noise]") {
    const DepthNoise noise = measured(NoisyScene{tilted, [](double) { return 0.7; }}.frames(10));
    for (std::size_t b = 0; b < kNoiseBands; ++b)
        CHECK_THAT(noise.character.bands[b],
                   WithinAbs(static_cast<double>(kWhiteBands[b]), b == 0 ? 0.03 : 0.01));
    CHECK(noise.character.kept < 0.1F);
    CHECK(fixed_levels(noise) < 0.2);
}

TEST_CASE("noise that neighbours share is in the coarser bands", "[noise]") {
    const DepthNoise noise = measured(plane_with(10, [](int frame, std::size_t pixel) {
        static std::vector<DepthImage> fields;
        while (fields.size() <= static_cast<std::size_t>(frame))
            fields.push_back(correlated(static_cast<unsigned>(fields.size()) + 1, 6));
        return fields[static_cast<std::size_t>(frame)].levels[pixel];
    }));
    CHECK(noise.character.bands[0] < 0.3F);
    CHECK(noise.character.bands[1] + noise.character.bands[2] > 0.3F);
    // Few values of the coarsest ones are in a tile, and their medians are below the mean.
    std::array<double, kNoiseBands> energies{};
    double whole = 0.0;
    NoiseBands bands;
    for (unsigned k = 0; k < 10; ++k) {
        const DepthImage field = correlated(k + 1, 6);
        bands.split({field.columns, field.rows, field.levels});
        whole += mean_square(field.levels);
        for (std::size_t b = 0; b < kNoiseBands; ++b)
            energies[b] += mean_square(bands.band(b).values);
    }
    for (std::size_t b = 0; b < kNoiseBands; ++b)
        CHECK_THAT(noise.character.bands[b], WithinRel(energies[b] / whole, 0.25));
}

TEST_CASE("noise that a frame keeps from the one before is told from fresh noise", "[noise]") {
    std::vector<DepthImage> fields;
    for (unsigned k = 0; k < 10; ++k) {
        fields.push_back(correlated(k + 1, 0));
        if (k == 0) continue;
        for (std::size_t p = 0; p < fields[k].levels.size(); ++p)
            fields[k].levels[p] =
                0.5F * fields[k - 1].levels[p] + std::sqrt(0.75F) * fields[k].levels[p];
    }
    const DepthNoise noise = measured(plane_with(10, [&](int frame, std::size_t pixel) {
        return fields[static_cast<std::size_t>(frame)].levels[pixel];
    }));
    CHECK_THAT(noise.character.kept, WithinAbs(0.5, 0.1));
    CHECK(fixed_levels(noise) < 0.4);
}

TEST_CASE("grain that stands still is measured beside noise that does not", "[noise]") {
    const DepthImage pattern = correlated(99, 0);
    const double moving = GENERATE(0.0, 1.0);
    const auto frames = NoisyScene{tilted, [moving](double) { return moving; }}.frames(10);
    std::vector<DepthImage> with = frames;
    for (DepthImage& frame : with)
        for (std::size_t p = 0; p < frame.levels.size(); ++p) frame.levels[p] += pattern.levels[p];
    CHECK_THAT(fixed_levels(measured(with)), WithinRel(1.0, 0.15));
    CHECK_THAT(fixed_levels(measured({with.front()})),
               WithinRel(std::sqrt(1.0 + moving * moving), 0.15));
}

TEST_CASE("a texture is no noise that stands still", "[noise]") {
    const DepthImage small = correlated(7, 4);
    const DepthImage large = correlated(8, 30);
    const DepthNoise noise = measured(plane_with(10, [&](int, std::size_t pixel) {
        return 2.0F * small.levels[pixel] + 6.0F * large.levels[pixel];
    }));
    CHECK(noise.character.fixed == 0.0F);
}

TEST_CASE(
    "what stands still all over the picture is noise of its band, what does here and there is not",
    "[noise]") {
    const DepthImage pattern = correlated(99, 0);
    const double share = GENERATE(1.0, 0.3);  // of the picture that has it
    std::vector<DepthImage> frames = NoisyScene{tilted, [](double) { return 1.0; }}.frames(10);
    for (DepthImage& frame : frames)
        for (std::size_t p = 0; p < frame.levels.size(); ++p)
            if (static_cast<double>(p) < share * static_cast<double>(frame.levels.size()))
                frame.levels[p] += 0.5F * pattern.levels[p];
    const NoiseCharacter character = measured(frames).character;
    const float whole = std::accumulate(character.standing.begin(), character.standing.end(), 0.0F);
    if (share < 1.0) {
        CHECK(whole < 0.05F);
    } else {
        CHECK(character.standing[0] > 0.5F);  // six times a quarter, as it varies
        CHECK(character.standing[0] < 2.0F);
        CHECK(character.standing[0] > 5.0F * character.standing[1]);
    }
    const auto clean = measured(NoisyScene{tilted, [](double) { return 1.0; }}.frames(10));
    for (const float band : clean.character.standing) CHECK(band < 0.02F);
}

TEST_CASE("steps of levels are measured: whole levels, and disparities that grow with distance",
          "[noise]") {
    const auto grain = [](double) { return 1.0; };
    std::vector<DepthImage> whole = NoisyScene{tilted, grain}.frames(3);
    for (DepthImage& frame : whole)
        for (float& level : frame.levels) level = std::round(level);
    const DepthNoise of_whole = measured(whole);
    for (const float height : {0.2F, 0.5F, 0.8F})
        CHECK_THAT(255.0 * static_cast<double>(of_whole.step.at(height)), WithinAbs(1.0, 0.05));

    // Level 255 is at 1 m, level 0 at 3 m; a disparity step is 20 mm at 2 m.
    std::vector<DepthImage> disparities = NoisyScene{tilted, grain, 160, 240}.frames(3);
    for (DepthImage& frame : disparities) {
        for (float& level : frame.levels) {
            const double metres = 3.0 - 2.0 * static_cast<double>(level) / 255.0;
            const double steps = std::round(200.0 / metres);
            level = static_cast<float>(255.0 * (3.0 - 200.0 / steps) / 2.0);
        }
    }
    const DepthNoise of_disparities = measured(disparities);
    const auto step_mm = [&](double metres) {
        const auto height = static_cast<float>((3.0 - metres) / 2.0);
        return 2000.0 * static_cast<double>(of_disparities.step.at(height));
    };
    CHECK_THAT(step_mm(1.5), WithinRel(11.25, 0.2));
    CHECK_THAT(step_mm(2.0), WithinRel(20.0, 0.2));
    CHECK_THAT(step_mm(2.5), WithinRel(31.25, 0.2));

    CHECK(measured(NoisyScene{tilted, grain}.frames(3)).step == StepByDistance{});
}

TEST_CASE("noise is the same after it was written as a text, also one of an older version",
          "[noise]") {
    const DepthNoise noise = measured(NoisyScene{tilted, [](double) { return 0.7; }}.frames(10));
    CHECK(noise_in(text_of(noise)) == noise);
    const auto old = noise_in("0.01 0.02 0.03 0.5 1");
    REQUIRE(old);
    CHECK(old->square == 0.03F);
    CHECK(old->per_frame_scale);
    CHECK(old->character == NoiseCharacter{});
    CHECK(old->step == StepByDistance{});
    CHECK_FALSE(noise_in("0.01 0.02"));
}
