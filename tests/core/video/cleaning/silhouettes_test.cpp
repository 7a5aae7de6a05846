// Ramps between near and far become steps; slopes, bumps and crisp edges stay.
#include "core/video/cleaning/silhouettes.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "core/video/frames/frame_window.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/some_of.hpp"

using namespace dibhr;
using Catch::Matchers::WithinAbs;

namespace {

constexpr int kColumns = 640;
constexpr int kRows = 200;
constexpr double kNear = 180.0;
constexpr double kFar = 60.0;

using At = std::function<double(double, double)>;  // of column and row

DepthImage with_noise(const At& level, double noise_levels, int rows = kRows) {
    std::mt19937 random(7);
    std::normal_distribution<double> normal;
    return image_of(kColumns, rows, 255.0,
                    [&](int i, int j) { return level(i, j) + noise_levels * normal(random); });
}

/// An object before a background; `inside` is the distance to its outline [px], positive in it.
struct Object {
    At inside{};
    At near{[](double, double) { return kNear; }};
    At far{[](double, double) { return kFar; }};

    [[nodiscard]] double truth(double x, double y) const {
        return inside(x, y) > 0.0 ? near(x, y) : far(x, y);
    }
    /// The same with a ramp as outline.
    [[nodiscard]] DepthImage seen(double ramp_px, double noise_levels = 0.0) const {
        return with_noise(
            [&](double x, double y) {
                const double part = std::clamp(0.5 + inside(x, y) / ramp_px, 0.0, 1.0);
                return far(x, y) + part * (near(x, y) - far(x, y));
            },
            noise_levels);
    }
};

At disc(double radius_px) {
    return [=](double x, double y) { return radius_px - std::hypot(x - 320.3, y - 100.1); };
}
At half_plane(double degrees) {
    const double angle_rad = degrees * std::numbers::pi / 180.0;
    return [=](double x, double y) {
        return (x - 320.3) * std::cos(angle_rad) + (y - 100.1) * std::sin(angle_rad);
    };
}
At stripe(double width_px, double degrees) {
    return [=, across = half_plane(degrees)](double x, double y) {
        return 0.5 * width_px - std::fabs(across(x, y));
    };
}

DepthImage sharpened(DepthImage image, double noise_levels = 0.0,
                     const ColourImage* colour = nullptr) {
    SilhouetteSharpener().sharpen(image, colour, static_cast<float>(noise_levels));
    return image;
}

/// Share of the pixels near an outline, but not next to it or to the border, that are on neither
/// side or on the wrong one.
double misplaced(const DepthImage& image, const Object& object, double tolerance_levels) {
    constexpr int kBorder_px = 24;
    int near_outline = 0;
    int wrong = 0;
    for (int j = kBorder_px; j < image.rows - kBorder_px; ++j) {
        for (int i = kBorder_px; i < image.columns - kBorder_px; ++i) {
            const double away_px = std::fabs(object.inside(i, j));
            if (away_px <= 1.0 || away_px > 8.0) continue;
            ++near_outline;
            const double error = std::fabs(image.at(i, j) - object.truth(i, j));
            wrong += error > tolerance_levels ? 1 : 0;
        }
    }
    REQUIRE(near_outline > 100);
    return static_cast<double>(wrong) / near_outline;
}

bool same(const DepthImage& one, const DepthImage& other) {
    return one.levels == other.levels;
}

ColourImage painted(int columns, int rows, const std::function<int(int, int)>& grey) {
    ColourImage colour{columns, rows, {}};
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i)
            colour.rgb.insert(colour.rgb.end(), 3, static_cast<std::uint8_t>(grey(i, j)));
    return colour;
}

/// The first column of the near side in a row.
int step_in_row(const DepthImage& image, int row) {
    int i = 0;
    while (i + 1 < image.columns && image.at(i, row) < 0.5 * (kNear + kFar)) ++i;
    return i;
}

}  // namespace

TEST_CASE("a ramp becomes a step where it was half way up, within a pixel", "[silhouettes]") {
    const double ramp_px = GENERATE(some_of<double>({7.0, 1.0, 3.0, 13.0}, 2));
    const double noise_levels = GENERATE(some_of<double>({1.0, 0.0, 2.0}, 1));
    CAPTURE(ramp_px, noise_levels);
    const double tolerance_levels = 6.0 + 4.0 * noise_levels;
    SECTION("of a straight outline at any angle") {
        const double degrees = GENERATE(0.0, 20.0, 45.0, 65.0, 90.0, 200.0);
        CAPTURE(degrees);
        const Object object{half_plane(degrees)};
        const DepthImage seen = object.seen(ramp_px, noise_levels);
        if (ramp_px > 3.0) CHECK(misplaced(seen, object, tolerance_levels) > 0.1);
        CHECK(misplaced(sharpened(seen, noise_levels), object, tolerance_levels) < 0.025);
    }
    SECTION("of a round one, large or small") {
        const Object object{disc(GENERATE(60.0, 20.0))};
        const DepthImage seen = object.seen(ramp_px, noise_levels);
        CHECK(misplaced(sharpened(seen, noise_levels), object, tolerance_levels) < 0.03);
    }
}

