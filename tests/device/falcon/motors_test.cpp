// Motor commands: they never wrap, and keep the direction of the force.
#include "device/falcon/kinematics.hpp"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <optional>
#include <random>

#include "tests/support/catch.hpp"

namespace {

using Catch::Matchers::WithinAbs;
using dibhr::Vec3;
using namespace dibhr::falcon;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

Vec3 as_vector(const Counts& counts) {
    return {counts[0], counts[1], counts[2]};
}

double largest_of(Vec3 v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

/// How far the command is from the exact one, scaled down to full scale [counts].
double rounding_of(const Counts& counts, Vec3 torques, const Motors& motors) {
    const double largest = largest_of(torques);
    if (largest == 0.0) return largest_of(as_vector(counts));
    const double size =
        std::min(motors.counts_per_newton_metre * largest, std::floor(motors.full_scale_counts));
    return largest_of(as_vector(counts) + torques / largest * size);
}

Vec3 random_direction(std::mt19937& random) {
    std::normal_distribution<double> normal;
    return {normal(random), normal(random), normal(random)};
}

}  // namespace

TEST_CASE("torques of any size become the nearest command, shortened by one common factor",
          "[motors]") {
    const double size =
        GENERATE(0.0, 1e-300, 1e-6, 1e-3, 0.1, 0.4, 0.41, 1.0, 30.0, 1e3, 1e6, 1e9, 1e100, 1e300);
    CAPTURE(size);
    const Motors motors;
    std::mt19937 random(7);
    double worst_rounding = 0.0;
    double largest = 0.0;
    for (int k = 0; k < 5000; ++k) {
        const Vec3 torques = size * random_direction(random);
        const Counts counts = motor_counts(torques, motors);
        worst_rounding = std::max(worst_rounding, rounding_of(counts, torques, motors));
        largest = std::max(largest, largest_of(as_vector(counts)));
    }
    CHECK(worst_rounding <= 0.5 + 1e-6);
    CHECK(largest <= 4095.0);
}

TEST_CASE("forces up to 1e9 N at the grip never wrap a motor and keep their direction",
          "[motors]") {
    const double force_newton = GENERATE(0.1, 4.0, 8.9, 40.0, 1e3, 1e6, 1e9);
    CAPTURE(force_newton);
    const Geometry geometry;
    std::mt19937 random(11);
    std::uniform_real_distribution<double> aside(-0.03, 0.03);
    for (int k = 0; k < 2000; ++k) {
        const Vec3 grip{aside(random), aside(random), 0.115 + aside(random)};
        const auto jacobian = jacobian_at(grip, geometry);
        REQUIRE(jacobian);
        const Vec3 force = force_newton * random_direction(random);
        const auto torques = torques_of(force, *jacobian);
        REQUIRE(torques);
        const Counts counts = motor_counts(*torques, {});
        if (rounding_of(counts, *torques, {}) > 0.5 + 1e-6 ||
            largest_of(as_vector(counts)) > 4095.0) {
            CAPTURE(force.x, force.y, force.z);
            FAIL_CHECK("wrapped, or turned");
        }
    }
    CHECK(largest_of(as_vector(motor_counts({1e9, 0.0, 0.0}, {}))) > 4094.5);
}

TEST_CASE("a command is minus the torque by the scale", "[motors]") {
    const Counts counts = motor_counts({0.0123, -0.0456, 0.0}, {});
    CHECK(counts == Counts{-123, 456, 0});
    CHECK(motor_counts({0.01, 0.0, -0.02}, {.counts_per_newton_metre = 6616.0}) ==
          Counts{-66, 0, 132});
}

TEST_CASE("a pull towards the base gives three positive commands, as Novint's packets do",
          "[motors]") {
    const auto jacobian = jacobian_at({0.0, 0.0, 0.115}, {});
    REQUIRE(jacobian);
    const auto torques = torques_of({0.0, 0.0, -1.0}, *jacobian);
    REQUIRE(torques);
    for (const std::int16_t command : motor_counts(*torques, {})) CHECK(command > 0);
}

TEST_CASE("a larger torque never gives a smaller command", "[motors]") {
    const Vec3 direction{0.3, -1.0, 0.7};
    int last = 0;
    for (double size = 1e-6; size < 1e12; size *= 1.1) {
        const int command = motor_counts(size * direction, {})[1];
        CHECK(command >= last);
        last = command;
    }
    CHECK(last == 4095);
}

TEST_CASE("a torque that is no number moves no motor", "[motors]") {
    const double bad = GENERATE(values({kNan, kInfinity, -kInfinity}));
    CHECK(motor_counts({bad, 0.1, 0.1}, {}) == Counts{});
    CHECK(motor_counts({0.1, bad, 0.1}, {}) == Counts{});
    CHECK(motor_counts({0.1, 0.1, bad}, {}) == Counts{});
}

TEST_CASE("whatever full scale a person sets, no motor gets more than 4095 or than it",
          "[motors]") {
    const double full = GENERATE(4095.0, 4096.0, 32767.0, 32768.0, 1e9, kInfinity, 100.7, 1.0);
    CAPTURE(full);
    const Counts counts = motor_counts({1e9, -2e9, 5e8}, {.full_scale_counts = full});
    const double most = std::floor(std::min(full, 4095.0));
    CHECK_THAT(as_vector(counts).y, WithinAbs(most, 1e-9));
    CHECK_THAT(as_vector(counts).x, WithinAbs(-most / 2.0, 0.5));
    CHECK_THAT(as_vector(counts).z, WithinAbs(-most / 4.0, 0.5));
}

TEST_CASE("a full scale or a scale that makes no sense moves no motor", "[motors]") {
    const double bad = GENERATE(values({kNan, -kInfinity, -1.0, -4095.0, 0.0}));
    CHECK(motor_counts({0.1, 0.2, 0.3}, {.full_scale_counts = bad}) == Counts{});
    CHECK(motor_counts({0.1, 0.2, 0.3}, {.counts_per_newton_metre = bad}) == Counts{});
}

TEST_CASE("an enormous scale saturates and keeps the direction", "[motors]") {
    const Counts counts = motor_counts({1e10, -5e9, 0.0}, {.counts_per_newton_metre = 1e305});
    CHECK(counts == Counts{-4095, 2048, 0});
}
