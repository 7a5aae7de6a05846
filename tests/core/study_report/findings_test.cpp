// What a report finds of simulated people, whose answers follow known rules.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/sqlite/database.hpp"
#include "tests/core/study_report/made_study.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/some_of.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;
using Catch::Matchers::WithinAbs;

namespace {

constexpr int kFew = 20;  ///< studies

/// Of studies; a thousand of each kind, as the README tells, where DIBHR_ALL_STUDIES is set.
int many(int count, int all) {
    return std::getenv("DIBHR_ALL_STUDIES") != nullptr ? all : count;
}

/// Four standard errors of a share over so few studies.
double slack(double share, int studies) {
    return 4.0 * std::sqrt(share * (1.0 - share) / studies);
}

const std::string kVaried = R"(question = "Which?"
vary = "friction"
reference = 0.3
)";
const std::string kStaircase = R"([block.staircase]
start = 0.4
lowest = 0.01
highest = 0.6
factor = 1.25
down-after = 2
halve-after = 2
trials = 60
tracks = 4
)";

struct Found {
    double value{0.0};
    Interval interval{};
};

/// A form of trial with a known true value, and how to get that value from a report.
struct KnownForm {
    std::string name{};
    std::string block{};
    int conditions{1};
    SimulatedParticipant kind{};
    int people{1};
    double truth{0.0};
    double scale{1.0};  ///< which 5 % are taken of
    std::function<Found(const BlockFindings&)> found{};
    bool exact_interval{false};  ///< of counts: covers more than its confidence
};

SimulatedParticipant noticing(double threshold) {
    return {.guesses = false, .threshold = threshold, .slope = 20.0, .lapse = 0.02};
}

Found threshold_found(const BlockFindings& block) {
    const ParticipantThreshold& one = block.thresholds.at(0).fits.at(0);
    return {one.fit.function.threshold, one.fit.threshold};
}

std::vector<KnownForm> known_forms() {
    const std::string levels = "levels = [0.02, 0.06, 0.1, 0.14, 0.2, 0.3]\nrepetitions = 40\n";
    const SimulatedParticipant wary{
        .guesses = false, .threshold = 0.12, .slope = 20.0, .lapse = 0.02, .false_alarm = 0.0};
    return {
        {"two intervals, levels", "form = \"two-interval\"\n" + kVaried + levels, 1, noticing(0.12),
         1, 0.12, 0.12, threshold_found},
        {"two intervals, staircases", "form = \"two-interval\"\n" + kVaried + kStaircase, 1,
         noticing(0.12), 1, 0.12, 0.12, threshold_found},
        {"three intervals, levels", "form = \"three-interval\"\n" + kVaried + levels, 1,
         noticing(0.12), 1, 0.12, 0.12, threshold_found},
        {"three intervals, staircases", "form = \"three-interval\"\n" + kVaried + kStaircase, 1,
         noticing(0.12), 1, 0.12, 0.12, threshold_found},
        {"yes or no, levels",
         "form = \"explore\"\n" + kVaried +
             "levels = [0, 0.06, 0.1, 0.14, 0.2, 0.3]\nrepetitions = 40\n",
         1, wary, 1, 0.12, 0.12, threshold_found},
        {"adjustment, one person",
         "form = \"adjust\"\n" + kVaried +
             "repetitions = 12\n[block.adjust]\nlowest = 0\nhighest = 0.6\n",
         1,
         {.guesses = false, .bias = 0.05, .noise = 0.04},
         1,
         0.05,
         0.3,
         [](const BlockFindings& block) {
             return Found{block.values.at(0).mean.value, block.values.at(0).mean.interval};
         }},
        {"adjustment, people who differ",
         "form = \"adjust\"\n" + kVaried +
             "repetitions = 4\n[block.adjust]\nlowest = 0\nhighest = 0.6\n",
         1,
         {.guesses = false, .bias = 0.02, .noise = 0.04, .spread = 0.03},
         10,
         0.02,
         0.3,
         [](const BlockFindings& block) {
             return Found{block.values.at(0).mean.value, block.values.at(0).mean.interval};
         }},
        {"rating, people who differ",
         "form = \"rating\"\nquestion = \"How smooth?\"\nrepetitions = 4\n[block.scale]\n"
         "lowest = 0\nhighest = 100\n",
         2,
         {.guesses = false, .prefers = "a", .difference = 12.0, .noise = 10.0, .spread = 6.0},
         12,
         12.0,
         100.0,
         [](const BlockFindings& block) {
             return Found{block.pairs.at(0).difference.value,
                          block.pairs.at(0).difference.interval};
         }},
        {"which of two",
         "form = \"two-interval\"\nquestion = \"Which?\"\npairs = \"all\"\n"
         "repetitions = 60\n",
         2,
         {.guesses = false, .prefers = "a", .share = 0.7},
         1,
         0.7,
         0.7,
         [](const BlockFindings& block) {
             return Found{block.shares.at(0).all.share(), block.shares.at(0).interval};
         },
         true},
        {"which of two, people who differ",
         "form = \"two-interval\"\nquestion = \"Which?\"\npairs = \"all\"\nrepetitions = 20\n",
         2,
         {.guesses = false, .prefers = "a", .share = 0.65, .spread = 0.08},
         12,
         0.65,
         0.65,
         [](const BlockFindings& block) {
             return Found{block.shares.at(0).participants_mean.value,
                          block.shares.at(0).participants_mean.interval};
         }},
    };
}

