// How many people a study needs.
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/psychophysics/proportions.hpp"
#include "core/study_report/study_plan.hpp"
#include "tests/core/study_report/made_study.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;
using Catch::Matchers::WithinAbs;

namespace {

const std::string kPairs =
    "[[block]]\nform = \"two-interval\"\nquestion = \"Which?\"\npairs = \"all\"\n";

const PlanLine& on_the_page(const std::vector<PlanLine>& lines) {
    for (const PlanLine& line : lines)
        if (line.as_in_protocol) return line;
    throw std::runtime_error("no line is as on the page");
}

/// How often the binomial test of so many trials finds such a share.
double binomial_power(int trials, double share) {
    double power = 0.0;
    for (int hits = 0; hits <= trials; ++hits) {
        if (binomial_test({hits, trials}, 0.5).mid_p >= kSignificance) continue;
        power += std::exp(std::lgamma(trials + 1.0) - std::lgamma(hits + 1.0) -
                          std::lgamma(trials - hits + 1.0) + hits * std::log(share) +
                          (trials - hits) * std::log1p(-share));
    }
    return power;
}

}  // namespace

TEST_CASE("the power of one participant is that of the binomial test", "[study plan]") {
    const Protocol page = protocol(page_of_conditions(2, kPairs + "repetitions = 40\n"));
    PlanSettings settings{.effect = {.guesses = false, .prefers = "a", .share = 0.7},
                          .studies = 200,
                          .most_participants = 1};
    const PlanLine line = on_the_page(plan_of(page, settings));
    CHECK(line.finding == "a rather than b");
    CHECK(line.trials == 40);
    const double expected = binomial_power(40, 0.7);
    CHECK_THAT(line.studies.at(0).power,
               WithinAbs(expected, 4.0 * std::sqrt(0.25 / settings.studies)));
}

TEST_CASE("a smaller effect, and people who differ more, need more participants", "[study plan]") {
    const Protocol page = protocol(page_of_conditions(2, kPairs + "repetitions = 8\n"));
    const auto enough = [&](double share, double spread) {
        PlanSettings settings{
            .effect = {.guesses = false, .prefers = "a", .share = share, .spread = spread},
            .studies = 50};
        return on_the_page(plan_of(page, settings)).needed_participants;
    };
    const int large = enough(0.85, 0.0);
    const int small = enough(0.65, 0.0);
    const int uneven = enough(0.65, 0.25);
    CAPTURE(large, small, uneven);
    CHECK(large > 0);
    CHECK(large < small);
    CHECK((uneven == 0 || uneven > small));
}

TEST_CASE("more trials make a threshold more precise", "[study plan]") {
    const Protocol page = protocol(page_of_conditions(
        1,
        "[[block]]\nform = \"two-interval\"\nquestion = \"Which?\"\nvary = \"friction\"\n"
        "reference = 0.3\nlevels = [0.02, 0.06, 0.1, 0.14, 0.2, 0.3]\nrepetitions = 10\n"));
    PlanSettings settings{.effect = {.guesses = false, .threshold = 0.12, .slope = 20.0},
                          .studies = 80,
                          .most_participants = 1};
    std::vector<double> precision;
    for (const PlanLine& line : plan_of(page, settings))
        if (line.finding.starts_with("threshold"))
            precision.push_back(line.studies.at(0).precision);
    REQUIRE(precision.size() == 3);
    CHECK(precision[0] > precision[1]);
    CHECK(precision[1] > precision[2]);
}

TEST_CASE("the precision of a threshold is how far 95 % of all studies' estimates lie from it",
          "[study plan]") {
    const auto line = [](const std::string& levels, double threshold) {
        const Protocol page = protocol(page_of_conditions(
            1,
            "[[block]]\nform = \"two-interval\"\nquestion = \"Which?\"\nvary = \"friction\"\n"
            "reference = 0.3\n" +
                levels));
        const PlanSettings settings{
            .effect = {.guesses = false, .threshold = threshold, .slope = 20.0},
            .studies = 20,
            .most_participants = 8};
        for (const PlanLine& one : plan_of(page, settings))
            if (one.finding.starts_with("threshold") && one.as_in_protocol)
                return std::pair(one, plan_text({one}, settings));
        throw std::runtime_error("no line of a threshold");
    };
    const std::string good = "levels = [0.02, 0.06, 0.1, 0.14, 0.2, 0.3]\nrepetitions = 40\n";
    const auto [found, found_text] = line(good, 0.12);
    CHECK(found.needed_participants > 0);
    CHECK(found.studies.back().precision < 0.1);
    // Who only guesses goes to the top of a staircase, all alike and far from the truth.
    const auto [never, never_text] = line(
        "[block.staircase]\nstart = 0.4\nlowest = 0.01\nhighest = 1\nfactor = 1.2\n"
        "down-after = 3\ntrials = 20\n",
        50.0);
    CHECK(never.needed_participants == 0);
    for (const PlannedStudies& one : never.studies) CHECK(one.precision > 0.9);
    CHECK(std::isinf(never.studies.back().precision));
    CHECK(never.studies.back().unbounded > 0.5);
    CHECK(contains(never_text, "does not find it"));
    CHECK_FALSE(contains(found_text, "does not find it"));
}

TEST_CASE("an effect that changes nothing is told", "[study plan]") {
    const Protocol page = protocol(page_of_conditions(2, kPairs));
    CHECK_THROWS_AS(plan_of(page, {}), InputError);
    PlanSettings settings{.effect = {.guesses = false, .threshold = 0.1}};
    settings.studies = 20;
    CHECK_THROWS_AS(plan_of(page, settings), InputError);
}
