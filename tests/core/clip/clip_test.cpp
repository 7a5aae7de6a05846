// Clips as a player reads them: their length, the times of their pictures, and what is in them.
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "core/clip/clip_file.hpp"
#include "core/clip/clip_recorder.hpp"
#include "core/clip/live_recorder.hpp"
#include "core/error.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/eventually.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;
using Catch::Matchers::WithinAbs;
namespace fs = std::filesystem;

namespace {

constexpr double kRounding_s = 0.0011;  // of times, in the file

ColourImage plain(int columns, int rows, std::array<std::uint8_t, 3> colour) {
    ColourImage picture{columns, rows, {}};
    for (int k = 0; k < columns * rows; ++k)
        picture.rgb.insert(picture.rgb.end(), colour.begin(), colour.end());
    return picture;
}

ColourImage noisy(int columns, int rows, unsigned seed) {
    ColourImage picture = plain(columns, rows, {});
    for (std::uint8_t& level : picture.rgb) {
        seed = seed * 1664525U + 1013904223U;
        level = static_cast<std::uint8_t>(seed >> 24U);
    }
    return picture;
}

/// What a shell command says; it must end with 0.
std::string said(const TemporaryFolder& folder, const std::string& command) {
    const fs::path answer = folder / "answer";
    const std::string line = command + " > '" + answer.string() + "' 2>&1";
    CAPTURE(line);
    REQUIRE(std::system(line.c_str()) == 0);  // NOLINT(cert-env33-c): of a test
    std::string text = read_text(answer);
    fs::remove(answer);
    return text;
}

std::string probed(const TemporaryFolder& folder, const fs::path& clip, const std::string& what) {
    return said(folder, "ffprobe -v error -select_streams v:0 -of csv=p=0 -show_entries " + what +
                            " '" + clip.string() + "'");
}

double length_s(const TemporaryFolder& folder, const fs::path& clip) {
    return std::stod(probed(folder, clip, "format=duration"));
}

std::vector<double> times_s(const TemporaryFolder& folder, const fs::path& clip) {
    std::istringstream lines(probed(folder, clip, "packet=pts_time"));
    std::vector<double> times;
    for (std::string line; std::getline(lines, line);) times.push_back(std::stod(line));
    return times;
}

struct Picture {
    int columns;
    std::string rgb;
    /// 0 .. 255
    [[nodiscard]] int level(int i, int j, int channel) const {
        return static_cast<std::uint8_t>(rgb[3UL * static_cast<std::size_t>(j * columns + i) +
                                             static_cast<std::size_t>(channel)]);
    }
};

/// The last one of a clip of that size.
Picture last_picture(const TemporaryFolder& folder, const fs::path& clip, int columns, int rows) {
    const fs::path raw = folder / "last.rgb";
    said(folder, "ffmpeg -nostdin -y -v error -sseof -1 -i '" + clip.string() +
                     "' -f rawvideo -pix_fmt rgb24 '" + raw.string() + "'");
    const std::string all = read_text(raw);
    fs::remove(raw);
    const std::size_t bytes = 3UL * static_cast<std::size_t>(columns * rows);
    REQUIRE(all.size() >= bytes);
    return {columns, all.substr(all.size() - bytes)};
}

std::vector<std::string> names(const TemporaryFolder& folder) {
    return names_in(folder.path());
}

}  // namespace

TEST_CASE("a video of what is live that nobody refers to leaves nothing, and its name is free",
          "[clip]") {
    const TemporaryFolder folder;
    for (int again = 0; again < 2; ++again) {
        LiveRecorder recorder(live_files_beside(folder / "a.dibhr"));
        CHECK(names_in(folder.path()) == std::vector<std::string>{"a.color.mkv", "a.depth.mkv"});
        recorder.discard();
        CHECK(names_in(folder.path()).empty());
    }
}

TEST_CASE(
    "a clip shows each picture at its time, the last until the end, and begins with its index",
    "[clip]") {
    const TemporaryFolder folder;
    const fs::path file = folder / "view.mp4";
    const ClipEnd how = GENERATE(ClipEnd::indexed, ClipEnd::at_once);
    const std::vector<double> shown{0.0, 0.033, 0.05, 0.4, 0.433, 1.9, 1.95, 2.0, 2.6};
    {
        ClipFile clip(file, ClipNameConflict::replaces);
        unsigned seed = 0;
        for (const double at_s : shown) clip.add(noisy(160, 90, ++seed), at_s);
        clip.add(noisy(160, 90, 99), 2.6);  // no time between the two
        CHECK_FALSE(fs::exists(file));
        CHECK(clip.finish(3.1, how) == file);
    }
    CHECK_THAT(length_s(folder, file), WithinAbs(3.1, kRounding_s));
    const std::vector<double> times = times_s(folder, file);
    REQUIRE(times.size() == shown.size());
    for (std::size_t k = 0; k < shown.size(); ++k)
        CHECK_THAT(times[k], WithinAbs(shown[k], kRounding_s));
    CHECK(
        contains(probed(folder, file, "stream=codec_name,pix_fmt,width,height"), "160,90,yuv420p"));
    const std::string bytes = read_text(file);
    CHECK(bytes.find("moov") < bytes.find("mdat"));
    CHECK((bytes.find("moof") == std::string::npos) == (how == ClipEnd::indexed));
    CHECK(names(folder) == std::vector<std::string>{"view.mp4"});
}

