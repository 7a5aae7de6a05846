// What must always hold, on random and on hostile surfaces.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <vector>

#include <glm/geometric.hpp>

#include "core/haptics/dibhr.hpp"
#include "core/haptics/facet.hpp"
#include "core/haptics/neighbours.hpp"
#include "core/haptics/touch.hpp"
#include "tests/core/haptics/surfaces.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr;

namespace {

constexpr int kColumns = 48;
constexpr int kRows = 37;

/// Goals a nasty hand would give: smooth strokes, jitter, teleports, positions exactly on the grid.
class NastyHand {
  public:
    explicit NastyHand(std::uint64_t seed) : dice_(seed) {}
    Vec3 next() {
        const double what = dice_.uniform(0.0, 1.0);
        if (what < 0.02) {
            goal_ = {dice_.uniform(-5.0, kColumns + 5.0), dice_.uniform(-5.0, kRows + 5.0),
                     dice_.uniform(-50.0, 280.0)};
        } else if (what < 0.04) {
            goal_ = {std::round(goal_.x), std::round(goal_.y), std::round(goal_.z)};
        } else if (what < 0.06) {
            velocity_ = {dice_.uniform(-5.0, 5.0), dice_.uniform(-5.0, 5.0),
                         dice_.uniform(-6.0, 6.0)};
        } else if (what < 0.9) {
            goal_ += 0.3 * velocity_;
            goal_ = {std::clamp(goal_.x, -3.0, kColumns + 2.0),
                     std::clamp(goal_.y, -3.0, kRows + 2.0), std::clamp(goal_.z, -60.0, 290.0)};
        }
        return goal_;
    }

  private:
    test::Dice dice_;
    Vec3 goal_{20.0, 15.0, 120.0};
    Vec3 velocity_{1.0, 0.5, -1.0};
};

/// The point of a triangle nearest to p (Ericson, Real-Time Collision Detection, 5.1.5).
Vec3 nearest_on(Vec3 a, Vec3 b, Vec3 c, Vec3 p) {
    const Vec3 ab = b - a, ac = c - a, ap = p - a;
    const double d1 = glm::dot(ab, ap), d2 = glm::dot(ac, ap);
    if (d1 <= 0.0 && d2 <= 0.0) return a;
    const Vec3 bp = p - b;
    const double d3 = glm::dot(ab, bp), d4 = glm::dot(ac, bp);
    if (d3 >= 0.0 && d4 <= d3) return b;
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return a + (d1 / (d1 - d3)) * ab;
    const Vec3 cp = p - c;
    const double d5 = glm::dot(ab, cp), d6 = glm::dot(ac, cp);
    if (d6 >= 0.0 && d5 <= d6) return c;
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return a + (d2 / (d2 - d6)) * ac;
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) {
        return b + ((d4 - d3) / ((d4 - d3) + (d5 - d6))) * (c - b);
    }
    const double sum = va + vb + vc;
    return a + ab * (vb / sum) + ac * (vc / sum);
}

/// The smallest distance from the goal to any triangle that the proxy touches.
double nearest_around(const DepthSurface& surface, Vec3 proxy, Vec3 goal) {
    double nearest = glm::length(goal - proxy);
    const int i0 = static_cast<int>(std::floor(proxy.x));
    const int j0 = static_cast<int>(std::floor(proxy.y));
    const auto corner = [&](int i, int j) { return Vec3(i, j, surface.elevation(i, j)); };
    for (int j = std::max(0, j0 - 1); j <= std::min(surface.rows() - 2, j0 + 1); ++j) {
        for (int i = std::max(0, i0 - 1); i <= std::min(surface.columns() - 2, i0 + 1); ++i) {
            const Vec3 triangles[2][3] = {
                {corner(i, j), corner(i + 1, j), corner(i, j + 1)},
                {corner(i + 1, j + 1), corner(i, j + 1), corner(i + 1, j)}};
            for (const auto& t : triangles) {
                if (glm::length(nearest_on(t[0], t[1], t[2], proxy) - proxy) > 1e-9) continue;
                nearest = std::min(nearest, glm::length(nearest_on(t[0], t[1], t[2], goal) - goal));
            }
        }
    }
    return nearest;
}

