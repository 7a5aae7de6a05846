// A modelled, a drawn and a recorded hand on the built-in sample feel the same in a study, in its
// report and in the experiment.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "app/commands/experiment_human.hpp"
#include "core/files/json.hpp"
#include "core/metrics/force_variation.hpp"
#include "core/session/session.hpp"
#include "core/study/study_file.hpp"
#include "tests/app/commands/study_page.hpp"
#include "tests/app/program/command_program.hpp"
#include "tests/app/program/recorded_session.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;
using Catch::Matchers::WithinRel;

namespace {

/// Read once.
const SampleClip& sample() {
    static const SampleClip clip = read_sample({}, {});
    return clip;
}

/// The forces of one interval of a trial's session.
struct Felt {
    std::vector<Vec3> goals{}, proxies{};
    std::vector<char> contact{};
};

std::map<std::uint64_t, Felt> felt_in(const std::filesystem::path& file) {
    const Session session(file);
    std::map<std::uint64_t, Felt> felt;
    Session::Ticks ticks(session);
    for (TickRecord tick; ticks.next(tick);) {
        Felt& one = felt[tick.settings & 0xffffffffU];
        one.goals.push_back(tick.goal);
        one.proxies.push_back(tick.proxy);
        one.contact.push_back(tick.contact ? 1 : 0);
    }
    return felt;
}

/// Of `path`, as both conditions of the study feel it.
void check_felt(const PathRun& path, const StudyRecord& record,
                const std::filesystem::path& session) {
    const auto felt = felt_in(session);
    REQUIRE(felt.size() == 2);
    for (std::size_t k = 0; k < 2; ++k) {
        const std::string& condition = record.answered.at(0).trial.intervals.at(k).condition;
        const AlgorithmRun& expected = path.runs.at(condition == "smooth-one" ? 0 : 1);
        const Felt& one = felt.at(k + 1);
        const auto variation =
            force_variation(one.goals, one.proxies, one.contact, path.reversal, 0);
        CHECK(variation.pairs == expected.variation.pairs);
        CHECK(variation.mean_deg == expected.variation.mean_deg);
        CHECK(variation.sd_deg == expected.variation.sd_deg);
    }
}

void check_reported(const PathRun& path, const Json& motion) {
    REQUIRE(motion.size() == 2);
    for (const Json& felt : motion) {
        const AlgorithmRun& run = path.runs.at(felt["condition"] == "smooth-one" ? 0 : 1);
        CHECK(felt["updates"] == path.goals.size());
        CHECK(felt["contact_updates"] == std::count(run.contact.begin(), run.contact.end(), 1));
        CHECK_THAT(felt["moves_per_update"].get<double>(), WithinRel(run.moves_per_update, 1e-9));
        const Json& variation = felt["variation_deg"];
        CHECK(variation["pairs"] == run.variation.pairs);
        CHECK_THAT(variation["mean"].get<double>(), WithinRel(run.variation.mean_deg, 1e-12));
        CHECK_THAT(variation["sd"].get<double>(), WithinRel(run.variation.sd_deg, 1e-9));
        CHECK(felt["force_sent_newton"]["mean"] > 0.1);
    }
}

}  // namespace

TEST_CASE("each trial is a session in which the modelled hand feels what the experiment feels",
          "[study]") {
    const TemporaryFolder folder;
    write_text(folder / "study.toml", "title = \"T\"\n" + kTwoConditions + R"([[block]]
form = "two-interval"
pairs = "all"
question = "Which was smoother?"
)");
    const ProgramResult result =
        run_dibhr(folder, {"study", "run", "study.toml", "--participant", "P1", "--pilot", "hand"});
    INFO(result.errors);
    REQUIRE(result.exit_code == 0);
    REQUIRE(run_dibhr(folder, {"study", "sessions", "P1.dibhr-study", "--out", "s"}).exit_code ==
            0);
    CHECK(names_in(folder / "s") == std::vector<std::string>{"P1-001.dibhr"});
    const ProgramResult told = run_dibhr(folder, {"info", "s/P1-001.dibhr"});
    CHECK_THAT(told.output, Catch::Matchers::Matches("[^]*participant +P1\n[^]*"));
    CHECK_THAT(told.output, Catch::Matchers::Matches("[^]*note +T, trial 1\n[^]*"));
    const ProgramResult replayed = run_dibhr(folder, {"replay", "s/P1-001.dibhr"});
    CHECK(contains(replayed.output, "are identical, bit for bit"));

    PathRun path = human_goals({}, sample(), 0.4);
    CHECK(contains(path.source, "modelled"));
    const std::vector<Algorithm> both{Algorithm::dibhr, Algorithm::pga};
    run_algorithms(path, sample().depth, both, Timing::quick);
    check_felt(path, read_study(folder / "P1.dibhr-study"), folder / "s/P1-001.dibhr");

    REQUIRE(run_dibhr(folder, {"study", "report", "P1.dibhr-study", "--out", "r"}).exit_code == 0);
    check_reported(path, parsed_json(read_text(folder / "r/report.json"))["motion"]);
    CHECK(split(read_text(folder / "r/intervals.csv"), '\n').size() >= 3);
}

TEST_CASE("experiment human says whose hand it is", "[experiment]") {
    const TemporaryFolder folder;
    write_text(folder / "pen.csv", "t_s,x_mm,y_mm\n0,10,10\n0.5,20,30\n1,40,10\n");
    write_moving_hand(folder / "hand.dibhr", 300);
    const HandInput trace = read_hand({.trace = folder / "pen.csv"});
    CHECK(contains(human_goals(trace, sample(), 0.4).source, "a person's trace, pen.csv"));
    const ProgramResult result = run_dibhr(
        folder,
        {"experiment", "human", "--session", "hand.dibhr", "--algorithm", "dibhr", "--raw-depth"});
    INFO(result.errors);
    REQUIRE(result.exit_code == 0);
    const std::string first = result.output.substr(0, result.output.find('\n'));
    CHECK(contains(first, "a recorded session, hand.dibhr"));
    CHECK(contains(first, "300 updates"));
}
