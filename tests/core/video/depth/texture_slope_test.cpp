// The slope of pictures whose slope is known, and what does not count in it.
#include "core/video/depth/texture_slope.hpp"

#include <cmath>
#include <limits>
#include <random>

#include "tests/support/catch.hpp"

using namespace dibhr;
using Catch::Matchers::WithinRel;

namespace {

template <typename Level>
DepthImage shares_of(int columns, int rows, double highest, const Level& level) {
    DepthImage image;
    image.columns = columns;
    image.rows = rows;
    image.highest_level = highest;
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i)
            image.levels.push_back(static_cast<float>(highest * level(i, j)));
    return image;
}

}  // namespace

TEST_CASE("a plane has its slope at every size and with all forms of levels", "[texture_slope]") {
    const int columns = GENERATE(48, 320, 1920);
    const double highest = GENERATE(1.0, 255.0, 65535.0);
    const double across = 0.8 / columns;
    const DepthImage plane =
        shares_of(columns, 48, highest, [across](int i, int j) { return across * (i + 0.5 * j); });
    REQUIRE(texture_slope(plane));
    CHECK_THAT(*texture_slope(plane), WithinRel(across, 0.01));
}

TEST_CASE("noise of a tenth of the range is no slope of a scene at any size", "[texture_slope]") {
    constexpr double kReliefOfPaper = 255.0 / 720.0;
    const int columns = GENERATE(320, 640, 1280, 1920);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> noise(-0.05, 0.05);
    const DepthImage flat =
        shares_of(columns, 120, 255.0, [&](int, int) { return 0.5 + noise(random); });
    REQUIRE(texture_slope(flat));
    CHECK(*texture_slope(flat) * kReliefOfPaper * columns < 1.0);
}

TEST_CASE("pixels without data do not count; hardly any picture has no slope", "[texture_slope]") {
    constexpr double kWithoutData = std::numeric_limits<double>::quiet_NaN();
    const DepthImage half =
        shares_of(128, 64, 255.0, [](int i, int) { return i < 64 ? 0.004 * i : kWithoutData; });
    REQUIRE(texture_slope(half));
    CHECK_THAT(*texture_slope(half), WithinRel(0.004, 0.01));
    CHECK_FALSE(texture_slope(shares_of(128, 64, 255.0, [](int, int) { return kWithoutData; })));
    CHECK_FALSE(texture_slope(shares_of(7, 7, 255.0, [](int, int) { return 0.5; })));
}
