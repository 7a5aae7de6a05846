// The algorithms side by side: what each of them does by construction, and how one takes over.
#include <cmath>
#include <string>

#include <glm/geometric.hpp>

#include "core/haptics/touch.hpp"
#include "tests/core/haptics/surfaces.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr;
using Catch::Matchers::WithinAbs;

namespace {

constexpr double kDepth_px = 12.0;

/// A scribble over the middle of a 64 x 64 image, `kDepth_px` under elevation 100.
Vec3 scribble(int k) {
    return {32.0 + 18.0 * std::cos(0.11 * k), 32.0 + 18.0 * std::sin(0.17 * k), 100.0 - kDepth_px};
}

}  // namespace

TEST_CASE("every algorithm has a name, and only its own", "[algorithms]") {
    for (const Algorithm algorithm : all_algorithms()) {
        CHECK(named<Algorithm>(name_of(algorithm)) == algorithm);
    }
    CHECK(all_algorithms().size() == 4);
    CHECK(std::string(name_of(Algorithm::god_object)) == "god-object");
    CHECK_FALSE(named<Algorithm>("PGA"));
    CHECK_FALSE(named<Algorithm>(""));
}

TEST_CASE("on a plane without friction neighborhood and god-object rest at the goal's foot",
          "[algorithms]") {
    const Algorithm algorithm = GENERATE(Algorithm::neighborhood, Algorithm::god_object);
    const double slope = GENERATE(0.0, 0.3);
    CAPTURE(name_of(algorithm), slope);
    const DepthImage image = test::tilted(64, 64, 100.0 * slope, 0.0, 10000.0);
    const DepthSurface surface(image, image, 0.0, {655.35, 0.0});
    const auto proxy = make_algorithm(algorithm);
    for (int k = 0; k < 300; ++k) {
        const Vec3 goal = scribble(k);
        const double fall = (100.0 + slope * goal.x - goal.z) / (1.0 + slope * slope);
        const Vec3 foot = goal + fall * Vec3(-slope, 0.0, 1.0);
        const Proxy& p = proxy->update(surface, goal, {0.0, 0.0});
        CAPTURE(k);
        REQUIRE(p.contact);
        if (k == 0) continue;  // it comes from above, and the first touch is not the foot's
        REQUIRE(glm::length(p.position - foot) <= 1e-8);
    }
}

TEST_CASE("on a flat plane without friction PGA rests on the vertex nearest to the goal",
          "[algorithms]") {
    const DepthImage image = test::flat(64, 64, 100.0);
    const DepthSurface surface(image, image, 0.0, {255.0, 0.0});
    const auto pga = make_algorithm(Algorithm::pga);
    pga->update(surface, {32.0, 32.0, 80.0}, {0.0, 0.0});
    for (int k = 0; k < 300; ++k) {
        const Vec3 goal = scribble(k);
        const Proxy& p = pga->update(surface, goal, {0.0, 0.0});
        CAPTURE(k);
        REQUIRE(p.active.kind == PrimitiveKind::vertex);
        REQUIRE(std::abs(p.position.x - goal.x) <= 0.5 + 1e-12);
        REQUIRE(std::abs(p.position.y - goal.y) <= 0.5 + 1e-12);
    }
}

TEST_CASE("along a row of vertices every algorithm slides alike and leans back by atan(mu)",
          "[algorithms]") {
    const Algorithm algorithm =
        GENERATE(Algorithm::dibhr, Algorithm::pga, Algorithm::neighborhood, Algorithm::god_object);
    const double mu = GENERATE(0.2, 0.4, 0.8);
    CAPTURE(name_of(algorithm), mu);
    const DepthImage image = test::flat(300, 60, 100.0);
    const DepthSurface surface(image, image, 0.0, {255.0, 0.0});
    const auto proxy = make_algorithm(algorithm);
    for (int k = 0; k < 90; ++k) {  // there and back
        const bool back = k >= 45;
        const Vec3 goal(back ? 20.0 + 4.961 * (89 - k) : 20.0 + 4.961 * k, 30.0, 90.0);
        const Vec3 lean = proxy->update(surface, goal, {mu, mu}).position - goal;
        CAPTURE(k);
        REQUIRE_THAT(lean.y, WithinAbs(0.0, 1e-9));
        if (k % 45 < 8) continue;  // it starts, or turns
        REQUIRE_THAT(lean.x, WithinAbs((back ? mu : -mu) * 10.0, 1e-8));
    }
}

