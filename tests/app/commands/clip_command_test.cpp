// `dibhr clip`: pictures drawn off line, on a virtual display.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/app/program/command_program.hpp"
#include "tests/app/program/desk.hpp"
#include "tests/app/program/passing_ticks.hpp"
#include "tests/app/program/recorded_session.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/eventually.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;
namespace fs = std::filesystem;

namespace {

constexpr int kColumns = 320;
constexpr int kRows = 240;
constexpr std::size_t kPictureBytes = std::size_t{3} * kColumns * kRows;

/// Two seconds of grey film, which stands still.
void put_films(const TemporaryFolder& folder) {
    run_shell(folder,
              "ffmpeg -nostdin -v error -f lavfi -i color=gray:s=64x48:r=20:d=2 -c:v ffv1 "
              "film_color.mkv -c:v ffv1 -pix_fmt gray film_depth.mkv");
}

/// Ten seconds of a hand that hovers over the middle of the film and, from 4 to 7 s, presses.
void write_goals(const fs::path& file) {
    std::string text = "t,x,y,z\n";
    for (int k = 0; k < 10'000; ++k) {
        const bool presses = k >= 4000 && k < 7000;
        text += std::to_string(0.001 * k) + ",32,24," + (presses ? "-40" : "60") + "\n";
    }
    write_text(file, text);
}

std::vector<std::string> clip_of(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "clip");
    arguments.insert(arguments.end(), {"--size", "320x240"});
    return arguments;
}

void make_clip(const TemporaryFolder& folder, const std::vector<std::string>& arguments) {
    const Desk desk;
    WindowProgram program = desk.start(folder, clip_of(arguments));
    const int exit_code = program.wait();
    REQUIRE(exit_code == 0);
}

/// All pictures of the clip, RGB.
std::string pictures_of(const TemporaryFolder& folder, const std::string& clip) {
    run_shell(folder, "ffmpeg -nostdin -v error -i '" + clip +
                          "' -f rawvideo -pix_fmt rgb24 -vsync passthrough -y pictures");
    return read_text(folder / "pictures");
}

/// The share of pixels of picture k that differ visibly.
double difference(const std::string& a, const std::string& b, std::size_t k) {
    std::size_t differing = 0;
    for (std::size_t at = k * kPictureBytes; at < (k + 1) * kPictureBytes; ++at)
        if (std::abs(static_cast<unsigned char>(a[at]) - static_cast<unsigned char>(b[at])) > 24)
            ++differing;
    return static_cast<double>(differing) / static_cast<double>(kPictureBytes);
}

void check_refused(const TemporaryFolder& folder, const std::vector<std::string>& arguments,
                   int exit_code, const std::string& words) {
    const std::size_t files = names_in(folder.path()).size();
    const ProgramResult result = run_dibhr(folder, clip_of(arguments));
    INFO(result.errors);
    CHECK(result.exit_code == exit_code);
    CHECK(split(result.errors, '\n').size() == 2);
    CHECK(contains(result.errors, words));
    CHECK(names_in(folder.path()).size() == files);
}

}  // namespace

TEST_CASE("a clip of ten seconds at 30 a second has 300 pictures and the same bytes twice",
          "[clip]") {
    const TemporaryFolder folder;
    put_films(folder);
    write_goals(folder / "goals.csv");
    make_clip(folder, {"film_color.mkv", "--goals", "goals.csv", "--out", "one.mp4"});
    make_clip(folder, {"film_color.mkv", "--goals", "goals.csv", "--out", "two.mp4"});
    const std::string pictures = pictures_of(folder, "one.mp4");
    CHECK(pictures.size() == 300 * kPictureBytes);
    CHECK(read_text(folder / "one.mp4") == read_text(folder / "two.mp4"));

    SECTION("what the hand does is seen when it does it, and nowhere else") {
        make_clip(folder, {"film_color.mkv", "--end", "10", "--out", "still.mp4"});
        const std::string untouched = pictures_of(folder, "still.mp4");
        REQUIRE(untouched.size() == pictures.size());
        const double hovers = difference(pictures, untouched, 60);
        const double presses = difference(pictures, untouched, 160);
        CHECK(hovers > 0.0);
        CHECK(presses > 0.0);
        CHECK(presses != hovers);
    }
    SECTION("a part of it shows the same moments") {
        make_clip(folder, {"film_color.mkv", "--goals", "goals.csv", "--start", "5", "--end", "6",
                           "--fps", "10", "--out", "part.mp4"});
        const std::string part = pictures_of(folder, "part.mp4");
        REQUIRE(part.size() == 10 * kPictureBytes);
        for (const std::size_t k : {0U, 5U, 9U})
            CHECK(difference(part, pictures.substr((150 + 2 * k) * kPictureBytes), k) < 0.01);
    }
}

