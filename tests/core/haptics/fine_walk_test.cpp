// On bumpy ground DIBHR agrees with a reference that walks a hundred times finer steps.
#include <cmath>
#include <string>
#include <vector>

#include "core/haptics/surface.hpp"
#include "tests/core/haptics/fine_walk.hpp"
#include "tests/core/haptics/surfaces.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr;

namespace {

constexpr int kSize = 240;
constexpr double kSpeed_px = 4.961;  // per update: 700 mm/s x 720 px / 101.6 mm at 1 kHz

struct Ground {
    const char* name;
    double (*elevation)(double x, double y);
};

double hill_with_ripples(double x, double y) {
    const double dx = (x - 120.0) / 60.0;
    const double dy = (y - 110.0) / 60.0;
    return 60.0 + 50.0 * std::exp(-dx * dx - dy * dy) +
           1.5 * std::sin(0.35 * x) * std::sin(0.27 * y);
}

/// Waves of random direction and phase, shorter ones lower.
double random_terrain(double x, double y) {
    test::Dice dice(11);
    double z = 80.0;
    for (int wave = 0; wave < 24; ++wave) {
        const double heading = dice.uniform(0.0, 6.2831853);
        const double length_px = dice.uniform(6.0, 80.0);
        const double phase = dice.uniform(0.0, 6.2831853);
        const double along = x * std::cos(heading) + y * std::sin(heading);
        z += 0.02 * length_px * std::sin(6.2831853 * along / length_px + phase);
    }
    return z;
}

std::vector<Vec3> goals_under(const DepthSurface& surface, double depth_px) {
    std::vector<Vec3> goals;
    for (int k = 0; k < 800; ++k) {
        const double t = k * kSpeed_px / 80.0;
        Vec3 goal(120.0 + 80.0 * std::cos(t), 120.0 + 80.0 * std::sin(1.31 * t), 0.0);
        goal.z = surface.elevation_at(goal.x, goal.y) - depth_px;
        goals.push_back(goal);
    }
    return goals;
}

}  // namespace

TEST_CASE("on bumpy ground the force is within half a degree of a hundred times finer walk's",
          "[reference]") {
    const Ground ground = GENERATE(Ground{"hill with ripples", &hill_with_ripples},
                                   Ground{"random terrain", &random_terrain});
    const double mu = GENERATE(0.0, 0.4);
    const DepthImage image = test::image_of(kSize, kSize, 65535.0, [&](int i, int j) {
        return std::round(100.0 * ground.elevation(i, j));
    });
    const DepthSurface surface(image, image, 0.0, {655.35, 0.0});
    const auto angles_deg = test::angles_to_fine_walk(surface, goals_under(surface, 8.0), mu);
    const double median_deg = test::median_of(angles_deg);
    CAPTURE(ground.name, mu, median_deg);
    CHECK(median_deg <= 0.5);
}
