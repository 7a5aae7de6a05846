// Folders of sessions by one command: the same results however they are made, gone on with after
// an interruption, and by a workflow.
#include <algorithm>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/files/json.hpp"
#include "tests/app/program/command_program.hpp"
#include "tests/app/program/recorded_session.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;

namespace {

namespace fs = std::filesystem;

/// Sessions of different content, at two depths, one without its ending, and one that is none.
void record_some(const TemporaryFolder& folder) {
    write_depth_png(folder / "hill_depth.png", 60, 40, 60, 2);
    write_depth_png(folder / "hill_color.png", 60, 40, 10, 1);
    fs::create_directories(folder / "recordings/of/P07");
    RecordedSession wanted{.colour = folder / "hill_color.png", .depth = folder / "hill_depth.png"};
    record_session(folder / "recordings/a.dibhr", wanted);
    wanted.seconds = 0.5;
    record_session(folder / "recordings/of/P07/b.dibhr", wanted);
    wanted.parameters.coupling.stiffness_newton_per_mm = 0.4;
    record_session(folder / "recordings/without-ending", wanted);
    write_text(folder / "recordings/bad.dibhr", "no session\n");
    write_text(folder / "recordings/notes.txt", "not looked at\n");
}

/// Every file below, by its path, with its bytes.
std::map<std::string, std::string> all_in(const fs::path& folder) {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.is_regular_file())
            files[entry.path().lexically_relative(folder).string()] = read_text(entry.path());
    return files;
}

/// When each file below was written.
std::map<std::string, fs::file_time_type> times_in(const fs::path& folder) {
    std::map<std::string, fs::file_time_type> times;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.is_regular_file())
            times[entry.path().lexically_relative(folder).string()] = entry.last_write_time();
    return times;
}

ProgramResult replay_into(const TemporaryFolder& folder, const std::string& out,
                          const std::vector<std::string>& more = {}) {
    std::vector<std::string> words{"replay",      "recordings", "--algorithm", "dibhr",
                                   "--algorithm", "pga",        "--out",       out};
    words.insert(words.end(), more.begin(), more.end());
    return run_dibhr(folder, words);
}

}  // namespace

TEST_CASE("a folder of sessions is replayed to the same bytes by one process and by three",
          "[many]") {
    const TemporaryFolder folder;
    record_some(folder);
    const ProgramResult one = replay_into(folder, "one", {"--jobs", "1"});
    const ProgramResult three = replay_into(folder, "three", {"--jobs", "3"});
    INFO(one.output << one.errors);
    CHECK(one.exit_code == 1);
    CHECK(three.exit_code == 1);
    CHECK(one.errors == three.errors);
    CHECK(std::count(one.errors.begin(), one.errors.end(), '\n') == 1);
    CHECK(contains(one.errors, "recordings/bad.dibhr"));
    CHECK(all_in(folder / "one") == all_in(folder / "three"));
    const auto lines = split(read_text(folder / "one/replay.csv"), '\n');
    REQUIRE(lines.size() == 6);
    CHECK(lines[0].starts_with(
        "session,failure,duration_s,ticks,missing_ticks,marks,first_tick_utc_s,dibhr_differs,"));
    CHECK(contains(lines[0], ",pga_differs,"));
    CHECK(contains(lines[0], ",fact device,"));
    CHECK(lines[1].starts_with("recordings/a.dibhr,,0.999,1000,0,"));
    CHECK(contains(lines[2], "is not a session that can be read"));
    CHECK(lines[3].starts_with("recordings/of/P07/b.dibhr,,0.499,500,0,"));
    CHECK(lines[4].starts_with("recordings/without-ending,,0.499,500,0,"));
    CHECK(fs::exists(folder / "one/of/P07/b.replay.json"));
    CHECK(contains(one.output, "session                    duration_s  ticks  dibhr_differs"));
    CHECK(contains(one.output, "recordings/bad.dibhr                -      -              -"));
    CHECK(one.output.ends_with("one/replay.csv\n"));
}

