// `dibhr study` as a person runs it: checked, run with a simulated participant, killed and resumed.
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "core/study/study_file.hpp"
#include "tests/app/commands/study_page.hpp"
#include "tests/app/program/command_program.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/some_of.hpp"

using namespace dibhr;
using namespace dibhr::test;

namespace {

const std::string kPage = "title = \"T\"\n" + kTwoConditions + R"([[block]]
form = "two-interval"
pairs = "all"
question = "Which was smoother?"
)";

const std::string kLongPage = kPage + R"(repetitions = 200
[[block]]
form = "two-interval"
conditions = ["smooth-one"]
question = "Which held more?"
vary = "friction"
reference = 0.2
[block.staircase]
start = 0.4
highest = 0.6
lowest = 0.01
factor = 1.2
trials = 150
tracks = 2
)";

std::vector<std::string> run_arguments(const std::string& label, const std::string& pilot) {
    return {"study", "run", "study.toml", "--participant", label, "--pilot", pilot};
}

/// The answers, without their times.
std::vector<AnsweredTrial> answers_in(const std::filesystem::path& file) {
    std::vector<AnsweredTrial> answered = read_study(file).answered;
    for (AnsweredTrial& one : answered) one.utc_s = 0.0;
    return answered;
}

/// A limit that kills the program when a file grows beyond so many bytes.
std::vector<std::string> killer_beyond(std::uintmax_t bytes) {
    return {"/usr/bin/env", "prlimit", "--core=0", "--fsize=" + std::to_string(bytes)};
}

/// Kills `kills` runs of a study, each a little later, and resumes each.
void check_kills(std::uintmax_t kills) {
    const std::string pilot = "threshold=0.1,slope=20,lapse=0.02,prefer=other-one";
    const TemporaryFolder folder;
    write_text(folder / "study.toml", kLongPage);
    REQUIRE(run_dibhr(folder, run_arguments("P7", pilot)).exit_code == 0);
    const auto whole = answers_in(folder / "P7.dibhr-study");
    REQUIRE(whole.size() == 500);
    const std::uintmax_t bytes = std::filesystem::file_size(folder / "P7.dibhr-study");
    std::set<unsigned long> stopped_at;
    for (std::uintmax_t k = 0; k < kills; ++k) {
        CAPTURE(k);
        const std::string out = "run" + std::to_string(k);
        auto arguments = run_arguments("P7", pilot);
        arguments.insert(arguments.end(), {"--out", out});
        const ProgramResult killed =
            run_dibhr(folder, arguments, killer_beyond((2 * k + 1) * bytes / (2 * kills)));
        const ProgramResult resumed = run_dibhr(folder, arguments);
        INFO(killed.output << killed.errors << resumed.output << resumed.errors);
        CHECK(killed.exit_code == 128 + SIGXFSZ);
        REQUIRE(resumed.exit_code == 0);
        CHECK(answers_in(folder / (out + "/P7.dibhr-study")) == whole);
        const auto at = resumed.output.find("trial ");
        if (at != std::string::npos)
            stopped_at.insert(std::strtoul(resumed.output.c_str() + at + 6, nullptr, 10));
    }
    CAPTURE(stopped_at);
    CHECK(stopped_at.size() >= kills / 3);  // else it was always killed in the same trial
}

}  // namespace

TEST_CASE("the studies that come with the program are checked and run to their end", "[study]") {
    const std::string name =
        GENERATE("paper-question", "friction-threshold", "roughness-threshold");
    const TemporaryFolder folder;
    const ProgramResult checked = run_dibhr(folder, {"study", "check", name});
    INFO(checked.errors);
    REQUIRE(checked.exit_code == 0);
    CHECK(contains(checked.output, "minutes a participant"));
    CHECK(contains(checked.output, "are there"));
    const std::vector<std::string> lines = split(checked.output, '\n');
    CHECK(lines.at(lines.size() - 2).starts_with("not ready"));  // nothing is attached
    const std::string others = "least stability margin on devices that are not attached: a Falcon ";
    CHECK(lines.at(lines.size() - 3).starts_with(others));
    CHECK(contains(lines.at(lines.size() - 3), ", an Inverse3 "));
    const ProgramResult result = run_dibhr(
        folder, {"study", "run", name, "--participant", "P07", "--out", "a", "--pilot", "guess"});
    INFO(result.errors);
    REQUIRE(result.exit_code == 0);
    const StudyRecord record = read_study(folder / "a/P07.dibhr-study");
    CHECK(record.finished);
    CHECK(record.identity.number == 7);
    CHECK(record.answered.size() > 20);
}