/// Whether friction holds a proxy back from going to the foot F of the goal on a straight piece.
bool is_held(Vec3 proxy, Vec3 foot, Vec3 goal, double mu) {
    return glm::length(proxy - foot) <= mu * glm::length(goal - foot) + 1e-7;
}

/// Whether a TRIANGLE that the proxy touches leads it nearer to the goal, and friction lets it.
bool leads_on(const std::array<Vec3, 3>& corners, Vec3 proxy, Vec3 goal, double mu) {
    const auto& [a, b, c] = corners;
    if (glm::length(nearest_on(a, b, c, proxy) - proxy) > 1e-9) return false;
    for (int k = 0; k < 3; ++k) {
        const Vec3 begin = corners[static_cast<std::size_t>(k)];
        const Vec3 along = corners[static_cast<std::size_t>((k + 1) % 3)] - begin;
        const double at = glm::dot(proxy - begin, along) / glm::dot(along, along);
        if (glm::length(begin + at * along - proxy) > 1e-9) continue;  // not on this EDGE
        const double foot_at = glm::dot(goal - begin, along) / glm::dot(along, along);
        const bool is_way = foot_at > at ? at < 1.0 - 1e-6 : at > 1e-6;
        if (is_way && !is_held(proxy, begin + foot_at * along, goal, mu)) return true;
    }
    const Vec3 normal = glm::normalize(glm::cross(b - a, c - a));
    const Vec3 foot = goal - normal * glm::dot(goal - a, normal);
    const Vec3 ahead = proxy + 1e-4 * glm::normalize(foot - proxy);
    const bool is_way = glm::length(nearest_on(a, b, c, ahead) - ahead) <= 1e-9;
    return is_way && !is_held(proxy, foot, goal, mu);
}

/// Whether any TRIANGLE or EDGE around the proxy leads it nearer to the goal, and friction lets it.
bool something_leads_on(const DepthSurface& surface, Vec3 proxy, Vec3 goal, double mu) {
    const int i0 = static_cast<int>(std::floor(proxy.x));
    const int j0 = static_cast<int>(std::floor(proxy.y));
    for (int j = std::max(0, j0 - 1); j <= std::min(surface.rows() - 2, j0 + 1); ++j) {
        for (int i = std::max(0, i0 - 1); i <= std::min(surface.columns() - 2, i0 + 1); ++i) {
            const std::array<Vec3, 4> z{surface.vertex_at(i, j), surface.vertex_at(i + 1, j),
                                        surface.vertex_at(i, j + 1),
                                        surface.vertex_at(i + 1, j + 1)};
            if (leads_on({z[0], z[1], z[2]}, proxy, goal, mu)) return true;
            if (leads_on({z[3], z[2], z[1]}, proxy, goal, mu)) return true;
        }
    }
    return false;
}

/// Whether the proxy is in the cone around the goal's foot on the active piece.
bool in_cone(const DepthSurface& surface, const Proxy& proxy, Vec3 goal, double mu) {
    Vec3 foot(0.0);
    if (proxy.active.kind == PrimitiveKind::triangle) {
        const Facet facet(surface, proxy.active);
        const Vec3 n = glm::normalize(Vec3(-facet.slope_x(), -facet.slope_y(), 1.0));
        foot = goal - n * glm::dot(goal - proxy.position, n);
    } else if (proxy.active.kind == PrimitiveKind::edge) {
        const EdgeEnds ends = ends_of(proxy.active);
        const Vec3 a(ends.begin_i, ends.begin_j, surface.elevation(ends.begin_i, ends.begin_j));
        const Vec3 b(ends.end_i, ends.end_j, surface.elevation(ends.end_i, ends.end_j));
        const Vec3 along = glm::normalize(b - a);
        foot = a + along * glm::dot(goal - a, along);
    } else {
        return false;
    }
    return glm::length(proxy.position - foot) <= mu * glm::length(goal - foot) + 1e-7;
}

