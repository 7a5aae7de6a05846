// Clips and pictures of the real window, by keys and by options.
#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "tests/app/program/command_program.hpp"
#include "tests/app/program/desk.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/eventually.hpp"

using namespace dibhr;
using namespace dibhr::test;
using Catch::Matchers::WithinAbs;
namespace fs = std::filesystem;

namespace {

using Clock = std::chrono::steady_clock;

constexpr int kColumns = 640;
constexpr int kRows = 480;
constexpr const char* kSize = "640x480";
constexpr double kRounding_s = 0.002;  // of times in files

/// Two seconds of grey film.
void put_films(const TemporaryFolder& folder) {
    static const TemporaryFolder made;
    if (fs::is_empty(made.path())) {
        run_shell(made,
                  "ffmpeg -nostdin -v error -f lavfi -i color=gray:s=64x48:r=20:d=2 -c:v ffv1 "
                  "film_color.mkv -c:v ffv1 -pix_fmt gray film_depth.mkv");
    }
    fs::copy(made.path(), folder.path());
}

std::vector<std::string> film_and(const std::vector<std::string>& options) {
    std::vector<std::string> arguments{"film_color.mkv", "--raw-depth", "--device",
                                       "mouse",          "--size",      kSize};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return arguments;
}

std::string said(const TemporaryFolder& folder, const std::string& command) {
    run_shell(folder, command + " > answer");
    std::string text = read_text(folder / "answer");
    fs::remove(folder / "answer");
    return text;
}

struct Probed {
    int columns{0}, rows{0}, pictures{0};
    double length_s{0.0};
};

Probed probed(const TemporaryFolder& folder, const std::string& clip) {
    const std::vector<std::string> words =
        split(said(folder,
                   "ffprobe -v error -count_packets -of default=nw=1:nk=1 -show_entries "
                   "stream=width,height,nb_read_packets:format=duration '" +
                       clip + "'"),
              '\n');
    REQUIRE(words.size() >= 4);
    return {std::stoi(words[0]), std::stoi(words[1]), std::stoi(words[2]), std::stod(words[3])};
}

/// Number of pictures in the unfinished clip; 0: it cannot be played yet.
int pictures_written(const TemporaryFolder& folder) {
    const std::string all =
        said(folder,
             "(ffprobe -v quiet -count_packets -of default=nw=1:nk=1 -show_entries "
             "stream=nb_read_packets all.mp4.part* || true)");
    return std::atoi(all.c_str());
}

/// Waits until there are more pictures than that; returns how many.
int wait_for_more(const TemporaryFolder& folder, int pictures) {
    int now = 0;
    REQUIRE(eventually([&] { return (now = pictures_written(folder)) > pictures; }));
    return now;
}

/// Number of pixels as red as the recording sign.
int red_pixels(const std::string& rgb) {
    int red = 0;
    for (std::size_t k = 0; k + 2 < rgb.size(); k += 3) {
        const auto level = [&](std::size_t c) { return static_cast<std::uint8_t>(rgb[k + c]); };
        if (level(0) > 200 && level(1) < 90 && level(2) < 90) ++red;
    }
    return red;
}

/// All pictures of the clip, RGB.
std::string pictures_of(const TemporaryFolder& folder, const std::string& clip) {
    return said(folder, "ffmpeg -nostdin -v error -i '" + clip + "' -f rawvideo -pix_fmt rgb24 -");
}

/// The length in a notice: "Saved clip.mp4, 00:01.250" gives 1.25 s.
double told_length_s(const std::string& notice) {
    const std::string minutes_and_seconds = notice.substr(notice.rfind(' ') + 1);
    const std::size_t colon = minutes_and_seconds.find(':');
    REQUIRE(colon != std::string::npos);
    return 60.0 * std::stod(minutes_and_seconds) + std::stod(minutes_and_seconds.substr(colon + 1));
}

double seconds_since(Clock::time_point moment) {
    return std::chrono::duration<double>(Clock::now() - moment).count();
}

void check_one_clip(const TemporaryFolder& folder) {
    CHECK(std::ranges::count_if(names_in(folder.path()), [](const std::string& name) {
              return contains(name, "all.mp4");
          }) == 1);
}

/// A clip from the start to the window's end, of a window that is made smaller meanwhile.
void check_whole_clip(const std::function<void(const Desk&, const WindowProgram&)>& end_window) {
    const Desk desk;
    const TemporaryFolder folder;
    put_films(folder);
    const auto start = Clock::now();
    WindowProgram viewer = desk.start_viewer(folder, film_and({"--clip", "all.mp4"}));
    viewer.wait_until([](const Seen& now) { return now.clip && now.clip_s > 0.2; });
    viewer.act("windowsize 500 470");
    viewer.wait_until([](const Seen& now) { return now.columns == 500; });
    const double resized_s = viewer.seen().clip_s;
    viewer.wait_until([&](const Seen& now) { return now.clip_s > resized_s + 0.2; });
    const double shown_s = viewer.seen().clip_s;
    end_window(desk, viewer);
    REQUIRE(viewer.wait() == 0);
    const Probed clip = probed(folder, "all.mp4");
    CHECK(clip.columns == kColumns);
    CHECK(clip.rows == kRows);
    CHECK(clip.length_s > shown_s - kRounding_s);
    CHECK(clip.length_s < seconds_since(start));
    check_one_clip(folder);
}

}  // namespace