TEST_CASE("a study that is killed at any moment goes on at its trial, nothing lost or doubled",
          "[study]") {
    check_kills(DIBHR_SANITIZED ? 3 : 6);
}

TEST_CASE("a study that is killed at fifty moments goes on at its trial, nothing lost or doubled",
          "[study][long]") {
    check_kills(50);
}

TEST_CASE("a study says in one line what it cannot do", "[study]") {
    const TemporaryFolder folder;
    write_text(folder / "study.toml", kPage);
    const auto said = [&](const std::vector<std::string>& arguments, int exit_code) {
        const ProgramResult result = run_dibhr(folder, arguments);
        CHECK(result.exit_code == exit_code);
        CHECK(split(result.errors, '\n').size() <= 2);
        return result.errors;
    };
    CHECK(contains(said({"study", "run", "study.toml", "--pilot", "guess"}, 2), "--participant"));
    CHECK(contains(said(run_arguments("Anna B.", "guess"), 1), "letters, digits, - and _"));
    CHECK(contains(said(run_arguments("Anna", "guess"), 2), "--number"));
    CHECK(contains(said(run_arguments("P1", "gess"), 1), "did you mean guess?"));
    CHECK(contains(said(run_arguments("P2", "prefer=other-on"), 1), "did you mean other-one?"));
    CHECK(contains(said({"study", "check", "paper-qestion"}, 1), "did you mean paper-question?"));
    CHECK(contains(said({"study", "chekc", "study.toml"}, 2), "did you mean check?"));
    CHECK(contains(said(run_arguments("P0", "guess"), 2), "a number from 1 to 1000000"));
    CHECK(contains(said(run_arguments("-1", "guess"), 1), "a letter or a digit first"));
    CHECK(contains(said(run_arguments("P3", ""), 2), "--pilot"));
    CHECK(contains(said(run_arguments("P3", "guess,threshold=1"), 1), "has no threshold"));
    CHECK_FALSE(std::filesystem::exists(folder / "P3.dibhr-study"));
    CHECK(contains(
        said({"study", "plan", "study.toml", "--pilot", "prefer=other-one", "--power", "nan"}, 2),
        "--power"));
    CHECK(contains(said({"study", "check", "."}, 1), "is a folder"));
    CHECK(contains(said({"study", "sessions", "study.toml"}, 1), "study.toml"));
    write_text(folder / "study.toml", kPage + "form = 3\n");
    CHECK(contains(said({"study", "check", "study.toml"}, 1), "study.toml:14: "));
}