TEST_CASE("a clip has the colours of its pictures, whatever their size", "[clip]") {
    const TemporaryFolder folder;
    const fs::path file = folder / "view.mp4";
    const int odd = GENERATE(0, 1);
    const std::array<std::uint8_t, 3> colour{200, 60, 30};
    ClipFile clip(file, ClipNameConflict::replaces);
    for (int k = 0; k < 10; ++k) clip.add(plain(160 + odd, 90 + odd, colour), 0.05 * k);
    clip.finish(0.5, ClipEnd::indexed);
    const Picture last = last_picture(folder, file, 160, 90);
    for (int channel = 0; channel < 3; ++channel)
        CHECK(std::abs(last.level(80, 45, channel) - colour[static_cast<std::size_t>(channel)]) <=
              5);
}

TEST_CASE("a clip of a window of odd size loses a row and a column, and is as crisp", "[clip]") {
    const TemporaryFolder folder;
    const fs::path file = folder / "view.mp4";
    ColourImage stripes = plain(161, 91, {0, 0, 0});
    for (std::size_t k = 0; k < stripes.rgb.size(); ++k)
        if (k / 3 % 161 % 2 == 1) stripes.rgb[k] = 255;
    ClipFile clip(file, ClipNameConflict::replaces);
    for (int k = 0; k < 5; ++k) clip.add(stripes, 0.1 * k);
    clip.finish(0.5, ClipEnd::indexed);
    const Picture last = last_picture(folder, file, 160, 90);
    for (int i = 0; i < 160; ++i) {
        INFO(i);
        CHECK((i % 2 == 1 ? 255 - last.level(i, 45, 1) : last.level(i, 45, 1)) < 60);
    }
}

TEST_CASE("a picture of another size keeps its shape, between black borders", "[clip]") {
    const TemporaryFolder folder;
    const fs::path file = folder / "view.mp4";
    const int columns = GENERATE(90, 61, 77, 102, 113);
    ClipFile clip(file, ClipNameConflict::replaces);
    clip.add(plain(160, 90, {20, 200, 20}), 0.0);
    clip.add(plain(columns, 90, {20, 200, 20}), 0.1);
    clip.finish(0.5, ClipEnd::indexed);
    const Picture last = last_picture(folder, file, 160, 90);
    INFO(columns);
    const int left = (160 - columns) / 2;
    for (const int j : {2, 45, 87}) {
        INFO(j);
        for (int i = 0; i < 160; ++i) {
            INFO(i);
            if (i < left - 3 || i > 163 - left) CHECK(last.level(i, j, 1) < 20);
            if (i > left + 3 && i < 157 - left) CHECK(last.level(i, j, 1) > 180);
        }
    }
}

TEST_CASE("a picture with nothing in it leaves the one before it", "[clip]") {
    const TemporaryFolder folder;
    const fs::path file = folder / "view.mp4";
    const auto [columns, rows] = GENERATE(std::pair{0, 0}, std::pair{1, 90}, std::pair{90, 0});
    ClipFile clip(file, ClipNameConflict::replaces);
    clip.add(plain(160, 90, {20, 200, 20}), 0.0);
    clip.add(plain(columns, rows, {200, 20, 20}), 0.1);
    clip.finish(0.5, ClipEnd::indexed);
    CHECK(last_picture(folder, file, 160, 90).level(80, 45, 1) > 180);
}

TEST_CASE("what is written of a clip plays before it is finished", "[clip]") {
    const TemporaryFolder folder;
    ClipFile clip(folder / "view.mp4", ClipNameConflict::replaces);
    unsigned seed = 0;
    for (int k = 0; k < 30; ++k) clip.add(noisy(160, 90, ++seed), k / 9.0);  // a slow machine
    const fs::path copy = folder / "copy.mp4";
    fs::copy_file(folder / names(folder).front(), copy);
    const double length = length_s(folder, copy);
    CHECK(length > 1.9);
    CHECK(length < 3.3);
    CHECK_FALSE(times_s(folder, copy).empty());
}

TEST_CASE("a clip knows from when on what is written of it plays", "[clip]") {
    const double apart_s = GENERATE(0.2, 0.7, 3.0);
    const TemporaryFolder folder;
    ClipFile clip(folder / "view.mp4", ClipNameConflict::replaces);
    CHECK_FALSE(clip.plays());
    unsigned seed = 0;
    for (int k = 0; k < 12; ++k) {
        clip.add(noisy(160, 90, ++seed), k * apart_s);
        const fs::path copy = folder / "copy.mp4";
        fs::copy_file(folder / names(folder).front(), copy, fs::copy_options::overwrite_existing);
        CAPTURE(apart_s, k);
        CHECK(clip.plays() == !times_s(folder, copy).empty());
        fs::remove(copy);
    }
    CHECK(clip.plays());
}