/// Updates of the long run; DIBHR_LONG_UPDATES asks for more.
long long_updates() {
    const char* asked = std::getenv("DIBHR_LONG_UPDATES");
    return asked == nullptr ? 1'000'000 : std::atol(asked);
}

Algorithm each_algorithm() {
    return GENERATE(Algorithm::dibhr, Algorithm::pga, Algorithm::neighborhood,
                    Algorithm::god_object);
}

}  // namespace

TEST_CASE(
    "on every surface the proxy stays finite, on or above the surface, and the walk ends by itself",
    "[property]") {
    const auto surfaces = test::hostile_surfaces(kColumns, kRows);
    const Algorithm algorithm = each_algorithm();
    const long in_all = algorithm == Algorithm::dibhr ? long_updates() : long_updates() / 10;
    const long updates = in_all / static_cast<long>(surfaces.size()) / 3;
    for (const auto& [name, image] : surfaces) {
        for (const double mu : {0.0, 0.3, 1.0}) {
            CAPTURE(name_of(algorithm), name, mu);
            const DepthSurface surface(image, image, 0.0, {255.0, 0.0});
            NastyHand hand(17);
            const auto proxy = make_algorithm(algorithm);
            for (long k = 0; k < updates; ++k) {
                const Vec3 goal = hand.next();
                const Proxy& p = proxy->update(surface, goal, {mu, mu});
                const Vec3 at = p.position;
                const double height = at.z - surface.elevation_at(at.x, at.y);
                if (!(is_finite(at) && height >= -1e-9 && (!p.contact || height <= 1e-8) &&
                      !p.bound_met && at.x >= 0.0 && at.y >= 0.0 && at.x <= kColumns - 1 &&
                      at.y <= kRows - 1)) {
                    CAPTURE(k, goal.x, goal.y, goal.z, at.x, at.y, at.z, p.moves, p.bound_met);
                    FAIL("a property is broken");
                }
            }
            SUCCEED();
        }
    }
}

TEST_CASE(
    "while the surface moves the proxy stays on it, and a goal deep below never loses contact",
    "[property]") {
    const Algorithm algorithm = each_algorithm();
    const auto surfaces = test::hostile_surfaces(kColumns, kRows);
    for (std::size_t from = 0; from < surfaces.size(); ++from) {
        const auto& to = surfaces[(from + 3) % surfaces.size()];
        CAPTURE(name_of(algorithm), surfaces[from].name, to.name);
        NastyHand hand(53);
        const auto proxy = make_algorithm(algorithm);
        for (int k = 0; k < 3000; ++k) {
            const double blend = 0.5 - 0.5 * std::cos(0.05 * k);
            const DepthSurface surface(surfaces[from].image, to.image, blend, {255.0, 0.0});
            Vec3 goal = hand.next();
            if (k % 1000 >= 500) goal.z = -80.0;  // below every surface
            const Proxy& p = proxy->update(surface, goal, {0.8, 0.3});
            const double height = p.position.z - surface.elevation_at(p.position.x, p.position.y);
            CAPTURE(k, height);
            REQUIRE(is_finite(p.position));
            REQUIRE(height >= -1e-9);
            REQUIRE_FALSE(p.bound_met);
            if (goal.z < 0.0) REQUIRE(p.contact);
            if (p.contact) REQUIRE(height <= 1e-8);
        }
    }
}

