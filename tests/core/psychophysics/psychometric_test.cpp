// Psychometric functions and staircases, fitted to a simulated person's answers.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "core/psychophysics/psychometric.hpp"
#include "core/psychophysics/staircase.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/some_of.hpp"

using namespace dibhr;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

struct Form {
    std::string name{};
    double guess{0.0};
    int down_after{1};
};

const std::vector<Form> kForms{
    {"two intervals", 0.5, 2}, {"three intervals", 1.0 / 3.0, 2}, {"yes or no", 0.0, 1}};

LevelCounts constant_levels(int trials) {
    LevelCounts counts;
    for (const double x : {0.1, 0.25, 0.4, 0.5, 0.6, 0.75, 0.9}) counts.push_back({x, {0, trials}});
    return counts;
}

StaircaseRule rule_of(const Form& form) {
    StaircaseRule rule;
    rule.down_after = form.down_after;
    rule.low = 0.05;
    rule.high = 1.2;
    return rule;
}

PsychometricFunction person_of(Curve curve, double guess) {
    const double scale = curve == Curve::weibull ? 0.35 : 0.15;
    return {curve, 0.5, scale, 0.5, guess, 0.02};
}

/// The number of studies, and of bootstraps for each.
struct Studies {
    int count{20};
    int bootstraps{99};
};

/// As in the README where DIBHR_ALL_STUDIES is set.
Studies many_studies(int count) {
    if (std::getenv("DIBHR_ALL_STUDIES") != nullptr) return {1000, 399};
    return {count, 99};
}

struct Recovery {
    double bias{0.0};      ///< of the threshold, as a share of it
    double coverage{0.0};  ///< of its interval
};

Recovery recovered(const PsychometricFunction& person, const Simulate& simulate,
                   const Studies& studies) {
    const FitSettings settings{person.curve, person.level, person.guess, 0.06, studies.bootstraps};
    Recovery found;
    for (int study = 0; study < studies.count; ++study) {
        const auto seed = static_cast<std::uint64_t>(study);
        Random random = draws_for(seed, {1});
        const PsychometricFit fit = fitted(simulate(person, random), settings, simulate, seed);
        found.bias += (fit.function.threshold / person.threshold - 1.0) / studies.count;
        found.coverage += fit.threshold.holds(person.threshold) ? 1.0 / studies.count : 0.0;
    }
    return found;
}

/// Of a share of 0.95 over so few studies.
double standard_error(const Studies& studies) {
    return std::sqrt(0.95 * 0.05 / studies.count);
}

void require_unbiased(const Studies& studies) {
    const Form form = GENERATE(some_of(kForms, 1));
    const Curve curve = GENERATE(Curve::logistic, Curve::weibull);
    const bool staircase = GENERATE(false, true);
    const PsychometricFunction person = person_of(curve, form.guess);
    const Simulate simulate =
        staircase ? same_staircases(rule_of(form), 4) : same_levels(constant_levels(40));
    const Recovery found = recovered(person, simulate, studies);
    CAPTURE(form.name, name_of(curve), staircase, studies.count, found.bias, found.coverage);
    CHECK_THAT(found.bias, WithinAbs(0.0, 0.05));
    // 2 % are allowed, which a thousand studies show.
    const double beside = studies.count < 1000 ? 4.0 * standard_error(studies) : 0.02 + 1e-9;
    CHECK_THAT(found.coverage, WithinAbs(0.95, beside));
}

void require_few_trials_covered(const Studies& studies) {
    // Steep between three levels: the fit often is a step, of which a bootstrap alone thinks that
    // nothing else is possible.
    const Form form = GENERATE(some_of(kForms, 1));
    const int trials = GENERATE(12, 33, 99);
    LevelCounts levels;
    for (const double x : {0.05, 0.15, 0.3}) levels.push_back({x, {0, trials}});
    const PsychometricFunction person{Curve::logistic, 0.15, 0.025, 0.5, form.guess, 0.05};
    const Recovery found = recovered(person, same_levels(levels), studies);
    CAPTURE(form.name, trials, studies.count, found.coverage);
    CHECK(found.coverage >= 0.95 - 0.02 - 2.5 * standard_error(studies));
}

}  // namespace