/// People who feel nothing, and the p of what the report tests.
struct Guessing {
    std::string name{};
    std::string block{};
    int conditions{1};
    int people{1};
    std::function<double(const BlockFindings&)> p{};
};

double p_of_share(const BlockFindings& block) {
    return block.shares.at(0).test->p;
}

std::vector<Guessing> guessing() {
    const std::string two = "form = \"two-interval\"\nquestion = \"Which?\"\npairs = \"all\"\n";
    return {
        {"which of two, one person", two + "repetitions = 60\n", 2, 1, p_of_share},
        {"which of two, twelve people", two + "repetitions = 12\n", 2, 12, p_of_share},
        {"which of two, three pairs of conditions", two + "repetitions = 12\n", 3, 12,
         [](const BlockFindings& block) {
             double least = 1.0;
             for (const ShareFinding& share : block.shares)
                 least = std::min(least, share.adjusted_p);
             return least;
         }},
        {"which of three, one person",
         "form = \"three-interval\"\nquestion = \"Which?\"\npairs = \"all\"\nrepetitions = 60\n", 2,
         1, p_of_share},
        {"adjustment, ten people",
         "form = \"adjust\"\n" + kVaried +
             "repetitions = 4\n[block.adjust]\nlowest = 0\nhighest = 0.6\n",
         1, 10, [](const BlockFindings& block) { return block.values.at(0).test->p; }},
        {"ratings of two, twelve people",
         "form = \"rating\"\nquestion = \"How smooth?\"\nrepetitions = 3\n", 2, 12,
         [](const BlockFindings& block) { return block.pairs.at(0).test.p; }},
        {"ratings of four, twelve people",
         "form = \"rating\"\nquestion = \"How smooth?\"\nrepetitions = 2\n", 4, 12,
         [](const BlockFindings& block) { return block.overall->p; }},
        {"yes or no of two, twelve people",
         "form = \"explore\"\nquestion = \"Is it smooth?\"\nrepetitions = 6\n", 2, 12,
         [](const BlockFindings& block) { return block.pairs.at(0).test.p; }},
    };
}

std::string page(int conditions, const std::string& block) {
    return page_of_conditions(conditions, "[[block]]\n" + block);
}

BlockFindings findings_in(const Study& study, int bootstraps = 399) {
    return findings_of(study, {.bootstraps = bootstraps}).at(0);
}

void require_found(int all) {
    const KnownForm form = GENERATE(some_of(known_forms(), 4));
    double bias = 0.0;
    double coverage = 0.0;
    for (int study = 0; study < all; ++study) {
        const Study made = made_study(page(form.conditions, form.block), form.kind, form.people,
                                      static_cast<std::uint64_t>(study));
        const Found found = form.found(findings_in(made, all >= 1000 ? 399 : 99));
        bias += (found.value - form.truth) / form.scale / all;
        coverage += found.interval.holds(form.truth) ? 1.0 / all : 0.0;
    }
    CAPTURE(form.name, all, bias, coverage);
    CHECK_THAT(bias, WithinAbs(0.0, 0.05));
    const double beside = std::max(0.02, slack(0.95, all));
    CHECK(coverage >= 0.95 - beside);
    CHECK(coverage <= (form.exact_interval ? 1.0 + 1e-9 : 0.95 + beside));
}

void require_no_effect(int all) {
    const Guessing form = GENERATE(some_of(guessing(), 4));
    double found = 0.0;
    for (int study = 0; study < all; ++study) {
        const Study made = made_study(page(form.conditions, form.block), {}, form.people,
                                      static_cast<std::uint64_t>(study));
        found += form.p(findings_in(made)) < kSignificance ? 1.0 / all : 0.0;
    }
    CAPTURE(form.name, all, found);
    CHECK(found <= 0.05 + std::max(0.015, slack(0.05, all)));
}

}  // namespace

