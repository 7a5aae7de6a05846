// `dibhr study report` and `dibhr study plan` as a person runs them.
#include <cstddef>
#include <string>
#include <vector>

#include "core/files/json.hpp"
#include "tests/app/commands/study_page.hpp"
#include "tests/app/program/command_program.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;

namespace {

const std::string kTwoAlgorithms =
    "title = \"Which <b>was</b> smoother?\"\n" + kTwoConditions + R"([[block]]
name = "smoother"
form = "two-interval"
pairs = "all"
question = "Which was smoother?"
)";

ProgramResult run_participant(const TemporaryFolder& folder, const std::string& label,
                              const std::string& pilot) {
    return run_dibhr(folder, {"study", "run", "study.toml", "--participant", label, "--pilot",
                              pilot, "--out", "answers"});
}

Json report_in(const TemporaryFolder& folder, const std::string& name) {
    return parsed_json(read_text(folder / name / "report.json"));
}

}  // namespace

TEST_CASE("a report is a page, numbers, tables and pictures of all participants",
          "[study report]") {
    const TemporaryFolder folder;
    write_text(folder / "study.toml", kTwoAlgorithms + "repetitions = 10\n");
    for (int number = 1; number <= 8; ++number)
        REQUIRE(run_participant(folder, "P" + std::to_string(number),
                                "prefer=smooth-one,share=0.9,seed=3")
                    .exit_code == 0);
    const ProgramResult made =
        run_dibhr(folder, {"study", "report", "answers", "--out", "r", "--plot-format", "svg"});
    INFO(made.errors);
    REQUIRE(made.exit_code == 0);
    CHECK(made.output == "r/report.html\n");
    CHECK(names_in(folder / "r") == std::vector<std::string>{"block-1-shares.svg", "intervals.csv",
                                                             "report.html", "report.json",
                                                             "trials.csv"});
    const Json report = report_in(folder, "r");
    CHECK(report["participants"].size() == 8);
    const Json share = report["blocks"][0]["shares"][0];
    CHECK(share["name"] == "smooth-one rather than other-one");
    CHECK(share["trials"] == 80);
    CHECK(share["test"]["test"] == "Wilcoxon signed-rank, exact");
    CHECK(share["test"]["p"] < 0.05);
    const std::vector<std::string> lines = split(read_text(folder / "r/trials.csv"), '\n');
    CHECK(lines.at(0) ==
          "participant,number,pilot,trial,block,position,practice,form,reference,comparison,"
          "repetition,target,track,parameter,level,choice,chosen,answer,right,reaction_s,utc_s,"
          "early");
    CHECK(lines.size() >= 81);
    CHECK(contains(lines.at(1), "P1,1,\"prefer=smooth-one,share=0.9,seed=3\",1,smoother,1,0,"));
    const std::string page = read_text(folder / "r/report.html");
    CHECK(contains(page, "Which &lt;b&gt;was&lt;/b&gt; smoother?"));
    CHECK(contains(page, "they say nothing about people"));
    CHECK(contains(page, "people like these 8 participants notice a difference"));
    CHECK(contains(page, "data:image/png;base64,"));
    CHECK_FALSE(contains(page, "<script"));
}

TEST_CASE("a study of the first schema, with a session of its time, is reported and taken out",
          "[study report]") {
    const TemporaryFolder folder;
    run_shell(folder, "sqlite3 s.dibhr <'" DIBHR_SOURCE_DIR
                      "/tests/data/sessions/schema_2_first.sql' && "
                      "sqlite3 P07.dibhr-study <'" DIBHR_SOURCE_DIR
                      "/tests/data/studies/schema_1.sql' && "
                      "sqlite3 P07.dibhr-study \"INSERT INTO session VALUES(0, "
                      "readfile('s.dibhr'))\"");
    const ProgramResult made =
        run_dibhr(folder, {"study", "report", "P07.dibhr-study", "--out", "r"});
    INFO(made.errors);
    REQUIRE(made.exit_code == 0);
    CHECK(made.errors.empty());
    CHECK(report_in(folder, "r")["blocks"][0]["trials"] == 6);
    REQUIRE(run_dibhr(folder, {"study", "sessions", "P07.dibhr-study", "--out", "s"}).exit_code ==
            0);
    CHECK(contains(run_dibhr(folder, {"info", "s/P07-001.dibhr"}).output, "P07"));
}

