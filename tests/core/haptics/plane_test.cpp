// DIBHR against the exact answers on planes.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <glm/geometric.hpp>

#include "core/haptics/dibhr.hpp"
#include "tests/core/haptics/surfaces.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr;
using Catch::Matchers::WithinAbs;

namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kSpeed_px = 4.961;  // per update: 700 mm/s x 720 px / 101.6 mm at 1 kHz

/// p_k = p_(k-1) inside the cone, else on it: "Exact answers" of core/haptics/README.md.
Vec3 exact_step(Vec3 proxy, Vec3 foot, double radius) {
    const Vec3 back = proxy - foot;
    const double length = glm::length(back);
    return length <= radius ? proxy : foot + back * (radius / length);
}

double angle_deg(Vec3 a, Vec3 b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * 180.0 / kPi;
}

struct Plane {
    double slope_x, slope_y, height;
    [[nodiscard]] Vec3 foot(Vec3 g) const {
        const Vec3 n = glm::normalize(Vec3(-slope_x, -slope_y, 1.0));
        const double above = (g.z - (slope_x * g.x + slope_y * g.y + height)) * n.z;
        return g - above * n;
    }
    [[nodiscard]] double depth(Vec3 g) const { return glm::length(g - foot(g)); }
};

/// The farthest of the proxy from its exact place [px].
double farthest_from_orbit(const Plane& plane, const DepthSurface& surface, double mu,
                           double depth) {
    Dibhr dibhr;
    Vec3 exact(0.0);
    double worst = 0.0;
    test::Dice dice(5);
    for (int k = 0; k < 1500; ++k) {
        // A circle, then a line back and forth, then a scribble.
        const double a = k * kSpeed_px / 200.0;
        const double line = std::abs(std::fmod(k * kSpeed_px, 600.0) - 300.0) - 150.0;
        const double x = k < 500 ? 200.0 * std::cos(a) : k < 1000 ? line : dice.uniform(-9.0, 9.0);
        const double y = k < 500    ? 200.0 * std::sin(a)
                         : k < 1000 ? 0.37 * line
                                    : dice.uniform(-9.0, 9.0);
        Vec3 goal(360.0 + x, 243.0 + y, 0.0);
        goal.z = plane.slope_x * goal.x + plane.slope_y * goal.y + plane.height -
                 depth / glm::normalize(Vec3(-plane.slope_x, -plane.slope_y, 1.0)).z;
        const Proxy& proxy = dibhr.update(surface, goal, {mu, mu});
        if (!proxy.contact) return std::numeric_limits<double>::infinity();
        exact =
            k == 0 ? proxy.position : exact_step(exact, plane.foot(goal), mu * plane.depth(goal));
        worst = std::max(worst, glm::length(proxy.position - exact));
    }
    return worst;
}

}  // namespace

TEST_CASE(
    "on a plane, flat or tilted, the proxy follows the exact orbit to 1e-9 px in every update",
    "[plane]") {
    const auto slopes = GENERATE(std::array{0.0, 0.0}, std::array{0.3, -0.2},
                                 std::array{-0.11, 0.45}, std::array{0.4, 0.3});
    const Plane plane{slopes[0], slopes[1], 200.0};
    // Levels are hundredths of a pixel.
    const DepthImage image =
        test::tilted(720, 486, 100.0 * plane.slope_x, 100.0 * plane.slope_y, 20000.0);
    const DepthSurface surface(image, image, 0.0, {655.35, 0.0});
    for (const double mu : {0.0, 0.1, 0.4, 1.0})
        for (const double depth : {0.5, 5.0, 20.0, 60.0}) {
            CAPTURE(slopes[0], slopes[1], mu, depth);
            CHECK(farthest_from_orbit(plane, surface, mu, depth) <= 1e-9);
        }
}

