// Small files that claim large pictures: each is refused by its size before memory is taken.
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/video/sources/media.hpp"
#include "tests/core/video/clips.hpp"
#include "tests/core/video/form_writers.hpp"
#include "tests/core/video/forms.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;

namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kLongEnough = 1 << 18;  ///< not to be refused as too short

std::string number(std::uint32_t value, bool little = true) {
    std::string bytes;
    append_bytes(bytes, value, little);
    return bytes;
}

std::string number16(std::uint16_t value, bool little = true) {
    std::string bytes;
    append_bytes(bytes, value, little);
    return bytes;
}

std::string encoded(const std::string& ending, int type) {
    std::vector<std::uint8_t> bytes;
    REQUIRE(cv::imencode(ending, cv::Mat(64, 64, type, cv::Scalar(7)), bytes));
    return {bytes.begin(), bytes.end()};
}

std::string png(std::uint32_t columns, std::uint32_t rows, char bits, char kind) {
    std::string bytes = encoded(".png", CV_8UC1);
    bytes.replace(16, 10, number(columns, false) + number(rows, false) + bits + kind);
    return bytes;
}

/// Its SOF segment says so.
std::string jpeg(std::uint16_t columns, std::uint16_t rows) {
    std::string bytes = encoded(".jpg", CV_8UC3);
    const std::size_t at = bytes.find("\xff\xc0");
    return bytes.replace(at + 5, 4, number16(rows, false) + number16(columns, false));
}

/// A page of four 64-bit numbers a pixel, or of tiles larger than itself.
std::string tiff_of(const std::vector<std::pair<int, std::uint32_t>>& tags, bool big) {
    std::string bytes = big ? "II\x2b" + std::string(1, '\0') + number(8) + number(16) + number(0)
                            : "II*" + std::string(1, '\0') + number(8);
    bytes += number16(static_cast<std::uint16_t>(tags.size()));
    if (big) bytes += std::string(6, '\0');
    for (const auto& [tag, value] : tags) {
        bytes += number16(static_cast<std::uint16_t>(tag)) + number16(4) + number(1);
        if (big) bytes += number(0);
        bytes += number(value);
        if (big) bytes += number(0);
    }
    return bytes + number(0);
}

/// The depth of the film's only track is claimed as large as that, wherever its size stands.
std::string film(const std::string& ending, const std::string& encoding, const std::string& size,
                 const std::string& claim) {
    const TemporaryFolder folder;
    make_flat_clip(folder / ("a." + ending), 2, 25, encoding, "", 640, 480);
    std::string bytes = read_text(folder / ("a." + ending));
    const std::size_t at = bytes.find(size);
    REQUIRE(at != std::string::npos);
    return bytes.replace(at, claim.size(), claim);
}

std::string exr_of(std::uint32_t columns, std::uint32_t rows) {
    const TemporaryFolder folder;
    exr("Z", cv::Mat(64, 64, CV_32FC1, cv::Scalar(1)))(folder / "a.exr");
    std::string bytes = read_text(folder / "a.exr");
    for (const std::string window : {"dataWindow", "displayWindow"}) {
        const std::size_t at = bytes.find(window) + window.size() + 1 + 6 + 4 + 8;
        bytes.replace(at, 8, number(columns - 1) + number(rows - 1));
    }
    return bytes;
}

/// A chunk of a recording that claims to unpack to a gigabyte.
std::string mcap() {
    const std::string wide = number(0) + number(0);
    const std::string chunk = wide + wide + number(1U << 30U) + number(0) + number(0) + number(4) +
                              "zstd" + number(4) + number(0) + "\x28\xb5\x2f\xfd";
    return "\x89MCAP0\r\n\x06" + number(static_cast<std::uint32_t>(chunk.size())) + number(0) +
           chunk;
}

std::string webp(const std::string& chunk) {
    return "RIFF" + number(kLongEnough - 8) + "WEBP" + chunk;
}

std::string array_header(const std::string& type, const std::string& shape) {
    return npy(type, shape, "");
}