TEST_CASE("thresholds are unbiased and their intervals cover as often as they say",
          "[psychometric]") {
    require_unbiased({});
}

TEST_CASE("thresholds of many studies are unbiased, and their intervals cover as they say",
          "[psychometric][long]") {
    require_unbiased(many_studies(100));
}

TEST_CASE("of few trials the threshold's interval covers it nearly as often as it says",
          "[psychometric]") {
    require_few_trials_covered({});
}

TEST_CASE("of few trials, too, an interval covers the threshold in many studies",
          "[psychometric][long]") {
    require_few_trials_covered(many_studies(200));
}

TEST_CASE("a rough fit is the same function, and knows who has a threshold", "[psychometric]") {
    int guessing = 0;
    int noticing = 0;
    for (std::uint64_t study = 0; study < 40; ++study) {
        Random random(study);
        const PsychometricFunction person = person_of(Curve::logistic, 0.5);
        const FitSettings settings{Curve::logistic, 0.5, 0.5};
        LevelCounts chance = constant_levels(40);
        for (LevelCount& level : chance) level.count.hits = random.binomial(40, 0.5);
        const LevelCounts felt = same_levels(constant_levels(40))(person, random);
        const PsychometricFit rough = fitted_roughly(felt, settings);
        CHECK(rough.function.threshold == most_likely(felt, settings).threshold);
        const auto bounded = [&settings](const LevelCounts& counts) {
            const Interval interval = fitted_roughly(counts, settings).threshold;
            return std::isfinite(interval.low) && std::isfinite(interval.high) ? 1 : 0;
        };
        guessing += bounded(chance);
        noticing += bounded(felt);
    }
    CHECK(guessing <= 6);
    CHECK(noticing >= 38);
}

TEST_CASE("a function has its level at its threshold, its guess and lapse rates at its ends",
          "[psychometric]") {
    const Curve curve = GENERATE(Curve::logistic, Curve::cumulative_gaussian, Curve::weibull);
    const double level = GENERATE(0.3, 0.5, 0.8);
    const PsychometricFunction function{curve, 0.5, 0.1, level, 0.5, 0.04};
    CHECK_THAT(function.share(0.5), WithinRel(0.5 + 0.46 * level, 1e-9));
    const double nothing = curve == Curve::weibull ? 1e-9 : -100.0;
    CHECK_THAT(function.share(nothing), WithinAbs(0.5, 1e-9));
    CHECK_THAT(function.share(100.0), WithinAbs(0.96, 1e-9));
    const double step = 1e-6;
    const double rise = (function.share(0.5 + step) - function.share(0.5 - step)) / (2.0 * step);
    CHECK_THAT(function.slope(), WithinRel(rise / 0.46, 1e-4));
}

TEST_CASE("a great many answers give the function back", "[psychometric]") {
    const Curve curve = GENERATE(Curve::logistic, Curve::cumulative_gaussian, Curve::weibull);
    const PsychometricFunction person = person_of(curve, 0.5);
    LevelCounts counts = constant_levels(1'000'000);
    for (LevelCount& level : counts) {
        level.count.hits = static_cast<int>(std::lround(1e6 * person.share(level.x)));
    }
    const PsychometricFunction found = most_likely(counts, {curve, 0.5, 0.5});
    CHECK_THAT(found.threshold, WithinRel(person.threshold, 1e-3));
    CHECK_THAT(found.scale, WithinRel(person.scale, 1e-2));
    CHECK_THAT(found.lapse, WithinAbs(person.lapse, 1e-3));
}

TEST_CASE("a participant who guesses has a threshold without bounds", "[psychometric]") {
    int bounded = 0;
    for (std::uint64_t study = 0; study < 40; ++study) {
        Random random(study);
        LevelCounts counts = constant_levels(20);
        for (LevelCount& level : counts) level.count.hits = random.binomial(20, 0.5);
        const FitSettings settings{Curve::logistic, 0.5, 0.5, 0.06, 99};
        const Interval interval = fitted(counts, settings, same_levels(counts), study).threshold;
        bounded += std::isfinite(interval.low) && std::isfinite(interval.high) ? 1 : 0;
    }
    CHECK(bounded <= 6);
}