TEST_CASE("a page that could not be felt to its end is refused with its line, before anything else",
          "[study]") {
    const std::string head = "title = \"T\"\n[[condition]]\nname = \"a\"\n";  // 3 lines
    const std::string block = "[[block]]\nform = \"two-interval\"\nquestion = \"Q\"\n";
    const std::string rating = "[[block]]\nform = \"rating\"\nquestion = \"Q\"\n";
    struct Mistake {
        std::string page;
        int line;
        std::string said;
    };
    const auto mistake = GENERATE_COPY(values<Mistake>({
        {head + block + "vary = \"dynamic-friction\"\nreference = 0.3\nlevels = [0.05, 0.2]\n", 9,
         "dynamic-friction 0.5 is above the static friction 0.4: give static-friction"},
        {head + block + "vary = \"static-friction\"\nreference = 0.5\nlevels = [-0.2]\n", 9,
         "static-friction 0.3 is below the dynamic friction 0.4"},
        {head + "static-friction = 0.2\n" + rating, 4, "is below the dynamic friction 0.4"},
        {head + block +
             "vary = \"dynamic-friction\"\nreference = 0.2\n[block.staircase]\n"
             "start = 0.1\nhighest = 0.3\nstep = 0.1\n",
         11, "dynamic-friction 0.5 in the condition 'a'"},
        {head + "[[block]]\nform = \"adjust\"\nquestion = \"Q\"\nvary = \"static-friction\"\n"
                "reference = 0.4\n[block.adjust]\nlowest = 0\nhighest = 1\n",
         10, "static-friction 0 in the condition 'a'"},
        {head + block + "vary = \"roughness\"\nlevels = [1, 2]\n", 8, "needs bump"},
        {head + "roughness = 3\n" + rating, 4, "needs bump = \"FILE\" or a material that has one"},
        {"title = \"T\"\n[[media]]\nname = \"m\"\ncolour = \"none.mp4\"\n", 4, "none.mp4"},
        {"title = \"T\"\n[[media]]\nname = \"m\"\ncolour = \"text.png\"\n", 4, "text.png"},
        {"title = \"T\"\ninstructions-picture = \"none.png\"\n", 2, "none.png"},
        {"title = \"T\"\nthanks-picture = \"text.png\"\n", 2, "text.png"},
        {"title = \"T\"\nthanks-picture = \".\"\n", 2, ""},
        {head + "bump = \"none.png\"\n", 4, "none.png"},
        {head + "bump = \"text.png\"\n", 4, "text.png"},
    }));
    CAPTURE(mistake.page);
    const TemporaryFolder folder;
    write_text(folder / "text.png", "hello\n");
    write_text(folder / "study.toml", mistake.page);
    const ProgramResult checked = run_dibhr(folder, {"study", "check", "study.toml"});
    INFO(checked.errors);
    CHECK(checked.exit_code == 1);
    CHECK(checked.output.empty());
    CHECK(contains(checked.errors, "study.toml:" + std::to_string(mistake.line) + ": "));
    CHECK(contains(checked.errors, mistake.said));
    CHECK(split(checked.errors, '\n').size() <= 2);
}

TEST_CASE("a pilot is refused what cannot be felt, but needs no files", "[study]") {
    const TemporaryFolder folder;
    write_text(folder / "study.toml", "thanks-picture = \"none.png\"\n" + kPage);
    CHECK(run_dibhr(folder, run_arguments("P1", "guess")).exit_code == 0);
    write_text(folder / "study.toml", kPage + "vary = \"roughness\"\nlevels = [1]\n");
    const ProgramResult refused = run_dibhr(folder, run_arguments("P2", "guess"));
    CHECK(refused.exit_code == 1);
    CHECK(contains(refused.errors, "study.toml:15: roughness 1 in the condition 'other-one'"));
}

TEST_CASE("a check tells what may not be meant", "[study]") {
    const TemporaryFolder folder;
    write_text(folder / "study.toml", R"(title = "T"
[[condition]]
name = "one"
[[condition]]
name = "two"
[[block]]
name = "yes or no"
form = "explore"
conditions = ["one"]
question = "Q"
vary = "friction"
reference = 0.3
levels = [0.1]
practice = true
[[block]]
name = "rated"
form = "rating"
question = "Q"
order = "latin"
practice = true
)");
    const ProgramResult checked = run_dibhr(folder, {"study", "check", "study.toml"});
    INFO(checked.errors);
    REQUIRE(checked.exit_code == 0);
    CHECK(contains(checked.output, "one and two have the same values"));
    CHECK(contains(checked.output, "yes or no: without a level 0"));
    CHECK(contains(checked.output, "explore, 1 trial, order random"));
    CHECK(contains(checked.output, "around 0.3, 1 level\n"));
    CHECK(contains(checked.output, "order latin, balanced over every 2 participants"));
    CHECK(contains(checked.output, "3 trials, about 1 minute a participant"));
    CHECK(contains(checked.output, "all of it is practice"));
}

TEST_CASE("a study goes on under its label, and is finished once", "[study]") {
    const TemporaryFolder folder;
    write_text(folder / "study.toml", kPage);
    REQUIRE(run_dibhr(folder, run_arguments("P1", "guess")).exit_code == 0);
    const ProgramResult again = run_dibhr(folder, run_arguments("P1", "guess"));
    CHECK(again.exit_code == 0);
    CHECK(contains(again.output, "is finished"));
    write_text(folder / "study.toml", kPage + "repetitions = 2\n");
    const ProgramResult other = run_dibhr(folder, run_arguments("P1", "guess"));
    CHECK(other.exit_code == 1);
    CHECK(contains(other.errors, "another protocol"));
}
