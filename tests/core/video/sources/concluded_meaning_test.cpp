// Files as people have them, of which nobody says what their depth means: what is concluded is
// right, or it is not sure and the right answer is among the alternatives.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <opencv2/core.hpp>
#include <string>
#include <utility>
#include <vector>

#include "core/video/sources/media.hpp"
#include "tests/core/video/form_writers.hpp"
#include "tests/core/video/forms.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;
namespace fs = std::filesystem;

namespace {

constexpr int kColumns = 320;
constexpr int kRows = 240;

/// What the function of column and row gives.
cv::Mat each_pixel(int type, const std::function<double(double x, double y)>& value) {
    cv::Mat picture(kRows, kColumns, CV_32F);
    for (int j = 0; j < kRows; ++j)
        for (int i = 0; i < kColumns; ++i)
            picture.at<float>(j, i) = static_cast<float>(value(i, j));
    cv::Mat typed;
    picture.convertTo(typed, type);
    return typed;
}

/// A floor that comes nearer downwards, and a ball in front of it: 0.05 (near) to 1.05.
double farness(double x, double y) {
    const double off = std::hypot(x - 150.0, y - 125.0) / 55.0;
    if (off < 1.0) return 0.3 - 0.25 * std::sqrt(1.0 - off * off);
    return 1.0 - 0.55 * y / kRows + 0.05 * x / kColumns;
}

double nearness(double x, double y) {
    return 1.05 - farness(x, y);
}

double metres(double x, double y) {
    return 1.2 + 1.8 * farness(x, y);
}

bool in_hole(double x, double y) {
    return x >= 50.0 && x < 90.0 && y >= 20.0 && y < 50.0;
}

/// Far in the middle: 1 there, 0 at the sides.
double down_a_corridor(double x, double y) {
    return std::exp(-std::hypot(x - 160.0, y - 120.0) / 50.0);
}

/// Terrain with a low middle, 0 to 1.
double height(double x, double y) {
    return std::min(std::hypot(x - 160.0, y - 120.0) / 200.0, 1.0);
}

MediaDescription opened(const fs::path& file, const DepthStatement& stated = {}) {
    return open_depth(file, {.find_out = true, .command_line = stated})->description();
}

MediaDescription described(const std::string& name, const Write& write) {
    const TemporaryFolder folder;
    write(folder / name);
    return opened(folder / name);
}

Write real_tiff(const cv::Mat& numbers, const std::string& no_data = {}, bool geographic = false) {
    return text(tiff(kColumns, kRows, 32, 3, true, bytes_of(numbers), no_data, geographic));
}

Write real_array(const cv::Mat& numbers) {
    return text(npy("<f4", "(240, 320)", bytes_of(numbers)));
}

bool is_sure(const MediaDescription& media) {
    return media.conclusion.sure >= kSureEnough && media.conclusion.alternatives.empty();
}

bool may_be(const MediaDescription& media, NearLevels near, DepthUnit unit, double scale) {
    const std::vector<DepthAlternative>& all = media.conclusion.alternatives;
    return std::any_of(all.begin(), all.end(), [&](const DepthAlternative& other) {
        return other.statement.near == near && other.statement.unit == unit &&
               std::abs(*other.statement.scale - scale) < 1e-9;
    });
}

}  // namespace

TEST_CASE("a value that real numbers have exactly, beyond a gap, is no data", "[meaning]") {
    const double mark = GENERATE(0.0, -9999.0, 1e10, 65504.0, 0.001, 100.0);
    CAPTURE(mark);
    const cv::Mat numbers =
        each_pixel(CV_32F, [=](double x, double y) { return in_hole(x, y) ? mark : metres(x, y); });
    const TemporaryFolder folder;
    const std::vector<std::pair<std::string, Write>> files{
        {"a.npy", real_array(numbers)},
        {"a.npz", zip_of("depth.npy", npy("<f4", "(240, 320)", bytes_of(numbers)))},
        {"a.pfm", text(pfm(numbers, "-1", true))},
        {"a.tif", real_tiff(numbers)},
        {"a.exr", exr("Y", numbers)}};
    for (const auto& [name, write] : files) {
        CAPTURE(name);
        if (name == "a.exr" && mark == 1e10) continue;  // its reader takes that for infinity
        write(folder / name);
        const DepthMeaning meaning = *opened(folder / name).meaning;
        CHECK(meaning.no_data.value ==
              std::vector<double>{static_cast<double>(static_cast<float>(mark))});
        CHECK(meaning.no_data.origin == Origin::found);
        CHECK(meaning.unit.value == DepthUnit::m);
        CHECK(meaning.near.value == NearLevels::dark);
        CHECK(meaning.range.value.near > 1.1);
        CHECK(meaning.range.value.far < 3.2);
    }
}