TEST_CASE(
    "keys save pictures and clips of the window under a sign that is not in them, called as "
    "the pattern says, replacing none, also right before the end",
    "[clip]") {
    const Desk desk;
    const TemporaryFolder folder;
    put_films(folder);
    const auto file = [&folder](const std::string& ending) {
        return folder / ("film_color 000001" + ending);
    };
    write_text(file(".png"), "before");
    WindowProgram viewer =
        desk.start_viewer(folder, film_and({"--pause", "--screenshot-name", "{file} {frame}"}));
    viewer.wait_for_surface();
    viewer.act("key s");
    CHECK(eventually([&] { return fs::exists(file("-2.png")); }));
    viewer.act("key s");
    CHECK(eventually([&] { return fs::exists(file("-3.png")); }));
    viewer.act("key shift+F12");
    CHECK(eventually([&] { return fs::exists(file("-4.png")); }));

    viewer.act("key F9");
    const std::uint64_t begin = viewer.seen().picture;
    viewer.wait_until([begin](const Seen& now) {
        return now.clip && now.clip_s > 0.5 && now.picture > begin + 10;
    });
    CHECK(red_pixels(desk.picture()) > 50);
    viewer.act("key F9");
    viewer.wait_until([](const Seen& now) { return !now.clip; });
    const std::string told = viewer.seen().notice.str();
    CHECK(told.starts_with("Saved "));
    CHECK(contains(told, "/film_color 000001.mp4, "));

    viewer.act("key shift+F9");
    viewer.wait_until([](const Seen& now) { return now.clip && now.clip_s > 0.2; });
    const double relief_s = viewer.seen().clip_s;
    desk.press("key s key shift+F12 key q");
    REQUIRE(viewer.wait() == 0);

    std::vector<std::string> names = names_in(folder.path());
    std::erase_if(names, [](const std::string& name) { return !name.starts_with("film_color "); });
    CHECK(names == std::vector<std::string>{"film_color 000001-2.mp4", "film_color 000001-2.png",
                                            "film_color 000001-3.png", "film_color 000001-4.png",
                                            "film_color 000001-5.png", "film_color 000001-6.png",
                                            "film_color 000001.mp4", "film_color 000001.png"});
    CHECK(read_text(file(".png")) == "before");
    const Probed whole = probed(folder, "film_color 000001.mp4");
    CHECK(whole.columns == kColumns);
    CHECK(whole.rows == kRows);
    CHECK(whole.pictures >= 4);  // as many can wait for the encoder, on any machine
    CHECK_THAT(whole.length_s, WithinAbs(told_length_s(told), kRounding_s));
    CHECK(red_pixels(pictures_of(folder, "film_color 000001.mp4")) == 0);
    const Probed relief = probed(folder, "film_color 000001-2.mp4");
    CHECK(relief.columns < kColumns * 2 / 3);
    CHECK(relief.rows == kRows);
    CHECK(relief.length_s > relief_s - kRounding_s);
    CHECK(read_text(folder / "errors.txt").empty());
}

TEST_CASE("an option saves a clip from start to end, and a resized window stays within its size",
          "[clip]") {
    check_whole_clip([](const Desk& desk, const WindowProgram&) { desk.press("key q"); });
}

// 600 ms after the signal the program would end itself at once, with exit code 1.
TEST_CASE("a clip that an option saves is whole when a signal ends the window",
          "[clip][realtime]") {
    check_whole_clip([](const Desk&, const WindowProgram& viewer) { viewer.send(SIGTERM); });
}

