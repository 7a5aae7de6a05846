// Keys that move a video, typed into the real window; what is recorded tells where it went.
#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstddef>
#include <filesystem>
#include <glm/geometric.hpp>
#include <string>
#include <vector>

#include "app/settings/file_memory.hpp"
#include "core/haptics/safety.hpp"
#include "core/session/session.hpp"
#include "core/video/media.hpp"
#include "tests/app/program/command_program.hpp"
#include "tests/app/program/desk.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/text.hpp"

namespace fs = std::filesystem;
using namespace dibhr;
using namespace dibhr::test;
using Catch::Matchers::WithinAbs;

namespace {

constexpr double kFrame_s = 0.1;

/// 100 seconds of film.
void make_long_films(const TemporaryFolder& folder) {
    const std::string quiet = "ffmpeg -nostdin -v error -y -f lavfi -i ";
    run_shell(quiet + "color=gray:s=64x48:r=10:d=100 -c:v ffv1 '" +
              (folder / "long_color.mkv").string() + "'");
    run_shell(quiet + "color=gray:s=64x48:r=10:d=100,format=gray -c:v ffv1 '" +
              (folder / "long_depth.mkv").string() + "'");
}

/// What is recorded while these keys are typed.
std::vector<Row> played(const std::vector<std::string>& options, const std::string& commands,
                        const std::string& settings = {}) {
    const Desk desk;
    const TemporaryFolder folder;
    make_long_films(folder);
    fs::create_directories(folder / "config/dibhr");
    write_text(folder / "config/dibhr/settings.toml", settings);
    std::vector<std::string> arguments{"long_color.mkv", "--raw-depth", "--device", "mouse",
                                       "--record",       "hand.dibhr",  "--size",   "640x480",
                                       "--seconds",      "30"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    Process viewer = desk.start_viewer(folder, arguments);
    desk.act("search --sync --onlyvisible --name dibhr sleep 0.6 " + commands + "key q");
    REQUIRE(viewer.wait() == 0);
    return read_session(folder / "hand.dibhr");
}

}  // namespace

TEST_CASE("arrows seek by 5, 1 and 60 seconds, Home and End to the start and the last second",
          "[playing]") {
    std::string commands = "key space sleep 0.3 ";
    for (const char* key :
         {"Home", "Up", "Right", "shift+Right", "shift+Left", "Left", "Down", "End"}) {
        commands += std::string("key ") + key + " sleep 0.7 ";
    }
    std::vector<double> held = held_moments(played({}, commands));
    const std::vector<double> wanted{0.0, 60.0, 65.0, 66.0, 65.0, 60.0, 0.0, 99.0};
    if (held.size() > wanted.size()) held.erase(held.begin());  // where it was paused
    CAPTURE(held);
    REQUIRE(held.size() == wanted.size());
    for (std::size_t k = 0; k < wanted.size(); ++k)
        CHECK_THAT(held[k], WithinAbs(wanted[k], 1.5 * kFrame_s));
}

TEST_CASE("every press counts, as short as it is, also of many between two pictures", "[playing]") {
    const Desk desk;
    const TemporaryFolder folder;
    make_long_films(folder);
    Process viewer = desk.start_viewer(
        folder, {"long_color.mkv", "--raw-depth", "--device", "mouse", "--record", "hand.dibhr",
                 "--size", "640x480", "--seconds", "30", "--pause"});
    desk.act("search --sync --onlyvisible --name dibhr sleep 0.6");
    const auto press = [](const std::string& key) {
        return "keydown " + key + " sleep 0.012 keyup " + key + " sleep 0.05 ";
    };
    // No picture is drawn while it stands still.
    viewer.send(SIGSTOP);
    desk.act(press("Right") + press("Up") + press("Right") + press("Right"));
    viewer.send(SIGCONT);
    desk.act("sleep 0.7");
    for (int k = 0; k < 10; ++k) {  // ten pictures a second
        viewer.send(SIGSTOP);
        desk.act(k % 2 == 0 ? press("shift+Left") : "sleep 0.06");
        viewer.send(SIGCONT);
        desk.act("sleep 0.04");
    }
    desk.act("sleep 0.7 key q");
    REQUIRE(viewer.wait() == 0);
    const std::vector<double> held = held_moments(read_session(folder / "hand.dibhr"));
    CAPTURE(held);
    REQUIRE(held.size() >= 3);
    CHECK_THAT(held.front(), WithinAbs(0.0, 1.5 * kFrame_s));
    CHECK_THAT(held[1], WithinAbs(75.0, 1.5 * kFrame_s));
    CHECK_THAT(held.back(), WithinAbs(70.0, 1.5 * kFrame_s));
}

TEST_CASE("own keys move the video, and are lost to what had them", "[playing]") {
    const std::string own =
        "[keys]\nplay-or-pause = [\"F5\", \"Z\"]\nseek-forward-far = \"L\"\ngo-to-end = "
        "\"Shift+L\"\n"
        "seek-forward = \"Home\"\ngo-to-start = \"Ctrl+G\"\n";
    std::string commands = "key F5 sleep 0.3 ";
    for (const char* key : {"ctrl+g", "space", "l", "Up", "Home", "End", "shift+l", "ctrl+g"})
        commands += std::string("key ") + key + " sleep 0.7 ";
    std::vector<double> held = held_moments(played({}, commands, own));
    const std::vector<double> wanted{0.0, 60.0, 65.0, 99.0, 0.0};
    if (held.size() > wanted.size()) held.erase(held.begin());  // where it was paused
    CAPTURE(held);
    REQUIRE(held.size() == wanted.size());
    for (std::size_t k = 0; k < wanted.size(); ++k)
        CHECK_THAT(held[k], WithinAbs(wanted[k], 1.5 * kFrame_s));
}

TEST_CASE("a key doubles the speed, and Backspace makes it normal again", "[playing]") {
    const std::string back = GENERATE("", "key BackSpace sleep 0.3 ");
    const double speed = back.empty() ? 2.0 : 1.0;
    CAPTURE(speed);
    const std::vector<Row> rows = played({}, "key Prior sleep 0.3 " + back + "sleep 2 ");
    REQUIRE(rows.size() > 1500);
    const Row& from = rows[rows.size() - 1200];
    const Row& to = rows[rows.size() - 100];
    CHECK_THAT((to.video_s - from.video_s) / (to.t_s - from.t_s), WithinAbs(speed, 0.25));
}

TEST_CASE("options say where it begins, that it stands still, and how fast it goes on",
          "[playing]") {
    SECTION("standing still") {
        const std::vector<Row> rows = played({"--start", "42", "--pause"}, "sleep 0.6 ");
        const std::vector<double> held = held_moments(rows);
        REQUIRE(held.size() == 1);
        CHECK_THAT(held[0], WithinAbs(42.0, 1.5 * kFrame_s));
    }
    SECTION("faster") {
        const std::vector<Row> rows = played({"--start", "10", "--speed", "3"}, "sleep 2 ");
        REQUIRE(rows.size() > 1500);
        const Row& from = rows[rows.size() - 1200];
        const Row& to = rows[rows.size() - 100];
        CHECK(from.video_s > 10.0);
        CHECK_THAT((to.video_s - from.video_s) / (to.t_s - from.t_s), WithinAbs(3.0, 0.4));
    }
    SECTION("not again from the start") {
        const std::vector<double> held =
            held_moments(played({"--start", "99", "--loop", "off"}, "sleep 2.5 "));
        REQUIRE(held.size() == 1);
        CHECK_THAT(held[0], WithinAbs(100.0 - kFrame_s, 0.5 * kFrame_s));
    }
}

TEST_CASE("a key plays from here to here again and again, and then all again", "[playing]") {
    const std::vector<Row> rows =
        played({"--start", "50"}, "key a sleep 0.8 key a sleep 3 key a sleep 2 ");
    double latest_s = 0.0;
    int laps = 0;
    for (std::size_t k = 1; k < rows.size(); ++k) {
        if (!rows[k].surface || !rows[k - 1].surface) continue;
        if (rows[k].video_s < rows[k - 1].video_s - 0.3) ++laps;
        latest_s = std::max(latest_s, rows[k].video_s);
    }
    CHECK(laps >= 2);
    CHECK(laps <= 5);
    CHECK(rows.back().video_s > 51.5);  // beyond where it was to end
    CHECK(latest_s < 60.0);
}

TEST_CASE("options say what part is played, once or again and again", "[playing]") {
    const std::string looping = GENERATE("on", "off");
    CAPTURE(looping);
    std::vector<Row> rows = played({"--start", "10", "--end", "11", "--loop", looping}, "sleep 3 ");
    const auto is_there = [](const Row& row) {
        return row.surface && row.video_s >= 10.0 - kFrame_s;
    };
    // It is opened at its very beginning, and sought to the part at once.
    rows.erase(rows.begin(), std::find_if(rows.begin(), rows.end(), is_there));
    REQUIRE(rows.size() > 1000);
    for (const Row& row : rows) {
        if (!row.surface) continue;
        CHECK(row.video_s >= 10.0 - kFrame_s);
        CHECK(row.video_s <= 11.0 + kFrame_s);
    }
    const auto goes_back = [](const Row& before, const Row& after) {
        return before.surface && after.surface && after.video_s < before.video_s - 0.3;
    };
    const bool again = std::adjacent_find(rows.begin(), rows.end(), goes_back) != rows.end();
    CHECK(again == (looping == "on"));
    if (looping == "off") CHECK_THAT(rows.back().video_s, WithinAbs(11.0, 1.5 * kFrame_s));
}

TEST_CASE("a window that fills the screen does not change the size it is kept with", "[playing]") {
    const Desk desk;
    const TemporaryFolder folder;
    make_long_films(folder);
    Process viewer =
        desk.start_viewer(folder, {"long_color.mkv", "--device", "mouse", "--size", "640x480",
                                   "--full-screen", "--seconds", "4", "--screenshot", "last.png"});
    REQUIRE(viewer.wait() == 0);
    const MediaDescription picture = describe_media(folder / "last.png");
    CHECK(picture.colour_columns == 1280);
    CHECK(picture.colour_rows == 800);
    run_shell("! grep -rqE '1280|800' '" + folder.path().string() + "' --include=settings.toml");
}

TEST_CASE("with the panels hidden the force switch stays, and the time line comes to the pointer",
          "[playing]") {
    const auto rows = played({},
                             "key Tab sleep 0.3 key space sleep 0.3 "
                             // The switch in the corner, where nothing else is.
                             "mousemove 590 460 sleep 0.3 mousedown 1 sleep 0.2 mouseup 1 "
                             "sleep 0.4 mousedown 1 sleep 0.2 mouseup 1 sleep 0.4 "
                             // The line, a little right of its middle.
                             "mousemove 200 452 sleep 0.4 mousedown 1 sleep 0.2 mouseup 1 "
                             "sleep 0.8 ");
    const auto is_off = [](const Row& row) { return row.cut == static_cast<int>(SafetyCut::off); };
    const auto off = std::find_if(rows.begin(), rows.end(), is_off);
    REQUIRE(off != rows.end());
    CHECK(std::find_if_not(off, rows.end(), is_off) != rows.end());
    CHECK(rows.back().video_s > 20.0);
    CHECK(rows.back().video_s < 95.0);
}

TEST_CASE(
    "while E explains an update the video stands still, its step keys step the explanation, "
    "and the hand is felt on",
    "[playing]") {
    const std::vector<Row> rows =
        played({"--start", "20"},
               "mousemove 200 250 sleep 0.3 mousedown 1 sleep 0.5 key e sleep 0.6 "
               "key period sleep 0.5 key period sleep 0.5 mousemove 240 250 sleep 0.6 "
               "key e sleep 0.4 key period sleep 0.6 ");
    const std::vector<double> held = held_moments(rows);
    REQUIRE(held.size() == 2);
    CHECK(held[1] > held[0]);  // paused between two frames, it steps to the next one
    CHECK(held[1] <= held[0] + 1.01 * kFrame_s);
    const auto in_still = [&](const Row& row) {
        return row.surface && row.contact && !(row.video_s < held[0] || row.video_s > held[0]);
    };
    const auto first = std::find_if(rows.begin(), rows.end(), in_still);
    const auto last = std::find_if(rows.rbegin(), rows.rend(), in_still);
    REQUIRE(first != rows.end());
    REQUIRE(last != rows.rend());
    CHECK(last->proxy.x > first->proxy.x + 2.0);
}

TEST_CASE(
    "another recording is opened with the pointer alone, and the next one of the folder by key",
    "[playing]") {
    const Desk desk;
    const TemporaryFolder folder;
    make_long_films(folder);
    fs::create_directory(folder / "films");
    for (const std::string of : {"_color.mkv", "_depth.mkv"}) {
        for (const std::string name : {"films/long", "films/other", "films/still"})
            fs::copy_file(folder / ("long" + of), folder / (name + of));
    }
    Process viewer =
        desk.start_viewer(folder, {"films/long_color.mkv", "--raw-depth", "--device", "mouse",
                                   "--record", "hand.dibhr", "--seconds", "60"});
    desk.act(
        "search --sync --onlyvisible --name dibhr sleep 0.8 "
        "mousemove 970 97 sleep 0.3 mousedown 1 sleep 0.1 mouseup 1 sleep 0.8 "  // Open
        "mousemove 350 280 sleep 0.3 mousedown 1 sleep 0.1 mouseup 1 sleep 0.1 "
        "mousedown 1 sleep 0.1 mouseup 1 sleep 1.5 mousemove 300 600 "
        "key ctrl+Next sleep 1.5 key ctrl+q");
    REQUIRE(viewer.wait() == 0);
    std::vector<std::string> opened;
    const Session session(folder / "hand.dibhr");
    for (const SessionSource& source : session.sources())
        opened.push_back(source.depth.file.filename().string());
    opened.erase(std::unique(opened.begin(), opened.end()), opened.end());
    CHECK(opened ==
          std::vector<std::string>{"long_depth.mkv", "other_depth.mkv", "still_depth.mkv"});
}

TEST_CASE("a copied view is taken again: the hand then touches where it did", "[playing]") {
    const auto touched = [](const std::string& keys) {
        const auto rows = played({"--start", "20", "--pause"},
                                 "mousemove 200 260 sleep 0.3 key ctrl+c sleep 0.3 " + keys +
                                     "mousedown 1 sleep 0.8 mouseup 1 ");
        const auto first = std::find_if(rows.begin(), rows.end(),
                                        [](const Row& row) { return row.surface && row.contact; });
        REQUIRE(first < rows.end());
        return first->proxy;
    };
    const std::string away = "click 4 click 4 click 4 click 4 sleep 0.3 ";
    const Vec3 before = touched("");
    const Vec3 elsewhere = touched(away);
    const Vec3 again = touched(away + "key ctrl+v sleep 0.4 ");
    CHECK(glm::length(elsewhere - before) > 2.0);
    CHECK(glm::length(again - before) < 0.5);
}

TEST_CASE(
    "a file is found again as it was left: relief and view, and, where it is wished, the moment",
    "[playing]") {
    const Desk desk;
    const TemporaryFolder folder;
    make_long_films(folder);
    run_shell(
        "ffmpeg -nostdin -v error -y -f lavfi -i \"color=gray:s=64x48:r=10:d=100,"
        "format=gray,geq=lum='40+3*X'\" -c:v ffv1 '" +
        (folder / "long_depth.mkv").string() + "'");  // a slope
    const auto rows_of = [&](const std::vector<std::string>& options, const std::string& commands) {
        static int taken = 0;
        const std::string session = "hand" + std::to_string(++taken) + ".dibhr";
        std::vector<std::string> arguments{"long_color.mkv", "--device",  "mouse",
                                           "--record",       session,     "--size",
                                           "640x480",        "--seconds", "30"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        Process viewer = desk.start_viewer(folder, arguments);
        desk.act("search --sync --onlyvisible --name dibhr sleep 0.6 " + commands + "key q");
        REQUIRE(viewer.wait() == 0);
        return read_session(folder / session);
    };
    const auto touched = [](const std::vector<Row>& rows) {
        const auto first = std::find_if(rows.begin(), rows.end(),
                                        [](const Row& row) { return row.surface && row.contact; });
        REQUIRE(first < rows.end());
        return first->proxy;
    };
    const std::string press = "mousemove 200 260 sleep 0.3 mousedown 1 sleep 0.8 mouseup 1 ";
    keep_memory(folder / "state/dibhr/files", folder / "long_color.mkv", {.relief_px = 30.0});
    const Vec3 zoomed = touched(
        rows_of({"--start", "50", "--pause", "--resume", "on"},
                "mousemove 200 260 sleep 0.2 click 4 click 4 click 4 click 4 sleep 0.3 " + press));
    const std::vector<Row> again = rows_of({"--pause", "--resume", "on"}, press);
    CHECK(glm::length(touched(again) - zoomed) < 0.5);
    CHECK_THAT(again.back().video_s, WithinAbs(50.0, 1.5 * kFrame_s));
    const Vec3 other = touched(rows_of({"--pause", "--relief", "80"}, press));
    CHECK(std::abs(other.z - zoomed.z) > 10.0);
    const std::vector<Row> anew = rows_of({"--pause"}, press);  // 80 was for once
    CHECK(glm::length(touched(anew) - zoomed) < 0.5);
    CHECK_THAT(anew.back().video_s, WithinAbs(0.0, 1.5 * kFrame_s));
}

TEST_CASE("a window that stays shows what cannot be opened, and opens something else",
          "[playing]") {
    const Desk desk;
    const TemporaryFolder folder;
    write_depth_png(folder / "cup_depth.png", 64, 48, 120);
    const std::vector<std::string> wrong{
        "no_depth.png", "--stay", "--device",          "mouse",      "--size", "800x600",
        "--seconds",    "60",     "--screenshot-name", "seen-{file}"};
    CHECK(run_dibhr(folder, {"no_depth.png", "--device", "mouse"}).exit_code == 1);
    Process viewer = desk.start_viewer(folder, wrong);
    // Keys that want a picture find none.
    desk.act(
        "search --sync --onlyvisible --name dibhr sleep 1 key Escape sleep 0.2 key e g n k i d "
        "a period Home F sleep 0.4 key n g sleep 0.2 mousemove 200 300 mousedown 1 sleep 0.2 "
        "mouseup 1 key ctrl+o sleep 1.5 key Return sleep 1.5 key s sleep 1.5 key q");
    REQUIRE(viewer.wait() == 0);
    CHECK(fs::exists(folder / "seen-cup_depth.png"));
}
