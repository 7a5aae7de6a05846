// The simulated hand gives way as a spring does, and its linkage is the Falcon's.
#include "tests/device/falcon/hand_model.hpp"

#include <glm/geometric.hpp>

#include <cstdint>
#include <random>

#include "device/falcon/kinematics.hpp"
#include "tests/device/falcon/counts_of_angles.hpp"
#include "tests/support/catch.hpp"

namespace {

using Catch::Matchers::WithinAbs;
using dibhr::Vec3;
using dibhr::test::falcon::counts_of_angles;
using dibhr::test::falcon::HandModel;
using dibhr::test::falcon::HandOptions;

}  // namespace

TEST_CASE("a hand without motor commands rests where it is held", "[hand]") {
    HandModel hand;
    hand.place({0.01, -0.02, 0.12});
    hand.advance(1.0);
    CHECK_THAT(glm::distance(hand.grip_m(), Vec3(0.01, -0.02, 0.12)), WithinAbs(0.0, 1e-12));
    CHECK_THAT(glm::length(hand.motor_force_newton()), WithinAbs(0.0, 1e-12));
}

TEST_CASE("under a lasting motor command the hand gives way by force over stiffness", "[hand]") {
    std::mt19937 random(7);
    std::uniform_int_distribution<int> command(-1200, 1200);
    for (int i = 0; i < 20; ++i) {
        HandModel hand;
        hand.drive({static_cast<std::int16_t>(command(random)),
                    static_cast<std::int16_t>(command(random)),
                    static_cast<std::int16_t>(command(random))});
        hand.advance(2.0);
        const Vec3 given_way = hand.grip_m() - hand.hand_m();
        const Vec3 expected = hand.motor_force_newton() / HandOptions{}.stiffness_newton_per_m;
        CAPTURE(i, given_way.x, given_way.y, given_way.z);
        CHECK_THAT(glm::distance(given_way, expected), WithinAbs(0.0, 1e-6));
        CHECK_THAT(glm::length(hand.velocity_m_per_s()), WithinAbs(0.0, 1e-6));
    }
}

TEST_CASE("three equal positive commands pull the grip towards the base", "[hand]") {
    HandModel hand;
    hand.drive({500, 500, 500});
    const Vec3 force = hand.motor_force_newton();
    CHECK(force.z < -1.0);
    CHECK_THAT(force.x, WithinAbs(0.0, 1e-6));
    CHECK_THAT(force.y, WithinAbs(0.0, 1e-6));
}

TEST_CASE("the hand goes its way point by point and in its time", "[hand]") {
    HandModel hand;
    const Vec3 start = hand.hand_m();
    hand.move(start + Vec3(0.01, 0.0, 0.0), 0.5);
    hand.move(start + Vec3(0.01, 0.02, 0.0), 0.25);
    hand.advance(0.25);
    CHECK_THAT(glm::distance(hand.hand_m(), start + Vec3(0.005, 0.0, 0.0)), WithinAbs(0.0, 1e-9));
    hand.advance(0.375);
    CHECK_THAT(glm::distance(hand.hand_m(), start + Vec3(0.01, 0.01, 0.0)), WithinAbs(0.0, 1e-9));
    CHECK_FALSE(hand.arrived());
    hand.advance(0.5);
    CHECK(hand.arrived());
    CHECK_THAT(glm::distance(hand.grip_m(), start + Vec3(0.01, 0.02, 0.0)), WithinAbs(0.0, 1e-4));
}

TEST_CASE("the worked example of the README gives the same counts and torques", "[hand]") {
    const dibhr::test::falcon::Linkage linkage;
    const Vec3 grip{0.020, -0.010, 0.120};
    const auto counts = linkage.counts_at(grip);
    REQUIRE(counts.has_value());
    CHECK_THAT(counts->x, WithinAbs(16.0, 0.5));
    CHECK_THAT(counts->y, WithinAbs(-645.0, 0.5));
    CHECK_THAT(counts->z, WithinAbs(-128.0, 0.5));
    const Vec3 force = linkage.force_of({0.01019, -0.06734, 0.03257}, grip);
    CHECK_THAT(glm::distance(force, Vec3(1.0, 0.0, -0.5)), WithinAbs(0.0, 2e-3));
}

TEST_CASE("its linkage gives the driver's counts and torques over the whole workspace", "[hand]") {
    const dibhr::test::falcon::Linkage linkage;
    const dibhr::falcon::Geometry geometry;
    std::mt19937 random(11);
    std::uniform_real_distribution<double> within(-1.0, 1.0);
    for (int i = 0; i < 2000; ++i) {
        const Vec3 grip =
            Vec3(within(random), within(random), within(random)) * 0.04 + Vec3(0.0, 0.0, 0.115);
        CAPTURE(grip.x, grip.y, grip.z);
        const auto angles = dibhr::falcon::angles_at(grip, geometry);
        const auto jacobian = dibhr::falcon::jacobian_at(grip, geometry);
        const auto counts = linkage.counts_at(grip);
        REQUIRE((angles && jacobian && counts));
        const Vec3 driver_counts = counts_of_angles(*angles, geometry);
        CHECK_THAT(glm::distance(*counts, driver_counts), WithinAbs(0.0, 1e-6));
        const Vec3 force{within(random), within(random), within(random)};
        const auto torques = dibhr::falcon::torques_of(force, *jacobian);
        REQUIRE(torques.has_value());
        CHECK_THAT(glm::distance(linkage.force_of(*torques, grip), force), WithinAbs(0.0, 1e-5));
    }
}