TEST_CASE("what is done of many sessions is done again only where something else decides it",
          "[many]") {
    const TemporaryFolder folder;
    record_some(folder);
    fs::remove(folder / "recordings/bad.dibhr");
    REQUIRE(replay_into(folder, "out").exit_code == 0);
    const auto kept = [&] {
        auto times = times_in(folder / "out");
        times.erase("replay.csv");
        return times;
    };
    /// The results that a run makes again.
    const auto made_by = [&](const std::vector<std::string>& more) {
        const auto before = kept();
        const ProgramResult result = replay_into(folder, "out", more);
        INFO(result.errors);
        CHECK(result.exit_code == 0);
        std::vector<std::string> made;
        for (const auto& [name, time] : kept())
            if (before.at(name) != time) made.push_back(name);
        return made;
    };
    using Names = std::vector<std::string>;
    const Names all{"a.replay.json", "of/P07/b.replay.json", "without-ending.replay.json"};
    CHECK(made_by({}).empty());
    const fs::path a = folder / "recordings/a.dibhr";
    fs::last_write_time(a, fs::last_write_time(a) + std::chrono::seconds(10));  // the same content
    CHECK(made_by({}).empty());
    run_shell(folder, "sqlite3 recordings/a.dibhr \"INSERT INTO session VALUES('note', 'x')\"");
    CHECK(made_by({}) == Names{"a.replay.json"});
    write_text(folder / "out/of/P07/b.replay.json", "{\"of\": 1");
    CHECK(made_by({}) == Names{"of/P07/b.replay.json"});
    CHECK(made_by({"--friction", "0.1"}) == all);
    CHECK(made_by({"--friction", "0.1", "--jobs", "1"}).empty());
    CHECK(made_by({"--friction", "0.1", "--again"}) == all);
}

TEST_CASE("work on many sessions that was stopped or killed goes on and leaves no trace of it",
          "[many]") {
    const TemporaryFolder folder;
    record_some(folder);
    fs::remove(folder / "recordings/bad.dibhr");
    const std::string kind = GENERATE("TERM", "KILL");
    for (int k = 0; k < 8; ++k)
        fs::copy_file(folder / "recordings/a.dibhr",
                      folder / ("recordings/more-" + std::to_string(k) + ".dibhr"));
    REQUIRE(run_dibhr(folder, {"export", "recordings", "--out", "whole"}).exit_code == 0);
    run_shell(folder, "{ '" DIBHR_PROGRAM
                      "' export recordings --jobs 1 --out out >/dev/null 2>stopped & child=$!; "
                      "until test -e out/more-0.export.json; do sleep 0.005; done; kill -" +
                          kind + " $child; if wait $child; then exit 1; fi; }");
    const auto halfway = all_in(folder / "out");
    CHECK(halfway.contains("a.export.json"));
    CHECK_FALSE(halfway.contains("export.csv"));
    if (kind == "TERM") {
        CHECK(contains(read_text(folder / "stopped"), "the same command goes on with the others"));
        for (const auto& [name, bytes] : halfway) CHECK_FALSE(contains(name, ".part"));
    }
    const auto times = times_in(folder / "out");
    REQUIRE(run_dibhr(folder, {"export", "recordings", "--out", "out"}).exit_code == 0);
    CHECK(times_in(folder / "out").at("a.csv") == times.at("a.csv"));
    CHECK(all_in(folder / "out") == all_in(folder / "whole"));
}

TEST_CASE("an export of many sessions is the export of each", "[many]") {
    const TemporaryFolder folder;
    record_some(folder);
    fs::remove(folder / "recordings/bad.dibhr");
    const ProgramResult made = run_dibhr(folder, {"export", "recordings", "--out", "ticks"});
    INFO(made.errors);
    REQUIRE(made.exit_code == 0);
    REQUIRE(
        run_dibhr(folder, {"export", "recordings/of/P07/b.dibhr", "--csv", "b.csv"}).exit_code ==
        0);
    CHECK(read_text(folder / "ticks/of/P07/b.csv") == read_text(folder / "b.csv"));
    CHECK(contains(run_dibhr(folder, {"export", "recordings", "--csv", "b.csv"}).errors, "--out"));
    CHECK(contains(run_dibhr(folder, {"export", "recordings"}).errors, "--out"));
}