TEST_CASE(
    "what is true of a participant is found without bias, and its interval covers it as often "
    "as it says",
    "[study report]") {
    require_found(kFew);
}

TEST_CASE("what is true of a participant is found by many studies", "[study report][long]") {
    require_found(many(100, 1000));
}

TEST_CASE("participants who guess give no effect but in one study of twenty", "[study report]") {
    require_no_effect(kFew);
}

TEST_CASE("participants who guess give no effect but in a twentieth of many studies",
          "[study report][long]") {
    require_no_effect(many(100, 1000));
}

TEST_CASE("shares are tested by all trials of a few people, and by the ranks of many",
          "[study report]") {
    const std::vector<Count> few{{9, 10}, {8, 10}};
    CHECK(chance_test(few, 0.5, false).test == "binomial, mid-p, of all trials");
    CHECK(chance_test(few, 0.5, false).p < 0.01);
    const std::vector<Count> many(8, Count{9, 10});
    const TestResult ranks = chance_test(many, 0.5, true);
    CHECK(ranks.test == "Wilcoxon signed-rank, exact");
    CHECK_THAT(ranks.p, WithinAbs(2.0 / 256.0, 1e-12));
    // One who differs wildly counts as one person, not as ninety trials.
    std::vector<Count> uneven(6, Count{5, 10});
    uneven.push_back({90, 90});
    CHECK(chance_test(uneven, 0.5, true).p > 0.5);
}

TEST_CASE("tests of one block are corrected together", "[study report]") {
    const Study made =
        made_study(page(3,
                        "form = \"two-interval\"\nquestion = \"Which?\"\npairs = \"all\"\n"
                        "repetitions = 10\n"),
                   {.guesses = false, .prefers = "a", .share = 0.75}, 8, 1);
    const BlockFindings block = findings_in(made);
    REQUIRE(block.shares.size() == 3);
    CHECK(block.shares[0].name == "a rather than b");
    CHECK(block.shares[0].all.share() > 0.6);
    CHECK(block.shares[2].name == "b rather than c");
    for (const ShareFinding& share : block.shares) CHECK(share.adjusted_p >= share.test->p);
}

TEST_CASE("practice counts for nothing", "[study report]") {
    const std::string two = "form = \"two-interval\"\nquestion = \"Which?\"\npairs = \"all\"\n";
    const Study made = made_study(
        page_of_conditions(2, "[[block]]\npractice = true\n" + two + "[[block]]\n" + two), {}, 3,
        1);
    const auto blocks = findings_of(made, {});
    REQUIRE(blocks.size() == 1);
    CHECK(blocks[0].block == 1);
    CHECK(blocks[0].trials == 3);
}

