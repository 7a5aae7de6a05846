// Whatever the goal, the surface and the algorithm: an update ends within its moves, on or above
// the surface, with finite numbers, and the next one goes on from there.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include <glm/geometric.hpp>

#include "core/haptics/touch.hpp"
#include "tests/core/haptics/bounds.hpp"
#include "tests/core/haptics/surfaces.hpp"
#include "tests/core/haptics/worst_update.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr;

namespace {

Algorithm each_algorithm() {
    return GENERATE(Algorithm::dibhr, Algorithm::pga, Algorithm::neighborhood,
                    Algorithm::god_object);
}

/// +-10^exponent, with a random exponent in the range.
double any_size(test::Dice& dice, double least_exponent, double greatest_exponent) {
    const double size = std::pow(10.0, dice.uniform(least_exponent, greatest_exponent));
    return dice.uniform(0.0, 1.0) < 0.5 ? -size : size;
}

/// A place near the image, very near to a VERTEX, or anywhere in the range of numbers.
double wild_coordinate(test::Dice& dice, double size_px, double now) {
    const double what = dice.uniform(0.0, 1.0);
    if (what < 0.5) return now + dice.uniform(-6.0, 6.0);
    if (what < 0.7) return dice.uniform(-0.1 * size_px, 1.1 * size_px);
    if (what < 0.8) return std::floor(dice.uniform(0.0, size_px)) + any_size(dice, -320.0, -5.0);
    if (what < 0.9) return any_size(dice, -320.0, 3.0);
    return any_size(dice, 0.0, 308.0);
}

struct Scene {
    DepthImage from;
    DepthImage to;
    BumpMap bump{};
};

Scene wild_scene(test::Dice& dice, int columns, int rows) {
    const double highest = dice.uniform(0.0, 1.0) < 0.5 ? 255.0 : 65535.0;
    const double kind = dice.uniform(0.0, 1.0);
    const double step = std::round(any_size(dice, 0.0, 2.0));
    const auto level = [&](int i, int j) {
        if (kind < 0.2) return std::floor(dice.uniform(0.0, highest + 1.0));
        if (kind < 0.4) return std::floor(0.4 * highest) + std::floor(dice.uniform(-1.0, 2.0));
        if (kind < 0.6) return (i / 9 + j / 7) % 2 == 0 ? 0.1 * highest : 0.9 * highest;
        if (kind < 0.8) return std::abs(std::fmod(std::floor(0.3 * i + 0.1 * j) * step, highest));
        return std::floor(0.5 * highest) + (j % 2);
    };
    Scene scene;
    scene.from = test::image_of(columns, rows, highest, level);
    scene.to =
        dice.uniform(0.0, 1.0) < 0.5 ? scene.from : test::image_of(columns, rows, highest, level);
    scene.bump = {16, 9, std::vector<float>(16 * 9)};
    for (float& height : scene.bump.heights) height = static_cast<float>(dice.uniform(0.0, 1.0));
    if (dice.uniform(0.0, 1.0) < 0.5) stretch(scene.bump, columns, rows);
    return scene;
}

void require_bounds_kept_by_wild_goals(long updates_in_all) {
    const Algorithm algorithm = each_algorithm();
    constexpr int kScenes = 40;
    constexpr int kMostToCatchUp = 3000;  // a proxy that never gets to its goal would go on
    test::Dice dice(101 + static_cast<std::uint64_t>(algorithm));
    const long updates = updates_in_all / kScenes;
    for (int n = 0; n < kScenes; ++n) {
        const int columns = n % 10 == 9 ? 1280 : 2 + static_cast<int>(dice.uniform(0.0, 90.0));
        const int rows = n % 10 == 9 ? 720 : 2 + static_cast<int>(dice.uniform(0.0, 70.0));
        const Scene scene = wild_scene(dice, columns, rows);
        const SurfaceShape shape{dice.uniform(0.0, 1.0) < 0.5 ? 255.0 : 4096.0,
                                 dice.uniform(0.0, 1.0) < 0.5 ? 0.0 : dice.uniform(0.0, 9.0),
                                 dice.uniform(0.0, 1.0) < 0.5 ? 0.0 : dice.uniform(0.0, 30.0)};
        const auto proxy = make_algorithm(algorithm);
        Friction friction{};
        Vec3 goal(0.5 * columns, 0.5 * rows, 50.0);
        double blend = 0.0;
        test::BoundsWatch watch;
        int behind = 0;  // updates since the goal was left standing for the proxy to catch up
        for (long k = 0; k < updates; ++k) {
            if (k % 100 == 0) {
                const double mu = dice.uniform(0.0, 1.0) < 0.5
                                      ? dice.uniform(0.0, 2.0)
                                      : std::abs(any_size(dice, -160.0, 0.0));
                friction = {mu, dice.uniform(0.0, 1.0) < 0.7 ? mu : 0.5 * mu};
                if (n % 3 == 0) blend = dice.uniform(0.0, 1.0);
            }
            const Vec3 last = goal;
            if (behind == 0) {
                goal = {wild_coordinate(dice, columns, last.x), wild_coordinate(dice, rows, last.y),
                        wild_coordinate(dice, shape.relief_px, last.z)};
            }
            const DepthSurface surface(scene.from, scene.to, blend, shape, &scene.bump);
            const Proxy& p = proxy->update(surface, goal, friction);
            goal = surface.clamped_to_frame(surface.clamped_to_reach(goal));
            const char* broken = watch.broken_by(surface, algorithm, goal, p);
            const bool waits = p.bound_met && (behind > 0 || dice.uniform(0.0, 1.0) < 0.3);
            behind = waits ? behind + 1 : 0;
            if (behind > kMostToCatchUp) broken = "the proxy never catches up";
            if (broken != nullptr) {
                CAPTURE(name_of(algorithm), n, k, columns, rows, shape.relief_px,
                        shape.roughness_px, friction.static_coefficient,
                        friction.dynamic_coefficient, goal.x, goal.y, goal.z, p.position.x,
                        p.position.y, p.position.z, p.contact, p.moves, p.bound_met);
                FAIL(broken);
            }
        }
        SUCCEED();
    }
}

}  // namespace

