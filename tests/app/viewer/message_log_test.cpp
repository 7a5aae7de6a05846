// Settings in a named file, and the log of the window's messages.
#include <algorithm>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "app/settings/settings.hpp"
#include "tests/app/program/command_program.hpp"
#include "tests/app/program/desk.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/text.hpp"

namespace fs = std::filesystem;
using namespace dibhr;
using namespace dibhr::test;
using Catch::Matchers::Matches;

namespace {

/// Runs the window over a picture with these options, pressing a key for its panels and one that
/// ends it.
void run(const TemporaryFolder& folder, const std::vector<std::string>& options,
         const std::string& quit) {
    write_depth_png(folder / "cup_depth.png", 64, 48, 120);
    std::vector<std::string> arguments{"cup_depth.png", "--device", "mouse", "--size", "640x480"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Desk desk;
    WindowProgram viewer = desk.start_viewer(folder, arguments);
    viewer.wait_for_surface();
    const bool panels = viewer.seen().panels;
    viewer.act("key Tab");
    CHECK(viewer.seen().panels != panels);
    desk.press("key " + quit);
    CHECK(viewer.wait() == 0);
}

}  // namespace

TEST_CASE("settings that others sent are read from their file, and changed there alone",
          "[settings]") {
    const TemporaryFolder folder;
    write_text(folder / "theirs.toml",
               "[window]\npanels-visible = false\n[touch]\nrelief = 77.0\n[keys]\nquit = \"F7\"\n");
    run(folder, {"--settings", "theirs.toml"}, "F7");
    const Settings kept = load_settings(folder / "theirs.toml");
    CHECK(kept.panels_visible);
    CHECK(kept.touch.shape.relief_px == 77.0);
    CHECK(kept.keys == std::vector<OwnKeys>{{"quit", {"F7"}}});
    CHECK_FALSE(fs::exists(folder / "config/dibhr/settings.toml"));
}

TEST_CASE(
    "a window that stays opens with the usual settings where its file is damaged, and keeps it",
    "[settings]") {
    const TemporaryFolder folder;
    const std::string damaged = "[touch\nstiffness = = 3";
    write_text(folder / "theirs.toml", damaged);
    write_text(folder / "theirs.toml.damaged", "of before");
    write_depth_png(folder / "cup_depth.png", 64, 48, 120);
    CHECK(run_dibhr(folder, {"cup_depth.png", "--settings", "theirs.toml"}).exit_code == 1);
    CHECK(read_text(folder / "theirs.toml") == damaged);
    const Desk desk;
    WindowProgram viewer = desk.start_viewer(
        folder, {"cup_depth.png", "--settings", "theirs.toml", "--device", "mouse", "--stay"});
    viewer.wait_for_surface();
    CHECK(contains(viewer.seen().message.str(), "theirs.toml.damaged-2"));
    viewer.act("key Escape");
    viewer.act("key Tab");
    desk.press("key q");
    CHECK(viewer.wait() == 0);
    CHECK(read_text(folder / "theirs.toml.damaged-2") == damaged);
    CHECK(read_text(folder / "theirs.toml.damaged") == "of before");
    CHECK_FALSE(load_settings(folder / "theirs.toml").panels_visible);
    CHECK(contains(read_text(folder / "errors.txt"), "It is kept as "));
}

TEST_CASE("a log keeps each line that is told, with its time, behind those of before", "[log]") {
    const TemporaryFolder folder;
    run(folder, {"--log-file", "told.txt", "--settings", "new.toml"}, "q");
    CHECK_FALSE(load_settings(folder / "new.toml").panels_visible);  // a file that was not there
    const std::string first = read_text(folder / "told.txt");
    CHECK(contains(first, "begin: dibhr "));
    CHECK(contains(first, "told: Panels hidden"));
    CHECK(run_dibhr(folder, {"gone.mp4", "--log-file", "told.txt"}).exit_code == 1);
    const std::string all = read_text(folder / "told.txt");
    CHECK(all.starts_with(first));
    CHECK(contains(all, " error: "));
    CHECK(contains(all, "gone.mp4"));
    bool ticks_reported = false;
    std::istringstream lines(all);
    for (std::string line; std::getline(lines, line);) {
        CHECK_THAT(line, Matches(R"(\d{4}-\d\d-\d\d \d\d:\d\d:\d\d\.\d{3} [a-z]+: .+)"));
        ticks_reported |= Matches(R"(.*ticks: \d+, late \d+, the worst by [\d.]+ ms)").match(line);
    }
    CHECK(ticks_reported);
    CHECK(all.ends_with('\n'));
}

TEST_CASE("a log is not written into what is none", "[log]") {
    const TemporaryFolder folder;
    write_depth_png(folder / "cup_depth.png", 8, 6, 100);
    const std::string picture = read_text(folder / "cup_depth.png");
    for (const char* const name : {"cup_depth.png", "gone/told.txt", "."}) {
        const ProgramResult result = run_dibhr(folder, {"cup_depth.png", "--log-file", name});
        CHECK(result.exit_code == 1);
        CHECK(contains(result.errors, "--log-file"));
        CHECK(std::count(result.errors.begin(), result.errors.end(), '\n') == 1);
    }
    CHECK(read_text(folder / "cup_depth.png") == picture);
}
