// Proportions: exact intervals and tests, and d' of the trial forms.
#include <cmath>

#include "core/psychophysics/proportions.hpp"
#include "core/psychophysics/random.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr;
using Catch::Matchers::WithinAbs;

TEST_CASE("an exact interval is Clopper and Pearson's", "[proportions]") {
    // R: binom.test(7, 20)$conf.int, binom.test(0, 10)$conf.int
    const Interval seven = exact_interval({7, 20});
    CHECK_THAT(seven.low, WithinAbs(0.1539092, 1e-7));
    CHECK_THAT(seven.high, WithinAbs(0.5921885, 1e-7));
    CHECK(exact_interval({0, 10}).low == 0.0);
    CHECK_THAT(exact_interval({0, 10}).high, WithinAbs(0.3084971, 1e-7));
    CHECK(exact_interval({10, 10}).high == 1.0);
    CHECK(exact_interval({0, 0}).holds(0.5));
}

TEST_CASE("an exact interval covers the true share at least as often as it says", "[proportions]") {
    const double share = GENERATE(0.05, 1.0 / 3.0, 0.5, 0.9);
    Random random(3);
    int covered = 0;
    for (int i = 0; i < 2000; ++i) {
        covered += exact_interval({random.binomial(24, share), 24}).holds(share) ? 1 : 0;
    }
    CHECK(covered >= 2000 * 0.94);
}

TEST_CASE("the binomial test counts what is no likelier than what was seen", "[proportions]") {
    CHECK_THAT(binomial_test({15, 20}, 0.5).exact_p, WithinAbs(0.0413895, 1e-7));  // R: binom.test
    CHECK_THAT(binomial_test({11, 20}, 1.0 / 3.0).exact_p, WithinAbs(0.0552292, 1e-7));
    CHECK(binomial_test({10, 20}, 0.5).exact_p == 1.0);
    CHECK(binomial_test({15, 20}, 0.5).mid_p < binomial_test({15, 20}, 0.5).exact_p);
}

TEST_CASE("a guess is an effect in at most 5 % of studies, by mid-p in about 5 %",
          "[proportions]") {
    const double chance = GENERATE(0.5, 1.0 / 3.0);
    constexpr int kStudies = 2000;
    Random random(5);
    int exact = 0;
    int mid = 0;
    for (int i = 0; i < kStudies; ++i) {
        const BinomialTest test = binomial_test({random.binomial(120, chance), 120}, chance);
        exact += test.exact_p < kSignificance ? 1 : 0;
        mid += test.mid_p < kSignificance ? 1 : 0;
    }
    CAPTURE(chance, exact, mid);
    CHECK(exact <= 0.055 * kStudies);
    CHECK_THAT(static_cast<double>(mid) / kStudies, WithinAbs(0.05, 0.012));
}

TEST_CASE("d' is 0 at chance and grows with the share right", "[proportions]") {
    CHECK_THAT(oddity_share(0.0), WithinAbs(1.0 / 3.0, 1e-9));
    CHECK_THAT(oddity_share(2.0), WithinAbs(0.6046, 2e-3));  // Ennis's table of the triangular test
    CHECK_THAT(two_interval_sensitivity({50, 100}).d_prime, WithinAbs(0.0, 1e-9));
    // 76 % right of two intervals is d' = 1.
    CHECK_THAT(two_interval_sensitivity({7602, 10'000}).d_prime, WithinAbs(1.0, 2e-3));
    CHECK(oddity_sensitivity({30, 100}).d_prime == 0.0);
    CHECK(oddity_sensitivity({60, 100}).d_prime < oddity_sensitivity({70, 100}).d_prime);
    const Sensitivity all = two_interval_sensitivity({10, 10});
    CHECK(std::isfinite(all.d_prime));
    CHECK(std::isinf(all.interval.high));
}

TEST_CASE("yes or no gives d' and a criterion", "[proportions]") {
    const YesNoSensitivity found = yes_no_sensitivity({840, 1000}, {160, 1000});
    CHECK_THAT(found.sensitivity.d_prime, WithinAbs(2.0 * 0.9945, 5e-3));
    CHECK_THAT(found.criterion, WithinAbs(0.0, 1e-9));
    CHECK(found.sensitivity.interval.holds(1.989));
    CHECK(std::isinf(yes_no_sensitivity({1, 2}, {}).sensitivity.interval.high));
}
