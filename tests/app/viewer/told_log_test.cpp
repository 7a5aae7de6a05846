// Settings in a file that is named, and the log of what a person is told.
#include <algorithm>
#include <filesystem>
#include <regex>
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

namespace {

const std::string kInWindow = "search --sync --onlyvisible --name dibhr sleep 0.7 ";

/// Runs the window over a picture, with these options and keys.
void run(const Desk& desk, const TemporaryFolder& folder, const std::vector<std::string>& options,
         const std::string& keys) {
    write_depth_png(folder / "cup_depth.png", 64, 48, 120);
    std::vector<std::string> arguments{"cup_depth.png", "--device",  "mouse", "--size",
                                       "800x600",       "--seconds", "30"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    Process viewer = desk.start_viewer(folder, arguments);
    desk.act(kInWindow + keys);
    CHECK(viewer.wait() == 0);
}

}  // namespace

TEST_CASE("settings that others sent are read from their file, and changed there alone",
          "[settings]") {
    const Desk desk;
    const TemporaryFolder folder;
    write_text(folder / "theirs.toml",
               "[window]\npanels-visible = false\n[touch]\nrelief = 77.0\n[keys]\nquit = \"F7\"\n");
    run(desk, folder, {"--settings", "theirs.toml"}, "key Tab sleep 0.4 key F7");
    const Settings kept = load_settings(folder / "theirs.toml");
    CHECK(kept.panels_visible);
    CHECK(kept.touch.shape.relief_px == 77.0);
    CHECK(kept.keys == std::vector<OwnKeys>{{"quit", {"F7"}}});
    CHECK_FALSE(fs::exists(folder / "config/dibhr/settings.toml"));
    run(desk, folder, {"--settings", "new.toml"}, "key Tab sleep 0.4 key q");
    CHECK_FALSE(load_settings(folder / "new.toml").panels_visible);
}

TEST_CASE("a log keeps each line that is told, with its time, behind those of before", "[log]") {
    const Desk desk;
    const TemporaryFolder folder;
    const std::vector<std::string> options{"--log-file", "told.txt"};
    run(desk, folder, options, "key Tab sleep 0.4 key q");
    const std::string first = read_text(folder / "told.txt");
    CHECK(contains(first, "begin: dibhr "));
    CHECK(contains(first, "told: Panels hidden"));
    CHECK(run_dibhr(folder, {"gone.mp4", "--log-file", "told.txt"}).exit_code == 1);
    const std::string all = read_text(folder / "told.txt");
    CHECK(all.starts_with(first));
    CHECK(contains(all, " error: "));
    CHECK(contains(all, "gone.mp4"));
    CHECK(std::regex_search(all, std::regex(R"(ticks: \d+, late \d+, the worst by [\d.]+ ms\n)")));
    const std::regex line(R"(\d{4}-\d\d-\d\d \d\d:\d\d:\d\d\.\d{3} [a-z]+: .+)");
    std::istringstream lines(all);
    for (std::string each; std::getline(lines, each);) {
        INFO(each);
        CHECK(std::regex_match(each, line));
    }
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
