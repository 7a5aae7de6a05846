// The mechanism: thigh angles, poses, torques (device/falcon/README.md, Kinematics).
#include "device/falcon/kinematics.hpp"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <random>
#include <vector>

#include "tests/device/falcon/counts_of_angles.hpp"
#include "tests/support/catch.hpp"

namespace {

using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;
using dibhr::Vec3;
using dibhr::test::falcon::counts_of_angles;
using namespace dibhr::falcon;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr Vec3 kCentre_m{0.0, 0.0, 0.115};

/// The constants of Martin & Hillier.
constexpr Geometry kMartinHillier{.shin_end_d_m = 0.0115,
                                  .shin_end_e_m = 0.0115,
                                  .platform_radius_m = 0.0157,
                                  .base_radius_m = 0.0366,
                                  .platform_shift_m = 0.0262,
                                  .base_shift_m = 0.0272,
                                  .gear = 7.62,
                                  .angle_at_zero_deg = 50.0};

class Random {
  public:
    explicit Random(unsigned seed) : engine_(seed) {}
    double between(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(engine_);
    }
    Vec3 in_box(Vec3 low, Vec3 high) {
        return {between(low.x, high.x), between(low.y, high.y), between(low.z, high.z)};
    }
    Vec3 direction() {
        std::normal_distribution<double> normal;
        return glm::normalize(Vec3{normal(engine_), normal(engine_), normal(engine_)});
    }
    Vec3 in_sphere(Vec3 centre, double radius) {
        return centre + direction() * radius * std::cbrt(between(0.0, 1.0));
    }

  private:
    std::mt19937 engine_;
};

/// Volume of the rows as unit vectors: 0 when singular, negative on the side of the workspace.
double volume_of(const Jacobian& rows) {
    return glm::dot(glm::normalize(rows[0]),
                    glm::cross(glm::normalize(rows[1]), glm::normalize(rows[2])));
}

/// Where a hand can bring the grip: reachable, and not near a pose where the mechanism would flip.
bool in_workspace(Vec3 position, const Geometry& geometry) {
    const auto jacobian = jacobian_at(position, geometry);
    return jacobian && volume_of(*jacobian) < -0.1;
}

/// Random poses of the whole workspace; it is some 230 mm wide and reaches to 180 mm.
std::vector<Vec3> workspace_poses(std::size_t count, Random& random, const Geometry& geometry) {
    std::vector<Vec3> poses;
    while (poses.size() < count) {
        const Vec3 position = random.in_box({-0.13, -0.13, 0.05}, {0.13, 0.13, 0.19});
        if (in_workspace(position, geometry)) poses.push_back(position);
    }
    return poses;
}

/// How far the pose found for the angles of `position` is from it [m]; infinite when none is found.
double round_trip_error(Vec3 position, Vec3 start, const Geometry& geometry) {
    const auto angles = angles_at(position, geometry);
    if (!angles) return kInfinity;
    const auto found = position_with(*angles, start, geometry);
    return found ? glm::distance(*found, position) : kInfinity;
}

Vec3 turned_by_a_leg(Vec3 p) {
    const double cos = -0.5;
    const double sin = -std::numbers::sqrt3 / 2.0;
    return {cos * p.x - sin * p.y, sin * p.x + cos * p.y, p.z};
}

}  // namespace

TEST_CASE("the worked pose of the README has its angles and counts", "[kinematics]") {
    const auto angles = angles_at({0.020, -0.010, 0.120}, {});
    REQUIRE(angles);
    CHECK_THAT(glm::degrees(angles->x), WithinAbs(35.568, 0.0005));
    CHECK_THAT(glm::degrees(angles->y), WithinAbs(11.492, 0.0005));
    CHECK_THAT(glm::degrees(angles->z), WithinAbs(30.349, 0.0005));
    const Vec3 counts = counts_of_angles(*angles, {});
    CHECK_THAT(counts.x, WithinAbs(16.0, 0.5));
    CHECK_THAT(counts.y, WithinAbs(-645.0, 0.5));
    CHECK_THAT(counts.z, WithinAbs(-128.0, 0.5));
}

TEST_CASE("the worked force of the README has its torques", "[kinematics]") {
    const auto jacobian = jacobian_at({0.020, -0.010, 0.120}, {});
    REQUIRE(jacobian);
    const auto torques = torques_of({1.0, 0.0, -0.5}, *jacobian);
    REQUIRE(torques);
    CHECK_THAT(torques->x, WithinAbs(0.01019, 0.000005));
    CHECK_THAT(torques->y, WithinAbs(-0.06734, 0.000005));
    CHECK_THAT(torques->z, WithinAbs(0.03257, 0.000005));
}