/// Entry of a zip file that claims to unpack to four gigabytes.
std::string packed_array() {
    const TemporaryFolder folder;
    std::string noise(5 << 20, '\0');
    std::uint32_t state = 1;
    for (char& byte : noise) byte = static_cast<char>((state = state * 1664525 + 1013904223) >> 24);
    const std::string array = npy("<f4", "(1000, 1024, 1024)", noise);
    write_zip(folder / "a.npz", {{"depth.npy", array}}, true);
    std::string bytes = read_text(folder / "a.npz");
    const std::string real = number(static_cast<std::uint32_t>(array.size()));
    for (std::size_t at = bytes.find(real); at != std::string::npos; at = bytes.find(real, at + 1))
        bytes.replace(at, 4, number(0xfff00000U));
    return bytes;
}

struct Bomb {
    std::string bytes;
    std::string said;                   ///< in the refusal
    std::uintmax_t holds{kLongEnough};  ///< as long a file, of which only the begin is on the disk
};

std::map<std::string, Bomb> bombs() {
    const std::string wide = "says that it is 30000 x 30000 pixels";
    const std::string mkv_size = "\xb0\x82\x02\x80\xba\x82\x01\xe0";
    const std::string mkv_claim = "\xb0\x82\x75\x30\xba\x82\x75\x30";
    const std::string mov_size =
        number16(640, false) + number16(480, false) + number(0x480000, false);
    const std::string mov_claim = number16(30000, false) + number16(30000, false);
    constexpr std::uintmax_t kGigabytes = 4ULL << 30;
    return {
        {"grey.png", {png(30000, 30000, 8, 0), wide}},
        {"bits.png", {png(30000, 30000, 1, 0), wide}},
        {"palette.png", {png(70000, 1000, 8, 3), "70000 x 1000"}},
        {"four_of_16.png", {png(8000, 8000, 16, 6), "8000 x 8000 pixels of 8 bytes"}},
        {"a.bmp",
         {"BM" + std::string(12, '\0') + number(40) + number(30000) + number(30000), wide}},
        {"a.pgm", {"P5\n30000 30000\n255\n", wide}},
        {"a.ppm", {"P6\n8000 8000\n65535\n", "8000 x 8000 pixels of 6 bytes"}},
        {"a.pam", {"P7\nWIDTH 30000\nHEIGHT 30000\nDEPTH 1\nMAXVAL 255\nENDHDR\n", wide}},
        {"a.jpg", {jpeg(60000, 60000), "60000 x 60000"}},
        {"a.tif", {tiff_of({{256, 30000}, {257, 30000}, {258, 8}}, false), wide}},
        {"big.tif", {tiff_of({{256, 30000}, {257, 30000}, {258, 8}}, true), wide}},
        {"wide.tif",
         {tiff_of({{256, 5000}, {257, 5000}, {258, 64}, {277, 4}}, false),
          "5000 x 5000 pixels of 32 bytes"}},
        {"tiles.tif",
         {tiff_of({{256, 64}, {257, 64}, {258, 8}, {322, 30000}, {323, 30000}}, false), wide}},
        {"canvas.webp",
         {webp("VP8X" + number(10) + number(0) + "\xff\x3f" + std::string(1, '\0') + "\xff\x3f" +
               std::string(1, '\0')),
          "16384 x 16384"}},
        {"lossless.webp", {webp("VP8L" + number(99) + "\x2f\xff\xff\xff\x0f"), "16384 x 16384"}},
        {"lossy.webp",
         {webp("VP8 " + number(99) + std::string("\x10\0\0\x9d\x01\x2a\xff\x3f\xff\x3f", 10)),
          "16383 x 16383"}},
        {"a.jp2", {std::string("\0\0\0\x0cjP  \r\n\x87\n", 12), "unknown size"}},
        {"a.pfm", {"Pf\n30000 30000\n-1\n", wide, kGigabytes}},
        {"a.npy", {array_header("<f4", "(30000, 30000)"), wide, kGigabytes}},
        {"doubles.npy", {array_header("<f8", "(8000, 8000)"), "of 8 bytes", kGigabytes}},
        {"many.npy", {array_header("|u1", "(500000000, 2, 2)"), "500000000 pictures", kGigabytes}},
        {"column.npy", {npy("<f4", "(2000, 500, 500)", "", true), "Fortran order", kGigabytes}},
        {"a.mcap", {mcap(), "a chunk claims to be larger"}},
        {"a.npz", {packed_array(), "unpacks to 4095 MB", 0}},
        {"a.exr", {exr_of(30000, 30000), wide}},
        {"a.mkv", {film("mkv", kLossless, mkv_size, mkv_claim), wide}},
        {"a.mov", {film("mov", "-c:v png -pix_fmt gray", mov_size, mov_claim), wide}},
        {"a.avi",
         {film("avi", kLossless, number(640) + number(480) + number16(1),
               number(30000) + number(30000)),
          wide}},
        {"a.y4m",
         {"YUV4MPEG2 W30000 H30000 F25:1 Cmono\nFRAME\n" + std::string(1 << 18, '\0'),
          "cannot be opened"}},
        {"a.gif",
         {"GIF89a\xff\xff\xff\xff" + std::string(3, '\0') + "," + std::string(9, '\0'), ""}},
    };
}

