// Each kind of evidence gives its row of the table of findings.
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "core/video/depth/depth_guess.hpp"
#include "core/video/sources/media.hpp"
#include "tests/core/video/asks.hpp"
#include "tests/core/video/coded_scene.hpp"
#include "tests/core/video/depth_photos.hpp"
#include "tests/core/video/form_writers.hpp"
#include "tests/core/video/forms.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;
namespace fs = std::filesystem;

namespace {

cv::Mat scene_between(double nearest, double farthest) {
    cv::Mat numbers;
    scene_depth().convertTo(numbers, CV_32F, farthest - nearest, nearest);
    return numbers;
}

cv::Mat in_16_bits(double nearest, double farthest) {
    cv::Mat levels = scene_between(nearest, farthest);
    levels.setTo(0.0F, ~(levels == levels));
    levels.convertTo(levels, CV_16U);
    return levels;
}

/// The scene in the size of a spinning LiDAR's pictures.
cv::Mat of_spinning_lidar() {
    cv::Mat levels;
    cv::resize(in_16_bits(1600.0, 9000.0), levels, {1024, 64}, 0.0, 0.0, cv::INTER_NEAREST);
    return levels;
}

Write coded(DepthCode code, double nearest, double farthest) {
    return picture(in_bytes(scene_between(nearest, farthest), code));
}

Write real_tiff() {
    cv::Mat heights = scene_between(200.0, 900.0);
    heights.setTo(-9999.0F, ~(heights == heights));
    return text(tiff(kSceneColumns, kSceneRows, 32, 3, true, bytes_of(heights), "-9999", true));
}

/// A folder of pictures and one of their colours.
Write folders(const std::string& colour, const std::string& depth) {
    return [=](const fs::path& place) {
        for (const std::string& name : {colour, depth}) fs::create_directories(place / name);
        for (const char* const name : {"1.png", "2.png", "3.png"}) {
            picture(scene_photo())(place / colour / name);
            picture(in_16_bits(900.0, 4000.0))(place / depth / name);
        }
    };
}

struct Row {
    std::string file;
    Write write;
    Evidence evidence;
    DepthStatement states;  ///< at least
    std::string reason;     ///< holds this
};

std::vector<Row> rows() {
    const cv::Mat metres = scene_between(1.0, 5.0);
    const cv::Mat grey = painted(scene_depth(), as_grey);
    const cv::Mat halves = beside(scene_photo(), grey);
    cv::Mat raw = in_16_bits(600.0, 1000.0);
    raw.setTo(2047, raw == 0);
    const std::string flat = encoded_as(cv::Mat(24, 32, CV_8UC1, cv::Scalar(90)), ".png");
    return {
        {"a_depth.pfm",
         text(pfm(metres, "-1", true)),
         Evidence::magic,
         {.unit = DepthUnit::disparity},
         "portable float maps"},
        {"a_depth.exr",
         exr("Z", metres),
         Evidence::metadata,
         {.unit = DepthUnit::m},
         "EXR channel Z"},
        {"a_depth.tif",
         real_tiff(),
         Evidence::metadata,
         {.near = NearLevels::bright, .unit = DepthUnit::levels},
         "GeoTIFF"},
        {"a_depth.tif",
         real_tiff(),
         Evidence::metadata,
         {.no_data = std::vector{-9999.0}},
         "GDAL_NODATA"},
        {"a.npz",
         zip_of("disparity.npy", npy("<f4", "(240, 320)", bytes_of(metres))),
         Evidence::metadata,
         {.unit = DepthUnit::disparity},
         "array 'disparity'"},
        {"a.jpg",
         text(gdepth_photo(encoded_as(scene_photo(), ".jpg"), "", flat)),
         Evidence::metadata,
         {.near = NearLevels::bright, .unit = DepthUnit::disparity},
         "GDepth"},
        {"a.mkv",
         tracks(scene_photo(), in_16_bits(900.0, 4000.0), "gray16le", "Depth"),
         Evidence::metadata,
         {.packing = DepthPacking::tracks},
         "tracks"},
        {"scan",
         folders("color", "depth"),
         Evidence::layout,
         {.unit = DepthUnit::mm, .scale = 1.0, .no_data = std::vector{0.0}},
         "Open3D"},
        {"a.png",
         picture(painted(scene_depth(), as_hue)),
         Evidence::code,
         {.near = NearLevels::dark, .unit = DepthUnit::levels, .code = DepthCode::hue},
         "hues"},
        {"a.png",
         coded(DepthCode::rg16, 900.0, 6000.0),
         Evidence::code,
         {.code = DepthCode::rg16},
         "bytes"},
        {"a.png",
         coded(DepthCode::rgb24, 9000.0, 900000.0),
         Evidence::code,
         {.near = NearLevels::dark, .unit = DepthUnit::levels, .code = DepthCode::rgb24},
         "bytes"},
        {"carla.png",
         coded(DepthCode::rgb24, 9000.0, 900000.0),
         Evidence::code,
         {.near = NearLevels::dark, .unit = DepthUnit::m, .code = DepthCode::rgb24},
         "CARLA"},
        {"a.png",
         coded(DepthCode::float32, 1.0, 5.0),
         Evidence::code,
         {.code = DepthCode::float32},
         "bytes"},
        {"a.png",
         coded(DepthCode::terrain, 200.0, 2900.0),
         Evidence::code,
         {.near = NearLevels::bright, .unit = DepthUnit::levels, .code = DepthCode::terrain},
         "bytes"},
        {"a.png",
         picture(raw),
         Evidence::code,
         {.near = NearLevels::dark, .unit = DepthUnit::mm, .code = DepthCode::kinect11},
         "2047"},
        {"photo-dpt_large_384.png",
         picture(in_16_bits(900.0, 60000.0)),
         Evidence::layout,
         {.near = NearLevels::bright, .unit = DepthUnit::levels},
         "MiDaS"},
        {"a_RGBD.png",
         picture(halves),
         Evidence::name,
         {.packing = DepthPacking::left_right},
         "its name"},
        {"rock_height.png",
         picture(grey),
         Evidence::name,
         {.near = NearLevels::bright, .unit = DepthUnit::levels},
         "'height'"},
        {"a_disp.png",
         picture(in_16_bits(900.0, 40000.0)),
         Evidence::name,
         {.unit = DepthUnit::disparity},
         "'disp'"},
        {"depth_cm.png",
         picture(in_16_bits(90.0, 400.0)),
         Evidence::name,
         {.near = NearLevels::dark, .unit = DepthUnit::mm, .scale = 10.0},
         "'cm' in its name"},
        {"depth_m.png",  // whole metres of no scene
         picture(in_16_bits(900.0, 4000.0)),
         Evidence::numbers,
         {.unit = DepthUnit::m, .scale = 1.0},
         "a scene has no depth from"},
        {"Shot01_WorldDepth.0001.exr",
         exr("R", metres * 100.0),
         Evidence::layout,
         {.near = NearLevels::dark, .unit = DepthUnit::mm, .scale = 10.0},
         "Unreal Engine's world depth"},
        {"log_depth.npy",
         text(npy("<f4", "(240, 320)", bytes_of(metres))),
         Evidence::name,
         {.near = NearLevels::dark, .unit = DepthUnit::levels},
         "a logarithm of depth in its name"},
        {"a_disp.pfm",
         text(pfm(metres - 3.0, "-1", true)),
         Evidence::numbers,
         {.near = NearLevels::bright, .unit = DepthUnit::levels},
         "disparities about a plane"},
        {"a.npy",
         text(npy("<f4", "(240, 320)", bytes_of(metres + 10.0))),
         Evidence::numbers,
         {.unit = DepthUnit::mm, .scale = 1.0},
         "a close-up in millimetres"},
        {"inv_depth.npy",
         text(npy("<f4", "(240, 320)", bytes_of(metres))),
         Evidence::name,
         {.near = NearLevels::bright, .unit = DepthUnit::disparity},
         "inverse depth in its name"},
        {"a_depth.png",
         picture(in_16_bits(900.0, 4000.0)),
         Evidence::name,
         {.near = NearLevels::dark},
         "'depth' in its name"},
        {"disp_occ_0/000000_10.png",
         picture(in_16_bits(900.0, 40000.0)),
         Evidence::layout,
         {.unit = DepthUnit::disparity, .scale = 1.0 / 256.0},
         "KITTI stereo"},
        {"disp_0/000000.png",
         picture(in_16_bits(900.0, 40000.0)),
         Evidence::name,
         {.near = NearLevels::bright, .unit = DepthUnit::disparity},
         "'disp' in its folder's name"},
        {"scan_mm/depth_0001.npy",  // "scan_mm" speaks of no distances
         text(npy("<f4", "(240, 320)", bytes_of(metres))),
         Evidence::name,
         {.near = NearLevels::dark},
         "'depth' in its name"},
        {"depth_cm/depth_0001.npy",
         text(npy("<f4", "(240, 320)", bytes_of(metres * 100.0))),
         Evidence::name,
         {.near = NearLevels::dark, .unit = DepthUnit::mm, .scale = 10.0},
         "'cm' in its folder's name"},
        {"a.npz",
         zip_of("depth.npy", npy("<f4", "(240, 320)", bytes_of(metres))),
         Evidence::name,
         {.near = NearLevels::dark},
         "'depth' in its array's name"},
        {"a.png",
         picture(in_16_bits(900.0, 4000.0) * 8.0),
         Evidence::code,
         {.near = NearLevels::dark, .unit = DepthUnit::mm, .code = DepthCode::turned16},
         "multiples of 8"},
        {"a.png",
         picture(below_confidence(in_16_bits(900.0, 4000.0))),
         Evidence::code,
         {.near = NearLevels::dark, .unit = DepthUnit::mm, .code = DepthCode::depth16},
         "three highest bits"},
        {"a.png",
         picture(of_spinning_lidar()),
         Evidence::numbers,
         {.unit = DepthUnit::mm, .scale = 4.0},
         "a row a laser"},
        {"a.png",
         picture(painted(scene_depth(), as_ramp)),
         Evidence::appearance,
         {.near = NearLevels::bright},
         "from white"},
        {"a.png",
         picture(halves),
         Evidence::appearance,
         {.packing = DepthPacking::left_right, .code = DepthCode::grey},
         "halves"},
        {"a.png", picture(grey), Evidence::numbers, {.unit = DepthUnit::levels}, "8 bits"},
        {"a_depth.npy",
         text(npy("<f4", "(240, 320)", bytes_of(metres))),
         Evidence::numbers,
         {.unit = DepthUnit::m, .scale = 1.0},
         "a scene in metres"},
    };
}

Findings table_of(const fs::path& place) {
    return open_media(place, {}, {.find_out = true})->description().conclusion.findings;
}

bool has_row(const Findings& table, const Row& expected) {
    return std::any_of(table.begin(), table.end(), [&](const Finding& row) {
        DepthStatement all = expected.states;
        all.fill_in(row.statement);
        return row.evidence == expected.evidence && all == row.statement &&
               contains(row.reason, expected.reason);
    });
}

bool names_unit(const Findings& table, DepthUnit unit) {
    return std::any_of(table.begin(), table.end(), [unit](const Finding& row) {
        return row.evidence == Evidence::name && row.statement.unit == unit &&
               row.sureness >= kSureEnough;
    });
}

/// How sure the row is; 0: there is none.
double sureness_of(const Findings& table, const std::string& about, Evidence evidence,
                   const std::string& reason) {
    for (const Finding& row : table)
        if (row.about == about && row.evidence == evidence && contains(row.reason, reason))
            return row.sureness;
    return 0.0;
}

}  // namespace

