// Where a straight path first meets the surface.
#include "core/haptics/collision.hpp"

#include <cmath>

#include "tests/core/haptics/surfaces.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr;
using Catch::Matchers::WithinAbs;

TEST_CASE("a path that dives into a plane hits it where the line meets the plane", "[collision]") {
    const DepthImage image = test::flat(50, 40, 100.0);
    const DepthSurface surface(image, image, 0.0, {255.0, 0.0});
    const auto hit = first_hit(surface, {5.0, 6.0, 120.0}, {25.0, 26.0, 80.0});
    REQUIRE(hit);
    CHECK_THAT(hit->position.x, WithinAbs(15.0, 1e-9));
    CHECK_THAT(hit->position.y, WithinAbs(16.0, 1e-9));
    CHECK_THAT(hit->position.z, WithinAbs(100.0, 1e-9));
    CHECK(hit->triangle.kind == PrimitiveKind::triangle);
}

TEST_CASE("a path above the surface hits nothing, and neither does one along it", "[collision]") {
    const DepthImage image = test::flat(50, 40, 100.0);
    const DepthSurface surface(image, image, 0.0, {255.0, 0.0});
    CHECK_FALSE(first_hit(surface, {5.0, 6.0, 300.0}, {25.0, 26.0, 101.0}));
    CHECK_FALSE(first_hit(surface, {5.0, 6.0, 100.0}, {25.0, 26.0, 100.0}));
    CHECK_FALSE(first_hit(surface, {5.0, 6.0, 100.0}, {25.0, 26.0, 250.0}));
}

TEST_CASE("a path straight down hits the surface under it, on vertices and edges too",
          "[collision]") {
    const DepthImage image = test::tilted(20, 20, 100.0, 50.0, 0.0);
    const DepthSurface surface(image, image, 0.0, {655.35, 0.0});
    const double x = GENERATE(0.0, 3.0, 3.5, 19.0);
    const double y = GENERATE(0.0, 7.0, 7.5, 19.0);
    CAPTURE(x, y);
    const auto hit = first_hit(surface, {x, y, 500.0}, {x, y, -5.0});
    REQUIRE(hit);
    CHECK_THAT(hit->position.z, WithinAbs(x + 0.5 * y, 1e-9));
}

TEST_CASE(
    "no path slips through: before the hit it is above the surface, and a missed path ends above "
    "it",
    "[collision]") {
    test::Dice dice(11);
    for (const auto& [name, image] : test::hostile_surfaces(40, 30)) {
        CAPTURE(name);
        const DepthSurface surface(image, image, 0.0, {255.0, 0.0});
        for (int k = 0; k < 2000; ++k) {
            Vec3 from(dice.uniform(0.0, 39.0), dice.uniform(0.0, 29.0), 0.0);
            from.z = surface.elevation_at(from.x, from.y) + dice.uniform(0.0, 60.0);
            Vec3 to(dice.uniform(0.0, 39.0), dice.uniform(0.0, 29.0), dice.uniform(-20.0, 280.0));
            if (k % 5 == 0) to = {std::round(to.x), std::round(from.y), to.z};
            const auto hit = first_hit(surface, from, to);
            const Vec3 end = hit ? hit->position : to;
            REQUIRE(end.z >= surface.elevation_at(end.x, end.y) - 1e-9);
            bool stays_above = true;
            for (double t = 0.01; t < 1.0; t += 0.07) {
                const Vec3 p = from + t * (end - from);
                stays_above = stays_above && p.z >= surface.elevation_at(p.x, p.y) - 1e-7;
            }
            REQUIRE(stays_above);
            if (hit) REQUIRE_THAT(end.z, WithinAbs(surface.elevation_at(end.x, end.y), 1e-9));
        }
    }
}
