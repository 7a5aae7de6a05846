// Intervals and paired tests over participants.
#include <cmath>
#include <vector>

#include "core/psychophysics/random.hpp"
#include "core/psychophysics/ranks.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr;
using Catch::Matchers::WithinAbs;

using Values = std::vector<double>;

TEST_CASE("a mean has Student's interval, one value none", "[ranks]") {
    const Estimate mean = mean_of(Values{1.0, 2.0, 3.0, 4.0});
    CHECK(mean.value == 2.5);
    CHECK_THAT(mean.interval.high, WithinAbs(4.554260, 1e-6));  // R: t.test(1:4)
    CHECK(std::isinf(mean_of(Values{1.0}).interval.low));
    CHECK(std::isinf(mean_of(Values{0.1, 0.1, 0.1}).interval.low));  // nothing varies: no interval
    CHECK(std::isnan(mean_of(Values{}).value));
}

TEST_CASE("a median's interval lies between two of the values", "[ranks]") {
    const Estimate median = median_of(Values{9, 1, 8, 2, 7, 3, 6, 4, 5, 10});
    CHECK(median.value == 5.5);
    CHECK(median.interval.low == 2.0);
    CHECK(median.interval.high == 9.0);
    CHECK_THAT(median.confidence, WithinAbs(0.978516, 1e-6));
    CHECK(std::isinf(median_of(Values{1, 2, 3, 4, 5}).interval.low));
}

TEST_CASE("signed ranks are exact, with ties and zeros too", "[ranks]") {
    // R: wilcox.test(c(1, 2, 3, 4, 5, 6))
    CHECK_THAT(signed_rank_test(Values{1, 2, 3, 4, 5, 6}).p, WithinAbs(0.03125, 1e-9));
    CHECK(signed_rank_test(Values{1, 2, 3, 4, 5, 6}).effect == 1.0);
    // Ranks 1.5, 1.5, 3: of the 8 ways 4 are as far from the middle as this one.
    CHECK_THAT(signed_rank_test(Values{1, 1, -2, 0}).p, WithinAbs(1.0, 1e-9));
    CHECK_THAT(signed_rank_test(Values{1, 1, 2, 0}).p, WithinAbs(0.25, 1e-9));
    CHECK(signed_rank_test(Values{0, 0}).p == 1.0);
    // Equal distances whose last bits differ are ties: 7 of 12 is as far from half as 5 of 12.
    const double above = 7.0 / 12.0 - 0.5;
    const double below = 5.0 / 12.0 - 0.5;
    REQUIRE(above != -below);
    CHECK_THAT(signed_rank_test(Values{above, above, above, below, below}).p,
               WithinAbs(sign_test(Values{1, 1, 1, -1, -1}).p, 1e-9));
    CHECK_THAT(sign_test(Values{1, 2, 3, 4, 5, -6}).p, WithinAbs(0.21875, 1e-9));
}

TEST_CASE("the t test of one sample is Student's", "[ranks]") {
    const TestResult t = one_sample_t_test(Values{1.0, 2.0, 3.0, 4.0});
    CHECK(t.test == "one-sample t");
    CHECK_THAT(t.statistic, WithinAbs(3.872983, 1e-6));
    CHECK_THAT(t.p, WithinAbs(0.030466, 1e-6));
}

TEST_CASE("no difference is found in about 5 % of studies", "[ranks]") {
    Random random(17);
    constexpr int kStudies = 400;
    int ranks = 0;
    int several = 0;
    for (int i = 0; i < kStudies; ++i) {
        Values differences;
        std::vector<Values> rows;
        for (int person = 0; person < 12; ++person) {
            differences.push_back(random.normal());
            rows.push_back({random.normal(), random.normal(), random.normal()});
        }
        ranks += signed_rank_test(differences).p < kSignificance ? 1 : 0;
        if (i < kStudies / 4) several += friedman_test(rows).p < kSignificance ? 1 : 0;
    }
    CHECK(ranks <= 0.08 * kStudies);
    CHECK(ranks >= 0.02 * kStudies);
    CHECK(several <= 0.12 * kStudies / 4);
}

TEST_CASE("Friedman's test sees an order that all share", "[ranks]") {
    const std::vector<Values> rows{{1, 2, 3}, {2, 3, 4}, {1, 5, 6}, {0, 1, 9}, {3, 4, 5}};
    const TestResult result = friedman_test(rows);
    CHECK_THAT(result.statistic, WithinAbs(10.0, 1e-9));
    CHECK_THAT(result.effect, WithinAbs(1.0, 1e-9));
    CHECK(result.p < 0.01);
    CHECK(friedman_test({{1, 1, 1}, {2, 2, 2}}).p == 1.0);
}

TEST_CASE("Holm's correction keeps the order and never helps", "[ranks]") {
    const Values adjusted = holm_adjusted({0.01, 0.04, 0.03});
    CHECK_THAT(adjusted[0], WithinAbs(0.03, 1e-12));
    CHECK_THAT(adjusted[1], WithinAbs(0.06, 1e-12));
    CHECK_THAT(adjusted[2], WithinAbs(0.06, 1e-12));
}
