// What must always hold, on random and on hostile surfaces.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <ostream>
#include <vector>

#include <glm/geometric.hpp>

#include "core/haptics/dibhr.hpp"
#include "core/haptics/touch.hpp"
#include "tests/core/haptics/bounds.hpp"
#include "tests/core/haptics/resting_place.hpp"
#include "tests/core/haptics/surfaces.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr;

namespace {

/// The grounds of the tests.
struct Ground {
    int columns;
    int rows;
    double relief_px;

    [[nodiscard]] SurfaceShape shape() const { return {relief_px, 0.0}; }
};

std::ostream& operator<<(std::ostream& out, const Ground& ground) {
    return out << ground.columns << " x " << ground.rows << ", relief " << ground.relief_px;
}

/// The paper's relief, none, gentle and the steepest; strips of one cell's width, odd sizes.
constexpr std::array kGrounds{Ground{48, 37, 255.0}, Ground{2, 2, 255.0},   Ground{2, 41, 60.0},
                              Ground{57, 2, 4096.0}, Ground{33, 48, 0.0},   Ground{3, 3, 4096.0},
                              Ground{48, 37, 1.5},   Ground{31, 29, 4096.0}};
/// A camera's and a video's, where a hand that jumps is not reached in one update.
constexpr std::array kLargeGrounds{Ground{641, 481, 255.0}, Ground{1280, 720, 30.0}};

/// Hostile goals: smooth strokes, jitter, teleports, positions exactly on the grid.
class NastyHand {
  public:
    NastyHand(std::uint64_t seed, const Ground& ground) : ground_(ground), dice_(seed) {}
    Vec3 next() {
        const double what = dice_.uniform(0.0, 1.0);
        if (what < 0.02) {
            goal_ = {dice_.uniform(-5.0, ground_.columns + 5.0),
                     dice_.uniform(-5.0, ground_.rows + 5.0),
                     dice_.uniform(-50.0, 1.1 * ground_.relief_px)};
        } else if (what < 0.04) {
            goal_ = {std::round(goal_.x), std::round(goal_.y), std::round(goal_.z)};
        } else if (what < 0.06) {
            velocity_ = {dice_.uniform(-5.0, 5.0), dice_.uniform(-5.0, 5.0),
                         dice_.uniform(-6.0, 6.0)};
        } else if (what < 0.9) {
            goal_ += 0.3 * velocity_;
            goal_ = {std::clamp(goal_.x, -3.0, ground_.columns + 2.0),
                     std::clamp(goal_.y, -3.0, ground_.rows + 2.0),
                     std::clamp(goal_.z, -60.0, ground_.relief_px + 35.0)};
        }
        return goal_;
    }

  private:
    Ground ground_;
    test::Dice dice_;
    Vec3 goal_{0.4 * ground_.columns, 0.4 * ground_.rows, 0.5 * ground_.relief_px};
    Vec3 velocity_{1.0, 0.5, -1.0};
};

Algorithm each_algorithm() {
    return GENERATE(Algorithm::dibhr, Algorithm::pga, Algorithm::neighborhood,
                    Algorithm::god_object);
}

}  // namespace

namespace {

/// `updates` of DIBHR over all grounds, and a tenth as many of each other algorithm.
void require_bounds_kept(long updates) {
    const Algorithm algorithm = each_algorithm();
    const Ground ground = GENERATE(from_range(kGrounds));
    const auto surfaces = test::hostile_surfaces(ground.columns, ground.rows);
    const long in_all = algorithm == Algorithm::dibhr ? updates : updates / 10;
    const auto runs = 3 * surfaces.size() * kGrounds.size();
    for (const auto& [name, image] : surfaces) {
        for (const double mu : {0.0, 0.3, 1.0}) {
            const DepthSurface surface(image, image, 0.0, ground.shape());
            NastyHand hand(17, ground);
            test::BoundsWatch watch;
            const auto proxy = make_algorithm(algorithm);
            for (long k = 0; k < in_all / static_cast<long>(runs); ++k) {
                const Vec3 goal = hand.next();
                const Proxy& p = proxy->update(surface, goal, {mu, mu});
                const char* broken = watch.broken_by(surface, algorithm, goal, p);
                if (p.bound_met) broken = "the walk did not end by itself";
                if (broken != nullptr) {
                    CAPTURE(name_of(algorithm), ground, name, mu, k, goal.x, goal.y, goal.z,
                            p.position.x, p.position.y, p.position.z, p.moves);
                    FAIL(broken);
                }
            }
            SUCCEED();
        }
    }
}

}  // namespace

