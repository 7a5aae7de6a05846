// The steps of a study.
#include <cmath>
#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/study/simulated_participant.hpp"
#include "tests/core/study/pages.hpp"
#include "tests/support/catch.hpp"

namespace {

using namespace dibhr;

const std::string kAllForms =
    "[[block]]\nform = \"explore\"\nquestion = \"Q\"\nanswers = [\"yes\", \"no\", \"maybe\"]\n"
    "practice = true\n"
    "[[block]]\nform = \"two-interval\"\nquestion = \"Q\"\nconditions = [\"a\"]\n"
    "vary = \"friction\"\nreference = 0.2\nlevels = [0.1, 0.3]\nrepetitions = 2\nfeedback = true\n"
    "again = true\nbreak-after = 2\ninstructions = \"I\"\n"
    "[[block]]\nform = \"three-interval\"\nquestion = \"Q\"\npairs = \"all\"\nrepetitions = 2\n"
    "[[block]]\nform = \"adjust\"\nquestion = \"Q\"\nvary = \"friction\"\nreference = 0.3\n"
    "conditions = [\"b\"]\n[block.adjust]\nlowest = 0.1\nhighest = 0.6\n"
    "[[block]]\nform = \"rating\"\nquestion = \"Q\"\nanswer-s = 5\n"
    "[[block]]\nform = \"explore\"\nquestion = \"Q\"\nconditions = [\"a\"]\nvary = \"friction\"\n"
    "[block.staircase]\nstart = 0.5\nhighest = 1\nstep = 0.1\ntrials = 6\n";

Protocol all_forms() {
    return test::protocol("instructions = \"W\"\nthanks = \"E\"\n" +
                          test::page_of_conditions(2, kAllForms));
}

/// The steps of a whole study, and its answers.
std::vector<StudyStep> walk(StudyRun& run, const SimulatedParticipant& who,
                            std::size_t most_trials = 10000) {
    std::vector<StudyStep> steps;
    while (run.step() != StudyStep::finished && run.answered().size() < most_trials) {
        steps.push_back(run.step());
        if (run.step() == StudyStep::question || run.step() == StudyStep::adjust)
            run.accept(run.judged(answer_of(who, run), 0.0));
        else
            run.go_on();
    }
    return steps;
}

}  // namespace

TEST_CASE("a study goes from its page through blocks and trials to its end", "[study]") {
    StudyRun run(all_forms(), 1);
    const auto steps = walk(run, {.guesses = false, .threshold = 1e-6, .slope = 1e6});
    using enum StudyStep;
    const std::vector<StudyStep> begin{instructions, interval,           question, interval,
                                       question,     block_instructions, interval, interval,
                                       question,     feedback,           interval, interval,
                                       question,     feedback,           pause,    interval};
    REQUIRE(steps.size() > begin.size());
    CHECK(std::vector<StudyStep>(steps.begin(), steps.begin() + 16) == begin);
    CHECK(steps.back() == thanks);
    CHECK(run.answered().size() == 2 + 4 + 2 + 1 + 2 + 6);
    CHECK(run.share_done() == 1.0);
}

TEST_CASE("a study that was left goes on with the very trial it would have come to", "[study]") {
    const SimulatedParticipant who{.guesses = false, .threshold = 0.2, .slope = 8.0, .noise = 0.05};
    StudyRun whole(all_forms(), 3);
    walk(whole, who);
    const std::size_t left_at = GENERATE(0U, 1U, 2U, 4U, 7U, 8U, 9U, 12U, 16U, 17U);
    StudyRun begun(all_forms(), 3);
    walk(begun, who, left_at);
    StudyRun resumed(all_forms(), 3, begun.answered());
    walk(resumed, who);
    CHECK(resumed.answered() == whole.answered());
}

TEST_CASE("answers of another study or participant are not gone on from", "[study]") {
    StudyRun run(all_forms(), 3);
    walk(run, {});
    CHECK_THROWS_AS(StudyRun(all_forms(), 4, run.answered()), InputError);
}

