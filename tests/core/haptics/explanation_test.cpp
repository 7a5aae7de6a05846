// An explained update is the update: the same moves, places and primitives, one after the other.
#include "core/haptics/explanation.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>
#include <string>

#include "core/haptics/dibhr.hpp"
#include "core/haptics/neighbours.hpp"
#include "tests/core/haptics/surfaces.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/comma_locale.hpp"

using namespace dibhr;

namespace {

constexpr int kWalkedColumns = 60;
constexpr int kWalkedRows = 44;
constexpr SurfaceShape kWalkedShape{60.0, 0.0};

/// Goals that jump about, above and below.
Vec3 next_goal(test::Dice& dice) {
    return {dice.uniform(-4.0, kWalkedColumns + 3.0), dice.uniform(-4.0, kWalkedRows + 3.0),
            dice.uniform(-20.0, 70.0)};
}

template <typename Check>
void walk_over_all(double mu, Check&& check) {
    for (const test::NamedSurface& ground : test::hostile_surfaces(kWalkedColumns, kWalkedRows)) {
        CAPTURE(ground.name, mu);
        const DepthSurface surface(ground.image, ground.image, 0.0, kWalkedShape);
        test::Dice dice(23);
        const Friction friction{1.3 * mu, mu};
        Dibhr dibhr;
        Proxy before = dibhr.update(surface, next_goal(dice), friction);
        for (int k = 0; k < 60; ++k) {
            const Vec3 goal = next_goal(dice);
            const ExplainedUpdate explained = explain(surface, before, goal, friction);
            before = dibhr.update(surface, goal, friction);
            check(surface, explained, before);
        }
    }
}

}  // namespace

TEST_CASE("the steps of an explained update end where the update ends, to the same bits",
          "[explain]") {
    const double mu = GENERATE(0.0, 0.1, 0.8);
    walk_over_all(mu,
                  [](const DepthSurface&, const ExplainedUpdate& explained, const Proxy& updated) {
                      REQUIRE(explained.result == updated);
                      if (explained.steps.empty()) return;
                      const Proxy& last = explained.steps.back().after;
                      REQUIRE(last.position == updated.position);
                      REQUIRE(last.active == updated.active);
                      REQUIRE(last.moves == updated.moves);
                  });
}

TEST_CASE("each step begins where the one before ended, and counts the primitives it visited",
          "[explain]") {
    const double mu = GENERATE(0.0, 0.4);
    long steps = 0;
    long counted = 0;
    walk_over_all(mu, [&](const DepthSurface&, const ExplainedUpdate& explained, const Proxy&) {
        Proxy at = explained.start;
        for (const WalkStep& step : explained.steps) {
            REQUIRE(step.before.position == at.position);
            REQUIRE(step.before.active == at.active);
            const int moves = step.after.moves - at.moves;
            REQUIRE(moves >= static_cast<int>(step.visits));
            ++steps;
            if (moves == static_cast<int>(step.visits)) ++counted;
            at = step.after;
        }
    });
    CHECK(steps > 1000);
    CHECK(steps - counted <= steps / 1000);  // off the surface and back at once
}

TEST_CASE("on the surface no step but a flight leads farther from the goal", "[explain]") {
    const double mu = GENERATE(0.0, 0.4);
    walk_over_all(mu,
                  [](const DepthSurface& surface, const ExplainedUpdate& explained, const Proxy&) {
                      for (const WalkStep& step : explained.steps) {
                          if (!step.before.contact || step.end == StepEnd::leaves) continue;
                          CAPTURE(text_of(step));
                          const double before = glm::length(explained.goal - step.before.position);
                          const double after = glm::length(explained.goal - step.after.position);
                          REQUIRE(after <= before + 1e-9);
                          const Vec3 end = step.after.position;
                          REQUIRE(std::abs(surface.elevation_at(end.x, end.y) - end.z) <= 1e-6);
                      }
                  });
}

