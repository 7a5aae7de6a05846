// The folders that scanner apps of phones export are opened as colour and depth in millimetres, and
// with the camera of the colour pictures.
#include "core/video/sources/layouts/scanner_layouts.hpp"

#include <filesystem>
#include <string>

#include "core/video/sources/media.hpp"
#include "core/video/sources/readers.hpp"
#include "tests/core/video/clips.hpp"
#include "tests/core/video/stated.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;
namespace fs = std::filesystem;

namespace {

/// As a phone's LiDAR has it.
void write_lidar(const fs::path& file, int number) {
    write_depth(file, number, 256, 192);
}

void write_level(const fs::path& file, int level) {
    fs::create_directories(file.parent_path());
    write_picture(file, 256, 192, 8, 1, [=](int i, int, int) { return i < 9 ? 0 : level; });
}

/// The camera of 1920 x 1440 pixels for pictures of 256 x 192.
const Intrinsics kLidarCamera{192.0, 192.0, 127.5, 95.5};
const std::string kMatrix = "1440.0,0.0,959.5\n0.0,1440.0,719.5\n0.0,0.0,1.0\n";

}  // namespace

TEST_CASE("Stray Scanner's folder is its film with its folder of depth, without the confidence",
          "[scanners]") {
    const TemporaryFolder folder;
    make_flat_clip(folder / "rgb.mp4", 4, 30, kH264);
    for (int k = 0; k < 4; ++k) {
        write_lidar(folder / ("depth/00000" + std::to_string(k) + ".png"), 20 + k);
        write_level(folder / ("confidence/00000" + std::to_string(k) + ".png"), 2);
    }
    write_text(folder / "odometry.csv", "timestamp, frame, x, y, z, qx, qy, qz, qw\n");
    write_text(folder / "camera_matrix.csv", kMatrix);
    const auto media = open_media(folder.path(), {}, {.find_out = true});
    const MediaDescription& said = media->description();
    CHECK(said.colour_path == folder / "rgb.mp4");
    CHECK(said.depth_path == folder / "depth");
    CHECK(said.meaning->unit == Known<DepthUnit>{DepthUnit::mm, Origin::found});
    CHECK(said.meaning->intrinsics.value == kLidarCamera);
    CHECK(said.meaning->found_in == "Stray Scanner's folders");
    CHECK(describe_media(folder.path()).depth_path == folder / "depth");
    CHECK(open_depth(folder.path(), {.find_out = true})->description().meaning->is_metric());
    CHECK(all_of(*open_media(folder.path())).front().depth == 20);
}

TEST_CASE("Polycam's export opens at its top and at its keyframes, in spite of its thumbnail",
          "[scanners]") {
    const TemporaryFolder folder;
    for (const std::string time : {"48389034120", "48389534120"}) {
        const fs::path frames = folder / "keyframes";
        const int number = time[4] == '9' && time[5] == '0' ? 3 : 4;
        write_lidar(frames / "depth" / (time + ".png"), number);
        write_level(frames / "confidence" / (time + ".png"), 127);
        write_colour(frames / "images" / (time + ".jpg"), 10 * number);
        write_colour(frames / "corrected_images" / (time + ".jpg"), 200);
        for (const char* const cameras : {"cameras", "corrected_cameras"}) {
            fs::create_directories(frames / cameras);
            write_text(frames / cameras / (time + ".json"),
                       R"({"fx": 720, "fy": 720, "cx": 511.5, "cy": 383.5, "width": 1024,
                           "height": 768, "t_00": 1})");
        }
    }
    write_colour(folder / "thumbnail.jpg", 250);
    write_text(folder / "mesh_info.json", "{}");
    const fs::path place = GENERATE(false, true) ? folder / "keyframes" : folder.path();
    const auto media = open_media(place, {}, {.find_out = true});
    CHECK(media->description().meaning->unit.value == DepthUnit::mm);
    CHECK(media->description().meaning->intrinsics.value == Intrinsics{180, 180, 127.5, 95.5});
    const auto shown = all_of(*open_media(place));
    REQUIRE(shown.size() == 2);
    CHECK(shown[0].depth == 3);
    CHECK(shown[0].colour == 30);
    CHECK(shown[1].depth == 4);
}

TEST_CASE("3D Scanner App's frames go with its depth by their numbers, its confidence with none",
          "[scanners]") {
    const TemporaryFolder folder;
    for (const int number : {3, 6}) {
        const std::string name = "0000" + std::to_string(number);
        write_lidar(folder / ("depth_" + name + ".png"), number);
        write_level(folder / ("conf_" + name + ".png"), 2);
        write_text(
            folder / ("frame_" + name + ".json"),
            R"({"frame_index": 3, "intrinsics": [1440, 0, 959.5, 0, 1440, 719.5, 0, 0, 1]})");
    }
    write_colour(folder / "frame_00003.jpg", 30);
    const bool has_info = GENERATE(false, true);
    if (has_info) write_text(folder / "info.json", "{}");
    const auto media = open_media(folder.path(), {}, {.find_out = true});
    CHECK(media->description().meaning->intrinsics.value.has_value() == has_info);
    if (has_info) CHECK(media->description().meaning->intrinsics.value == kLidarCamera);
    const auto shown = all_of(*open_media(folder.path()));
    REQUIRE(shown.size() == 2);
    CHECK(shown[0].depth == 3);
    CHECK(shown[1].depth == 6);
    CHECK(shown[1].colour == 30);
}

TEST_CASE("a camera whose centre is not that of an app's pictures is of smaller ones",
          "[scanners]") {
    const TemporaryFolder folder;
    write_lidar(folder / "depth_00003.png", 3);
    write_lidar(folder / "depth_00006.png", 6);
    write_colour(folder / "frame_00003.jpg", 30);
    write_text(folder / "frame_00003.json",
               R"({"intrinsics": [192, 0, 127.5, 0, 192, 95.5, 0, 0, 1]})");
    write_text(folder / "info.json", "{}");
    const auto media = open_media(folder.path(), {}, {.find_out = true});
    CHECK(media->description().meaning->intrinsics.value == kLidarCamera);
    CHECK_FALSE(contains(media->description().notice, "scaled"));
}

TEST_CASE("ARKitScenes' folders say millimetres and the camera of a line", "[scanners]") {
    const TemporaryFolder folder;
    write_lidar(folder / "lowres_depth/42445448_12.500.png", 7);
    write_lidar(folder / "lowres_depth/42445448_12.600.png", 8);
    write_colour(folder / "lowres_wide/42445448_12.500.png", 70);
    write_level(folder / "confidence/42445448_12.500.png", 2);
    fs::create_directories(folder / "lowres_wide_intrinsics");
    write_text(folder / "lowres_wide_intrinsics/42445448_12.500.pincam",
               "256 192 212 212 127 95\n");
    const auto media = open_media(folder.path(), {}, {.find_out = true});
    CHECK(media->description().meaning->unit.value == DepthUnit::mm);
    CHECK(media->description().meaning->intrinsics.value == Intrinsics{212, 212, 127, 95});
    CHECK(all_of(*open_media(folder.path())).size() == 2);
}

TEST_CASE("a folder of a film and depth without an app's sign says nothing of millimetres",
          "[scanners]") {
    const TemporaryFolder folder;
    write_lidar(folder / "depth/1.png", 20);
    make_flat_clip(folder / "rgb.mp4", 4, 30, kH264);
    CHECK_FALSE(scanner_folder(folder.path()));
    CHECK(stated_by(open_picture_source(folder / "depth", PictureRole::depth)->facts()) ==
          DepthStatement{});
}