TEST_CASE("a clip of a session shows its hand with the video and with the stored surface alone",
          "[clip]") {
    const TemporaryFolder folder;
    put_films(folder);
    write_goals(folder / "goals.csv");
    const Desk desk;
    WindowProgram viewer =
        desk.start_viewer(folder, {"film_color.mkv", "--device", "goals:goals.csv", "--record",
                                   "mine.dibhr", "--size", "320x240"});
    viewer.wait_until([](const Seen& now) { return now.contact; });
    wait_for_ticks(viewer, 500);  // else the contact may fall between two pictures of the clip
    desk.press("key q");
    REQUIRE(viewer.wait() == 0);
    make_clip(folder, {"mine.dibhr", "--out", "video.mp4"});
    const std::string pictures = pictures_of(folder, "video.mp4");
    REQUIRE(pictures.size() > 30 * kPictureBytes);
    CHECK(difference(pictures, pictures.substr(pictures.size() - kPictureBytes), 0) > 0.0);
    make_clip(folder, {"mine.dibhr", "--algorithm", "neighborhood", "--out", "other.mp4"});
    const bool alike = pictures_of(folder, "other.mp4") == pictures;
    CHECK_FALSE(alike);  // the pictures themselves would fill the report for minutes
    fs::remove(folder / "film_color.mkv");
    fs::remove(folder / "film_depth.mkv");
    make_clip(folder, {"mine.dibhr", "--out", "stored.mp4"});
    const std::string stored = pictures_of(folder, "stored.mp4");
    REQUIRE(stored.size() == pictures.size());
    CHECK(difference(stored, stored.substr(stored.size() - kPictureBytes), 0) > 0.0);
}

TEST_CASE("a clip that is interrupted leaves nothing", "[clip]") {
    const TemporaryFolder folder;
    put_films(folder);
    const Desk desk;
    WindowProgram program =
        desk.start(folder, clip_of({"film_color.mkv", "--end", "100000", "--out", "long.mp4"}));
    const auto clips = [&] {
        return std::ranges::count_if(names_in(folder.path()), [](const std::string& name) {
            return name.starts_with("long.mp4");
        });
    };
    REQUIRE(eventually([&] { return clips() == 1; }));
    program.interrupt();
    CHECK(program.wait() == 130);
    CHECK(clips() == 0);
}

TEST_CASE("a clip that cannot be made is one line and no file", "[clip]") {
    const TemporaryFolder folder;
    put_films(folder);
    write_depth_png(folder / "still.png", 64, 48, 100, 1);
    write_text(folder / "bad.csv", "t,x,y,z\n0,1,2,here\n");
    check_refused(folder, {"film_color.mkv", "--out", "a.mp4"}, 1, "no display");
    check_refused(folder, {"still.png", "--depth-code", "grey", "--out", "a.mp4"}, 1, "--end");
    check_refused(folder, {"none.mkv", "--out", "a.mp4"}, 1, "none.mkv");
    check_refused(folder, {"film_color.mkv", "--goals", "bad.csv", "--out", "a.mp4"}, 1, "bad.csv");
    check_refused(folder, {"film_color.mkv", "--out", "film_depth.mkv"}, 1, "is also read");
    check_refused(folder, {"film_color.mkv", "--start", "5", "--out", "a.mp4"}, 1, "lasts 2 s");
    check_refused(folder, {"film_color.mkv", "--out", "-"}, 2, "name of a file");
    check_refused(folder, {"film_color.mkv", "--start", "2", "--end", "1", "--out", "a.mp4"}, 2,
                  "--end 1 is not after --start 2");
    check_refused(folder, {"film_color.mkv", "--view", "up", "--out", "a.mp4"}, 2, "--view");
    check_refused(folder, {"film_color.mkv"}, 2, "--out");
    record_session(
        folder / "mine.dibhr",
        {.colour = folder / "film_color.mkv", .depth = folder / "film_depth.mkv", .seconds = 0.1});
    check_refused(folder, {"mine.dibhr", "--cleaning", "raw", "--out", "a.mp4"}, 2, "is a session");
}