TEST_CASE("each kind of evidence gives its row", "[rows]") {
    for (const Row& expected : rows()) {
        const TemporaryFolder folder;
        CAPTURE(expected.file, expected.reason);
        fs::create_directories((folder / expected.file).parent_path());
        expected.write(folder / expected.file);
        const Findings table = table_of(folder / expected.file);
        CHECK(has_row(table, expected));
    }
}

TEST_CASE("numbers in the size of a spinning LiDAR's pictures are asked about: 1 or 4 mm",
          "[rows]") {
    const TemporaryFolder folder;
    picture(of_spinning_lidar())(folder / "range.png");
    const MediaDescription media =
        open_media(folder / "range.png", {}, {.find_out = true})->description();
    CHECK(asks(media));
    for (const double scale : {1.0, 4.0}) {
        const std::vector<DepthAlternative>& all = media.conclusion.alternatives;
        CHECK(std::any_of(all.begin(), all.end(), [scale](const DepthAlternative& answer) {
            return answer.statement.unit == DepthUnit::mm && answer.statement.scale == scale &&
                   answer.statement.near == NearLevels::dark;
        }));
    }
}

TEST_CASE("the folder's name counts where the picture's says nothing, and the opened one's",
          "[rows]") {
    const TemporaryFolder folder;
    const auto write = [&](const std::string& file) {
        fs::create_directories((folder / file).parent_path());
        picture(in_16_bits(900.0, 4000.0))(folder / file);
        return folder / file;
    };
    CHECK(names_unit(table_of(write("height/0001.png")), DepthUnit::levels));
    CHECK_FALSE(names_unit(table_of(write("height/a_depth.png")), DepthUnit::levels));
    CHECK_FALSE(names_unit(table_of(write("disparity/scan/0001.png")), DepthUnit::disparity));
    const fs::path opened = write("run_depth_mm/depth/0001.png").parent_path().parent_path();
    CHECK(names_unit(table_of(opened), DepthUnit::mm));
    CHECK_FALSE(names_unit(table_of(write("aus_dem_labor/0001.png")), DepthUnit::levels));
    CHECK(names_unit(table_of(write("DEM/0001.png")), DepthUnit::levels));
}

