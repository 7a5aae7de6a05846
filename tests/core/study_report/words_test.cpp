// What a report says of a study in sentences.
#include <string>
#include <utility>
#include <vector>

#include "core/report/report_sentences.hpp"
#include "core/study_report/study_sentences.hpp"
#include "tests/core/study_report/made_study.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;

namespace {

const std::string kTwo = "form = \"two-interval\"\nquestion = \"Which?\"\n";
const std::string kLevels =
    kTwo + "vary = \"friction\"\nreference = 0.3\nlevels = [0.05, 0.1, 0.2]\n";

StudyReport report_of(Study study) {
    StudyReport report{.study = std::move(study), .analysis = {.bootstraps = 99}};
    report.blocks = findings_of(report.study, report.analysis);
    return report;
}

StudyReport report_of(const std::string& block, int conditions, const SimulatedParticipant& kind,
                      int people) {
    return report_of(
        made_study(page_of_conditions(conditions, "[[block]]\n" + block), kind, people, 2));
}

/// All conclusions on one block.
std::string said_of(const StudyReport& report) {
    std::string all;
    for (const std::string& sentence : conclusions_of(report, report.blocks.at(0)))
        all += sentence + '\n';
    return all;
}

}  // namespace

TEST_CASE("what chance would agree with is told with both ends, of people as their mean has it",
          "[study words]") {
    const StudyReport report = report_of(kTwo + "pairs = \"all\"\nrepetitions = 9\n", 2, {}, 8);
    const ShareFinding& share = report.blocks.at(0).shares.at(0);
    REQUIRE(share.adjusted_p >= kSignificance);
    CHECK(contains(said_of(report),
                   "any share from " + percent_text(share.participants_mean.interval.low) + " to " +
                       percent_text(share.participants_mean.interval.high) + " would agree"));
}

TEST_CASE("what a test of few people cannot show is not said to agree with chance",
          "[study words]") {
    const std::string said = said_of(report_of(kTwo + "pairs = \"all\"\nrepetitions = 9\n", 3,
                                               {.guesses = false, .prefers = "a"}, 6));
    CHECK(contains(said, "a rather than b: 100 % of 54 answers"));
    CHECK(contains(said, "although chance lies outside the interval of 93 % to 100 %"));
}

TEST_CASE("of people who guess no threshold is told but where it is not", "[study words]") {
    const std::string said = said_of(
        report_of(kLevels + "repetitions = 15\n", 1, {.guesses = false, .threshold = 9.0}, 7));
    CHECK(contains(said, ": not found. The median over 7 participants lies above 0.2."));
    CHECK(contains(said, "Above the levels that were tested (0.05 to 0.2), or guessing: "));
    CHECK_FALSE(contains(said, ", mean "));
    CHECK_FALSE(contains(said, "mean over 0"));
    CHECK_FALSE(contains(said, "not bounded to not bounded"));
}

TEST_CASE("an interval of few trials has its warning beside it", "[study words]") {
    const SimulatedParticipant kind{.guesses = false, .threshold = 0.1, .slope = 30.0};
    const std::string few = said_of(report_of(kLevels + "repetitions = 5\n", 1, kind, 1));
    CHECK(contains(few, "An interval of 15 trials covers the threshold less often"));
    CHECK(contains(few, "60 at the least"));
    const std::string many = said_of(report_of(kLevels + "repetitions = 20\n", 1, kind, 1));
    CHECK_FALSE(contains(many, "less often"));
}

TEST_CASE("answers are compared as shares of the first one", "[study words]") {
    const std::string said = said_of(
        report_of("form = \"explore\"\nquestion = \"What?\"\nanswers = [\"rough\", \"smooth\", "
                  "\"neither\"]\nrepetitions = 4\n",
                  2, {.guesses = false, .prefers = "a"}, 8));
    CHECK(contains(said, "a against b: mean difference of the share of 'rough' "));
}

TEST_CASE("the summary counts who answered, and warns of who is simulated first", "[study words]") {
    Study study = made_study(
        page_of_conditions(2, "[[block]]\n" + kTwo + "pairs = \"all\"\nrepetitions = 5\n"), {}, 4,
        1);
    study.participants[3].answered.clear();
    CHECK(summary_of(report_of(study)) ==
          "3 participants gave 15 answers. No answer that counts is of P4.");
    study.participants[1].identity.pilot = "guess";
    CHECK(summary_of(report_of(study)).starts_with("Warning: P2 is simulated"));
    for (StudyRecord& record : study.participants) record.identity.pilot = "guess";
    CHECK(summary_of(report_of(study)).starts_with("Simulated: no person has answered"));
}

TEST_CASE("whoever had only the mouse is named among the limits, and felt no force",
          "[study words]") {
    StudyReport report = report_of(kTwo + "pairs = \"all\"\nrepetitions = 5\n", 2, {}, 2);
    report.hands = {{{{"Novint Falcon (12)", {.all = 9}}}},
                    {{{"mouse", {.all = 9, .mouse_fallback = 9}}}}};
    std::string said;
    for (const std::string& limit : limits_of(report)) said += limit + '\n';
    CHECK(contains(said, "With the mouse, and so without feeling any force: P2."));
    CHECK(contains(said, "for these devices (Novint Falcon (12), mouse), these videos"));
    CHECK_FALSE(report.forces_were_felt());
    report.hands.pop_back();
    CHECK(report.forces_were_felt());
}