TEST_CASE("a window that hangs when a signal ends it keeps what was written of the clip",
          "[clip]") {
    const Desk desk;
    const TemporaryFolder folder;
    put_films(folder);
    WindowProgram viewer = desk.start_viewer(folder, film_and({"--clip", "all.mp4"}));
    viewer.wait_until([](const Seen& now) { return now.clip; });
    const int first = wait_for_more(folder, 0);
    const int written = wait_for_more(folder, first);
    viewer.wait_for_turn();
    viewer.hang();
    viewer.send(SIGTERM);
    CHECK(viewer.wait() == 1);
    const std::string errors = read_text(folder / "errors.txt");
    CHECK(contains(errors, "hung while drawing"));
    CHECK(contains(errors, "what was written of the clip is in all.mp4"));
    CHECK(std::ranges::count(errors, '\n') == 1);
    const Probed clip = probed(folder, "all.mp4");
    CHECK(clip.length_s > 1.0);
    CHECK(clip.pictures > 1);
    CHECK(clip.pictures >= written);
    check_one_clip(folder);
}

TEST_CASE("a clip that an option saves ends with what is played", "[clip]") {
    const Desk desk;
    const TemporaryFolder folder;
    put_films(folder);
    const auto start = Clock::now();
    WindowProgram viewer =
        desk.start_viewer(folder, film_and({"--clip", "all.mp4", "--end", "0.5", "--no-panels"}));
    REQUIRE(viewer.wait() == 0);
    const Seen last = viewer.seen();
    CHECK_FALSE(last.playing);
    CHECK(last.media_s > 0.4);  // two frames before
    const Probed clip = probed(folder, "all.mp4");
    CHECK(clip.columns < kColumns * 2 / 3);
    CHECK(clip.length_s > last.clip_s - kRounding_s);
    CHECK(clip.length_s < seconds_since(start));
    check_one_clip(folder);
}

TEST_CASE("a clip ends also where its last frames are missing or its end is behind the file",
          "[clip]") {
    const std::string end = GENERATE("1.2", "60");
    CAPTURE(end);
    const Desk desk;
    const TemporaryFolder folder;
    const std::string gap = "select='lt(t,0.5)+gt(t,1.6)'\" -vsync vfr -c:v ffv1 ";
    run_shell(folder, "ffmpeg -nostdin -v error -f lavfi -i color=gray:s=64x48:r=20:d=2 -vf \"" +
                          gap + "film_color.mkv -vf \"" + gap + "-pix_fmt gray film_depth.mkv");
    WindowProgram viewer =
        desk.start_viewer(folder, film_and({"--clip", "all.mp4", "--end", end, "--no-panels"}));
    REQUIRE(viewer.wait() == 0);
    CHECK_FALSE(viewer.seen().playing);
    CHECK(probed(folder, "all.mp4").pictures > 0);
    check_one_clip(folder);
}

TEST_CASE("a run that ends by itself goes on with what is likely of the depth, and says so once",
          "[clip]") {
    const Desk desk;
    const TemporaryFolder folder;
    run_shell(folder,  // far in the middle, without a floor
              "ffmpeg -v error -f lavfi -i \"color=black:s=64x48,format=gray16le,"
              "geq=lum='12000+48000*exp(-hypot(X-32,Y-24)/10)'\" -frames:v 1 a.png");
    const auto errors_of = [&](const std::vector<std::string>& options) {
        std::vector<std::string> arguments{"a.png", "--device", "mouse", "--size", kSize};
        arguments.insert(arguments.end(), options.begin(), options.end());
        CHECK(desk.start_viewer(folder, arguments).wait() == 0);
        return read_text(folder / "errors.txt");
    };
    const std::string errors =
        errors_of({"--seconds", "1", "--screenshot", "last.png", "--log-file", "log.txt"});
    CHECK(errors.starts_with("dibhr: 'a.png': near is assumed to be dark ("));
    CHECK(std::ranges::count(errors, '\n') == 1);
    CHECK(
        contains(read_text(folder / "log.txt"), "warning: 'a.png': near is assumed to be dark ("));
    CHECK(fs::exists(folder / "last.png"));
    CHECK(errors_of({"--seconds", "1", "--sure", "--near", "dark"}).empty());
}

TEST_CASE("a clip that cannot be written is told in one line, and the program goes on", "[clip]") {
    const Desk desk;
    const TemporaryFolder folder;
    put_films(folder);
    WindowProgram viewer = desk.start_viewer(folder, film_and({"--clip", "all.mp4"}),
                                             {"/bin/sh", "-c", "ulimit -f 8; exec \"$@\"", "sh"});
    const std::string trouble = "all.mp4: cannot be written (File too large)";
    viewer.wait_until([&trouble](const Seen& now) {
        return now.message.str().find(trouble) != std::string::npos;
    });
    viewer.wait_for_turn();
    desk.press("key q");
    CHECK(viewer.wait() == 1);
    const std::string errors = read_text(folder / "errors.txt");
    CHECK(contains(errors, "dibhr: " + trouble));
    CHECK(std::ranges::count(errors, '\n') == 1);
    CHECK_FALSE(fs::exists(folder / "all.mp4"));
}