TEST_CASE("two marks at either end are both no data, and so is a constant border", "[meaning]") {
    const cv::Mat both = each_pixel(CV_32F, [](double x, double y) {
        return in_hole(x, y) ? 0.0 : in_hole(x - 100.0, y) ? 100.0 : metres(x, y);
    });
    CHECK(described("a.npy", real_array(both)).meaning->no_data.value ==
          std::vector<double>{0.0, 100.0});
    const cv::Mat framed = each_pixel(CV_32F, [](double x, double y) {
        const bool inside = x >= 8.0 && y >= 8.0 && x < kColumns - 8.0 && y < kRows - 8.0;
        return inside ? metres(x, y) : 3.5;
    });
    CHECK(described("a.npy", real_array(framed)).meaning->no_data.value ==
          std::vector<double>{3.5});
}

TEST_CASE("numbers without a gap, and a wall behind a scene, are all data", "[meaning]") {
    const auto none_of = [](const std::function<double(double, double)>& value) {
        return described("a.npy", real_array(each_pixel(CV_32F, value))).meaning->no_data;
    };
    CHECK(none_of(metres) == Known<std::vector<double>>{{}, Origin::assumed});
    CHECK(none_of([](double x, double y) {
              return in_hole(x, y) ? 3.2 : metres(x, y);
          }).value.empty());
    CHECK(none_of([](double x, double) { return x < 200.0 ? 2.0 : 1.5; }).value.empty());
}

TEST_CASE("the tag GDAL_NODATA names no data that no number shows", "[meaning]") {
    const cv::Mat numbers =
        each_pixel(CV_32F, [](double x, double y) { return in_hole(x, y) ? 2.0 : metres(x, y); });
    const MediaDescription media = described("a.tif", real_tiff(numbers, "2"));
    CHECK(media.meaning->no_data == Known<std::vector<double>>{{2.0}, Origin::found});
    CHECK(media.meaning->found_in == "tag GDAL_NODATA");
    const std::string lowest = "-3.4028234663852886e+38";
    const double mark = std::numeric_limits<float>::lowest();
    CHECK(described("a.tif", real_tiff(numbers, lowest)).meaning->no_data.value ==
          std::vector<double>{mark});
}

TEST_CASE("heights are near where they are high, and linear", "[meaning]") {
    const cv::Mat heights =
        each_pixel(CV_32F, [](double x, double y) { return 200.0 + 900.0 * height(x, y); });
    const cv::Mat eight =
        each_pixel(CV_8U, [](double x, double y) { return 10.0 + 240.0 * height(x, y); });
    const std::vector<std::pair<std::string, Write>> files{
        {"heightmap8.png", picture(eight)},      {"displacement.jpg", picture(eight)},
        {"rock_bump.png", picture(eight)},       {"heightmap.npy", real_array(heights)},
        {"x_height.npy", real_array(heights)},   {"dem.tif", real_tiff(heights)},
        {"a.tif", real_tiff(heights, {}, true)}, {"b.tif", real_tiff(heights, "-9999", true)}};
    for (const auto& [name, write] : files) {
        CAPTURE(name);
        const TemporaryFolder folder;
        write(folder / name);
        const auto media = open_depth(folder / name, {.find_out = true});
        const MediaDescription& about = media->description();
        CHECK(about.meaning->near == Known<NearLevels>{NearLevels::bright, Origin::found});
        CHECK(about.meaning->unit == Known<DepthUnit>{DepthUnit::levels, Origin::found});
        CHECK(is_sure(about));
        const auto frame = media->next();
        REQUIRE(frame);
        CHECK(frame->depth.at(160, 120) < 0.1F * static_cast<float>(frame->depth.highest_level));
        CHECK(frame->depth.at(2, 2) > 0.9F * static_cast<float>(frame->depth.highest_level));
    }
}