TEST_CASE("a count is 0.036 degrees of the thigh, up is out, and count 0 is 35 degrees",
          "[kinematics]") {
    const Vec3 angles = angles_of_counts(Counts{0, 1, -1000}, {});
    CHECK_THAT(glm::degrees(angles.x), WithinAbs(35.0, 1e-12));
    CHECK_THAT(glm::degrees(angles.y), WithinAbs(35.0364, 0.0001));
    CHECK_THAT(glm::degrees(angles.z), WithinAbs(35.0 - 36.434, 0.001));
}

TEST_CASE("at count 0 the grip is 135 mm out, by the other source's constants 139 to 156 mm",
          "[kinematics]") {
    const auto height_mm = [](const Geometry& geometry) {
        const auto grip = position_with(angles_of_counts(Counts{}, geometry), kCentre_m, geometry);
        REQUIRE(grip);
        return 1000.0 * grip->z;
    };
    CHECK_THAT(height_mm({}), WithinAbs(135.0, 0.5));
    Geometry other = kMartinHillier;
    other.angle_at_zero_deg = 35.0;
    CHECK_THAT(height_mm(other), WithinAbs(139.0, 0.5));
    CHECK_THAT(height_mm(kMartinHillier), WithinAbs(156.0, 0.5));
}

TEST_CASE("counts and angles are each other's inverse", "[kinematics]") {
    const Geometry geometry = GENERATE(Geometry{}, kMartinHillier);
    Random random(1);
    for (int k = 0; k < 200; ++k) {
        const Vec3 counts = random.in_box(Vec3{-4000.0}, Vec3{4000.0});
        const Vec3 back = counts_of_angles(angles_of_counts(counts, geometry), geometry);
        CHECK_THAT(glm::distance(back, counts), WithinAbs(0.0, 1e-9));
    }
}

TEST_CASE("one count of one motor is some 15 um outwards at the centre, at most 34 um aside",
          "[kinematics]") {
    const Vec3 centre{0.0, 0.0, 0.11};
    const Vec3 counts = counts_of_angles(*angles_at(centre, {}), {});
    for (const Vec3 change : {Vec3{1.0, 0.0, 0.0}, Vec3{0.0, 1.0, 0.0}, Vec3{0.0, 0.0, 1.0}}) {
        const auto grip = position_with(angles_of_counts(counts + change, {}), centre, {});
        REQUIRE(grip);
        const Vec3 moved = *grip - centre;
        CHECK_THAT(1e6 * moved.z, WithinAbs(15.0, 0.5));
        CHECK_THAT(1e6 * std::hypot(moved.x, moved.y), WithinAbs(34.0, 0.5));
    }
}

TEST_CASE("full scale of the motors is the force of the README", "[kinematics]") {
    // For 0.41 N m 7.6 to 8.6 N laterally and 17 N axially, weaker when pulled out.
    const auto full_force = [](Vec3 grip, Vec3 direction) {
        const auto torques = torques_of(direction, *jacobian_at(grip, {}));
        REQUIRE(torques);
        return 0.4095 /
               std::max({std::abs(torques->x), std::abs(torques->y), std::abs(torques->z)});
    };
    const Vec3 centre{0.0, 0.0, 0.11};
    double weakest = kInfinity;
    double strongest = 0.0;
    double weakest_pulled_out = kInfinity;
    for (double angle = 0.0; angle < 6.28; angle += 0.01) {
        const Vec3 aside{std::cos(angle), std::sin(angle), 0.0};
        weakest = std::min(weakest, full_force(centre, aside));
        strongest = std::max(strongest, full_force(centre, aside));
        weakest_pulled_out = std::min(weakest_pulled_out, full_force({0.0, 0.0, 0.15}, aside));
    }
    CHECK_THAT(weakest, WithinAbs(7.6, 0.1));
    CHECK_THAT(strongest, WithinAbs(8.6, 0.2));
    CHECK_THAT(weakest_pulled_out, WithinAbs(5.6, 0.2));
    CHECK_THAT(full_force(centre, {0.0, 0.0, 1.0}), WithinAbs(17.0, 0.2));
}

TEST_CASE("a pose turned by a third of a turn has the same angles, one leg on", "[kinematics]") {
    Random random(2);
    for (const Vec3 position : workspace_poses(300, random, {})) {
        const auto angles = angles_at(position, {});
        const auto turned = angles_at(turned_by_a_leg(position), {});
        REQUIRE(angles);
        REQUIRE(turned);
        const Vec3 one_on{turned->y, turned->z, turned->x};
        CHECK_THAT(glm::distance(*angles, one_on), WithinAbs(0.0, 1e-12));
    }
}

