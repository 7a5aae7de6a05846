// The paper's goals, and the statistics.
#include <cmath>
#include <vector>

#include <glm/geometric.hpp>

#include "core/experiment/experiment.hpp"
#include "core/metrics/force_variation.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr;
using Catch::Matchers::WithinAbs;

TEST_CASE("goals move 4.961 px an update on the line and along the circle", "[paths]") {
    const PathPlace place{360.0, 243.0, 100.0, 20.0};
    CHECK_THAT(kHandStep_px, WithinAbs(4.961, 5e-4));
    int reversals = 0;
    for (int k = 1; k < 2000; ++k) {
        const double line = glm::length(linear_goal(place, k) - linear_goal(place, k - 1));
        REQUIRE(line <= kHandStep_px + 1e-9);
        if (line < kHandStep_px - 1e-9) ++reversals;
        const Vec3 on_circle = circle_goal(place, k);
        REQUIRE_THAT(std::hypot(on_circle.x - 360.0, on_circle.y - 243.0), WithinAbs(200.0, 1e-9));
        REQUIRE(on_circle.z == 80.0);
        REQUIRE(std::abs(linear_goal(place, k).x - 360.0) <= 300.0);
    }
    CHECK(reversals <= 17);
    CHECK(reversals >= 15);
}

TEST_CASE("quantiles are samples by nearest rank", "[statistics]") {
    std::vector<double> samples;
    for (int k = 1000; k >= 1; --k) samples.push_back(k);
    const SampleStatistics s = statistics_of(samples);
    CHECK(s.count == 1000);
    CHECK_THAT(s.mean, WithinAbs(500.5, 1e-9));
    CHECK(s.median == 500.0);
    CHECK(s.p99 == 990.0);
    CHECK(s.p999 == 999.0);
    CHECK(s.highest == 1000.0);
    CHECK(statistics_of({}).count == 0);
}