TEST_CASE("a curve that does not fit is told from one that does", "[psychometric]") {
    LevelCounts counts = constant_levels(100);
    const std::vector<int> hits{50, 95, 50, 95, 50, 95, 50};
    for (std::size_t k = 0; k < hits.size(); ++k) counts[k].count.hits = hits[k];
    const FitSettings settings{Curve::logistic, 0.5, 0.5, 0.06, 99};
    CHECK(fitted(counts, settings, same_levels(counts), 1).fit_p < 0.05);
}

TEST_CASE("a staircase goes down after n right answers and up after a wrong one", "[staircase]") {
    StaircaseRule rule;
    rule.down_after = 2;
    Staircase staircase(rule);
    std::vector<double> levels;
    for (const bool right : {true, true, true, true, false, true, true, false}) {
        levels.push_back(staircase.level());
        staircase.answer(right);
    }
    const std::vector<double> expected{1.0, 1.0, 0.9, 0.9, 0.8, 0.9, 0.9, 0.8};
    for (std::size_t k = 0; k < levels.size(); ++k)
        CHECK_THAT(levels[k], WithinAbs(expected[k], 1e-9));
    CHECK(staircase.reversals() == 3);
    CHECK_THAT(reversal_mean(staircase.trials(), 2), WithinAbs(0.85, 1e-9));
}

TEST_CASE("a staircase that goes down and up again has answers at one level, not at two",
          "[staircase]") {
    Staircase staircase({.start = 0.4,
                         .low = 0.01,
                         .high = 0.6,
                         .step_down = 0.5,
                         .step_up = 0.5,
                         .factors = true});
    LevelCounts counts;
    for (int k = 0; k < 60; ++k) {
        const bool right = k % 6 < 4;  // down twice, up twice
        add_answer(counts, staircase.level(), right);
        staircase.answer(right);
    }
    for (const LevelCount& one : counts)
        for (const LevelCount& other : counts)
            CHECK((&one == &other || std::abs(one.x - other.x) > 0.01 * one.x));
}

TEST_CASE("until the first reversals a staircase takes longer steps", "[staircase]") {
    Staircase staircase({.down_after = 1, .first_reversals = 2, .first_steps = 3.0});
    std::vector<double> levels;
    for (const bool right : {true, true, false, true, true, false}) {
        staircase.answer(right);
        levels.push_back(staircase.level());
    }
    // The step at which it turns for the second time is an ordinary one.
    const std::vector<double> expected{0.7, 0.4, 0.7, 0.6, 0.5, 0.6};
    for (std::size_t k = 0; k < levels.size(); ++k)
        CHECK_THAT(levels[k], WithinAbs(expected[k], 1e-9));
}

TEST_CASE("a staircase keeps within its bounds and ends as it is told", "[staircase]") {
    StaircaseRule rule;
    rule.down_after = 1;
    rule.low = 0.2;
    rule.most_trials = 30;
    rule.factors = true;
    Staircase downwards(rule);
    while (!downwards.finished()) downwards.answer(true);
    CHECK(downwards.level() == 0.2);
    CHECK(downwards.trials().size() == 30);
    rule.stop_reversals = 4;
    Staircase turning(rule);
    for (int i = 0; !turning.finished(); ++i) turning.answer(i % 2 == 0);
    CHECK(turning.reversals() == 4);
}

TEST_CASE("a staircase stays around the level where its steps are in balance", "[staircase]") {
    const int down_after = GENERATE(1, 2, 3);
    const double step_up = GENERATE(0.02, 0.06);
    StaircaseRule rule;
    rule.down_after = down_after;
    rule.step_down = 0.02;
    rule.step_up = step_up;
    rule.most_trials = 40'000;
    rule.high = 2.0;
    const PsychometricFunction person{Curve::logistic, 0.5, 0.1, 0.5, 0.0, 0.0};
    Random random(9);
    int right = 0;
    for (const LevelCount& level : same_staircases(rule)(person, random)) right += level.count.hits;
    // Answers spread over a curve that bends: near, not at, what the rule says.
    CHECK_THAT(right / 40'000.0, WithinAbs(convergence_share(rule), 0.035));
}