TEST_CASE("the pose comes back from its angles over the whole workspace, from a millimetre away",
          "[kinematics]") {
    const Geometry geometry = GENERATE(Geometry{}, kMartinHillier);
    Random random(3);
    double worst_m = 0.0;
    for (const Vec3 position : workspace_poses(50000, random, geometry)) {
        const Vec3 start = position + 0.001 * random.direction();
        worst_m = std::max(worst_m, round_trip_error(position, start, geometry));
    }
    CHECK(worst_m <= 1e-9);
}

TEST_CASE("the pose comes back from its angles over the whole workspace, from the centre",
          "[kinematics]") {
    Random random(4);
    double worst_m = 0.0;
    for (const Vec3 position : workspace_poses(50000, random, {})) {
        worst_m = std::max(worst_m, round_trip_error(position, kCentre_m, {}));
    }
    CHECK(worst_m <= 1e-9);
}

TEST_CASE("no pose within 70 mm of the centre is missed, wherever the search starts",
          "[kinematics]") {
    Random random(5);
    double worst_m = 0.0;
    for (int k = 0; k < 50000; ++k) {
        const Vec3 position = random.in_sphere(kCentre_m, 0.07);
        if (!angles_at(position, {})) continue;
        const Vec3 start = random.in_box({-0.2, -0.2, -0.2}, {0.2, 0.2, 0.3});
        worst_m = std::max(worst_m, round_trip_error(position, start, {}));
    }
    CHECK(worst_m <= 1e-9);
}

TEST_CASE("a grid over the usable volume is reachable and found, also after a lost start",
          "[kinematics]") {
    constexpr double kStep_m = 0.004;
    const Vec3 start = GENERATE(Vec3{kCentre_m}, Vec3{0.0}, Vec3{kNan}, Vec3{0.0, kInfinity, 0.1},
                                Vec3{1e9}, Vec3{-0.04, 0.04, 0.14});
    double worst_m = 0.0;
    for (double x = -0.04; x <= 0.04; x += kStep_m) {
        for (double y = -0.04; y <= 0.04; y += kStep_m) {
            for (double z = -0.04; z <= 0.04; z += kStep_m) {
                if (glm::length(Vec3{x, y, z}) > 0.0401) continue;
                worst_m = std::max(worst_m, round_trip_error(kCentre_m + Vec3{x, y, z}, start, {}));
            }
        }
    }
    CHECK(worst_m <= 1e-9);
}

TEST_CASE("poses at the edge that the centre does not lead to are found from other heights",
          "[kinematics]") {
    const Vec3 position = GENERATE(Vec3{-0.082, 0.060, 0.034}, Vec3{-0.104, -0.015, 0.043});
    CHECK(round_trip_error(position, kCentre_m, {}) <= 1e-9);
}

TEST_CASE("a pose that no hand can reach, beyond the singular ones, is found from beside it",
          "[kinematics]") {
    const Vec3 position = GENERATE(Vec3{-0.092, -0.056, 0.066}, Vec3{-0.017, 0.109, 0.020});
    CHECK_FALSE(in_workspace(position, {}));
    CHECK(round_trip_error(position, position + Vec3{0.0005}, {}) <= 1e-9);
}

TEST_CASE("the Jacobian is what finite differences give", "[kinematics]") {
    const Geometry geometry = GENERATE(Geometry{}, kMartinHillier);
    constexpr double kStep_m = 1e-6;
    Random random(6);
    double worst = 0.0;
    for (int k = 0; k < 20000; ++k) {
        const Vec3 position = random.in_sphere(kCentre_m, 0.05);
        const auto exact = jacobian_at(position, geometry);
        if (!exact) continue;
        for (const Vec3 axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
            const auto ahead = angles_at(position + kStep_m * axis, geometry);
            const auto behind = angles_at(position - kStep_m * axis, geometry);
            REQUIRE((ahead && behind));
            const Vec3 slope = (*ahead - *behind) / (2.0 * kStep_m);
            for (std::size_t leg = 0; leg < 3; ++leg) {
                const double difference =
                    std::abs(slope[static_cast<int>(leg)] - glm::dot((*exact)[leg], axis));
                worst = std::max(worst, difference / glm::length((*exact)[leg]));
            }
        }
    }
    CHECK(worst <= 1e-6);
}

TEST_CASE("torques do at the thighs the work that the force does at the grip", "[kinematics]") {
    Random random(7);
    for (const Vec3 position : workspace_poses(500, random, {})) {
        const auto jacobian = jacobian_at(position, {});
        const Vec3 force = 5.0 * random.direction();
        const Vec3 move = 1e-3 * random.direction();
        const auto torques = torques_of(force, *jacobian);
        REQUIRE(torques);
        const Vec3 turn{glm::dot((*jacobian)[0], move), glm::dot((*jacobian)[1], move),
                        glm::dot((*jacobian)[2], move)};
        CHECK_THAT(glm::dot(*torques, turn), WithinAbs(glm::dot(force, move), 1e-12));
    }
}

