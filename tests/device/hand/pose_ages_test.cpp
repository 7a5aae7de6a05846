// How old poses were, counted in fixed memory.
#include "device/hand/pose_ages.hpp"

#include "tests/support/catch.hpp"

namespace {

using Catch::Matchers::WithinAbs;
using dibhr::PoseAges;
using std::chrono::microseconds;

constexpr double kBin_ms = 0.05;

}  // namespace

TEST_CASE("of ages it is told how old half, most, and the oldest were, to a bin", "[hand]") {
    PoseAges ages;
    CHECK(ages.count() == 0);
    CHECK_THAT(ages.quantile_ms(1.0), WithinAbs(0.0, 1e-12));
    for (int k = 0; k < 1000; ++k) ages.add(microseconds(2 * k));  // 0 .. 2 ms
    CHECK(ages.count() == 1000);
    CHECK_THAT(ages.quantile_ms(0.5), WithinAbs(1.0, kBin_ms));
    CHECK_THAT(ages.quantile_ms(0.99), WithinAbs(1.98, kBin_ms));
    CHECK_THAT(ages.quantile_ms(1.0), WithinAbs(2.0, kBin_ms));
}

TEST_CASE("an age below zero is none, and one that no force follows is 20 ms or more", "[hand]") {
    PoseAges ages;
    ages.add(microseconds(-30));
    CHECK_THAT(ages.quantile_ms(1.0), WithinAbs(kBin_ms, 1e-9));
    ages.add(std::chrono::hours(1));
    CHECK_THAT(ages.quantile_ms(1.0), WithinAbs(20.0, 1.01 * kBin_ms));
}

TEST_CASE("what came after a copy of it is the difference", "[hand]") {
    PoseAges ages;
    for (int k = 0; k < 100; ++k) ages.add(microseconds(9000));
    const PoseAges earlier = ages;
    for (int k = 0; k < 10; ++k) ages.add(microseconds(400));
    CHECK(ages.since(earlier).count() == 10);
    CHECK_THAT(ages.since(earlier).quantile_ms(1.0), WithinAbs(0.4, 1.01 * kBin_ms));
}
