// Commands that find out what depth means: what is likely but not sure is told in one line, and
// fails with --sure.
#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/app/commands/study_page.hpp"
#include "tests/app/program/command_program.hpp"
#include "tests/app/program/recorded_session.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr;
using namespace dibhr::test;

namespace {

/// Levels of 16 bits that are far in the middle, without a floor: nothing says which are near.
const std::string kTunnel = "format=gray16le,geq=lum='12000+48000*exp(-hypot(X-32,Y-24)/10)'";

const std::string kLine =
    "dibhr: 'a.png': near is assumed to be dark (55 % sure): look at it, or say --near dark or "
    "--near bright\n";

void write_tunnel(const TemporaryFolder& folder) {
    run_shell(folder, "ffmpeg -v error -f lavfi -i \"color=black:s=64x48," + kTunnel +
                          "\" -frames:v 1 a.png");
}

/// The line without its number, which rests on many findings.
std::string without_percent(const std::string& line) {
    const std::size_t begin = line.find('(');
    const std::size_t end = line.find(" %");
    if (begin == std::string::npos || end == std::string::npos) return line;
    return line.substr(0, begin) + line.substr(end);
}

ProgramResult run_with_options(const TemporaryFolder& folder, std::vector<std::string> command,
                               const std::vector<std::string>& options) {
    command.insert(command.end(), options.begin(), options.end());
    return run_dibhr(folder, command);
}

std::vector<std::string> study_words(const std::string& action) {
    return {"study", action, "study.toml", "--participant", "P1"};
}

}  // namespace

TEST_CASE("what is likely but not sure is told in a line, settled by a word, and fails with --sure",
          "[sure]") {
    const TemporaryFolder folder;
    write_tunnel(folder);
    write_text(folder / "goals.csv", "t,x,y,z\n0,2,5,300\n");
    for (const std::vector<std::string>& command :
         {std::vector<std::string>{"info", "a.png"},
          {"info", "a.png", "--json"},
          {"surface", "a.png", "--out", "out.pfm"},
          {"touch", "--depth", "a.png", "--goals", "goals.csv", "--out", "out.csv"}}) {
        CAPTURE(command[0]);
        const std::vector<std::string> before = names_in(folder.path());
        const ProgramResult refused = run_with_options(folder, command, {"--sure"});
        CHECK(refused.exit_code == 1);
        CHECK(refused.output.empty());
        CHECK(names_in(folder.path()) == before);
        const ProgramResult likely = run_with_options(folder, command, {});
        CHECK(likely.exit_code == 0);
        CHECK(without_percent(likely.errors) == without_percent(kLine));
        CHECK(refused.errors == likely.errors);
        for (const char* const near : {"dark", "bright"}) {
            const ProgramResult said =
                run_with_options(folder, command, {"--sure", "--near", near});
            CHECK(said.exit_code == 0);
            CHECK(said.errors.empty());
        }
    }
}

TEST_CASE("view --sure fails before there is a window or a file", "[sure]") {
    const TemporaryFolder folder;
    write_tunnel(folder);
    const std::vector<std::string> before = names_in(folder.path());
    const ProgramResult refused =
        run_dibhr(folder, {"a.png", "--sure", "--record", "mine.dibhr", "--screenshot", "last.png",
                           "--clip", "all.mp4", "--device", "mouse"});
    CHECK(refused.exit_code == 1);
    CHECK(without_percent(refused.errors) == without_percent(kLine));
    CHECK(names_in(folder.path()) == before);
}

TEST_CASE("a study tells what is not sure of its media, and how a page's media are settled",
          "[sure]") {
    const TemporaryFolder folder;
    write_tunnel(folder);
    write_text(folder / "study.toml",
               "title = \"T\"\n[[media]]\nname = \"m\"\ncolour = \"a.png\"\n" + kTwoConditions +
                   "[[block]]\nform = \"two-interval\"\npairs = \"all\"\nquestion = \"Q\"\n");
    const ProgramResult likely = run_dibhr(folder, {"study", "check", "study.toml"});
    CHECK(likely.exit_code == 0);
    CHECK(contains(likely.errors, "a.png': near is assumed to be dark ("));
    CHECK(contains(likely.errors, "state near = \"dark\" or near = \"bright\" in its sidecar '"));
    CHECK(contains(likely.errors, "a.toml'\n"));
    CHECK(std::ranges::count(likely.errors, '\n') == 1);
    for (const char* const action : {"check", "run"}) {
        CAPTURE(action);
        const ProgramResult refused = run_with_options(folder, study_words(action), {"--sure"});
        CHECK(refused.exit_code == 1);
        CHECK(contains(refused.errors, "study.toml:4: "));
        CHECK(contains(refused.errors, "a.png': near is assumed to be dark ("));
        CHECK(std::ranges::count(refused.errors, '\n') == 1);
        CHECK_FALSE(std::filesystem::exists(folder / "P1.dibhr-study"));
    }
    write_text(folder / "a.toml", "[depth]\nnear = \"dark\"\n");
    const ProgramResult settled = run_dibhr(folder, {"study", "check", "study.toml", "--sure"});
    CHECK(settled.exit_code == 0);
    CHECK(settled.errors.empty());
}

TEST_CASE("a recorded session states what its depth meant: there is no doubt", "[sure]") {
    const TemporaryFolder folder;
    const std::string film = "ffmpeg -v error -f lavfi -i \"";
    const std::string size = "s=64x48:r=30:d=0.5";
    run_shell(folder, film + "color=black:" + size + "," + kTunnel + "\" -c:v ffv1 a_depth.mkv");
    run_shell(folder, film + "testsrc2=" + size + "\" -c:v ffv1 a_color.mkv");
    REQUIRE_FALSE(run_dibhr(folder, {"info", "a_depth.mkv"}).errors.empty());
    record_session(
        folder / "mine.dibhr",
        {.colour = folder / "a_color.mkv", .depth = folder / "a_depth.mkv", .finds_out = true});
    for (const std::vector<std::string>& command :
         {std::vector<std::string>{"replay", "mine.dibhr"},
          {"replay", "mine.dibhr", "--algorithm", "pga"},
          {"export", "mine.dibhr", "--csv", "all.csv"},
          {"report", "mine.dibhr", "--out", "report"}}) {
        CAPTURE(command[0]);
        const ProgramResult result = run_dibhr(folder, command);
        CHECK(result.exit_code == 0);
        CHECK(result.errors.empty());
    }
}

TEST_CASE("every command that finds out what depth means has the option --sure", "[sure]") {
    const TemporaryFolder folder;
    for (const char* const command : {"view", "touch", "surface", "info", "study"})
        CHECK(contains(run_dibhr(folder, {command, "--help"}).output, "--sure"));
    for (const char* const command : {"replay", "export", "report", "experiment", "bench", "depth"})
        CHECK_FALSE(contains(run_dibhr(folder, {command, "--help"}).output, "--sure"));
}