TEST_CASE("a step says that the proxy stops on the cone when it is as far from the foot as that",
          "[explain]") {
    long stopped = 0;
    walk_over_all(0.4, [&](const DepthSurface&, const ExplainedUpdate& explained, const Proxy&) {
        for (const WalkStep& step : explained.steps) {
            CAPTURE(text_of(step));
            const double to_foot = glm::length(step.after.position - step.foot);
            if (step.end == StepEnd::stops_on_cone) {
                ++stopped;
                REQUIRE(to_foot == Approx(step.cone_px).margin(1e-6));
            }
            if (step.end == StepEnd::stays_in_cone)
                REQUIRE(to_foot <= step.cone_px * 1.0001 + 1e-9);
            if (step.end == StepEnd::rests_at_foot) REQUIRE(to_foot <= 1e-6);
        }
    });
    CHECK(stopped > 50);
}

TEST_CASE("a proxy that cannot be on the surface is explained as one that begins above the goal",
          "[explain]") {
    const DepthImage image = test::flat(20, 20, 100.0);
    const DepthSurface surface(image, image, 0.0, {255.0, 0.0});
    const Friction friction{0.5, 0.5};
    const Vec3 goal{4.2, 3.3, 96.0};
    Dibhr fresh;
    const Proxy wanted = fresh.update(surface, goal, friction);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    Proxy elsewhere;
    elsewhere.contact = true;
    for (const Primitive& primitive :
         {triangle(TriangleSide::far_corner, 19, 3), edge(EdgeDirection::diagonal, 700, 2),
          edge(EdgeDirection::along_column, 3, 19), vertex(20, 20), vertex(-1, 4), Primitive{}}) {
        CAPTURE(text_of(primitive));
        elsewhere.position = {4.0, 4.0, 100.0};
        elsewhere.active = primitive;
        CHECK(explain(surface, elsewhere, goal, friction).result == wanted);
    }
    elsewhere.active = vertex(4, 4);
    for (const Vec3 position : {Vec3(500.0, 3.0, 100.0), Vec3(3.0, -0.5, 100.0),
                                Vec3(nan, 3.0, 100.0), Vec3(3.0, 3.0, nan)}) {
        elsewhere.position = position;
        CHECK(explain(surface, elsewhere, goal, friction).result == wanted);
    }
    CHECK(explain(surface, wanted, {nan, 3.0, 100.0}, friction).steps.empty());
}

TEST_CASE("over a flat ground the way to a goal below is told primitive by primitive",
          "[explain]") {
    const DepthImage image = test::flat(20, 20, 100.0);
    const DepthSurface surface(image, image, 0.0, {255.0, 0.0});
    const Friction friction{0.5, 0.5};
    Dibhr dibhr;
    dibhr.update(surface, {3.2, 3.3, 110.0}, friction);
    const Proxy above = dibhr.update(surface, {3.2, 3.3, 101.0}, friction);

    const ExplainedUpdate landing = explain(surface, above, {3.2, 3.3, 96.0}, friction);
    REQUIRE(landing.steps.size() == 2);
    CHECK(landing.steps[0].end == StepEnd::meets_surface);
    CHECK(landing.steps[1].end == StepEnd::rests_at_foot);

    const Proxy landed = dibhr.update(surface, {3.2, 3.3, 96.0}, friction);
    const ExplainedUpdate slide = explain(surface, landed, {7.2, 3.3, 96.0}, friction);
    CHECK(slide.steps.front().visited[0] == triangle(TriangleSide::near_origin, 3, 3));
    CHECK(slide.steps.front().end == StepEnd::crosses);
    CHECK(slide.steps.back().end == StepEnd::stops_on_cone);
    CHECK(slide.steps.back().cone_px == Approx(2.0));
    CHECK(slide.result.position.x == Approx(5.2));
    {
        const dibhr::test::CommaLocale locale;
        CHECK(text_of(slide.steps.back()).find("2.00 px") != std::string::npos);
    }
    CHECK(text_of(slide.steps.front()) ==
          "TRIANGLE (3, 3), upper left: the goal's foot is outside, so the proxy goes as far as "
          "EDGE (3, 3), diagonal.");

    const ExplainedUpdate held = explain(surface, landed, {4.0, 3.3, 96.0}, friction);
    REQUIRE(held.steps.size() == 1);
    CHECK(held.steps[0].end == StepEnd::stays_in_cone);

    const ExplainedUpdate leaving = explain(surface, landed, {4.0, 3.3, 120.0}, friction);
    REQUIRE(leaving.steps.size() == 1);
    CHECK(leaving.steps[0].end == StepEnd::leaves);
}
