// What an update costs, as ratios of runs by turns: DIBHR to PGA, and PGA to a plain walk over the
// VERTEXes that gives the same proxies.
#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <limits>
#include <vector>

#include <glm/geometric.hpp>

#include "core/experiment/grounds.hpp"
#include "core/haptics/dibhr.hpp"
#include "core/haptics/pga.hpp"
#include "core/video/media.hpp"
#include "tests/core/haptics/plain_vertex_walk.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr;
using namespace dibhr::test;

namespace {

using Clock = std::chrono::steady_clock;

/// The paper's computer took 4.4 times as long for DIBHR as for PGA.
constexpr double kMostOfPga = 2.5;
/// PGA reads three elevations more an update, to see whether the goal has come above the ground,
/// and knows the image's border: 1.10 to 1.23 times were measured, over the bump map 1.29.
constexpr double kMostOfPlainWalk = 1.4;
constexpr int kRounds = 5;
constexpr int kMostRounds = 40;  // on a machine that others use

/// A path over a ground, its surfaces made beforehand.
struct Course {
    Course(const DepthClip& clip, const PathRun& path)
        : goals(path.goals), friction{path.mu, path.mu} {
        surfaces.reserve(goals.size());
        for (std::size_t k = 0; k < goals.size(); ++k) surfaces.push_back(clip.at(seconds_of(k)));
    }
    const std::vector<Vec3>& goals;
    Friction friction;
    std::vector<DepthSurface> surfaces{};
};

template <typename Run>
double seconds_for(Run&& run) {
    const auto begin = Clock::now();
    run();
    return std::chrono::duration<double>(Clock::now() - begin).count();
}

double run(ProxyAlgorithm& algorithm, const Course& course) {
    return seconds_for([&] {
        algorithm.reset();
        for (std::size_t k = 0; k < course.goals.size(); ++k) {
            algorithm.update(course.surfaces[k], course.goals[k], course.friction);
        }
    });
}

template <Leaving kLeaving>
double run_plain(const Course& course) {
    double sum = 0.0;
    const double seconds = seconds_for([&] {
        PlainVertexWalk<kLeaving> walk(course.surfaces[0], course.goals[0],
                                       course.friction.static_coefficient);
        for (std::size_t k = 0; k < course.goals.size(); ++k) {
            sum += walk.follow(course.surfaces[k], course.goals[k]).x;
        }
    });
    REQUIRE(sum > 0.0);  // what nobody reads is not computed
    return seconds;
}

/// How far the plain walk's proxies are from PGA's, at most [px].
template <Leaving kLeaving>
double farthest_px(const Course& course) {
    Pga pga;
    PlainVertexWalk<kLeaving> walk(course.surfaces[0], course.goals[0],
                                   course.friction.static_coefficient);
    double farthest = 0.0;
    for (std::size_t k = 0; k < course.goals.size(); ++k) {
        const Vec3 proxy =
            pga.update(course.surfaces[k], course.goals[k], course.friction).position;
        const Vec3 plain = walk.follow(course.surfaces[k], course.goals[k]);
        farthest = std::max(farthest, glm::length(plain - proxy));
    }
    return farthest;
}

struct Costs {
    double of_pga{0.0};         ///< DIBHR : PGA
    double of_plain_walk{0.0};  ///< PGA : plain walk
};

/// Of the best rounds of all; more of them while others seem to use the machine.
template <Leaving kLeaving>
Costs costs_of(const Course& course) {
    Dibhr dibhr;
    Pga pga;
    std::array<double, 3> best{};
    best.fill(std::numeric_limits<double>::max());
    Costs costs;
    for (int round = 0; round < kMostRounds; ++round) {
        best[0] = std::min(best[0], run(dibhr, course));
        best[1] = std::min(best[1], run(pga, course));
        best[2] = std::min(best[2], run_plain<kLeaving>(course));
        costs = {best[0] / best[1], best[1] / best[2]};
        const bool good = costs.of_pga <= kMostOfPga && costs.of_plain_walk <= kMostOfPlainWalk;
        if (round + 1 >= kRounds && good) break;
    }
    return costs;
}

template <Leaving kLeaving>
void check(const Ground& ground) {
    for (const PathRun& path : ground.paths) {
        CAPTURE(ground.name, path.name, ground.clip.columns());
        const Course course(ground.clip, path);
        REQUIRE(farthest_px<kLeaving>(course) <= 1e-9);
        if (DIBHR_TIMED) {
            const Costs costs = costs_of<kLeaving>(course);
            CHECK(costs.of_pga <= kMostOfPga);
            CHECK(costs.of_plain_walk <= kMostOfPlainWalk);
        }
    }
}

}  // namespace

TEST_CASE("DIBHR costs at most 2.5 times PGA, and PGA 1.4 times a plain walk with its proxies",
          "[cost]") {
    for (const MakeGround make : made_grounds()) check<Leaving::never>(make());
    // Where the sample's person ends, the goal comes out of the ground and into it again.
    check<Leaving::possible>(video_ground(
        "sample",
        read_depth_clip(open_depth(DIBHR_SOURCE_ASSETS "/sample/depth.mp4"), {}, {}, {})));
}