TEST_CASE("a map and a micrograph that nothing calls heights may be no depth", "[meaning]") {
    const auto between = [](double lowest, double highest) {
        return each_pixel(
            CV_32F, [=](double x, double y) { return lowest + (highest - lowest) * height(x, y); });
    };
    const auto map = [](const cv::Mat& numbers, const std::map<int, std::string>& texts = {}) {
        return text(tiff(kColumns, kRows, 32, 3, true, bytes_of(numbers), {}, true, texts));
    };
    const cv::Mat degrees = between(0.1, 44.0);
    const cv::Mat people =
        each_pixel(CV_32F, [](double x, double y) { return 3800.0 * std::pow(height(x, y), 6.0); });
    cv::Mat noise(kRows, kColumns, CV_32F);
    cv::randu(noise, 0.0, 300.0);
    const cv::Mat light = between(300.0, 900.0) + noise;
    for (const cv::Mat& numbers : {degrees, between(-0.2, 0.9), between(-19.0, -4.0), people,
                                   between(285.0, 320.0), light}) {
        const MediaDescription media = described("field7.tif", map(numbers));
        CHECK(contains(media.conclusion.doubt, "map"));
        CHECK(may_be(media, NearLevels::bright, DepthUnit::levels, 1.0));
        CHECK(is_sure(described("field7_dem.tif", map(numbers))));
    }
    CHECK(is_sure(described("field7.tif",
                            map(degrees, {{42112,
                                           "<GDALMetadata><Item name=\"UNITTYPE\" sample=\"0\" "
                                           "role=\"unittype\">metre</Item></GDALMetadata>"}}))));
    for (const char* const unit : {"micron", "\xc2\xb5m", "nm"}) {
        const Write micrograph =
            text(tiff(kColumns, kRows, 32, 3, true, bytes_of(between(1.0, 12.0)), {}, false,
                      {{270, std::string("ImageJ=1.53t\nunit=") + unit + "\nspacing=0.3\n"}}));
        const MediaDescription media = described("sample3.tif", micrograph);
        CHECK(contains(media.conclusion.doubt, "microscope"));
        CHECK(media.meaning->near.value == NearLevels::bright);
        CHECK(media.meaning->unit.value == DepthUnit::levels);
        CHECK(is_sure(described("topo_sample3.tif", micrograph)));
    }
}

TEST_CASE("numbers that are named as another quantity may be no depth", "[meaning]") {
    const cv::Mat numbers =
        each_pixel(CV_32F, [](double x, double y) { return 1.5 + 11.0 * farness(x, y); });
    CHECK(contains(described("wind_speed.npy", real_array(numbers)).conclusion.doubt, "speed"));
    CHECK(is_sure(described("wind_speed_depth.npy", real_array(numbers))));
}

TEST_CASE("numbers as far and as flat as a close-up may be millimetres, and metres", "[meaning]") {
    const auto about = [](double nearest, double span) {
        return described("a.npy", real_array(each_pixel(CV_32F, [=](double x, double y) {
                             return nearest + span * farness(x, y);
                         })));
    };
    for (const MediaDescription& media : {about(11.0, 6.0), about(12.0, 12.0), about(30.0, 10.0)}) {
        CHECK_FALSE(is_sure(media));
        CHECK(may_be(media, NearLevels::dark, DepthUnit::mm, 1.0));
        CHECK(may_be(media, NearLevels::dark, DepthUnit::m, 1.0));
    }
    CHECK(about(1.2, 20.0).meaning->unit == Known<DepthUnit>{DepthUnit::m, Origin::found});
}

TEST_CASE("disparities below 0 are linear, near where bright, and all data", "[meaning]") {
    const cv::Mat numbers =
        each_pixel(CV_32F, [](double x, double y) { return 3.4 * nearness(x, y) - 1.6; });
    const MediaDescription media = described("gt_disp_lowres.pfm", text(pfm(numbers, "-1", true)));
    CHECK(is_sure(media));
    CHECK(media.meaning->unit.value == DepthUnit::levels);
    CHECK(media.meaning->near.value == NearLevels::bright);
    CHECK(media.meaning->range.value.far < -1.0);
}

TEST_CASE("16-bit numbers from closer than a sensor sees to a room's size are not sure",
          "[meaning]") {
    const cv::Mat slice =
        each_pixel(CV_16U, [](double x, double y) { return 1400.0 * farness(x, y) - 30.0; });
    const MediaDescription media = described("slice_0087.png", picture(slice));
    CHECK_FALSE(is_sure(media));
    CHECK(may_be(media, NearLevels::dark, DepthUnit::mm, 1.0));
}