TEST_CASE("a report of a newer dibhr's study says so in one line, and on its page",
          "[study report]") {
    const TemporaryFolder folder;
    run_shell(folder, "sqlite3 P07.dibhr-study <'" DIBHR_SOURCE_DIR
                      "/tests/data/studies/schema_1.sql' && sqlite3 P07.dibhr-study "
                      "'ALTER TABLE trial ADD COLUMN early; ALTER TABLE trial ADD COLUMN glove; "
                      "PRAGMA user_version = 3'");
    const ProgramResult made =
        run_dibhr(folder, {"study", "report", "P07.dibhr-study", "--out", "r"});
    INFO(made.errors);
    REQUIRE(made.exit_code == 0);
    CHECK(contains(made.errors, "P07.dibhr-study: was made by a newer dibhr (format 3, "));
    CHECK(made.errors.find('\n') == made.errors.size() - 1);
    CHECK(contains(read_text(folder / "r/report.html"), "Made by a newer dibhr: P07."));
}

TEST_CASE("a report takes studies of folders at any depth, passes a bad one over and goes on",
          "[study report]") {
    const TemporaryFolder folder;
    run_shell(folder, "mkdir -p a/b && sqlite3 s.dibhr <'" DIBHR_SOURCE_DIR
                      "/tests/data/sessions/schema_2_first.sql' && "
                      "sqlite3 a/b/P07.dibhr-study <'" DIBHR_SOURCE_DIR
                      "/tests/data/studies/schema_1.sql' && "
                      "sqlite3 a/b/P07.dibhr-study \"INSERT INTO session VALUES(0, "
                      "readfile('s.dibhr'))\" && echo no study >a/P08.dibhr-study");
    const std::vector<std::string> words{"study", "report", "a", "--out", "r"};
    const ProgramResult made = run_dibhr(folder, words);
    INFO(made.errors);
    CHECK(made.exit_code == 1);
    CHECK(contains(made.errors, "a/P08.dibhr-study: is not a study file"));
    CHECK(made.errors.find('\n') == made.errors.size() - 1);
    CHECK(std::filesystem::exists(folder / "r/b/P07.study.json"));
    const std::string intervals = read_text(folder / "r/intervals.csv");
    CHECK(split(intervals, '\n').size() > 2);
    const auto measured = std::filesystem::last_write_time(folder / "r/b/P07.study.json");
    CHECK(run_dibhr(folder, words).exit_code == 1);
    CHECK(std::filesystem::last_write_time(folder / "r/b/P07.study.json") == measured);
    CHECK(read_text(folder / "r/intervals.csv") == intervals);
    // What an earlier dibhr kept, without a device, is measured again.
    run_shell(folder,
              "sed -i 's/\"options\":\"[^\"]*\"/\"options\":\"\"/; "
              "s/\"device\":\"[^\"]*\",//g' r/b/P07.study.json");
    CHECK(run_dibhr(folder, words).exit_code == 1);
    CHECK(contains(read_text(folder / "r/b/P07.study.json"), "\"device\":"));
    CHECK(read_text(folder / "r/intervals.csv") == intervals);
}

TEST_CASE("the Python of the study's FORMAT.md reads its trials and takes its sessions out",
          "[study report]") {
    const TemporaryFolder folder;
    write_text(folder / "study.toml", kTwoAlgorithms + "repetitions = 2\n");
    REQUIRE(run_participant(folder, "P07", "guess").exit_code == 0);
    const std::string page = read_text(DIBHR_SOURCE_DIR "/core/study/FORMAT.md");
    const std::string fence = "```python\n";
    const std::size_t begin = page.find(fence) + fence.size();
    write_text(folder / "answers/read.py", page.substr(begin, page.find("```", begin) - begin));
    run_shell(folder,
              "cd answers && sqlite3 P07.dibhr-study \"INSERT INTO session VALUES(1, "
              "CAST('ticks' AS BLOB))\" && python3 read.py >trials");
    const std::string trials = read_text(folder / "answers/trials");
    CHECK(split(trials, '\n').size() == 3);
    CHECK(contains(trials, "'form': 'two-interval'"));
    CHECK(contains(trials, "('smooth-one', None, {'friction': 0.4, 'algorithm': 'dibhr'})"));
    CHECK(read_text(folder / "answers/P07-002.dibhr") == "ticks");
}

TEST_CASE("the tables of a report hold no formula, whatever its page calls things",
          "[study report]") {
    const TemporaryFolder folder;
    write_text(folder / "study.toml", R"(title = "T"
[[condition]]
name = "=cmd|' /C calc'!A0"
[[condition]]
name = "@other"
[[block]]
name = "+block"
form = "two-interval"
pairs = "all"
question = "Q"
)");
    REQUIRE(run_participant(folder, "P1", "guess").exit_code == 0);
    const ProgramResult made = run_dibhr(folder, {"study", "report", "answers", "--out", "r"});
    INFO(made.errors);
    REQUIRE(made.exit_code == 0);
    const std::vector<std::string> lines = split(read_text(folder / "r/trials.csv"), '\n');
    CHECK(contains(lines.at(1),
                   "P1,1,guess,1,'+block,1,0,two-interval,'=cmd|' /C calc'!A0,'@other,"));
}