TEST_CASE("files of another protocol, of the same participant, or with made-up trials are refused",
          "[study report]") {
    const TemporaryFolder folder;
    const std::string two =
        "[[block]]\nform = \"two-interval\"\nquestion = \"?\"\npairs = \"all\"\n";
    const auto made = [&](const std::string& name, const std::string& label,
                          const std::string& text) {
        const Protocol page = protocol(text);
        StudyFile file(folder / name, {.participant = label,
                                       .number = 1,
                                       .protocol_name = "study.toml",
                                       .protocol_text = page.text,
                                       .protocol_sha256 = page.sha256});
        for (const AnsweredTrial& one : answers_of({}, page, 1)) file.add(one);
        return folder / name;
    };
    const auto refusal = [](const std::vector<std::filesystem::path>& files) {
        try {
            (void)read_studies(files);
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    const std::string text = page_of_conditions(2, two);
    const auto first = made("1", "P1", text);
    CHECK(refusal({first}).empty());
    CHECK(contains(refusal({first, made("2", "P1", text)}), "give one of the two"));
    CHECK(contains(refusal({first, made("3", "P3", text + "repetitions = 2\n")}),
                   "another protocol"));
    const auto text_file = folder / "notes.txt";
    write_text(text_file, "P1 was tired");
    CHECK(contains(refusal({first, text_file}), "is not a study file"));
    // Files of a protocol with other blocks: the error must be about the protocol.
    const auto other =
        made("5", "P5", page_of_conditions(2, "[[block]]\nform = \"rating\"\nquestion = \"?\"\n"));
    CHECK(contains(refusal({first, other}), "another protocol"));
    CHECK(contains(refusal({first, other}), other.string()));
    for (const char* const lie : {"block = 7", "item = 9", "item = -1", "choice = 5", "level = 0.5",
                                  "form = 'rating'", "practice = 1", "number = 3, choice = -1"}) {
        CAPTURE(lie);
        const auto damaged = made("4", "P4", text);
        Database(damaged).execute("UPDATE trial SET " + std::string(lie));
        CHECK_FALSE(refusal({damaged}).empty());
        std::filesystem::remove(damaged);
    }
}

TEST_CASE("a wary participant's d' tells what is felt from what is said", "[study report]") {
    const auto d_prime = [](double false_alarm) {
        const Study made = made_study(
            page(1, "form = \"explore\"\n" + kVaried + "levels = [0, 0.3]\nrepetitions = 200\n"),
            {.guesses = false, .threshold = 0.1, .slope = 40.0, .false_alarm = false_alarm}, 1, 3);
        return findings_in(made, 19).shares.at(1).d_prime->d_prime;
    };
    CHECK(d_prime(0.0) > 4.0);  // never answers yes at level 0
    CHECK(d_prime(0.5) < d_prime(0.0) - 1.0);
}

TEST_CASE("a threshold that nobody has is not made up", "[study report]") {
    const Study made = made_study(page(1, "form = \"two-interval\"\n" + kVaried +
                                              "levels = [0.05, 0.1, 0.2, 0.3]\nrepetitions = 10\n"),
                                  {}, 4, 2);
    const BlockFindings block = findings_in(made, 99);
    REQUIRE(block.thresholds.size() == 1);
    CHECK(block.thresholds[0].unbounded >= 3);
    CHECK(std::isnan(block.thresholds[0].participants_mean.value));
}

namespace {

void require_all_in_the_median(int all) {
    // At the lowest level: people without a bound are those with better answers.
    const std::string levels = "form = \"two-interval\"\n" + kVaried +
                               "levels = [-0.2, -0.1, 0.1, 0.2]\nrepetitions = 20\n";
    std::vector<double> medians;
    double covered = 0.0;
    int unbounded = 0;
    for (int study = 0; study < all; ++study) {
        const Study made = made_study(
            page(1, levels), {.guesses = false, .threshold = 0.1, .slope = 15.0, .lapse = 0.05}, 12,
            static_cast<std::uint64_t>(study));
        const ThresholdFinding found = findings_in(made, 99).thresholds.at(0);
        unbounded += found.unbounded;
        CHECK(std::isfinite(found.participants_mean.value) == (found.unbounded == 0));
        CHECK(found.below + found.above <= found.unbounded);
        CHECK(found.median.count == 12);
        CHECK(found.lowest == 0.1);
        CHECK(found.highest == 0.2);
        medians.push_back(found.median.value);
        covered += found.median.interval.holds(0.1) ? 1.0 / all : 0.0;
    }
    CHECK(unbounded > all);
    CHECK_THAT(median_of(medians).value, WithinAbs(0.1, 0.01));
    CHECK(covered >= 0.95 - slack(0.95, all));
}

}  // namespace

TEST_CASE("of people of whom some set the threshold no bound all are in the median",
          "[study report]") {
    require_all_in_the_median(5);
}

TEST_CASE("of people of whom some set the threshold no bound all are in many studies' medians",
          "[study report][long]") {
    require_all_in_the_median(many(20, 400));
}

TEST_CASE("a median that lies beside all levels is told as beside them", "[study report]") {
    const auto finding = [](double threshold) {
        const Study made =
            made_study(page(1, "form = \"two-interval\"\n" + kVaried +
                                   "levels = [0.1, 0.15, 0.2]\nrepetitions = 30\n"),
                       {.guesses = false, .threshold = threshold, .slope = 40.0}, 8, 4);
        return findings_in(made, 99).thresholds.at(0);
    };
    const ThresholdFinding high = finding(5.0);
    CHECK(high.above >= 6);
    CHECK(high.median.value > 1e300);
    const ThresholdFinding low = finding(0.001);
    CHECK(low.below >= 6);
    CHECK(low.median.value < -1e300);
}

TEST_CASE("tests of one block are of one kind, and who answered less is named", "[study report]") {
    Study made = made_study(page(3,
                                 "form = \"two-interval\"\nquestion = \"Which?\"\npairs = \"all\"\n"
                                 "repetitions = 4\n"),
                            {.guesses = false, .prefers = "a", .share = 0.8}, 7, 1);
    // Two stop before they have met one of the pairs.
    for (std::size_t who = 0; who < 2; ++who)
        std::erase_if(made.participants[who].answered,
                      [](const AnsweredTrial& one) { return one.trial.item == 2; });
    const BlockFindings block = findings_in(made);
    CHECK(with_trials(block.shares[0].by_participant) == 7);
    CHECK(with_trials(block.shares[2].by_participant) == 5);
    for (const ShareFinding& share : block.shares)
        CHECK(share.test->test == "binomial, mid-p, of all trials");
    REQUIRE(block.remarks.size() == 1);
    CHECK(contains(block.remarks[0], "the most 12; P1 8, P2 8"));
}

TEST_CASE("intervals of shares lie in their range, and of equal shares are not of no width",
          "[study report]") {
    const auto findings = [](double share, int repetitions) {
        return findings_in(
            made_study(page(2,
                            "form = \"two-interval\"\nquestion = \"Which?\"\npairs = \"all\"\n"
                            "repetitions = " +
                                std::to_string(repetitions) + "\n"),
                       {.guesses = false, .prefers = "a", .share = share}, 7, 3));
    };
    const ShareFinding some = findings(0.95, 4).shares.at(0);
    CHECK(some.participants_mean.value < 1.0);
    CHECK(some.participants_mean.interval.high <= 1.0);
    const ShareFinding always = findings(1.0, 4).shares.at(0);
    CHECK(always.participants_mean.value == 1.0);
    CHECK(always.participants_mean.interval.low == exact_interval({28, 28}).low);
}

TEST_CASE("adjustments that are all the same are not tested", "[study report]") {
    const std::string adjust = "form = \"adjust\"\n" + kVaried +
                               "repetitions = 3\n[block.adjust]\nlowest = 0\nhighest = 0.6\n";
    const auto value = [&](double noise, int people) {
        return findings_in(made_study(page(1, adjust),
                                      {.guesses = false, .bias = 0.1, .noise = noise}, people, 1))
            .values.at(0);
    };
    CHECK_FALSE(value(0.0, 1).test.has_value());
    CHECK_FALSE(value(0.0, 4).test.has_value());
    CHECK(std::isinf(value(0.0, 4).mean.interval.high));
    CHECK(value(0.02, 1).test->test == "one-sample t");
}

TEST_CASE("trials that are in no threshold are counted and named", "[study report]") {
    const auto study = [](const std::string& form, const std::string& levels) {
        return made_study(page(1, "form = \"" + form + "\"\n" + kVaried + "levels = " + levels +
                                      "\nrepetitions = 10\n"),
                          noticing(0.1), 1, 1);
    };
    // Pages may no longer contain it, but older study files do.
    const std::string form = GENERATE("two-interval", "three-interval");
    Study of_nothing = study(form, "[0.05, 0.1, 0.2]");
    of_nothing.protocol.blocks[0].variation.levels[0] = 0.0;
    for (AnsweredTrial& one : of_nothing.participants[0].answered)
        if (one.trial.level == 0.05) {
            one.trial.level = 0.0;
            one.right = std::nullopt;
        }
    const BlockFindings two = findings_in(of_nothing, 19);
    CHECK(two.trials == 30);
    CHECK(two.not_counted == 10);
    CHECK(two.shares.size() == 2);
    CHECK(contains(two.remarks.at(0), "10 of the 30 trials had no difference"));
    CHECK(findings_in(study(form, "[-0.1, 0.1, 0.2]"), 19).remarks.empty());

    const BlockFindings yes_no = findings_in(study("explore", "[-0.1, 0, 0.1, 0.2]"), 19);
    CHECK(yes_no.not_counted == 0);
    CHECK(yes_no.shares.size() == 4);
    CHECK(yes_no.thresholds.at(0).fits.at(0).fit.trials == 20);
    CHECK(contains(yes_no.remarks.at(0), "10 of the 40 trials had less of it"));
    CHECK(contains(findings_in(study("explore", "[0.1, 0.2]"), 19).remarks.at(0),
                   "the guess rate is taken as 0"));
}

TEST_CASE("yes for less than the reference is no false alarm", "[study report]") {
    Study made = made_study(page(1, "form = \"explore\"\n" + kVaried +
                                        "levels = [-0.1, 0, 0.1, 0.3]\nrepetitions = 20\n"),
                            noticing(0.1), 1, 1);
    for (AnsweredTrial& one : made.participants[0].answered)
        if (*one.trial.level <= 0.0) one.answer.choice = *one.trial.level < 0.0 ? 0 : 1;
    CHECK(findings_in(made, 19).thresholds.at(0).fits.at(0).fit.function.guess == 0.0);
}