TEST_CASE("on the paper's circle the force turns by 0.528 degrees at mu 0.4, whatever the depth",
          "[plane]") {
    const double depth = GENERATE(5.0, 20.0, 60.0);
    const double mu = 0.4;
    const DepthImage image = test::flat(720, 486, 100.0);
    const DepthSurface surface(image, image, 0.0, {255.0, 0.0});
    Dibhr dibhr;
    const double w = kSpeed_px / 200.0;
    std::vector<double> turns;
    Vec3 last(0.0);
    Vec3 goal(0.0);
    for (int k = 0; k < 3000; ++k) {
        goal = {360.0 + 200.0 * std::cos(w * k), 243.0 + 200.0 * std::sin(w * k), 100.0 - depth};
        const Vec3 force = dibhr.update(surface, goal, {mu, mu}).position - goal;
        if (k > 1000) turns.push_back(angle_deg(force, last));
        last = force;
    }
    const double exact = std::acos((1.0 + mu * mu * std::cos(w)) / (1.0 + mu * mu)) * 180.0 / kPi;
    CHECK_THAT(exact, WithinAbs(0.528, 5e-4));
    for (const double turn : turns) REQUIRE_THAT(turn, WithinAbs(exact, 1e-6));

    const double rho = std::hypot(goal.x + last.x - 360.0, goal.y + last.y - 243.0);
    const double radius = mu * depth;
    CHECK_THAT(rho * rho + radius * (radius + 2.0 * rho * std::sin(w / 2.0)),
               WithinAbs(200.0 * 200.0, 1e-6));
}

TEST_CASE("dragged straight on, the force leans back by atan(mu), dead opposite to the motion",
          "[plane]") {
    const double mu = GENERATE(0.0, 0.2, 0.4, 0.8);
    const double heading = GENERATE(0.0, 0.3, 2.0, 4.0);
    const DepthImage image = test::flat(300, 300, 100.0);
    const DepthSurface surface(image, image, 0.0, {255.0, 0.0});
    Dibhr dibhr;
    Vec3 force(0.0);
    const Vec3 along(std::cos(heading), std::sin(heading), 0.0);
    for (int k = 0; k < 30; ++k) {
        const Vec3 goal = Vec3(150.0, 150.0, 90.0) + kSpeed_px * k * along;
        force = dibhr.update(surface, goal, {mu, mu}).position - goal;
    }
    CHECK_THAT(angle_deg(force, {0.0, 0.0, 1.0}), WithinAbs(std::atan(mu) * 180.0 / kPi, 1e-9));
    CHECK_THAT(glm::length(glm::cross(Vec3(force.x, force.y, 0.0), along)), WithinAbs(0.0, 1e-9));
    CHECK(glm::dot(force, along) <= 1e-9);
}

TEST_CASE("a reversal on a line turns the force by 2 atan(mu) in all", "[plane]") {
    const double mu = 0.4;
    const DepthImage image = test::flat(300, 100, 100.0);
    const DepthSurface surface(image, image, 0.0, {255.0, 0.0});
    Dibhr dibhr;
    Vec3 before(0.0);
    Vec3 force(0.0);
    for (int k = 0; k < 60; ++k) {
        const double x = 50.0 + 2.0 * (k < 30 ? k : 58 - k);
        const Vec3 goal(x, 50.0, 90.0);
        force = dibhr.update(surface, goal, {mu, mu}).position - goal;
        if (k == 29) before = force;
    }
    CHECK_THAT(angle_deg(before, force), WithinAbs(2.0 * std::atan(mu) * 180.0 / kPi, 1e-9));
}

TEST_CASE("a sticking contact holds with the static coefficient and slips with the dynamic one",
          "[friction]") {
    const DepthImage image = test::flat(100, 100, 100.0);
    const DepthSurface surface(image, image, 0.0, {255.0, 0.0});
    const Friction friction{0.8, 0.3};
    Dibhr dibhr;
    const auto at = [&](double x) { return dibhr.update(surface, {x, 50.0, 90.0}, friction); };
    CHECK_THAT(at(40.0).position.x, WithinAbs(40.0, 1e-12));
    CHECK_THAT(at(47.9).position.x, WithinAbs(40.0, 1e-12));  // within 0.8 * 10
    CHECK_FALSE(at(47.9).slipping);
    CHECK_THAT(at(49.0).position.x, WithinAbs(46.0, 1e-12));  // slips to 0.3 * 10 behind
    CHECK_THAT(at(50.0).position.x, WithinAbs(47.0, 1e-12));
    CHECK(at(50.5).slipping);
    CHECK_FALSE(at(50.5).slipping);                           // did not move: sticks again
    CHECK_THAT(at(55.0).position.x, WithinAbs(47.5, 1e-12));  // within 0.8 * 10 again
}

