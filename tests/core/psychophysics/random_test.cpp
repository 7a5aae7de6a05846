// Random numbers: reproducible, uniform, and independent of each other.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <span>

#include "core/psychophysics/random.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr;
using Catch::Matchers::WithinAbs;

TEST_CASE("a seed and a stream mean the same draws for good", "[random]") {
    // The first numbers of O'Neill's own pcg32 demonstration, seeded with (42, 54).
    Random random(42, 54);
    for (const std::uint32_t drawn : {0xa15c02b7U, 0x7b47f409U, 0xba1d3330U, 0x83d2f293U}) {
        CHECK(random.bits() == drawn);
    }
    CHECK(Random(1, 2).bits() != Random(1, 3).bits());
    CHECK(Random(1, 2).bits() != Random(2, 2).bits());
}

TEST_CASE("draws have the mean and the spread they are asked for", "[random]") {
    Random random(7);
    constexpr int kDraws = 200'000;
    double uniform = 0.0;
    double normal = 0.0;
    double squares = 0.0;
    double binomial = 0.0;
    std::array<int, 6> sides{};
    for (int i = 0; i < kDraws; ++i) {
        uniform += random.uniform();
        const double drawn = random.normal();
        normal += drawn;
        squares += drawn * drawn;
        binomial += random.binomial(10, 0.3);
        ++sides[random.below(6)];
    }
    CHECK_THAT(uniform / kDraws, WithinAbs(0.5, 0.003));
    CHECK_THAT(normal / kDraws, WithinAbs(0.0, 0.01));
    CHECK_THAT(squares / kDraws, WithinAbs(1.0, 0.015));
    CHECK_THAT(binomial / kDraws, WithinAbs(3.0, 0.015));
    for (const int count : sides) CHECK_THAT(6.0 * count / kDraws, WithinAbs(1.0, 0.03));
}

TEST_CASE("every order of a shuffle is as likely as the next", "[random]") {
    Random random(11);
    std::map<std::array<int, 3>, int> orders;
    for (int i = 0; i < 60'000; ++i) {
        std::array<int, 3> order{1, 2, 3};
        random.shuffle(std::span<int>(order));
        ++orders[order];
    }
    REQUIRE(orders.size() == 6);
    for (const auto& [order, count] : orders) CHECK_THAT(count / 10'000.0, WithinAbs(1.0, 0.05));
}