TEST_CASE("the range of two levels lies within their bits", "[meaning]") {
    const cv::Mat blocks = each_pixel(CV_8U, [](double x, double y) {
        return (static_cast<int>(x) / 8 + static_cast<int>(y) / 8) % 2 == 0 ? 0.0 : 255.0;
    });
    const DepthRange range = described("depth_sensor_qr.png", picture(blocks)).meaning->range.value;
    CHECK(std::max(range.near, range.far) == 255.0);
    CHECK(std::min(range.near, range.far) == 0.0);
}

TEST_CASE("far in the middle, without a floor: near is not sure, and both are offered",
          "[meaning]") {
    const cv::Mat deep = each_pixel(
        CV_16U, [](double x, double y) { return 12000.0 + 48000.0 * down_a_corridor(x, y); });
    const cv::Mat eight =
        each_pixel(CV_8U, [](double x, double y) { return 255.0 * down_a_corridor(x, y); });
    for (const cv::Mat& corridor : {deep, eight}) {
        const MediaDescription media = described("a.png", picture(corridor));
        CHECK(media.conclusion.sure < kSureEnough);
        CHECK(may_be(media, NearLevels::dark, DepthUnit::levels, 1.0));
        CHECK(may_be(media, NearLevels::bright, DepthUnit::levels, 1.0));
        CHECK(contains(doubt_about(media), "a.png': near is assumed to be " +
                                               std::string(name_of(media.meaning->near.value))));
        CHECK(contains(doubt_about(media), " % sure): look at it, or say --near "));
    }
}

TEST_CASE("a doubt names near or, where that is sure, unit and scale, and how to state each answer",
          "[meaning]") {
    const auto answer = [](NearLevels near, DepthUnit unit, double scale) {
        return DepthAlternative{{.near = near, .unit = unit, .scale = scale}, 0.0};
    };
    MediaDescription media{.depth_path = "/f/a.png"};
    DepthConclusion& conclusion = media.conclusion;
    CHECK(doubt_about(media).empty());
    conclusion.alternatives = {answer(NearLevels::dark, DepthUnit::mm, 0.2),
                               answer(NearLevels::dark, DepthUnit::mm, 1.0),
                               answer(NearLevels::bright, DepthUnit::levels, 1.0)};
    conclusion.sure = 0.4;
    conclusion.near_sure = 0.7;
    conclusion.unit_sure = 0.41;
    CHECK(doubt_about(media) ==
          "'/f/a.png': near is assumed to be dark (70 % sure): look at it, or say --near dark or "
          "--near bright");
    CHECK(contains(doubt_about(media, StatedBy::sidecar),
                   "state near = \"dark\" or near = \"bright\" in its sidecar '/f/a.toml'"));
    conclusion.unit_sure = 0.96;  // each is sure enough, but not both together
    conclusion.near_sure = 0.92;
    CHECK(contains(doubt_about(media), "near is assumed to be dark (92 % sure)"));
    conclusion.near_sure = 0.95;
    conclusion.unit_sure = 0.41;
    CHECK(doubt_about(media) ==
          "'/f/a.png': the unit is assumed to be mm and the scale 0.2 (41 % sure): look at it, or "
          "say --depth-unit mm --depth-scale 0.2 or --depth-unit mm or --depth-unit levels");
    CHECK(contains(doubt_about(media, StatedBy::sidecar), "state unit = \"mm\", scale = 0.2 or "));
    conclusion.alternatives = {answer(NearLevels::dark, DepthUnit::levels, 1.0),
                               answer(NearLevels::dark, DepthUnit::m, 1.0 / 256.0)};
    CHECK(contains(doubt_about(media),
                   "the unit is assumed to be levels (41 % sure): look at it, or say --depth-unit "
                   "levels or --depth-unit m --depth-scale 0.00390625"));
}

TEST_CASE("a person's word on near, unit or range leaves no doubt", "[meaning]") {
    const TemporaryFolder folder;
    const fs::path file = folder / "a.png";
    picture(each_pixel(CV_16U, [](double x, double y) {
        return 12000.0 + 48000.0 * down_a_corridor(x, y);
    }))(file);
    for (const DepthStatement& stated :
         {DepthStatement{.near = NearLevels::dark}, DepthStatement{.unit = DepthUnit::levels},
          DepthStatement{.range = DepthRange{60000.0, 12000.0}}}) {
        CHECK(opened(file, stated).conclusion.alternatives.empty());
        CHECK(doubt_about(opened(file, stated)).empty());
    }
    CHECK(opened(file, {.near = NearLevels::dark}).meaning->near.value == NearLevels::dark);
}