TEST_CASE("what is said of levels before they are decoded leaves no empty row", "[rows]") {
    const TemporaryFolder folder;
    write_text(folder / "calib.txt",
               "cam0=[1000 0 159; 0 1000 119; 0 0 1]\ndoffs=0\nbaseline=200\nwidth=320\n");
    text(pfm(scene_between(20.0, 90.0), "-1", true))(folder / "disp0.pfm");
    const Findings table = table_of(folder / "disp0.pfm");
    CHECK(std::all_of(table.begin(), table.end(), [](const Finding& row) {
        return row.statement != DepthStatement{} || !row.about.empty();
    }));
    CHECK(std::none_of(table.begin(), table.end(), [](const Finding& row) {
        return contains(row.reason, "portable float maps");
    }));
}

TEST_CASE("the first row says which reader took the file, and by what", "[rows]") {
    const TemporaryFolder folder;
    picture(in_16_bits(900.0, 4000.0))(folder / "a_depth.png");
    folders("color", "depth")(folder / "scan");
    picture(scene_photo())(folder / "b.png");
    write_text(folder / "b.raw", bytes_of(in_16_bits(900.0, 4000.0)));
    const auto first_of = [&](const std::string& name) { return table_of(folder / name).front(); };
    CHECK(first_of("a_depth.png").about == "form PNG");
    CHECK(first_of("a_depth.png").evidence == Evidence::magic);
    CHECK(contains(first_of("a_depth.png").reason, "OpenCV"));
    CHECK(first_of("scan").evidence == Evidence::layout);
    CHECK(contains(first_of("scan").reason, "row of pictures"));
    CHECK(first_of("b.raw").about == "form RAW");
    CHECK(first_of("b.raw").evidence == Evidence::layout);
}