TEST_CASE("every question takes the answers there are, and none only where time runs", "[study]") {
    StudyRun run(all_forms(), 1);
    CHECK_FALSE(run.accepts({.choice = 0}));  // nothing is asked yet
    std::set<TrialForm> asked;
    while (run.step() != StudyStep::finished) {
        if (run.step() != StudyStep::question && run.step() != StudyStep::adjust) {
            run.go_on();
            continue;
        }
        const Block& block = run.block();
        CAPTURE(name_of(block.form));
        asked.insert(block.form);
        CHECK(run.accepts({}) == (block.answer_s > 0.0));
        const auto check_choices = [&run](int count) {
            for (int choice = 0; choice < count; ++choice) CHECK(run.accepts({.choice = choice}));
            CHECK_FALSE(run.accepts({.choice = count}));
            CHECK_FALSE(run.accepts({.number = 1.0}));
        };
        switch (block.form) {
            case TrialForm::explore:
                check_choices(static_cast<int>(block.question.answers.size()));
                break;
            case TrialForm::two_interval:
                check_choices(2);
                break;
            case TrialForm::three_interval:
                check_choices(3);
                break;
            case TrialForm::adjust:
                CHECK(run.accepts({.number = 0.6}));
                CHECK_FALSE(run.accepts({.number = 0.601}));
                CHECK_FALSE(run.accepts({.number = 0.099}));
                CHECK_FALSE(run.accepts({.choice = 0}));
                break;
            case TrialForm::rating:
                CHECK(run.accepts({.number = 7.0}));
                CHECK_FALSE(run.accepts({.number = 8.0}));
                CHECK_FALSE(run.accepts({.number = 2.5}));
                CHECK_FALSE(run.accepts({.choice = 0}));
        }
        run.accept(run.judged(answer_of({}, run), 0.0));
    }
    CHECK(asked.size() == kTrialForms.size());
}

TEST_CASE("an interval may be felt again where the page says so", "[study]") {
    StudyRun run(all_forms(), 1);
    while (run.block().form != TrialForm::two_interval || run.step() != StudyStep::question) {
        if (run.step() == StudyStep::question)
            run.accept(run.judged({.choice = 0}, 0.0));
        else
            run.go_on();
    }
    run.repeat_interval(0);
    CHECK(run.step() == StudyStep::interval);
    CHECK(run.interval() == 0);
    run.go_on();
    CHECK(run.step() == StudyStep::question);
}

TEST_CASE("a simulated participant answers as often right as the function says", "[study]") {
    const Protocol study = test::protocol(test::page_of_conditions(
        1,
        "[[block]]\nform = \"two-interval\"\nquestion = \"Q\"\nvary = \"friction\"\n"
        "levels = [0.05, 0.1, 0.4]\nrepetitions = 400\n"));
    const SimulatedParticipant who{
        .guesses = false, .threshold = 0.1, .slope = 10.0, .lapse = 0.04};
    StudyRun run(study, 1);
    walk(run, who);
    std::map<double, double> right;
    for (const AnsweredTrial& one : run.answered())
        right[*one.trial.level] += *one.right ? 1.0 / 400.0 : 0.0;
    for (const auto& [level, share] : right) {
        CAPTURE(level);
        CHECK_THAT(share, Catch::Matchers::WithinAbs(who.function(0.5).share(level), 0.07));
    }
}

TEST_CASE("who prefers a condition chooses it, who guesses does not", "[study]") {
    const Protocol study = test::protocol(test::page_of_conditions(
        2,
        "[[block]]\nform = \"two-interval\"\nquestion = \"Q\"\npairs = \"all\"\n"
        "repetitions = 100\n"));
    const auto chosen = [&](const SimulatedParticipant& who) {
        StudyRun run(study, 1);
        walk(run, who);
        int count = 0;
        for (const AnsweredTrial& one : run.answered()) count += chosen_condition(one) == "b";
        return count;
    };
    CHECK(chosen(simulated_participant("prefer=b")) == 100);
    CHECK(std::abs(chosen(simulated_participant("guess")) - 50) < 20);
    const auto guesses = [&](const char* who) {
        std::vector<int> choices;
        for (const AnsweredTrial& one : answers_of(simulated_participant(who), study, 1))
            choices.push_back(one.answer.choice);
        return choices;
    };
    CHECK(guesses("guess,seed=3") != guesses("guess"));
    CHECK_THROWS_AS(simulated_participant("lapes=0.1"), InputError);
    CHECK_THROWS_AS(simulated_participant("lapse=2"), InputError);
    CHECK_THROWS_AS(simulated_participant("guess,threshold=1"), InputError);
    CHECK_THROWS_AS(simulated_participant("prefer=b,guess"), InputError);
    CHECK_THROWS_AS(simulated_participant("lapse=0.1,lapse=0.1"), InputError);
    CHECK_THROWS_AS(simulated_participant("prefer=a,prefer=b"), InputError);
}
