// How files lie and are named tells the data set, and that what the levels mean; other people's
// folders are none of them.
#include "core/video/sources/layouts/data_sets.hpp"

#include <array>
#include <cstdint>
#include <filesystem>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "core/video/depth/picture_levels.hpp"
#include "core/video/sources/media.hpp"
#include "tests/core/video/asks.hpp"
#include "tests/core/video/form_writers.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;
namespace fs = std::filesystem;

namespace {

/// A depth picture's path, and what else lies there.
struct Laid {
    std::string picture;
    int bits;
    std::vector<std::string> others{};
};

std::optional<DataSetFacts> set_of(const Laid& laid, const TemporaryFolder& folder) {
    for (const std::string& other : laid.others) {
        fs::create_directories((folder / other).parent_path());
        write_text(folder / other, "");
    }
    SourceFacts facts;
    facts.file = folder / laid.picture;
    facts.bits = laid.bits;
    facts.columns = 128;
    return data_set_of(facts);
}

void save_levels(const fs::path& file, int from, int to) {
    fs::create_directories(file.parent_path());
    cv::Mat levels(96, 128, CV_16UC1);
    for (int j = 0; j < levels.rows; ++j)
        for (int i = 0; i < levels.cols; ++i)
            levels.at<std::uint16_t>(j, i) =
                static_cast<std::uint16_t>(to - (to - from) * (128 * j + i) / (96 * 128 - 1));
    picture(levels)(file);
}

DepthMeaning meaning_of(const fs::path& file) {
    return *open_depth(file, {.find_out = true})->description().meaning;
}

}  // namespace

TEST_CASE("a data set is known by the last parts of a path, and by what lies beside", "[sets]") {
    struct Case {
        Laid laid;
        const char* name;
        DepthUnit unit;
        double scale;
    };
    const auto known = GENERATE(values<Case>({
        {{"a/proj_depth/groundtruth/image_02/0000000005.png", 16},
         "KITTI depth completion",
         DepthUnit::m,
         1.0 / 256.0},
        {{"disp_noc_0/000003_10.png", 16}, "KITTI stereo", DepthUnit::disparity, 1.0 / 256.0},
        {{"frames/depth/Camera_1/depth_00007.png", 16}, "Virtual KITTI 2", DepthUnit::mm, 10.0},
        {{"depth_left/000012_left_depth.npy", kRealBits}, "TartanAir", DepthUnit::m, 1.0},
        {{"IMG_A_DepthPlanar_170.PFM", kRealBits}, "AirSim", DepthUnit::m, 1.0},
        {{"undistorted_depth_images/ab12_d1_4.png", 16}, "Matterport3D", DepthUnit::m, 0.00025},
        {{"depth/1305.160407.png", 16, {"rgb/a.png", "groundtruth.txt"}},
         "TUM RGB-D",
         DepthUnit::mm,
         0.2},
        {{"depth/25.png", 16, {"photo/25.jpg", "instance/25.png"}},
         "SceneNet RGB-D",
         DepthUnit::mm,
         1.0},
        {{"a_depth.npy", kRealBits, {"a_depth_mask.npy"}}, "DIODE", DepthUnit::m, 1.0},
        {{"000001-depth.png", 16, {"000001-color.png", "000001-meta.mat"}},
         "YCB-Video",
         DepthUnit::mm,
         0.1},
        {{"Depth_0003.png", 16, {"FrameBuffer_0003.png"}},
         "SimCol3D",
         DepthUnit::mm,
         200.0 / 65280.0},
        {{"depth_bw/photo_pred.png", 16}, "Marigold", DepthUnit::levels, 1.0},
        {{"depth/NYU0001.png", 16, {"image/NYU0001.jpg", "intrinsics.txt", "scene.txt"}},
         "SUN RGB-D",
         DepthUnit::mm,
         1.0},
        {{"depth/lidar/CAMERA_01/1561.npz", kRealBits}, "DDAD", DepthUnit::m, 1.0},
        {{"capture_depth16_0001.png", 16}, "Android's DEPTH16", DepthUnit::mm, 1.0},
        {{"Shot01_FinalImageMovieRenderQueue_WorldDepth.0001.exr", kRealBits},
         "Unreal Engine's world depth",
         DepthUnit::mm,
         10.0},
        {{"rendered_depth_maps/00000003.pfm", kRealBits, {"blended_images/00000003.jpg"}},
         "BlendedMVS",
         DepthUnit::levels,
         1.0},
    }));
    CAPTURE(known.laid.picture);
    const TemporaryFolder folder;
    const auto found = set_of(known.laid, folder);
    REQUIRE(found);
    CHECK(found->name == known.name);
    CHECK(found->finding.evidence == Evidence::layout);
    CHECK(found->finding.statement.unit == known.unit);
    CHECK(found->finding.statement.scale == known.scale);
    CHECK(found->finding.sureness >= kSureEnough);
}

TEST_CASE("folders that only hold a common word are no data set", "[sets]") {
    const auto laid = GENERATE(values<Laid>({
        {"depth/000012.png", 16, {"rgb/000012.png", "notes.txt"}},
        {"depth/1305.160407.png", 16, {"color/a.png"}},
        {"proj_depth/000012.png", 16},
        {"depth_left/left.npy", kRealBits},
        {"velodyne_raw/000012.png", 16},
        {"disp0.pfm", kRealBits, {"im0.png"}},
        {"0000_depth.tiff", 16, {"0000_color.png"}},
        {"000001-depth.png", 16, {"000001-color.png"}},
        {"frames/depth/Camera_1/depth_00007.png", 8},
        {"a/proj_depth/groundtruth/image_02/5.png", kRealBits},
        {"my_depth_pred.npy", kRealBits},
        {"depth/1.png", 16, {"image/1.jpg", "intrinsics.txt"}},
        {"rendered_depth_maps/1.pfm", kRealBits},
    }));
    CAPTURE(laid.picture);
    const TemporaryFolder folder;
    CHECK_FALSE(set_of(laid, folder).has_value());
}