TEST_CASE("many sessions are reported in a folder each", "[many]") {
    const TemporaryFolder folder;
    record_some(folder);
    const ProgramResult made = run_dibhr(folder, {"report", "recordings", "--out", "reports"});
    INFO(made.errors);
    CHECK(made.exit_code == 1);  // the one that is none
    const std::string page = read_text(folder / "reports/of/P07/b/report.html");
    REQUIRE(run_dibhr(folder, {"report", "recordings/of/P07/b.dibhr", "--out", "b"}).exit_code ==
            0);
    CHECK(page == read_text(folder / "b/report.html"));
    CHECK(contains(made.output, "of/P07/b/report.html"));
    CHECK(split(read_text(folder / "reports/report.csv"), '\n').size() == 6);
}

TEST_CASE("info describes a folder's sessions in order and sums them up", "[many]") {
    const TemporaryFolder folder;
    record_some(folder);
    const ProgramResult said = run_dibhr(folder, {"info", "hill_depth.png", "recordings"});
    INFO(said.output << said.errors);
    CHECK(said.exit_code == 1);
    CHECK(said.output.starts_with("hill_depth.png\n"));
    const std::string alone = run_dibhr(folder, {"info", "recordings/a.dibhr"}).output;
    CHECK(contains(said.output, alone));
    CHECK(said.output.find("recordings/a.dibhr\n") <
          said.output.find("recordings/of/P07/b.dibhr\n"));
    CHECK(contains(said.output, "session                    duration_s"));
    const ProgramResult json = run_dibhr(folder, {"info", "recordings", "--json"});
    CHECK(split(json.output, '\n').size() == 4);
    CHECK(parsed_json(split(json.output, '\n')[0])["rows"] == 1000);
}

TEST_CASE("the list of many sessions names the results and the file of each", "[many]") {
    const TemporaryFolder folder;
    record_some(folder);
    const ProgramResult listed =
        run_dibhr(folder, {"replay", "recordings", "recordings/a.dibhr", "--list"});
    CHECK(listed.output ==
          "a\trecordings/a.dibhr\nbad\trecordings/bad.dibhr\n"
          "of/P07/b\trecordings/of/P07/b.dibhr\nwithout-ending\trecordings/without-ending\n"
          "a-2\trecordings/a.dibhr\n");
    CHECK(contains(run_dibhr(folder, {"replay", "recordings", "--only", "x", "--out", "o"}).errors,
                   "is none of the sessions"));
    fs::create_directory(folder / "empty");
    CHECK(contains(run_dibhr(folder, {"replay", "empty", "--out", "o"}).errors,
                   "there is no session file"));
}

TEST_CASE("the Snakemake workflow gives the same bytes as the command, a session a job", "[many]") {
    const TemporaryFolder folder;
    record_some(folder);
    const bool with_bad = GENERATE(false, true);
    if (!with_bad) fs::remove(folder / "recordings/bad.dibhr");
    REQUIRE(replay_into(folder, "results", {"--jobs", "2"}).exit_code == (with_bad ? 1 : 0));
    fs::rename(folder / "results", folder / "by-command");
    run_shell(folder, "cp -r '" DIBHR_SOURCE_DIR
                      "/assets/workflow/.' . && export HOME=\"$PWD\" && " +
                          std::string(with_bad ? "! " : "") +
                          "snakemake --cores 2 --config dibhr='" DIBHR_PROGRAM
                          "' options='--algorithm dibhr --algorithm pga' >said 2>&1");
    INFO(read_text(folder / "said"));
    CHECK(all_in(folder / "results") == all_in(folder / "by-command"));
    CHECK(contains(read_text(folder / "said"), "rule session"));
    if (with_bad) CHECK(contains(read_text(folder / "said"), "1 of 4 sessions were passed over"));
}