TEST_CASE("labels that end in one number are told before the first trial", "[study report]") {
    const TemporaryFolder folder;
    write_text(folder / "study.toml", kTwoAlgorithms);
    CHECK(run_participant(folder, "P21", "guess").errors.empty());
    const ProgramResult second = run_participant(folder, "Q21", "guess");
    CHECK(second.exit_code == 0);
    CHECK(contains(second.errors, "the number 21 chooses the order of P21, too"));
    CHECK(run_participant(folder, "Q21", "guess").errors.empty());  // it has begun
}

TEST_CASE("each study that comes with the program gives a report", "[study report]") {
    const std::string name =
        GENERATE("paper-question", "friction-threshold", "roughness-threshold");
    const TemporaryFolder folder;
    const std::string pilot = name == "paper-question" ? "prefer=dibhr" : "threshold=0.1,slope=20";
    for (const char* const label : {"P1", "P2"})
        REQUIRE(run_dibhr(folder, {"study", "run", name, "--participant", label, "--out", "a",
                                   "--pilot", pilot})
                    .exit_code == 0);
    const ProgramResult made =
        run_dibhr(folder, {"study", "report", "a", "--out", "r", "--curve", "weibull"});
    INFO(made.errors);
    REQUIRE(made.exit_code == 0);
    const Json block = report_in(folder, "r")["blocks"][0];
    if (name == "paper-question")
        CHECK(block["shares"].size() == 3);
    else
        CHECK(block["thresholds"][0]["fits"].size() == 2);
}

TEST_CASE("a plan says how many people an effect needs", "[study plan]") {
    const TemporaryFolder folder;
    write_text(folder / "study.toml", kTwoAlgorithms + "repetitions = 10\n");
    const ProgramResult planned =
        run_dibhr(folder, {"study", "plan", "study.toml", "--pilot", "prefer=smooth-one,share=0.8",
                           "--studies", "50"});
    INFO(planned.errors);
    REQUIRE(planned.exit_code == 0);
    CHECK(contains(planned.output,
                   "smooth-one rather than other-one, 10 trials each (as on the "
                   "page): "));
    CHECK(contains(planned.output, "Of 50 simulated studies each"));
}

TEST_CASE("a report and a plan say in one line what they cannot do", "[study report]") {
    const TemporaryFolder folder;
    write_text(folder / "study.toml", kTwoAlgorithms);
    REQUIRE(run_participant(folder, "P1", "guess").exit_code == 0);
    const auto said = [&](std::vector<std::string> arguments, int exit_code) {
        arguments.insert(arguments.begin(), "study");
        const ProgramResult result = run_dibhr(folder, arguments);
        CHECK(result.exit_code == exit_code);
        CHECK(split(result.errors, '\n').size() <= 2);
        CHECK_FALSE(std::filesystem::exists(folder / "r"));
        return result.errors;
    };
    CHECK(contains(said({"report", "answers"}, 2), "--out DIR"));
    CHECK(contains(said({"report", "nothing", "--out", "r"}, 1), "nothing"));
    std::filesystem::create_directory(folder / "none");
    CHECK(contains(said({"report", "none", "--out", "r"}, 1), "no study file"));
    CHECK(contains(said({"report", "study.toml", "--out", "r"}, 1), "study.toml"));
    CHECK(contains(said({"report", "answers", "answers", "--out", "r"}, 1), "give one of the two"));
    CHECK(contains(said({"report", "answers", "--out", "r", "--curve", "weibul"}, 2),
                   "did you mean weibull?"));
    CHECK(contains(said({"plan", "study.toml"}, 2), "--pilot"));
    CHECK(contains(said({"plan", "study.toml", "--pilot", "guess"}, 1), "no effect"));
    CHECK(contains(said({"plan", "study.toml", "--pilot", "threshold=0.1"}, 1), "changes nothing"));
    CHECK(contains(said({"check", "study.toml", "study.toml"}, 2), "takes one file"));
    write_text(folder / "study.toml", kTwoAlgorithms + "repetitions = 2\n");
    REQUIRE(run_participant(folder, "P2", "guess").exit_code == 0);
    CHECK(contains(said({"report", "answers", "--out", "r"}, 1), "another protocol"));
}