TEST_CASE("each side goes on as it was up to the step", "[silhouettes]") {
    Object object{disc(60.0)};
    object.near = [](double x, double y) { return 60.0 + 0.3 * x + 0.2 * y; };
    object.far = [](double x, double y) { return 10.0 + 0.1 * x - 0.1 * y; };
    const double ramp_px = GENERATE(3.0, 7.0, 13.0);
    CAPTURE(ramp_px);
    CHECK(misplaced(sharpened(object.seen(ramp_px)), object, 3.0) < 0.03);
}

TEST_CASE("a face that bends away from its outline keeps its shape", "[silhouettes]") {
    constexpr double kRadius_px = 80.0;
    Object object{disc(kRadius_px)};
    object.near = [&](double x, double y) {
        const double from_centre_px = std::min(kRadius_px - object.inside(x, y), kRadius_px - 0.3);
        return 140.0 + std::sqrt(kRadius_px * kRadius_px - from_centre_px * from_centre_px);
    };
    CHECK(misplaced(sharpened(object.seen(5.0)), object, 15.0) < 0.02);
    CHECK(misplaced(sharpened(object.seen(0.01)), object, 1.0) < 0.01);  // a step already
}

TEST_CASE("thin things keep their width and height", "[silhouettes]") {
    SECTION("a finger of six pixels between two ramps") {
        const double degrees = GENERATE(0.0, 30.0, 45.0);
        CAPTURE(degrees);
        const Object finger{stripe(6.0, degrees)};
        CHECK(misplaced(sharpened(finger.seen(5.0)), finger, 6.0) < 0.02);
    }
    SECTION("a hair of one pixel") {
        const DepthImage hair =
            with_noise([](double x, double) { return x == 320 ? kNear : kFar; }, 0);
        CHECK(same(sharpened(hair), hair));
    }
    SECTION("a pixel flying between the two sides goes to the one that it is nearer to") {
        const double part = GENERATE(0.2, 0.4, 0.6, 0.8);
        const DepthImage seen = with_noise(
            [&](double x, double) {
                if (x == 320) return kFar + part * (kNear - kFar);
                return x > 320 ? kNear : kFar;
            },
            0.0);
        CHECK_THAT(sharpened(seen).at(320, 50), WithinAbs(part > 0.5 ? kNear : kFar, 1e-3));
    }
}

TEST_CASE("what is no ramp stays as it is, to the bit", "[silhouettes]") {
    const auto hemisphere = [](double radius_px) {
        return [=](double x, double y) {
            const double square =
                radius_px * radius_px - (x - 320) * (x - 320) - (y - 100) * (y - 100);
            return 10.0 + std::sqrt(std::max(square, 0.0));
        };
    };
    const auto [name, level] = GENERATE_COPY(values<std::pair<std::string, At>>({
        {"a cone", [](double x, double y) { return std::max(0.0, 240.0 - 3.0 * std::hypot(x - 320, y - 100)); }},
        {"a steep cone", [](double x, double y) { return std::max(0.0, 240.0 - 8.0 * std::hypot(x - 320, y - 100)); }},
        {"a large sphere's side", hemisphere(90.0)},
        {"a small sphere's side", hemisphere(20.0)},
        {"a cheek", [](double x, double) { return 100.0 + 100.0 * std::cos(std::clamp((x - 320) / 60.0, -std::numbers::pi, std::numbers::pi)); }},
        {"a steep plane", [](double x, double y) { return 0.4 * x + 4.0 * y; }},
        {"a table of 255 levels over the picture", [](double x, double) { return x * 255.0 / kColumns; }},
        {"a roof", [](double x, double) { return std::max(0.0, 200.0 - 4.0 * std::fabs(x - 320)); }},
        {"a bevel of 30 px", [](double x, double) { return 40.0 + 5.0 * std::clamp(x - 300, 0.0, 30.0); }},
        {"a bump of 1 px, 8 px wide", [](double x, double) { return std::fabs(x - 320) < 4 ? 101.0 : 100.0; }},
        {"a crisp step between slopes", [](double x, double y) { return x < 300 ? 50.0 + 0.5 * x + 0.2 * y : 20.0 + 0.3 * x; }},
    }));
    CAPTURE(name);
    const DepthImage image = with_noise(level, 0.0);
    CHECK(same(sharpened(image), image));
}

TEST_CASE("noise is no step", "[silhouettes]") {
    const double noise_levels = GENERATE(1.0, 4.0);
    const double slope = GENERATE(0.0, 0.4);
    const DepthImage image =
        with_noise([&](double x, double) { return 20.0 + slope * x; }, noise_levels, 480);
    CHECK(same(sharpened(image, noise_levels), image));
}