/// In a process of its own, whose memory counts from its begin.
struct Opening {
    std::string said;  ///< the refusal
    long taken_kb{0};
};

Opening opening_of(const std::function<void()>& open) {
    std::array<int, 2> pipe{};
    REQUIRE(::pipe(pipe.data()) == 0);
    rusage before{};
    ::getrusage(RUSAGE_SELF, &before);
    const pid_t child = ::fork();
    if (child == 0) {
        // Only reached by a failure; what a sanitizer itself maps is beyond it at times.
        const rlimit most{3UL << 30, 3UL << 30};
        if (DIBHR_SANITIZED == 0) ::setrlimit(RLIMIT_DATA, &most);
        std::string said = "nothing";
        try {
            open();
        } catch (const std::exception& error) {
            said = error.what();
        }
        rusage after{};
        ::getrusage(RUSAGE_SELF, &after);
        said += "\n" + std::to_string(std::max(0L, after.ru_maxrss - before.ru_maxrss));
        (void)!::write(pipe[1], said.data(), said.size());
        ::_exit(0);
    }
    ::close(pipe[1]);
    std::string told;
    std::array<char, 4096> bytes{};
    for (ssize_t got = 0; (got = ::read(pipe[0], bytes.data(), bytes.size())) > 0;)
        told.append(bytes.data(), static_cast<std::size_t>(got));
    ::close(pipe[0]);
    ::waitpid(child, nullptr, 0);
    const std::size_t end = told.rfind('\n');
    REQUIRE(end != std::string::npos);
    return {told.substr(0, end), std::stol(told.substr(end + 1))};
}

}  // namespace

TEST_CASE("a picture beyond the bound is refused before memory is taken, whatever its form",
          "[refusal][memory]") {
    const TemporaryFolder folder;
    constexpr long kMost_kb = 64 << 10;
    for (const auto& [name, bomb] : bombs()) {
        CAPTURE(name);
        const fs::path file = folder / name;
        write_text(file, bomb.bytes);
        if (bomb.holds > fs::file_size(file)) fs::resize_file(file, bomb.holds);
        const std::map<std::string, std::function<void()>> ways{
            {"described", [&] { (void)describe_media(file); }},
            {"as depth", [&] { (void)open_depth(file); }}};
        for (const auto& [way, open] : ways) {
            CAPTURE(way);
            const Opening opening = opening_of(open);
            CHECK(contains(opening.said, name));
            CHECK(contains(opening.said, bomb.said));
            CHECK(opening.said.find('\n') == std::string::npos);
            CHECK(opening.taken_kb < kMost_kb);
        }
        fs::remove(file);
    }
}

TEST_CASE("a whole picture beyond the bound, packed to nearly nothing, is refused, too",
          "[refusal][memory]") {
    const TemporaryFolder folder;
    const cv::Mat large = cv::Mat::zeros(5800, 5800, CV_8UC1);
    REQUIRE(cv::imwrite((folder / "large.png").string(), large));
    CHECK(fs::file_size(folder / "large.png") < 200'000);
    for (const std::string name : {"large.png", "depth/0.png"}) {
        fs::create_directories((folder / name).parent_path());
        if (name != "large.png") fs::copy_file(folder / "large.png", folder / name);
        const Opening opening = opening_of([&] {
            const fs::path place = name == "large.png" ? folder / name : folder / "depth";
            (void)open_depth(place);
        });
        CHECK(contains(opening.said, "5800 x 5800 pixels"));
        CHECK(opening.taken_kb < (64 << 10));
    }
}