TEST_CASE("goals of any size on any ground: finite, on or above the surface, within the moves",
          "[bounded]") {
    require_bounds_kept_by_wild_goals(60'000);
}

TEST_CASE("goals of any size on any ground keep all bounds for a million updates",
          "[bounded][long]") {
    require_bounds_kept_by_wild_goals(250'000);  // of each of four algorithms
}

TEST_CASE("a hand that presses goes on pressing while its proxy catches up over uneven ground",
          "[bounded]") {
    const Algorithm algorithm = each_algorithm();
    test::Dice dice(7);
    const DepthImage image = test::image_of(
        2400, 40, 255.0, [&](int, int) { return 100.0 + std::floor(dice.uniform(-6.0, 7.0)); });
    const DepthSurface surface(image, image, 0.0, {});
    const auto proxy = make_algorithm(algorithm);
    const Friction none{0.0, 0.0};
    static_cast<void>(proxy->update(surface, {5.3, 20.2, 120.0}, none));
    REQUIRE(proxy->update(surface, {5.3, 20.2, 60.0}, none).contact);
    int behind = 0;
    for (bool is_behind = true; is_behind && behind < 1000; ++behind) {
        const Proxy& p = proxy->update(surface, {2390.1, 20.2, 60.0}, none);
        is_behind = p.bound_met;
        CAPTURE(name_of(algorithm), behind, p.position.x, p.position.z);
        REQUIRE(p.contact);
        REQUIRE(std::abs(p.position.z - surface.elevation_at(p.position.x, p.position.y)) < 1e-8);
    }
    CHECK(behind < 1000);
    CHECK(behind > 1);
}

TEST_CASE("the update that reads most, of any on any surface, stays within the bound of reads",
          "[bounded]") {
    constexpr int kSurfaces = DIBHR_SANITIZED ? 3 : 20;
    constexpr int kTries = 60;
    const Algorithm algorithm = each_algorithm();
    const auto proxy = make_algorithm(algorithm);
    test::Dice dice(31 + static_cast<std::uint64_t>(algorithm));
    int ended_by_reads = 0;
    for (int number = 0; number < kSurfaces; ++number) {
        const DepthImage image = test::generated_surface(number, 700, 120);
        const DepthSurface surface(image, image, 0.0, {});
        const Proxy worst = test::worst_jump(*proxy, surface, dice, kTries).made(*proxy, surface);
        const int most_reads = test::most_reads_of(algorithm, surface);
        CAPTURE(name_of(algorithm), number, worst.reads, worst.moves);
        CHECK(worst.reads <= (most_reads > 0 ? most_reads + test::kReadsOfOneMove : 0));
        CHECK(worst.moves <= test::most_moves_of(algorithm, surface) + 3);
        const bool by_reads =
            worst.bound_met && worst.moves < test::most_moves_of(algorithm, surface);
        if (by_reads && most_reads > 0 && worst.reads >= most_reads) ++ended_by_reads;
    }
    // Else the search would find nothing that the bound ends.
    const bool has_bound = algorithm == Algorithm::pga || algorithm == Algorithm::neighborhood;
    if (!DIBHR_SANITIZED) CHECK((ended_by_reads > 0) == has_bound);
}