TEST_CASE("with friction the god-object goes as DIBHR does on a plane", "[algorithms]") {
    const DepthImage image = test::tilted(64, 64, 20.0, -10.0, 10000.0);
    const DepthSurface surface(image, image, 0.0, {655.35, 0.0});
    const auto dibhr = make_algorithm(Algorithm::dibhr);
    const auto god_object = make_algorithm(Algorithm::god_object);
    for (int k = 0; k < 300; ++k) {
        const Vec3 p = dibhr->update(surface, scribble(k), {0.5, 0.3}).position;
        const Vec3 q = god_object->update(surface, scribble(k), {0.5, 0.3}).position;
        CAPTURE(k);
        REQUIRE(glm::length(p - q) <= 1e-7);
    }
}

TEST_CASE("another algorithm goes on from where the proxy is, and the force ramps up again",
          "[algorithms]") {
    const DepthImage image = test::image_of(64, 64, 255.0, [](int i, int j) {
        return std::round(90.0 + 8.0 * std::sin(0.3 * i) * std::cos(0.2 * j));
    });
    const DepthSurface surface(image, image, 0.0, {255.0, 0.0});
    TouchRenderer renderer;
    TouchParameters parameters;
    const SafetyInput input{.dt_s = 0.001};
    const Vec3 goal = scribble(0) - Vec3(0.0, 0.0, 10.0);
    Touch before;
    for (int k = 0; k < 2000; ++k) before = renderer.update(surface, goal, parameters, input, {});
    REQUIRE(glm::length(before.sent_force_newton) > 0.5);
    for (const Algorithm algorithm :
         {Algorithm::pga, Algorithm::god_object, Algorithm::neighborhood, Algorithm::dibhr}) {
        CAPTURE(name_of(algorithm));
        parameters.algorithm = algorithm;
        const Touch after = renderer.update(surface, goal, parameters, input, {});
        CHECK(after.proxy.contact);
        CHECK(glm::length(after.proxy.position - before.proxy.position) <= 1e-6);
        CHECK(glm::length(after.sent_force_newton) < glm::length(before.sent_force_newton));
    }
}

TEST_CASE("another algorithm over a smaller image, or after letting go, starts above the goal",
          "[algorithms]") {
    const Algorithm from = GENERATE(from_range(all_algorithms()));
    const Algorithm to = GENERATE(from_range(all_algorithms()));
    const bool smaller = GENERATE(true, false);
    CAPTURE(name_of(from), name_of(to), smaller);
    const DepthImage large = test::flat(300, 200, 100.0);
    const DepthImage small = test::flat(smaller ? 40 : 300, smaller ? 30 : 200, 100.0);
    const DepthSurface first(large, large, 0.0, {255.0, 0.0});
    const DepthSurface second(small, small, 0.0, {255.0, 0.0});
    TouchRenderer renderer;
    TouchParameters parameters;
    parameters.algorithm = from;
    const SafetyInput input{.dt_s = 0.001};
    for (const double z : {150.0, 90.0}) {
        renderer.update(first, {270.0, 180.0, z}, parameters, input, {});
    }
    if (!smaller) renderer.release_contact();
    parameters.algorithm = to;
    const Proxy& proxy = renderer.update(second, {20.0, 15.0, 80.0}, parameters, input, {}).proxy;
    CHECK(proxy.contact);
    CHECK(proxy.position == Vec3(20.0, 15.0, 100.0));
}
