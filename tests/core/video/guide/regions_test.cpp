// Named regions: label pictures and their table beside a recording, looked up and raised.
#include "core/video/guide/regions.hpp"

#include <algorithm>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "core/error.hpp"
#include "core/video/guide/regions_file.hpp"
#include "core/video/guide/ridged_maps.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;
using Catch::Matchers::Contains;
using Catch::Matchers::WithinAbs;
namespace fs = std::filesystem;

namespace {

constexpr int kWide = 40;
constexpr int kHigh = 30;
constexpr const char* kCup = "[[region]]\nlevel = 7\nname = \"Cup\"\ntext = \"A blue cup.\"\n";
constexpr const char* kBoth =
    "[[region]]\nlevel = 7\nname = \"Cup\"\n[[region]]\nlevel = 9\nname = \"Table\"\n";

/// Pictures one below the other: the left `seven[k]` columns of the k-th have level 7, others 9.
void write_labels(const fs::path& file, const std::vector<int>& seven) {
    cv::Mat all(kHigh * static_cast<int>(seven.size()), kWide, CV_8UC1, cv::Scalar(9));
    for (std::size_t k = 0; k < seven.size(); ++k)
        all.rowRange(static_cast<int>(k) * kHigh, static_cast<int>(k + 1) * kHigh)
            .colRange(0, seven[k])
            .setTo(7);
    REQUIRE(cv::imwrite(file.string(), all));
}

std::string name_at(const Regions& regions, double x, double y, double media_s = 0.0) {
    const Region* const found = regions.at(x, y, kWide, kHigh, media_s);
    return found == nullptr ? "" : found->name;
}

Regions halves() {
    Regions regions{kWide, kHigh, 1, 0.0, {}, {{"Cup", ""}, {"Table", ""}}};
    for (int j = 0; j < kHigh; ++j)
        for (int i = 0; i < kWide; ++i)
            regions.labels.push_back(static_cast<std::uint8_t>(i < kWide / 2 ? 1 : 2));
    return regions;
}

}  // namespace

TEST_CASE("a region is found where its level lies and nowhere else", "[regions]") {
    const TemporaryFolder folder;
    write_text(folder / "cup_regions.toml", kCup);
    write_labels(folder / "cup_regions.png", {12});
    const auto regions = read_regions(folder / "cup_depth.mp4", kWide, kHigh);
    REQUIRE(regions);
    CHECK(regions->regions.front().text == "A blue cup.");
    for (int i = 0; i < kWide; ++i) CHECK(name_at(*regions, i, 15) == (i < 12 ? "Cup" : ""));
    CHECK(name_at(*regions, -1.0, 15).empty());
    CHECK(name_at(*regions, 5.0, kHigh).empty());
    CHECK(name_at(*regions, std::nan(""), 15).empty());
}

TEST_CASE("a label picture of another resolution is stretched over the depth", "[regions]") {
    const TemporaryFolder folder;
    write_text(folder / "depth_regions.toml", kCup);
    write_labels(folder / "depth_regions.png", {20});
    const auto regions = read_regions(folder / "depth.mp4", 4 * kWide, 4 * kHigh);
    REQUIRE(regions);
    CHECK(regions->at(79.0, 60.0, 4 * kWide, 4 * kHigh, 0.0) != nullptr);
    CHECK(regions->at(80.0, 60.0, 4 * kWide, 4 * kHigh, 0.0) == nullptr);
}

TEST_CASE("several label pictures follow each other in time", "[regions]") {
    const TemporaryFolder folder;
    write_text(folder / "depth_regions.toml",
               std::string("[labels]\npictures = 3\nper-second = 2.0\n") + kBoth);
    write_labels(folder / "depth_regions.png", {10, 20, 30});
    const auto regions = read_regions(folder / "depth.mp4", kWide, kHigh);
    REQUIRE(regions);
    CHECK(regions->rows == kHigh);
    const auto at_25 = [&](double media_s) { return name_at(*regions, 25.0, 3.0, media_s); };
    CHECK(at_25(0.0) == "Table");
    CHECK(at_25(0.99) == "Table");
    CHECK(at_25(1.0) == "Cup");
    CHECK(at_25(100.0) == "Cup");  // held
    CHECK(at_25(-1.0) == "Table");
}

TEST_CASE("regions may be marked by colours as people draw them", "[regions]") {
    const TemporaryFolder folder;
    write_text(folder / "cup_regions.toml",
               "[[region]]\ncolour = \"#D08030\"\nname = \"Cup\"\n[[region]]\nlevel = 9\nname = "
               "\"Table\"\n");
    cv::Mat picture(kHigh, kWide, CV_8UC4, cv::Scalar(9, 9, 9, 255));
    picture.colRange(0, 10).setTo(cv::Scalar(0x30, 0x80, 0xd0, 255));
    picture.colRange(30, kWide).setTo(cv::Scalar(9, 9, 9, 0));
    REQUIRE(cv::imwrite((folder / "cup_regions.png").string(), picture));
    const auto regions = read_regions(folder / "cup_depth.mp4", kWide, kHigh);
    REQUIRE(regions);
    CHECK(name_at(*regions, 9, 3) == "Cup");
    CHECK(name_at(*regions, 10, 3) == "Table");
    CHECK(name_at(*regions, 35, 3).empty());  // transparent
}