TEST_CASE("of a clip that is given up, or has no picture, nothing remains", "[clip]") {
    const TemporaryFolder folder;
    const fs::path file = folder / "view.mp4";
    write_text(file, "before");
    {
        ClipRecorder clip(file, ClipNameConflict::replaces);
        clip.add(noisy(160, 90, 1), ClipRecorder::Clock::now());
    }
    {
        ClipRecorder clip(file, ClipNameConflict::replaces);
        clip.stop(ClipRecorder::Clock::now(), ClipEnd::indexed);
        CHECK_THROWS_AS(clip.result(), InputError);
    }
    CHECK(read_text(file) == "before");
    CHECK(names(folder) == std::vector<std::string>{"view.mp4"});
}

TEST_CASE("a clip beside others replaces none", "[clip]") {
    const TemporaryFolder folder;
    write_text(folder / "view.mp4", "before");
    ClipRecorder clip(folder / "view.mp4", ClipNameConflict::adds_number);
    const auto begin = ClipRecorder::Clock::now();
    clip.add(noisy(160, 90, 1), begin);
    clip.stop(begin + std::chrono::seconds(1), ClipEnd::indexed);
    CHECK(clip.result() == folder / "view-2.mp4");
    CHECK_THAT(length_s(folder, folder / "view-2.mp4"), WithinAbs(1.0, kRounding_s));
    CHECK(read_text(folder / "view.mp4") == "before");
}

namespace {

/// How often the calling thread has waited for something.
long waits() {
    rusage used{};
    REQUIRE(::getrusage(RUSAGE_THREAD, &used) == 0);
    return used.ru_nvcsw;
}

}  // namespace

TEST_CASE("a clip that falls behind drops pictures, never time, and waits for nobody", "[clip]") {
    const TemporaryFolder folder;
    const fs::path file = folder / "view.mp4";
    ClipRecorder clip(file, ClipNameConflict::replaces);
    const ColourImage large = noisy(640, 400, 1);
    const auto begin = ClipRecorder::Clock::now();
    // In bursts that lie ready: handed over faster than anything encodes, however slow the machine.
    constexpr int kBursts = 10;
    constexpr int kInOne = 12;
    constexpr int kPictures = kBursts * kInOne;
    int refused = 0;
    int handed_over = 0;
    long waited = 0;
    for (int burst = 0; burst < kBursts; ++burst) {
        std::vector<ColourImage> ready(kInOne, large);
        const long before = waits();
        for (ColourImage& picture : ready) {
            if (!clip.wants_picture()) ++refused;
            clip.add(std::move(picture), begin + std::chrono::milliseconds(25 * handed_over++));
        }
        waited += waits() - before;
    }
    clip.stop(begin + std::chrono::seconds(3), ClipEnd::indexed);
    CHECK(clip.result() == file);
    CHECK(refused > 0);
    CHECK(clip.encoded() < kPictures);
    // Now and then for the lock that the encoding thread holds while it takes a picture.
    CHECK(waited < kPictures / 4);
    CHECK_THAT(length_s(folder, file), WithinAbs(3.0, kRounding_s));
    CHECK(times_s(folder, file).size() == clip.encoded());
}

TEST_CASE("a clip that cannot be written says which file and why, and nothing remains", "[clip]") {
    const TemporaryFolder folder;
    CHECK_THROWS_WITH(ClipRecorder(folder / "nowhere/view.mp4", ClipNameConflict::replaces),
                      Catch::Matchers::Contains("nowhere/view.mp4"));
    // As on a full disk.
    rlimit before{};
    REQUIRE(::getrlimit(RLIMIT_FSIZE, &before) == 0);
    const auto ignored = std::signal(SIGXFSZ, SIG_IGN);
    {
        ClipRecorder clip(folder / "view.mp4", ClipNameConflict::replaces);
        const rlimit small{100'000, before.rlim_max};
        REQUIRE(::setrlimit(RLIMIT_FSIZE, &small) == 0);
        const auto begin = ClipRecorder::Clock::now();
        int k = 0;
        CHECK(eventually([&] {
            clip.add(noisy(320, 200, static_cast<unsigned>(k)),
                     begin + std::chrono::milliseconds(33 * k));
            ++k;
            return clip.done();
        }));
        CHECK_FALSE(clip.wants_picture());
        ::setrlimit(RLIMIT_FSIZE, &before);
        CHECK_THROWS_WITH(clip.result(),
                          Catch::Matchers::Contains("view.mp4: cannot be written (File too large"));
    }
    std::signal(SIGXFSZ, ignored);
    CHECK(names(folder).empty());
}