TEST_CASE("without friction DIBHR and neighborhood rest at a local minimum of the distance",
          "[property]") {
    const Algorithm algorithm = GENERATE(Algorithm::dibhr, Algorithm::neighborhood);
    for (const auto& [name, image] : test::hostile_surfaces(kColumns, kRows)) {
        CAPTURE(name_of(algorithm), name);
        const DepthSurface surface(image, image, 0.0, {255.0, 0.0});
        NastyHand hand(23);
        const auto proxy = make_algorithm(algorithm);
        for (int k = 0; k < 20000; ++k) {
            const Vec3 goal = hand.next();
            const Proxy& p = proxy->update(surface, goal, {0.0, 0.0});
            if (!p.contact) continue;
            const Vec3 clamped = surface.clamped_to_frame(goal);
            const double distance = glm::length(clamped - p.position);
            CAPTURE(k, distance, name_of(p.active.kind));
            REQUIRE(nearest_around(surface, p.position, clamped) >= distance - 1e-6);
        }
    }
}

TEST_CASE("with friction the proxy rests at a local minimum or in the cone of its piece",
          "[property]") {
    const double mu = GENERATE(0.1, 0.4, 1.5);
    for (const auto& [name, image] : test::hostile_surfaces(kColumns, kRows)) {
        CAPTURE(name, mu);
        const DepthSurface surface(image, image, 0.0, {255.0, 0.0});
        NastyHand hand(29);
        Dibhr dibhr;
        for (int k = 0; k < 10000; ++k) {
            const Vec3 goal = hand.next();
            const Proxy& p = dibhr.update(surface, goal, {mu, mu});
            if (!p.contact) continue;
            const Vec3 clamped = surface.clamped_to_frame(goal);
            const double distance = glm::length(clamped - p.position);
            CAPTURE(k, distance, name_of(p.active.kind));
            const bool rests = in_cone(surface, p, clamped, mu) ||
                               nearest_around(surface, p.position, clamped) >= distance - 1e-6;
            REQUIRE(rests);
        }
    }
}

TEST_CASE("where the proxy rests, friction holds it on all that surrounds it", "[property]") {
    const double mu = GENERATE(0.1, 0.4, 1.5);
    const double deeper_px = GENERATE(0.0, 60.0);
    for (const auto& [name, image] : test::hostile_surfaces(kColumns, kRows)) {
        CAPTURE(name, mu, deeper_px);
        const DepthSurface surface(image, image, 0.0, {255.0, 0.0});
        NastyHand hand(41);
        Dibhr dibhr;
        for (int k = 0; k < 10000; ++k) {
            const Vec3 goal = hand.next() - Vec3(0.0, 0.0, deeper_px);
            const Proxy& p = dibhr.update(surface, goal, {mu, mu});
            if (!p.contact || p.bound_met) continue;
            CAPTURE(k, goal.x, goal.y, goal.z, p.position.x, p.position.y, p.position.z,
                    name_of(p.active.kind));
            REQUIRE_FALSE(
                something_leads_on(surface, p.position, surface.clamped_to_frame(goal), mu));
        }
    }
}

TEST_CASE("the distance to the goal never grows in an update", "[property]") {
    const Algorithm algorithm = each_algorithm();
    const double mu = GENERATE(0.0, 0.5);
    for (const auto& [name, image] : test::hostile_surfaces(kColumns, kRows)) {
        CAPTURE(name_of(algorithm), name, mu);
        const DepthSurface surface(image, image, 0.0, {255.0, 0.0});
        NastyHand hand(31);
        const auto proxy = make_algorithm(algorithm);
        Vec3 before = proxy->update(surface, hand.next(), {mu, mu}).position;
        for (int k = 0; k < 20000; ++k) {
            const Vec3 goal = surface.clamped_to_frame(hand.next());
            const Vec3 after = proxy->update(surface, goal, {mu, mu}).position;
            REQUIRE(glm::length(goal - after) <= glm::length(goal - before) + 1e-9);
            before = after;
        }
    }
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
    const auto surfaces = test::hostile_surfaces(kColumns, kRows);
    const Algorithm algorithm = each_algorithm();
    const auto run = [&] {
        std::vector<Vec3> path;
        for (const auto& named : surfaces) {
            const DepthSurface surface(named.image, surfaces.back().image, 0.3, {255.0, 0.0});
            NastyHand hand(37);
            const auto proxy = make_algorithm(algorithm);
            for (int k = 0; k < 3000; ++k)
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