TEST_CASE("names that many use are no more than a hint", "[sets]") {
    const TemporaryFolder folder;
    const auto estimated = set_of({"photo_depth.png", 16, {"photo.jpg"}}, folder);
    REQUIRE(estimated);
    CHECK(estimated->name == "ZoeDepth");
    CHECK(estimated->finding.sureness < 0.5);
    const auto by_program = set_of({"kitchen_zoe.png", 16}, folder);
    REQUIRE(by_program);
    CHECK(by_program->name == "ZoeDepth");
    CHECK(by_program->finding.sureness > 0.5);
    CHECK(by_program->finding.sureness < kSureEnough);
    const auto stamped = set_of({"depth/1305.160407.png", 16, {"rgb/a.png"}}, folder);
    REQUIRE(stamped);
    CHECK(stamped->name == "TUM RGB-D");
    CHECK(stamped->finding.sureness < 0.5);
}

TEST_CASE("a picture whose name is full of stars is compared at once", "[sets][malformed]") {
    const TemporaryFolder folder;
    std::string stars;
    for (int k = 0; k < 60; ++k) stars += "*a";  // a pattern of the names beside it
    const auto set =
        set_of({stars + "_depth.npy", kRealBits, {std::string(200, 'a') + ".npy"}}, folder);
    CHECK_FALSE(set.has_value());
}

TEST_CASE("scales are read from the files of a data set", "[sets]") {
    const TemporaryFolder folder;
    fs::create_directories(folder / "depth");
    CHECK_FALSE(set_of({"depth/000002.png", 16, {"scene_camera.json"}}, folder).has_value());
    write_text(folder / "scene_camera.json",
               R"({"1": {"cam_K": [1, 0, 2, 0, 1, 2, 0, 0, 1], "depth_scale": 1.0},
                   "2": {"cam_K": [600, 0, 64, 0, 600, 48, 0, 0, 1], "depth_scale": 0.25}})");
    const auto bop = set_of({"depth/000002.png", 16}, folder);
    REQUIRE(bop);
    CHECK(bop->finding.statement.scale == 0.25);
    CHECK(bop->camera->intrinsics == Intrinsics{600.0, 600.0, 64.0, 48.0});
    write_text(folder / "calib.txt",
               "cam0=[1000 0 511; 0 1000 383; 0 0 1]\ndoffs=8\nbaseline=200\nwidth=256\n");
    const auto half = set_of({"disp0.pfm", kRealBits}, folder);  // 128 columns
    REQUIRE(half);
    CHECK(half->law == InverseLevels{100000.0, 4.0});
}

TEST_CASE("numbers that no such data set has are asked about", "[sets]") {
    const TemporaryFolder folder;
    const fs::path file = folder / "velodyne_raw/0000000005.png";
    fs::create_directories(folder / "image");
    save_levels(file, 4 * 256, 60 * 256);
    CHECK(meaning_of(file).scale == Known<double>{1.0 / 256.0, Origin::found});
    CHECK(meaning_of(file).found_in == "KITTI depth completion: metres x 256, 0 is no data");
    save_levels(file, 0, 65535);
    CHECK(asks(open_depth(file, {.find_out = true})->description()));
}

TEST_CASE("a data set's turned bits are turned back, but not in a copy that somebody turned",
          "[sets]") {
    const TemporaryFolder folder;
    for (const char* const name : {"depth_bfx", "image"}) fs::create_directories(folder / name);
    write_text(folder / "intrinsics.txt", "500 0 64 0 500 48 0 0 1");
    const bool is_turned = GENERATE(true, false);
    const int factor = is_turned ? 8 : 1;
    const fs::path file = folder / "depth/0000103.png";
    fs::create_directories(folder / "depth");
    cv::Mat levels(96, 128, CV_16UC1);
    for (int j = 0; j < levels.rows; ++j)
        for (int i = 0; i < levels.cols; ++i)
            levels.at<std::uint16_t>(j, i) =
                static_cast<std::uint16_t>(factor * (1000 + 3 * j + 2 * i));
    picture(levels)(file);
    const DepthMeaning meaning = meaning_of(file);
    CHECK(meaning.code.value == (is_turned ? DepthCode::turned16 : DepthCode::grey));
    CHECK(meaning.range.value.far < 1600.0);
    CHECK(meaning.range.value.near > 900.0);
}

TEST_CASE("the data set of a source is looked for once, and again for other levels", "[sets]") {
    const TemporaryFolder folder;
    SourceFacts facts;
    facts.file = folder / "indoors_depth.npy";
    facts.bits = kRealBits;
    write_text(folder / "indoors_depth_mask.npy", "");
    KnownDataSet known;
    REQUIRE(known.of(facts).has_value());
    fs::remove(folder / "indoors_depth_mask.npy");
    CHECK(known.of(facts)->name == "DIODE");
    facts.bits = 16;
    CHECK_FALSE(known.of(facts).has_value());
    facts.bits = kRealBits;
    CHECK_FALSE(known.of(facts).has_value());
}