TEST_CASE("written regions are read back with all names and texts and places and times",
          "[regions]") {
    const TemporaryFolder folder;
    const int count = GENERATE(1, 2, 12, 13, 255);
    const int pictures = GENERATE(1, 3);
    Regions regions{kWide, kHigh, pictures, pictures > 1 ? 2.5 : 0.0, {}, {}};
    for (int k = 0; k < count; ++k)
        regions.regions.push_back({"\"No. " + std::to_string(k) + "\" \\ é",
                                   k % 2 == 0 ? "" : "Text " + std::to_string(k)});
    for (int k = 0; k < kWide * kHigh * pictures; ++k)
        regions.labels.push_back(static_cast<std::uint8_t>(k % (count + 1)));
    write_regions(&regions, folder / "cup_depth.mp4");
    const auto read = read_regions(folder / "cup_depth.mp4", kWide, kHigh);
    REQUIRE(read);
    CHECK(read->pictures == pictures);
    CHECK(read->pictures_per_s == regions.pictures_per_s);
    CHECK(read->labels == regions.labels);
    REQUIRE(read->regions.size() == regions.regions.size());
    for (std::size_t k = 0; k < regions.regions.size(); ++k) {
        CHECK(read->regions[k].name == regions.regions[k].name);
        CHECK(read->regions[k].text == regions.regions[k].text);
    }
    write_regions(nullptr, folder / "cup_depth.mp4");
    CHECK(read_regions(folder / "cup_depth.mp4", kWide, kHigh) == nullptr);
    CHECK_FALSE(fs::exists(folder / "cup_regions.png"));
}

TEST_CASE("a recording without a table of regions has none", "[regions]") {
    const TemporaryFolder folder;
    CHECK(read_regions(folder / "cup_depth.mp4", kWide, kHigh) == nullptr);
    write_labels(folder / "cup_regions.png", {12});  // may be anything
    CHECK(read_regions(folder / "cup_depth.mp4", kWide, kHigh) == nullptr);
    const std::string picture = read_text(folder / "cup_regions.png");
    const Regions painted{1, 1, 1, 0.0, {1}, {{"Cup", ""}}};
    CHECK_THROWS_AS(write_regions(&painted, folder / "cup_depth.mp4"), InputError);
    CHECK(read_text(folder / "cup_regions.png") == picture);
    CHECK(read_regions({}, kWide, kHigh) == nullptr);
}

TEST_CASE("what is wrong with regions is told in one line with the file's name", "[regions]") {
    const TemporaryFolder folder;
    const auto problem_of = [&folder](const std::string& table) -> std::string {
        write_text(folder / "cup_regions.toml", table);
        try {
            static_cast<void>(read_regions(folder / "cup_depth.mp4", kWide, kHigh));
        } catch (const InputError& error) {
            CHECK(std::string(error.what()).find('\n') == std::string::npos);
            return error.what();
        }
        return "";
    };
    CHECK_THAT(problem_of(kCup), Contains("cup_regions.png") && Contains("is missing"));
    write_labels(folder / "cup_regions.png", {12, 12});
    CHECK_THAT(problem_of(kCup), Contains("as wide to its height as the depth"));
    CHECK_THAT(problem_of(std::string("[labels]\npictures = 7\nper-second = 1\n") + kCup),
               Contains("rows are not 7 pictures"));
    CHECK_THAT(problem_of(std::string("[labels]\npictures = 2\n") + kCup), Contains("per-second"));
    CHECK_THAT(problem_of(""), Contains("has no region"));
    CHECK_THAT(problem_of("[[region]]\nlevel = 7\n"), Contains("has no name"));
    CHECK_THAT(problem_of("[[region]]\nname = \"Cup\"\n"), Contains("neither a level"));
    CHECK_THAT(problem_of("[[region]]\nname = \"Cup\"\nlevel = 70000\n"),
               Contains("neither a level"));
    CHECK_THAT(problem_of(std::string(kCup) + kCup), Contains("of another"));
    CHECK_THAT(problem_of("[[region\n"), Contains("line 1"));
    write_text(folder / "cup_regions.png", "no picture");
    CHECK_THAT(problem_of(kCup), Contains("cup_regions.png"));
}

TEST_CASE("a ridge is highest on the outline and the same at both sides and nothing far from it",
          "[regions]") {
    const Regions regions = halves();
    const TouchMaps maps = with_ridges(nullptr, regions, 0, 640, 480);
    const auto height_px = [&](int i, int j) {
        return maps.at_vertices.heights_px.at(static_cast<std::size_t>(j * 640 + i));
    };
    const double most = maps.at_vertices.highest_px;
    CHECK_THAT(most, WithinAbs(0.008 * 640, 0.3));
    for (int j = 100; j < 400; j += 50) {
        CAPTURE(j);
        int top = 0;
        for (int i = 0; i < 640; ++i)
            if (height_px(i, j) > height_px(top, j)) top = i;
        CHECK(std::abs(top - 312) <= 16);  // a pixel of these coarse labels is 16 wide
        CHECK(height_px(200, j) == 0.0F);
        CHECK(height_px(450, j) == 0.0F);
    }
}

TEST_CASE("ridges are added to painted heights and leave other paint as it is", "[regions]") {
    TouchMaps painted;
    painted.friction = bare_map(TouchMapKind::friction, 8, 6);
    painted.height = bare_map(TouchMapKind::height, 64, 48);
    for (TouchMap::Pixel& pixel : painted.height.pixels)
        pixel = {painted.height.level_of(-5.0), 65535};
    const Regions regions = halves();
    const TouchMaps bare = with_ridges(nullptr, regions, 0, 64, 48);
    const TouchMaps both = with_ridges(&painted, regions, 0, 64, 48);
    CHECK(both.friction == painted.friction);
    REQUIRE(both.at_vertices.heights_px.size() == 64U * 48U);
    for (std::size_t k = 0; k < 64U * 48U; ++k)
        CHECK_THAT(both.at_vertices.heights_px[k],
                   WithinAbs(bare.at_vertices.heights_px[k] - 5.0F, 2e-3));
}