TEST_CASE("the table says who knows when frames are, the surest of whom counts", "[rows]") {
    const TemporaryFolder folder;
    folders("color", "depth")(folder / "scan");
    const auto media = [&] { return open_media(folder / "scan", {}, {.find_out = true}); };
    const auto counted = media();
    CHECK(sureness_of(counted->description().conclusion.findings, "times of the depth",
                      Evidence::numbers, "assumed") > 0.0);
    write_text(folder / "scan/depth/timestamps.txt", "0.5\n0.75\n1.0\n");
    const auto stamped = media();
    const Findings& table = stamped->description().conclusion.findings;
    const double by_list =
        sureness_of(table, "times of the depth", Evidence::layout, "timestamps.txt");
    CHECK(by_list > sureness_of(table, "times of the depth", Evidence::numbers, "assumed"));
    CHECK(by_list > kSureEnough);
    CHECK(contains(stamped->description().timing, "timestamps.txt"));
}

TEST_CASE("the levels that pictures use are counted once, those that are not finite never",
          "[findings]") {
    cv::Mat millimetres(2000, 1000, CV_32FC1);  // more than are collected at a time
    for (int j = 0; j < millimetres.rows; ++j) millimetres.row(j) = 0.25F * static_cast<float>(j);
    millimetres.at<float>(0, 0) = std::numeric_limits<float>::infinity();
    CHECK(levels_used({millimetres}) == 2000);
    const cv::Mat levels = (cv::Mat_<std::uint16_t>(2, 3) << 0, 1, 1, 300, 65535, 0);
    CHECK(levels_used({levels}) == 4);
    CHECK(levels_used({levels, levels + 1, cv::Mat(4, 4, CV_8UC1, cv::Scalar(9))}) == 7);
    CHECK(levels_used({}) == 0);
}