TEST_CASE("torques grow with the force, up to 1e9 N", "[kinematics]") {
    const auto jacobian = jacobian_at({0.02, 0.01, 0.13}, {});
    const Vec3 once = *torques_of({1.0, -2.0, 0.5}, *jacobian);
    const Vec3 enormous = *torques_of({1e9, -2e9, 0.5e9}, *jacobian);
    for (const int i : {0, 1, 2}) CHECK_THAT(enormous[i], WithinRel(1e9 * once[i], 1e-12));
}

TEST_CASE("where the grip cannot be there are no angles and no Jacobian", "[kinematics]") {
    const Vec3 nowhere =
        GENERATE(Vec3{0.0, 0.0, 0.3}, Vec3{0.2, 0.0, 0.1}, Vec3{0.0, -0.15, 0.12}, Vec3{1e9},
                 Vec3{kNan, 0.0, 0.1}, Vec3{0.0, 0.0, kNan}, Vec3{0.0, kInfinity, 0.1},
                 Vec3{0.0, 0.0, -kInfinity}, Vec3{1e308});
    CHECK_FALSE(angles_at(nowhere, {}));
    CHECK_FALSE(jacobian_at(nowhere, {}));
}

TEST_CASE("angles without a pose give none, never another one's", "[kinematics]") {
    Random random(8);
    int found = 0;
    int missed = 0;
    for (int k = 0; k < 20000; ++k) {
        const Vec3 angles = random.in_box(Vec3{-3.1}, Vec3{3.1});
        const auto position = position_with(angles, kCentre_m, {});
        if (!position) {
            ++missed;
            continue;
        }
        ++found;
        const auto back = angles_at(*position, {});
        REQUIRE(back);
        for (const int i : {0, 1, 2}) {
            const double turned = std::remainder((*back)[i] - angles[i], 2.0 * std::numbers::pi);
            if (!(std::abs(turned) <= 1e-9)) {
                CAPTURE(position->x, position->y, position->z, i, turned);
                FAIL_CHECK("not the pose of these angles");
            }
        }
    }
    CHECK(found > 100);
    CHECK(missed > 100);
}

TEST_CASE("angles that are no number have no pose", "[kinematics]") {
    const double bad = GENERATE(values({kNan, kInfinity, -kInfinity}));
    CHECK_FALSE(position_with({bad, 0.5, 0.5}, kCentre_m, {}));
    CHECK_FALSE(position_with({0.5, 0.5, bad}, kCentre_m, {}));
}

TEST_CASE("a singular mechanism turns no force into torques", "[kinematics]") {
    const Jacobian flat{Vec3{10.0, 0.0, 5.0}, Vec3{0.0, 10.0, 5.0}, Vec3{10.0, 10.0, 10.0}};
    CHECK_FALSE(torques_of({1.0, 0.0, 0.0}, flat));
    CHECK_FALSE(torques_of({1.0, 0.0, 0.0}, Jacobian{}));
    const Jacobian upright{Vec3{10.0, 0.0, 0.0}, Vec3{0.0, 10.0, 0.0}, Vec3{0.0, 0.0, 10.0}};
    CHECK_FALSE(torques_of({1.0, kNan, 0.0}, upright));
    CHECK_FALSE(torques_of({1.0, 0.0, kInfinity}, upright));
}

TEST_CASE("constants that make no mechanism give nothing", "[kinematics]") {
    const double bad = GENERATE(0.0, -0.1, kNan, kInfinity);
    CAPTURE(bad);
    const auto gives_nothing = [](const Geometry& geometry) {
        return !angles_at(kCentre_m, geometry) && !jacobian_at(kCentre_m, geometry) &&
               !position_with(Vec3{0.5}, kCentre_m, geometry);
    };
    CHECK(gives_nothing({.thigh_m = bad}));
    CHECK(gives_nothing({.shin_m = bad}));
    if (bad == 0.0) return;  // these may be
    CHECK(gives_nothing({.shin_end_d_m = bad - 0.1}));
    CHECK(gives_nothing({.platform_radius_m = 10.0 * bad}));
    CHECK(gives_nothing({.base_radius_m = 10.0 * bad}));
    CHECK(gives_nothing({.base_shift_m = 10.0 * bad}));
}

TEST_CASE("a gear that makes no sense has no pose", "[kinematics]") {
    const Geometry geometry{.gear = GENERATE(0.0, kNan)};
    const Vec3 angles = angles_of_counts(Counts{100, 200, 300}, geometry);
    CHECK_FALSE(position_with(angles, kCentre_m, geometry));
}