TEST_CASE(
    "on every surface the proxy stays finite, on or above the surface, and the walk ends by itself",
    "[property]") {
    require_bounds_kept(300'000);
}

TEST_CASE("on every surface all bounds are kept for ten million updates", "[property][long]") {
    require_bounds_kept(10'000'000);
}

TEST_CASE("over large images a hand that jumps is caught up with, on or above the surface",
          "[property]") {
    const Algorithm algorithm = each_algorithm();
    const Ground ground = GENERATE(from_range(kLargeGrounds));
    for (const auto& [name, image] : test::hostile_surfaces(ground.columns, ground.rows)) {
        const DepthSurface surface(image, image, 0.0, ground.shape());
        NastyHand hand(19, ground);
        test::BoundsWatch watch;
        const auto proxy = make_algorithm(algorithm);
        Vec3 goal = hand.next();
        for (int k = 0, behind = 0; k < 3000; ++k) {
            const Proxy& p = proxy->update(surface, goal, {0.3, 0.2});
            const char* broken = watch.broken_by(surface, algorithm, goal, p);
            behind = p.bound_met ? behind + 1 : 0;
            if (behind > 1000) broken = "the proxy never catches up";
            if (broken != nullptr) {
                CAPTURE(name_of(algorithm), ground, name, k, goal.x, goal.y, goal.z, p.position.x,
                        p.position.y, p.position.z, p.moves);
                FAIL(broken);
            }
            if (!p.bound_met) goal = hand.next();
        }
        SUCCEED();
    }
}

TEST_CASE(
    "while the surface moves the proxy stays on it, and a goal deep below never loses contact",
    "[property]") {
    const Algorithm algorithm = each_algorithm();
    const Ground ground = GENERATE(from_range(kGrounds));
    const auto surfaces = test::hostile_surfaces(ground.columns, ground.rows);
    for (std::size_t from = 0; from < surfaces.size(); ++from) {
        const auto& to = surfaces[(from + 3) % surfaces.size()];
        NastyHand hand(53, ground);
        const auto proxy = make_algorithm(algorithm);
        for (int k = 0; k < 1000; ++k) {
            const double blend = 0.5 - 0.5 * std::cos(0.05 * k);
            const DepthSurface surface(surfaces[from].image, to.image, blend, ground.shape());
            Vec3 goal = hand.next();
            if (k % 500 >= 250) goal.z = -80.0;  // below every surface
            const Proxy& p = proxy->update(surface, goal, {0.8, 0.3});
            const double height = p.position.z - surface.elevation_at(p.position.x, p.position.y);
            const bool stays_on = is_finite(p.position) && height >= -1e-9 && !p.bound_met &&
                                  (p.contact ? height <= 1e-8 : goal.z >= 0.0);
            if (stays_on) continue;
            CAPTURE(name_of(algorithm), ground, surfaces[from].name, to.name, k, height, p.contact,
                    p.bound_met);
            FAIL("the proxy left the surface that moves");
        }
    }
    SUCCEED();
}

TEST_CASE("without friction DIBHR and neighborhood rest at a local minimum of the distance",
          "[property]") {
    const Algorithm algorithm = GENERATE(Algorithm::dibhr, Algorithm::neighborhood);
    const Ground ground = GENERATE(from_range(kGrounds));
    for (const auto& [name, image] : test::hostile_surfaces(ground.columns, ground.rows)) {
        const DepthSurface surface(image, image, 0.0, ground.shape());
        NastyHand hand(23, ground);
        const auto proxy = make_algorithm(algorithm);
        for (int k = 0; k < 2000; ++k) {
            const Vec3 goal = hand.next();
            const Proxy& p = proxy->update(surface, goal, {0.0, 0.0});
            if (!p.contact) continue;
            const Vec3 clamped = surface.clamped_to_frame(goal);
            const double distance = glm::length(clamped - p.position);
            if (test::nearest_around(surface, p.position, clamped) >= distance - 1e-6) continue;
            CAPTURE(name_of(algorithm), ground, name, k, distance, name_of(p.active.kind));
            FAIL("a place around the proxy is nearer to the goal");
        }
    }
    SUCCEED();
}

TEST_CASE("with friction the proxy rests at a local minimum or in the cone of its piece",
          "[property]") {
    const double mu = GENERATE(0.1, 0.4, 1.5);
    const Ground ground = GENERATE(from_range(kGrounds));
    for (const auto& [name, image] : test::hostile_surfaces(ground.columns, ground.rows)) {
        const DepthSurface surface(image, image, 0.0, ground.shape());
        NastyHand hand(29, ground);
        Dibhr dibhr;
        for (int k = 0; k < 2000; ++k) {
            const Vec3 goal = hand.next();
            const Proxy& p = dibhr.update(surface, goal, {mu, mu});
            if (!p.contact) continue;
            const Vec3 clamped = surface.clamped_to_frame(goal);
            const double distance = glm::length(clamped - p.position);
            const bool rests =
                test::in_cone(surface, p, clamped, mu) ||
                test::nearest_around(surface, p.position, clamped) >= distance - 1e-6;
            if (rests) continue;
            CAPTURE(ground, name, mu, k, distance, name_of(p.active.kind));
            FAIL("the proxy rests where neither the cone nor the ground holds it");
        }
    }
    SUCCEED();
}

namespace {

/// `updates` of each ground, surface and friction.
void require_held_where_it_rests(int updates) {
    const double mu = GENERATE(0.1, 0.4, 1.5);
    const double deeper_px = GENERATE(0.0, 60.0);
    const Ground ground = GENERATE(from_range(kGrounds));
    for (const auto& [name, image] : test::hostile_surfaces(ground.columns, ground.rows)) {
        const DepthSurface surface(image, image, 0.0, ground.shape());
        NastyHand hand(41, ground);
        Dibhr dibhr;
        for (int k = 0; k < updates; ++k) {
            const Vec3 goal = hand.next() - Vec3(0.0, 0.0, deeper_px);
            const Proxy& p = dibhr.update(surface, goal, {mu, mu});
            if (!p.contact || p.bound_met) continue;
            if (!test::something_leads_on(surface, p.position, surface.clamped_to_frame(goal), mu))
                continue;
            CAPTURE(ground, name, mu, deeper_px, k, goal.x, goal.y, goal.z, p.position.x,
                    p.position.y, p.position.z, name_of(p.active.kind));
            FAIL("something around the proxy leads on, and friction lets it");
        }
    }
    SUCCEED();
}

}  // namespace

TEST_CASE("where the proxy rests, friction holds it on all that surrounds it", "[property]") {
    require_held_where_it_rests(500);
}

TEST_CASE("where the proxy rests, friction holds it, over a million updates", "[property][long]") {
    require_held_where_it_rests(3000);
}

TEST_CASE("the distance to the goal never grows in an update", "[property]") {
    const Algorithm algorithm = each_algorithm();
    const double mu = GENERATE(0.0, 0.5);
    const Ground ground = GENERATE(from_range(kGrounds));
    for (const auto& [name, image] : test::hostile_surfaces(ground.columns, ground.rows)) {
        const DepthSurface surface(image, image, 0.0, ground.shape());
        NastyHand hand(31, ground);
        const auto proxy = make_algorithm(algorithm);
        Vec3 before = proxy->update(surface, hand.next(), {mu, mu}).position;
        for (int k = 0; k < 2000; ++k) {
            const Vec3 goal = surface.clamped_to_frame(hand.next());
            const Vec3 after = proxy->update(surface, goal, {mu, mu}).position;
            const double grown_px = glm::length(goal - after) - glm::length(goal - before);
            before = after;
            if (grown_px <= 1e-9) continue;
            CAPTURE(name_of(algorithm), ground, name, mu, k, grown_px);
            FAIL("the distance to the goal grew");
        }
    }
    SUCCEED();
}

TEST_CASE("at every pixel pitch the spring pulls to the proxy, and what is sent keeps its limits",
          "[property]") {
    TouchParameters parameters;
    parameters.coupling.pixel_pitch_mm = GENERATE(0.001, 0.05, kPaperPitch_mm, 10.0);
    const Ground ground = GENERATE(from_range(kGrounds));
    const SafetyLimits limits;
    const double newton_per_px =
        parameters.coupling.stiffness_newton_per_mm * parameters.coupling.pixel_pitch_mm;
    for (const auto& [name, image] : test::hostile_surfaces(ground.columns, ground.rows)) {
        const DepthSurface surface(image, image, 0.0, ground.shape());
        NastyHand hand(43, ground);
        TouchRenderer renderer;
        Vec3 last(0.0);
        for (int k = 0; k < 1000; ++k) {
            const Touch& touch = renderer.update(surface, hand.next(), parameters, {}, limits);
            const Vec3 sent = touch.sent_force_newton;
            const Vec3 spring = touch.proxy.contact
                                    ? newton_per_px * (touch.proxy.position - touch.goal)
                                    : Vec3(0.0);
            const bool pulls = glm::length(touch.spring_force_newton - spring) <=
                               1e-12 * (1.0 + glm::length(spring));
            const bool is_limited = glm::length(sent) <= limits.max_force_newton + 1e-12;
            const bool dropped = sent == Vec3(0.0);
            const bool is_slow =
                dropped || glm::length(sent - last) <= limits.max_change_newton_per_ms + 1e-12;
            last = sent;
            if (pulls && is_limited && is_slow) continue;
            CAPTURE(ground, name, k, parameters.coupling.pixel_pitch_mm, pulls, is_limited,
                    is_slow);
            FAIL("a force is not as it is to be");
        }
    }
    SUCCEED();
}

TEST_CASE("a proxy in contact goes where a hand a hundred times slower takes it", "[property]") {
    // Smooth ground: the path has no forks, so only a jump or a wrong piece could part the two.
    const DepthImage image = test::image_of(64, 64, 65535.0, [](int i, int j) {
        return std::round(
            8000.0 +
            2500.0 * std::exp(-((i - 30.0) * (i - 30.0) + (j - 33.0) * (j - 33.0)) / 300.0));
    });
    const DepthSurface surface(image, image, 0.0, {655.35, 0.0});
    Dibhr fast;
    Dibhr slow;
    Vec3 last(12.3, 14.1, 70.0);
    fast.update(surface, last, {0.0, 0.0});
    slow.update(surface, last, {0.0, 0.0});
    for (int k = 1; k < 400; ++k) {
        const Vec3 goal(32.0 + 20.0 * std::cos(0.02 * k + 4.0),
                        32.0 + 20.0 * std::sin(0.031 * k + 4.0), 72.0);
        const Vec3 p = fast.update(surface, goal, {0.0, 0.0}).position;
        Vec3 q(0.0);
        for (int s = 1; s <= 100; ++s)
            q = slow.update(surface, last + (s / 100.0) * (goal - last), {0.0, 0.0}).position;
        last = goal;
        CAPTURE(k);
        REQUIRE(glm::length(p - q) <= 0.25);
    }
}

TEST_CASE("the same goals give the same bits twice", "[property]") {
    const Ground ground = GENERATE(from_range(kGrounds));
    const auto surfaces = test::hostile_surfaces(ground.columns, ground.rows);
    const Algorithm algorithm = each_algorithm();
    const auto run = [&] {
        std::vector<Vec3> path;
        for (const auto& named : surfaces) {
            const DepthSurface surface(named.image, surfaces.back().image, 0.3, ground.shape());
            NastyHand hand(37, ground);
            const auto proxy = make_algorithm(algorithm);
            for (int k = 0; k < 1000; ++k)
                path.push_back(proxy->update(surface, hand.next(), {}).position);
        }
        return path;
    };
    const auto first = run();
    const auto second = run();
    REQUIRE(first.size() == second.size());
    CHECK(std::memcmp(first.data(), second.data(), first.size() * sizeof(Vec3)) == 0);
}

TEST_CASE("a goal under a crease rests on the edge and does not alternate between the facets",
          "[property]") {
    // A V-shaped valley along the column x = 20.
    const DepthImage image =
        test::image_of(41, 30, 255.0, [](int i, int) { return 50.0 + 3.0 * std::abs(i - 20); });
    const DepthSurface surface(image, image, 0.0, {255.0, 0.0});
    Dibhr dibhr;
    dibhr.update(surface, {26.0, 15.2, 90.0}, {});
    for (int k = 0; k < 50; ++k) {
        const Vec3 goal(20.0 + 0.01 * (k % 3), 15.2, 30.0);
        const Proxy& p = dibhr.update(surface, goal, {0.0, 0.0});
        REQUIRE(p.active.kind == PrimitiveKind::edge);
        REQUIRE(std::abs(p.position.x - 20.0) <= 1e-12);
    }
}