TEST_CASE("the frame's border is a frictionless wall that the proxy slides along", "[plane]") {
    const DepthImage image = test::flat(60, 40, 100.0);
    const DepthSurface surface(image, image, 0.0, {255.0, 0.0});
    Dibhr dibhr;
    dibhr.update(surface, {50.0, 20.0, 90.0}, {0.0, 0.0});
    const Proxy proxy = dibhr.update(surface, {70.0, 25.0, 90.0}, {0.0, 0.0});
    CHECK(proxy.position == Vec3(59.0, 25.0, 100.0));
}

TEST_CASE("on a plane that moves with the video the contact is never lost", "[motion]") {
    const DepthImage low = test::flat(64, 64, 80.0);
    const DepthImage high = test::flat(64, 64, 120.0);
    Dibhr dibhr;
    double last = 80.0;
    for (int tick = 0; tick < 400; ++tick) {
        const double blend = 0.5 - 0.5 * std::cos(tick * 2.0 * kPi / 100.0);
        const DepthSurface surface(low, high, blend, {255.0, 0.0});
        const Vec3 goal(20.0 + 0.05 * tick, 30.0, 60.0);
        const Proxy& proxy = dibhr.update(surface, goal, {0.4, 0.4});
        REQUIRE(proxy.contact);
        REQUIRE_THAT(proxy.position.z, WithinAbs(80.0 + 40.0 * blend, 1e-9));
        REQUIRE(std::abs(proxy.position.z - last) <= 40.0 * kPi / 100.0 + 1e-9);
        last = proxy.position.z;
    }
}

TEST_CASE("a surface that rises past a free proxy lifts it and makes contact", "[motion]") {
    const DepthImage low = test::flat(64, 64, 80.0);
    const DepthImage high = test::flat(64, 64, 120.0);
    Dibhr dibhr;
    const Vec3 goal(20.2, 30.4, 100.0);
    CHECK_FALSE(dibhr.update({low, high, 0.0, {255.0, 0.0}}, goal, {}).contact);
    const Proxy lifted = dibhr.update({low, high, 1.0, {255.0, 0.0}}, goal, {});
    CHECK(lifted.contact);
    CHECK_THAT(lifted.position.z, WithinAbs(120.0, 1e-12));
    CHECK_FALSE(dibhr.update({low, high, 0.0, {255.0, 0.0}}, goal, {}).contact);
}

TEST_CASE("a goal far straight below a slope is followed to its foot in one update", "[plane]") {
    const double below = GENERATE(60.0, 150.0, 210.0);
    const DepthImage image = test::tilted(256, 200, 100.0, 100.0, 10000.0);
    const DepthSurface surface(image, image, 0.0, {655.35, 0.0});
    Dibhr dibhr;
    dibhr.update(surface, {240.0, 100.0, 900.0}, {0.0, 0.0});
    const Proxy& proxy = dibhr.update(surface, {240.0, 100.0, 440.0 - below}, {0.0, 0.0});
    CHECK_FALSE(proxy.bound_met);
    // z = x + y + 100: the foot lies a third of the way aside in x and in y.
    CHECK_THAT(proxy.position.x, WithinAbs(240.0 - below / 3.0, 1e-9));
    CHECK_THAT(proxy.position.y, WithinAbs(100.0 - below / 3.0, 1e-9));
}

TEST_CASE("static friction holds in a crease and on a vertex also without dynamic friction",
          "[friction]") {
    // A valley along the column x = 20; the goal moves along it under its VERTEXes.
    const DepthImage image =
        test::image_of(41, 80, 255.0, [](int i, int) { return 50.0 + 3.0 * std::abs(i - 20); });
    const DepthSurface surface(image, image, 0.0, {255.0, 0.0});
    Dibhr dibhr;
    for (const double y : {10.5, 10.9, 12.0, 14.0, 20.0}) {
        const Vec3 at = dibhr.update(surface, {20.0, y, 30.0}, {1.0, 0.0}).position;
        CHECK_THAT(at.y, WithinAbs(10.5, 1e-9));
    }
    CHECK(dibhr.update(surface, {20.0, 31.0, 30.0}, {1.0, 0.0}).position.y > 30.0);
}
