// How slopes bend tells distances from disparities and from nearness, whatever their scale.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <random>
#include <vector>

#include "core/video/depth/slope_shape.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr;

namespace {

constexpr int kColumns = 120;
constexpr int kRows = 90;

using Scene = std::function<double(double x, double y)>;

/// Metres of a floor and two walls, as a camera sees them; `x`, `y`: -1 to 1.
double hall(double x, double y) {
    return std::min(
        {1.5 / std::max(y, 1e-9), 2.0 / std::max(-x, 1e-9), 2.5 / std::max(x, 1e-9), 9.0});
}

/// Metres of a ball before a wall.
double ball(double x, double y) {
    const double off = std::hypot(x, y) / 0.8;
    return off < 1.0 ? 2.0 - 0.5 * std::sqrt(1.0 - off * off) : 3.0;
}

SlopeShape shape_of(const Scene& scene, const std::function<double(double metres)>& level) {
    std::vector<float> levels;
    for (int j = 0; j < kRows; ++j)
        for (int i = 0; i < kColumns; ++i)
            levels.push_back(
                static_cast<float>(level(scene(2.0 * i / kColumns - 1.0, 2.0 * j / kRows - 1.0))));
    SlopeMeter meter;
    meter.add(kColumns, kRows, levels);
    return meter.shape();
}

}  // namespace

TEST_CASE("distances are convex over planes, whatever their unit and their offset", "[slopes]") {
    const double scale = GENERATE(0.001, 1.0, 1000.0);
    const double offset = GENERATE(0.0, -1.5);
    CAPTURE(scale, offset);
    const SlopeShape shape =
        shape_of(hall, [=](double metres) { return scale * (metres + offset); });
    CHECK(shape.slopes > 1000);
    CHECK(shape.convex > 0.95);
    CHECK(shape.straight < 0.5);
    CHECK((shape.proportional > 0.8) == (offset == 0.0));
}

TEST_CASE("what falls with the distance is concave over planes", "[slopes]") {
    const SlopeShape shape = shape_of(hall, [](double metres) { return 255.0 - 20.0 * metres; });
    CHECK(shape.slopes > 1000);
    CHECK(shape.convex < 0.05);
}

TEST_CASE("disparities are straight over planes", "[slopes]") {
    const SlopeShape shape = shape_of(hall, [](double metres) { return 40.0 + 500.0 / metres; });
    CHECK(shape.slopes > 1000);
    CHECK(shape.straight > 0.9);
    CHECK(shape.perspective > 0.05);
}

TEST_CASE("a ball bends as a plane does", "[slopes]") {
    CHECK(shape_of(ball, [](double metres) { return metres; }).convex > 0.9);
    CHECK(shape_of(ball, [](double metres) { return 4.0 - metres; }).convex < 0.1);
}

TEST_CASE("noise, a step and pixels without data are no slopes", "[slopes]") {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> level(0.0, 1.0);
    const SlopeShape noise = shape_of([&](double, double) { return level(random); },
                                      [](double metres) { return metres; });
    CHECK(noise.slopes < 100);
    const SlopeShape step = shape_of([](double x, double) { return x < 0.1 ? 1.0 : 2.0; },
                                     [](double metres) { return metres; });
    CHECK(step.slopes == 0);
    const SlopeShape nothing =
        shape_of(hall, [](double) { return std::numeric_limits<double>::quiet_NaN(); });
    CHECK(nothing.slopes == 0);
}
