// `dibhr archive` as a person runs it.
#include <filesystem>
#include <string>
#include <vector>

#include "tests/app/program/command_program.hpp"
#include "tests/app/program/recorded_session.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;

namespace {

/// Records mine.dibhr in a folder.
void record_in(const TemporaryFolder& folder) {
    write_depth_png(folder / "hill_depth.png", 60, 40, 60, 2);
    write_depth_png(folder / "hill_color.png", 60, 40, 10, 1);
    record_session(folder / "mine.dibhr",
                   {.colour = folder / "hill_color.png", .depth = folder / "hill_depth.png"});
}

}  // namespace

TEST_CASE("an archive with its media replays to the recorded bits by itself", "[archive]") {
    const TemporaryFolder folder;
    record_in(folder);
    const ProgramResult made =
        run_dibhr(folder, {"archive", "mine.dibhr", "--out", "shared", "--media", "copy",
                           "--licence", "CC0", "--author", "A", "--author", "B"});
    INFO(made.errors);
    REQUIRE(made.exit_code == 0);
    CHECK(made.errors.empty());
    CHECK(contains(made.output, "shared: 1 session, 1 participant, 13 files\n"));
    const std::string said = read_text(folder / "shared/dataset_description.json");
    CHECK(contains(said, R"("License": "CC0")"));
    CHECK(contains(said, R"("Name": "shared")"));
    for (const char* const file : {"mine.dibhr", "hill_depth.png", "hill_color.png"})
        std::filesystem::remove(folder / file);
    const ProgramResult checked = run_dibhr(folder, {"archive", "--check", "shared"});
    CHECK(checked.exit_code == 0);
    CHECK(checked.output == "complete: 1 session, 1 participant, 13 files\n");
    const std::string kept =
        "shared/sourcedata/sub-unlabelled/sub-unlabelled_task-touch_run-001.dibhr";
    const ProgramResult replayed = run_dibhr(folder, {"replay", kept});
    INFO(replayed.errors);
    CHECK(replayed.exit_code == 0);
    CHECK(contains(replayed.output, "as recorded: all 1000 proxies and forces"));
    CHECK(run_dibhr(folder, {"export", kept, "--csv", "mine.csv"}).exit_code == 0);
    CHECK(read_text(folder / "mine.csv") ==
          read_text(folder /
                    "shared/sub-unlabelled/beh/sub-unlabelled_task-touch_run-001_ticks.csv"));
    write_text(folder / "shared/README.md", "");
    const ProgramResult faulty = run_dibhr(folder, {"archive", "--check", "shared"});
    CHECK(faulty.exit_code == 1);
    CHECK(faulty.output.empty());
    CHECK(faulty.errors ==
          "dibhr: README.md: has changed since the archive was made; copy it "
          "again\n");
}

TEST_CASE("an archive for which there is no room leaves nothing", "[archive]") {
    const TemporaryFolder folder;
    record_in(folder);
    const std::vector<std::string> before = names_in(folder.path());
    // Of the session's copy, and of the table of its ticks; as on a full disk there is an error and
    // no signal.
    const std::string bytes = GENERATE(as<std::string>(), "20000", "200000");
    CAPTURE(bytes);
    const ProgramResult full = run_dibhr(
        folder, {"archive", "mine.dibhr", "--out", "shared"},
        {"/bin/sh", "-c", "trap '' XFSZ; exec prlimit --fsize=" + bytes + " \"$0\" \"$@\""});
    INFO(full.errors);
    CHECK(full.exit_code == 1);
    CHECK(contains(full.errors, "make room"));
    CHECK(split(full.errors, '\n').size() == 2);
    CHECK(names_in(folder.path()) == before);
}

TEST_CASE("an archive needs sessions and a new folder, or a folder to check", "[archive]") {
    const TemporaryFolder folder;
    for (const std::vector<std::string>& wrong :
         {std::vector<std::string>{"archive"},
          {"archive", "mine.dibhr"},
          {"archive", "--out", "shared"},
          {"archive", "mine.dibhr", "--check", "shared"},
          {"archive", "mine.dibhr", "--out", "shared", "--media", "some"}}) {
        const ProgramResult result = run_dibhr(folder, wrong);
        CAPTURE(wrong, result.errors);
        CHECK(result.exit_code == 2);
        CHECK(split(result.errors, '\n').size() == 2);
    }
    const ProgramResult none = run_dibhr(folder, {"archive", "--check", "shared"});
    CHECK(none.exit_code == 1);
    CHECK(contains(none.errors, "holds no manifest.sha256"));
    CHECK(run_dibhr(folder, {"archive", "none.dibhr", "--out", "shared"}).exit_code == 1);
}
