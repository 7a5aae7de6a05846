// Clips and pictures of the real window, by keys and by options.
#include <algorithm>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <filesystem>
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

constexpr const char* kMeet = "search --sync --onlyvisible --name dibhr sleep 0.6 ";
constexpr int kColumns = 640;
constexpr int kRows = 480;
constexpr const char* kSize = "640x480";

/// Two seconds of grey film.
void make_films(const TemporaryFolder& folder) {
    run_shell(folder,
              "ffmpeg -nostdin -v error -y -f lavfi -i color=gray:s=64x48:r=20:d=2 -c:v ffv1 "
              "film_color.mkv");
    run_shell(folder,
              "ffmpeg -nostdin -v error -y -f lavfi -i color=gray:s=64x48:r=20:d=2,format=gray "
              "-c:v ffv1 film_depth.mkv");
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

std::vector<std::string> saved(const TemporaryFolder& folder, const std::string& ending) {
    std::vector<std::string> names = names_in(folder.path());
    std::erase_if(names, [&ending](const std::string& name) {
        return !name.starts_with("dibhr-") || !name.ends_with(ending);
    });
    return names;
}

/// Pixels as red as the sign, of a picture or the last of a clip.
int red_pixels(const TemporaryFolder& folder, const std::string& file) {
    const std::string rgb =
        said(folder, "ffmpeg -nostdin -v error -i '" + file + "' -f rawvideo -pix_fmt rgb24 -");
    int red = 0;
    for (std::size_t k = 0; k + 2 < rgb.size(); k += 3) {
        const auto level = [&](std::size_t c) { return static_cast<std::uint8_t>(rgb[k + c]); };
        if (level(0) > 200 && level(1) < 90 && level(2) < 90) ++red;
    }
    return red;
}

}  // namespace

TEST_CASE("a key saves clips of the window, under a sign that is not in them", "[clip]") {
    const Desk desk;
    const TemporaryFolder folder;
    make_films(folder);
    const std::string photograph =
        "(sleep 2.5; ffmpeg -nostdin -v error -f x11grab -video_size 640x480 -i $DISPLAY "
        "-frames:v 1 screen.png) & exec \"$@\"";
    Process viewer = desk.start_viewer(folder, film_and({"--seconds", "30"}),
                                       {"/bin/sh", "-c", photograph, "sh"});
    desk.act(std::string(kMeet) + "key F9 sleep 4 key F9");
    REQUIRE(eventually([&] { return saved(folder, ".mp4").size() == 1; }));
    desk.act("search --name dibhr sleep 0.3 key shift+F9 sleep 1 key q");
    REQUIRE(viewer.wait() == 0);
    const std::vector<std::string> clips = saved(folder, ".mp4");
    REQUIRE(clips.size() == 2);
    const Probed whole = probed(folder, clips[0]);
    CHECK(whole.columns == kColumns);
    CHECK(whole.rows == kRows);
    CHECK(whole.pictures > 8);
    CHECK_THAT(whole.length_s, WithinAbs(4.0, 0.4));
    const Probed relief = probed(folder, clips[1]);
    CHECK(relief.columns < kColumns * 2 / 3);
    CHECK(relief.rows == kRows);
    CHECK_THAT(relief.length_s, WithinAbs(1.0, 0.4));
    CHECK(red_pixels(folder, "screen.png") > 50);
    CHECK(red_pixels(folder, clips[0]) == 0);
    CHECK(read_text(folder / "errors.txt").empty());
}

TEST_CASE("an option saves a clip from start to end, and a resized window stays within its size",
          "[clip]") {
    const Desk desk;
    const TemporaryFolder folder;
    make_films(folder);
    SECTION("until the program is to leave") {
        Process viewer =
            desk.start_viewer(folder, film_and({"--clip", "all.mp4", "--seconds", "3"}));
        desk.act(std::string(kMeet) + "sleep 0.5 windowsize 500 470");
        REQUIRE(viewer.wait() == 0);
        const Probed clip = probed(folder, "all.mp4");
        CHECK(clip.columns == kColumns);
        CHECK(clip.rows == kRows);
        CHECK(clip.length_s > 2.0);
        CHECK(clip.length_s < 3.1);
    }
    SECTION("until what is played has ended") {
        Process viewer = desk.start_viewer(
            folder, film_and({"--clip", "all.mp4", "--end", "1.5", "--no-panels"}));
        REQUIRE(viewer.wait() == 0);
        const Probed clip = probed(folder, "all.mp4");
        CHECK(clip.columns < kColumns * 2 / 3);
        CHECK_THAT(clip.length_s, WithinAbs(1.5, 0.3));
    }
    SECTION("until a signal") {
        Process viewer = desk.start_viewer(folder, film_and({"--clip", "all.mp4"}));
        desk.act(std::string(kMeet) + "sleep 1");
        viewer.send(SIGTERM);
        REQUIRE(viewer.wait() == 0);
        CHECK(probed(folder, "all.mp4").length_s > 1.0);
    }
    CHECK(std::ranges::count_if(names_in(folder.path()), [](const std::string& name) {
              return contains(name, "all.mp4");
          }) == 1);
}

TEST_CASE("pictures and clips are called as the pattern says, and replace none", "[clip]") {
    const Desk desk;
    const TemporaryFolder folder;
    make_films(folder);
    write_text(folder / "film_color 000001.png", "before");
    Process viewer = desk.start_viewer(
        folder, film_and({"--pause", "--screenshot-name", "{file} {frame}", "--seconds", "30"}));
    desk.act(std::string(kMeet) + "key s sleep 0.2 key s sleep 0.2 key shift+F12 sleep 0.2 " +
             "key F9 sleep 0.8 key F9 sleep 0.2 key q");
    REQUIRE(viewer.wait() == 0);
    std::vector<std::string> names = names_in(folder.path());
    std::erase_if(names, [](const std::string& name) { return !name.starts_with("film_color "); });
    CHECK(names == std::vector<std::string>{"film_color 000001-2.png", "film_color 000001-3.png",
                                            "film_color 000001-4.png", "film_color 000001.mp4",
                                            "film_color 000001.png"});
    CHECK(read_text(folder / "film_color 000001.png") == "before");
}

TEST_CASE("pictures asked for right before the end are saved", "[clip]") {
    const Desk desk;
    const TemporaryFolder folder;
    make_films(folder);
    Process viewer = desk.start_viewer(folder, film_and({"--seconds", "30"}));
    desk.act(std::string(kMeet) + "key --delay 0 s shift+F12 q");
    REQUIRE(viewer.wait() == 0);
    CHECK(saved(folder, ".png").size() == 2);
}

TEST_CASE("a clip that cannot be written is told in one line, and the program goes on", "[clip]") {
    const Desk desk;
    const TemporaryFolder folder;
    make_films(folder);
    Process viewer = desk.start_viewer(folder, film_and({"--clip", "all.mp4", "--seconds", "5"}),
                                       {"/bin/sh", "-c", "ulimit -f 8; exec \"$@\"", "sh"});
    CHECK(viewer.wait() == 1);
    const std::string errors = read_text(folder / "errors.txt");
    CHECK(contains(errors, "dibhr: all.mp4: cannot be written (File too large)"));
    CHECK(std::ranges::count(errors, '\n') == 1);
    CHECK_FALSE(fs::exists(folder / "all.mp4"));
}
