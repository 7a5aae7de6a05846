// The whole program under the thread sanitizer, which knows of the distribution's libraries what
// tests/support/sanitizer_suppressions.cpp says and of dibhr nothing.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "tests/app/program/command_program.hpp"
#include "tests/app/program/desk.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr::test;

namespace {

/// Into the sample's chest, in circles there, and out again.
void write_press(const std::filesystem::path& file) {
    std::ofstream goals(file);
    goals << "t,x,y,z\n";
    for (int k = 0; k < 3000; ++k) {
        const double t_s = 1e-3 * k;
        goals << t_s << ',' << 320.0 + 12.0 * std::sin(4.0 * t_s) << ','
              << 400.0 + 12.0 * std::cos(4.0 * t_s) << ',' << 170.0 + 80.0 * std::cos(2.1 * t_s)
              << '\n';
    }
}

}  // namespace

TEST_CASE("threads of the program race for nothing while a hand touches, is recorded and replayed",
          "[window]") {
    const Desk desk;
    const TemporaryFolder folder;
    write_press(folder / "goals.csv");
    WindowProgram viewer = desk.start_viewer(
        folder, {"--device", "goals:goals.csv", "--record", "touch.dibhr", "--size", "640x480"});
    viewer.wait_until([](const Seen& now) { return now.contact && now.recorded_rows > 500; });
    viewer.wait_until([](const Seen& now) { return now.recorded_rows > 3000; });
    desk.press("key q");
    CHECK(viewer.wait() == 0);  // 66 after a report
    CHECK(read_text(folder / "errors.txt") == "");
    const auto rows = read_session(folder / "touch.dibhr");
    CHECK(std::any_of(rows.begin(), rows.end(), [](const Row& row) { return row.contact; }));

    WindowProgram replay = desk.start_viewer(folder, {"touch.dibhr", "--size", "640x480"});
    replay.wait_until([](const Seen& now) { return now.replays && now.tick > 500; });
    desk.press("key End");
    replay.wait_until([](const Seen& now) { return now.tick > 2000; });
    desk.press("key Home");
    replay.wait_until([](const Seen& now) { return now.tick < 1500; });
    desk.press("key q");
    CHECK(replay.wait() == 0);
    CHECK(read_text(folder / "errors.txt") == "");
}