TEST_CASE("across a wide ramp the step is where the colour has its one sharp edge",
          "[silhouettes]") {
    const Object object{half_plane(0.0)};  // half way up at column 320
    const DepthImage seen = object.seen(13.0, 1.0);
    const int edge = GENERATE(315, 320, 325);
    SECTION("in a picture of the same size") {
        const ColourImage colour =
            painted(kColumns, kRows, [&](int i, int) { return i < edge ? 40 : 140; });
        CHECK(std::abs(step_in_row(sharpened(seen, 1.0, &colour), 100) - edge) <= 1);
    }
    SECTION("in one that is finer or coarser") {
        const double scale = GENERATE(2.0, 0.5);
        const ColourImage colour =
            painted(static_cast<int>(kColumns * scale), static_cast<int>(kRows * scale),
                    [&](int i, int) { return i < edge * scale ? 140 : 40; });
        CHECK(std::abs(step_in_row(sharpened(seen, 1.0, &colour), 100) - edge) <= 2);
    }
}

TEST_CASE("a colour that has no such edge does not move the step", "[silhouettes]") {
    const Object object{half_plane(0.0)};
    const DepthImage seen = object.seen(13.0);
    const auto grey = GENERATE(values<std::function<int(int, int)>>({
        [](int, int) { return 90; },                    // plain
        [](int i, int) { return i < 325 ? 80 : 100; },  // hardly another colour
        [](int i, int) { return std::clamp(40 + 10 * (i - 316), 40, 140); },  // blurred
        [](int i, int) { return (i / 3) % 2 == 0 ? 40 : 140; },               // striped
    }));
    const ColourImage colour = painted(kColumns, kRows, grey);
    CHECK(same(sharpened(seen, 0.0, &colour), sharpened(seen)));
}

TEST_CASE("the same picture gives the same bits, whatever came before", "[silhouettes]") {
    SilhouetteSharpener sharpener;
    DepthImage other = Object{stripe(40.0, 30.0)}.seen(9.0, 1.0);
    sharpener.sharpen(other, nullptr, 1.0F);
    DepthImage image = Object{disc(60.0)}.seen(7.0, 1.0);
    const DepthImage alone = sharpened(image, 1.0);
    sharpener.sharpen(image, nullptr, 1.0F);
    CHECK(same(image, alone));
}

TEST_CASE("a picture of any size is sharpened, and stays within its levels", "[silhouettes]") {
    const int columns = GENERATE(1, 2, 3, 4, 5, 40);
    const int rows = GENERATE(1, 2, 5, 40);
    const ColourImage colour = painted(3, 2, [](int i, int) { return 80 * i; });
    DepthImage image =
        image_of(columns, rows, 255.0, [](int i, int j) { return (i * 37 + j * 91) % 256; });
    SilhouetteSharpener().sharpen(image, &colour, 0.0F);
    CHECK(std::all_of(image.levels.begin(), image.levels.end(),
                      [](float level) { return level >= 0.0F && level <= 255.0F; }));
}

TEST_CASE(
    "a face that falls towards an outline, or rises, goes on to the last level and no further",
    "[silhouettes]") {
    // The other face is 60 levels away, over a ramp of 12 pixels.
    const bool falls = GENERATE(true, false);
    DepthImage image = image_of(640, 16, 255.0, [](int i, int) {
        return i < 320 ? 1.0 + 0.6 * (320 - i) : std::min(1.0 + 5.0 * (i - 320), 61.0);
    });
    if (!falls)
        for (float& level : image.levels) level = 255.0F - level;
    const DepthImage before = image;
    SilhouetteSharpener().sharpen(image, nullptr, 0.0F);
    CHECK_FALSE(same(image, before));
    const auto [least, most] = std::minmax_element(image.levels.begin(), image.levels.end());
    CHECK(*least >= 0.0F);
    CHECK(*most <= 255.0F);
}

TEST_CASE("the rows of a ramp become crisp together, or none does", "[silhouettes]") {
    // One row in eight has a ramp that is narrow enough, or all but one in eight.
    const bool most_are_narrow = GENERATE(true, false);
    const auto ramp_px = [=](int row) { return (row % 8 == 3) == most_are_narrow ? 30.0 : 10.0; };
    const DepthImage image = image_of(kColumns, kRows, 255.0, [&](int i, int j) {
        return kFar + (kNear - kFar) * std::clamp(0.5 + (i - 320.3) / ramp_px(j), 0.0, 1.0);
    });
    const DepthImage crisp = sharpened(image);
    CHECK(same(crisp, image) != most_are_narrow);
}

TEST_CASE("a picture of more ramps than outlines can have stays as it is", "[silhouettes][long]") {
    const auto striped = [](int columns, int rows) {
        return image_of(columns, rows, 255.0, [](int i, int) {
            return 20.0 + 20.0 * std::min(i % 24 > 11 ? 23 - i % 24 : i % 24, 8);
        });
    };
    const DepthImage few = striped(2048, 64);
    CHECK_FALSE(same(sharpened(few), few));
    const DepthImage many = striped(4096, 2048);
    REQUIRE(many.levels.size() * 2 / 3 > SilhouetteSharpener::kMostRamps);
    CHECK(same(sharpened(many), many));
}