TEST_CASE("the middle and the floor of a scene together make near sure", "[meaning]") {
    const bool bright = GENERATE(true, false);
    CAPTURE(bright);
    const cv::Mat levels = each_pixel(CV_16U, [=](double x, double y) {
        return 65535.0 * (bright ? nearness(x, y) : 1.0 - nearness(x, y));
    });
    const MediaDescription media = described("a.png", picture(levels));
    CHECK(media.meaning->near.value == (bright ? NearLevels::bright : NearLevels::dark));
    CHECK(media.meaning->unit.value == DepthUnit::levels);
    CHECK(is_sure(media));
}

TEST_CASE("relative values below 0 are levels; with an offset it is not sure", "[meaning]") {
    const auto of = [](double offset) {
        return described("a.npy", real_array(each_pixel(CV_32F, [=](double x, double y) {
                             return 900.0 * nearness(x, y) + offset;
                         })));
    };
    const MediaDescription below = of(-40.0);
    CHECK(below.meaning->unit.value == DepthUnit::levels);
    CHECK(below.meaning->near.value == NearLevels::bright);
    CHECK(is_sure(below));
    CHECK(of(0.0).meaning->unit.value == DepthUnit::levels);
    const MediaDescription above = of(60.0);
    CHECK_FALSE(is_sure(above));
    CHECK(may_be(above, NearLevels::bright, DepthUnit::levels, 1.0));
}

TEST_CASE("16-bit millimetres of a room are sure", "[meaning]") {
    const bool has_holes = GENERATE(true, false);
    const MediaDescription media =
        described("a.png", picture(each_pixel(CV_16U, [=](double x, double y) {
                      return has_holes && in_hole(x, y) ? 0.0 : 1000.0 * metres(x, y);
                  })));
    CHECK(media.meaning->unit == Known<DepthUnit>{DepthUnit::mm, Origin::found});
    CHECK(media.meaning->scale == Known<double>{1.0, Origin::found});
    CHECK(media.meaning->no_data.value.size() == (has_holes ? 1U : 0U));
    CHECK(is_sure(media));
}

TEST_CASE("16-bit numbers that fit several units are not sure, and the right one is offered",
          "[meaning]") {
    const cv::Mat fifths = each_pixel(CV_16U, [](double x, double y) {
        return in_hole(x, y) ? 0.0 : 5000.0 * (1.0 + 4.0 * farness(x, y));
    });
    const MediaDescription desk = described("a.png", picture(fifths));
    CHECK_FALSE(is_sure(desk));
    CHECK(may_be(desk, NearLevels::dark, DepthUnit::mm, 0.2));

    cv::RNG random(7);
    const cv::Mat street = each_pixel(CV_16U, [&random](double x, double y) {
        const double off = std::abs(x - 159.5) / kColumns;
        const double down = (y - 119.5) / kRows;
        const double ahead = std::min(5.0 / std::max(off, 1e-6), down > 0.0 ? 1.6 / down : 80.0);
        const bool seen = random.uniform(0.0, 1.0) < 0.3;
        return seen && ahead < 79.0 ? 256.0 * ahead : 0.0;
    });
    const MediaDescription lidar = described("a.png", picture(street));
    CHECK((is_sure(lidar) || may_be(lidar, NearLevels::dark, DepthUnit::m, 1.0 / 256.0)));
    CHECK(lidar.meaning->unit.value == DepthUnit::m);
    CHECK(lidar.meaning->near.value == NearLevels::dark);
}

TEST_CASE("the table says where each finding comes from", "[meaning]") {
    const MediaDescription media =
        described("x_height.npy", real_array(each_pixel(CV_32F, metres)));
    const Findings& rows = media.conclusion.findings;
    const auto by_name = std::find_if(rows.begin(), rows.end(), [](const Finding& row) {
        return row.evidence == Evidence::name;
    });
    REQUIRE(by_name != rows.end());
    CHECK(contains(by_name->reason, "height"));
    CHECK(by_name->statement.near == NearLevels::bright);
    for (const Finding& row : rows) {
        CAPTURE(row.reason);
        CHECK_FALSE(row.reason.empty());
        CHECK(row.sureness > 0.0);
        CHECK(row.sureness <= 1.0);
    }
}
