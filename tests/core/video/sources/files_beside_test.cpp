// What lies beside depth and is none: masks, confidence, previews, paintings of it; and numbers,
// which beat paintings.
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "core/video/depth/colour_maps.hpp"
#include "core/video/sources/media.hpp"
#include "core/video/sources/media_names.hpp"
#include "core/video/sources/picture_kind.hpp"
#include "core/video/sources/readers.hpp"
#include "tests/core/video/clips.hpp"
#include "tests/core/video/coded_scene.hpp"
#include "tests/core/video/forms.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;
namespace fs = std::filesystem;

namespace {

constexpr int kColumns = 64;
constexpr int kRows = 48;

/// An array of one level, 1.5 m.
void write_array(const fs::path& file, float level = 1.5F) {
    fs::create_directories(file.parent_path());
    std::string data;
    for (int k = 0; k < kColumns * kRows; ++k)
        append_bytes(data, level + 0.001F * static_cast<float>(k));
    const std::string array = npy("<f4", "(48, 64)", data);
    if (file.extension() == ".npz")
        write_zip(file, {{"depth.npy", array}}, true);
    else
        write_text(file, array);
}

/// A ramp in the colours of a map.
cv::Mat painting(int map = cv::COLORMAP_JET) {
    cv::Mat ramp(kRows, kColumns, CV_8UC1);
    for (int i = 0; i < kColumns; ++i) ramp.col(i) = cv::Scalar(4 * i);
    cv::Mat colours;
    cv::applyColorMap(ramp, colours, map);
    return colours;
}

void write(const fs::path& file, const cv::Mat& picture) {
    fs::create_directories(file.parent_path());
    REQUIRE(cv::imwrite(file.string(), picture));
}

cv::Mat photograph() {
    cv::Mat small;
    cv::resize(scene_photo(), small, {kColumns, kRows}, 0.0, 0.0, cv::INTER_AREA);
    return small;
}

/// Whether that level is the first one of the media's first frame.
bool begins_at(Media& media, float level) {
    return std::abs(media.next()->depth.at(0, 0) - level) < 1e-3F;
}

}  // namespace

TEST_CASE("the last word of a name says that it is a mask, confidence or a painting", "[beside]") {
    for (const char* const name :
         {"a_depth_mask.npy", "depthMask.png", "depth_conf_0001.png", "confidence", "depth_vis.mp4",
          "depth_colored.png", "rock_nor_gl_2k.png", "thumbnail.jpg", "snap_Infrared.png",
          "depth_normals", "confidence_map.png", "gtFine_labelIds.png", "flow_occ",
          "frame_0001_flow.png", "confidence_image.npy", "mask_img_07.png", "normal_pred.npy"}) {
        CAPTURE(name);
        CHECK_FALSE(named_other(name).empty());
        CHECK_FALSE(named_depth(name));
        CHECK_FALSE(named_colour(name));
    }
    for (const char* const name : {"mask_depth.png", "normal_depth.mp4", "arm_depth.png",
                                   "metal_plate_disp_1k.png", "preview_color.png"}) {
        CAPTURE(name);
        CHECK(named_other(name).empty());
        CHECK(named_depth(name) != named_colour(name));
    }
}

TEST_CASE("arrays named as other content are no frames beside the depth", "[beside]") {
    const TemporaryFolder folder;
    write_array(folder / "radial_distance_image.npy");
    write_array(folder / "confidence_image.npy", 128.0F);
    write_array(folder / "norm_amplitude_image.npy", 300.0F);
    const auto media = open_media(folder.path());
    CHECK(media->description().frames == 1);
    CHECK(begins_at(*media, 1.5F));
}

TEST_CASE("pictures of brightness are the colour of the depth beside them", "[beside]") {
    const TemporaryFolder folder;
    cv::Mat grey;
    cv::cvtColor(photograph(), grey, cv::COLOR_BGR2GRAY);
    for (const char* const number : {"1", "2"}) {
        write(folder / ("depth_" + std::string(number) + ".png"),
              cv::Mat(kRows, kColumns, CV_16UC1, cv::Scalar(1500)));
        write(folder / ("amplitude_" + std::string(number) + ".png"), grey);
    }
    const auto media = open_media(folder.path());
    CHECK(media->description().frames == 2);
    CHECK(media->description().colour_path == folder.path());
}

TEST_CASE("an array and a picture of one name are depth and colour, not two frames", "[beside]") {
    const TemporaryFolder folder;
    const std::string ending = GENERATE(".npy", ".npz");
    write_array(folder / ("x" + ending));
    write(folder / "x.png", photograph());
    const fs::path place = GENERATE(0, 1) == 0 ? folder.path() : folder / "x.png";
    const auto media = open_media(place);
    CHECK(media->description().depth_codec == (ending == ".npy" ? "NPY" : "NPZ"));
    CHECK(media->description().frames == 1);
    CHECK(media->description().colour_path == place);
    CHECK(begins_at(*media, 1.5F));
}

TEST_CASE("a painting or a mask beside an array is neither its colour nor a frame", "[beside]") {
    const TemporaryFolder folder;
    write_array(folder / "a.npz");
    const bool is_mask = GENERATE(false, true);
    cv::Mat mask(kRows, kColumns, CV_8UC3, cv::Scalar::all(0));
    mask(cv::Rect(8, 8, 20, 20)) = cv::Scalar::all(255);
    write(folder / "a.png", is_mask ? mask : painting(cv::COLORMAP_TURBO));
    const auto media = open_media(folder.path());
    CHECK(media->description().colour_path.empty());
    CHECK(media->description().frames == 1);
    CHECK(contains(media->description().notice, "'a.png' is left out"));
    CHECK(begins_at(*media, 1.5F));
}

TEST_CASE("a mask beside depth is not felt", "[beside]") {
    const TemporaryFolder folder;
    write_array(folder / "a_depth.npy");
    write_array(folder / "a_depth_mask.npy", 7.0F);
    write(folder / "a_color.png", photograph());
    const fs::path place = GENERATE(0, 1) == 0 ? folder.path() : folder / "a_color.png";
    const auto media = open_media(place);
    CHECK(media->description().frames == 1);
    CHECK(begins_at(*media, 1.5F));
}

TEST_CASE("folders of masks alone are opened, as their owner asks for them", "[beside]") {
    const TemporaryFolder folder;
    write_depth(folder / "mask_1.png", 1);
    write_depth(folder / "mask_2.png", 2);
    CHECK(all_of(*open_depth(folder.path())).size() == 2);
}

TEST_CASE("an array whose name says confidence or a mask is no depth, unless a person says so",
          "[beside]") {
    const TemporaryFolder folder;
    const fs::path file = folder / GENERATE("x_conf.npy", "x_depth_mask.npy", "confidence.npz");
    write_array(file);
    CHECK(contains(refusal([&] { (void)open_media(file); }), "is by its name "));
    CHECK(contains(refusal([&] { (void)open_depth(file); }), "is by its name "));
    CHECK(contains(refusal([&] { (void)describe_media(file); }), "is by its name "));
    DepthRequest stated{.find_out = true};
    stated.command_line.unit = DepthUnit::m;
    CHECK(open_depth(file, stated)->next());
}

TEST_CASE("an array of another shape is refused by its shape, whatever its name", "[beside]") {
    const TemporaryFolder folder;
    write_text(folder / "x_conf.npy",
               npy("<f4", "(40, 60, 2)", std::string(40 * 60 * 2 * 4, '\0')));
    CHECK(contains(refusal([&, file = folder / "x_conf.npy"] { (void)open_media(file); }),
                   "[..., 0]"));
}

TEST_CASE("cameras and poses in arrays hide neither folders of pictures nor become frames",
          "[beside]") {
    const TemporaryFolder folder;
    for (const int number : {1, 2, 3}) {
        const std::string name = std::to_string(number) + ".png";
        write_depth(folder / "depth" / name, number, kColumns, kRows);
        write(folder / "rgb" / name, photograph());
    }
    std::string poses;
    for (int k = 0; k < 3 * 16; ++k) append_bytes(poses, k % 5 == 0 ? 1.0 : 0.0);
    write_text(folder / "camera_poses.npy", npy("<f8", "(3, 4, 4)", poses));
    std::string camera;
    for (const double number : {60.0, 0.0, 31.0, 0.0, 61.0, 24.0, 0.0, 0.0, 1.0})
        append_bytes(camera, number);
    write_text(folder / "camK.npy", npy("<f8", "(3, 3)", camera));
    const auto media = open_media(folder.path(), {}, {.find_out = true});
    CHECK(media->description().frames == 3);
    CHECK(media->description().meaning->intrinsics.value == Intrinsics{60.0, 61.0, 31.0, 24.0});
    CHECK(contains(media->description().meaning->found_in, "camK.npy"));
}

TEST_CASE("a camera file beside a picture says its camera, and what a level is", "[beside]") {
    const TemporaryFolder folder;
    cv::Mat levels(kRows, kColumns, CV_16UC1);
    for (int i = 0; i < kColumns; ++i) levels.col(i) = cv::Scalar(6000 + 20 * i);
    write(folder / "depth.png", levels);
    write(folder / "color.png", photograph());
    const std::string json = GENERATE(
        R"({"width": 128, "height": 96, "fx": 120, "fy": 120, "ppx": 63.5, "ppy": 47.5,
            "depth_scale": 0.00025})",
        R"({"depth_scale": 4000, "depth": {"w": 128, "h": 96, "fx": 120, "cx": 63.5, "cy": 47.5}})",
        R"({"width": 128, "height": 96, "K": [[120, 0, 63.5], [0, 120, 47.5], [0, 0, 1]],
            "factor_depth": 0.25})");
    write_text(folder / "intrinsics.json", json);
    const auto media = open_media(folder / "color.png", folder / "depth.png", {.find_out = true});
    const DepthMeaning& meaning = *media->description().meaning;
    CHECK(meaning.unit.value == DepthUnit::mm);
    CHECK(std::abs(meaning.scale.value - 0.25) < 1e-12);
    CHECK(meaning.intrinsics.value == Intrinsics{60.0, 60.0, 31.5, 23.5});
    CHECK(contains(media->description().notice, "so it is scaled to 64 x 48"));
}

TEST_CASE("a camera beside that is none of the picture is left out, and said to be", "[beside]") {
    const TemporaryFolder folder;
    write(folder / "depth.png", cv::Mat(kRows, kColumns, CV_16UC1, cv::Scalar(900)));
    write_text(folder / "camera_info.json",
               GENERATE(R"({"width": 1280, "height": 1280, "fx": 900, "cx": 640, "cy": 360})",
                        R"({"width": 64, "height": 48, "K": [0, 0, 0, 0, 0, 0, 0, 0, 0]})"));
    const auto media = open_depth(folder / "depth.png", {.find_out = true});
    CHECK_FALSE(media->description().meaning->intrinsics.value);
    CHECK(contains(media->description().notice, "so it is left out"));
}

TEST_CASE("a folder of depth takes BOP's scale of a scene, whatever its own name is", "[beside]") {
    const TemporaryFolder folder;
    write_depth(folder / "frames_d/000000.png", 10, kColumns, kRows);
    write_depth(folder / "frames_d/000001.png", 11, kColumns, kRows);
    write_text(folder / "scene_camera.json",
               R"({"0": {"cam_K": [60, 0, 31, 0, 61, 24, 0, 0, 1], "depth_scale": 0.1}})");
    const auto media = open_depth(folder / "frames_d", {.find_out = true});
    CHECK(media->description().meaning->unit.value == DepthUnit::mm);
    CHECK(std::abs(media->description().meaning->scale.value - 0.1) < 1e-12);
    CHECK(media->description().meaning->intrinsics.value == Intrinsics{60.0, 61.0, 31.0, 24.0});
}

TEST_CASE("numbers beat the painting of depth that lies beside them", "[beside]") {
    const TemporaryFolder folder;
    write(folder / "snap_Color.png", photograph());
    write(folder / "snap_Depth.png", painting());
    write(folder / "snap_Infrared.png", photograph());
    write_text(folder / "snap_Depth_metadata.csv", "Frame Info\nFrame Number,7\n");
    const bool is_raw = GENERATE(false, true);
    if (is_raw) {
        std::string levels;
        for (int k = 0; k < kColumns * kRows; ++k)
            append_bytes(levels, static_cast<std::uint16_t>(1500 + k));
        write_text(folder / "snap_Depth.raw", levels);
    } else {
        write_array(folder / "snap_Depth.npy");
    }
    const fs::path numbers = folder / (is_raw ? "snap_Depth.raw" : "snap_Depth.npy");
    const float first = is_raw ? 1500.0F : 1.5F;
    const auto whole = open_media(folder.path());
    CHECK(whole->description().frames == 1);
    CHECK(begins_at(*whole, first));
    const auto by_colour = open_media(folder / "snap_Color.png");
    CHECK(by_colour->description().depth_path == numbers);
    const auto by_painting = open_media(folder / "snap_Depth.png");
    CHECK(by_painting->description().depth_path == numbers);
    CHECK(contains(by_painting->description().notice, "the numbers that 'snap_Depth.png' paints"));
    CHECK(begins_at(*open_depth(folder / "snap_Depth.png"), first));
    CHECK(begins_at(*open_media(folder / "snap_Color.png", folder / "snap_Depth.png"), first));
}

TEST_CASE("raw levels without the picture that has their size are refused with the way",
          "[beside]") {
    const TemporaryFolder folder;
    write_text(folder / "d_Depth.raw", std::string(2 * kColumns * kRows, '\5'));
    const bool has_other = GENERATE(false, true);
    if (has_other) write(folder / "d_Depth.png", cv::Mat(20, 20, CV_8UC3, cv::Scalar::all(9)));
    CHECK(contains(refusal([&] { (void)open_depth(folder / "d_Depth.raw"); }),
                   "numpy.fromfile('d_Depth.raw'"));
}

TEST_CASE("estimators' folders of painted, grey and array depth are the arrays", "[beside]") {
    const TemporaryFolder folder;
    write_array(folder / "depth_npy/1_pred.npy");
    write(folder / "depth_bw/1_pred.png", cv::Mat(kRows, kColumns, CV_16UC1, cv::Scalar(9)));
    write(folder / "depth_colored/1_pred_colored.png", painting());
    CHECK(begins_at(*open_depth(folder.path()), 1.5F));
}

TEST_CASE("a thumbnail or a cover does not hide the recording of a folder", "[beside]") {
    const TemporaryFolder folder;
    const std::string cover = GENERATE("thumbnail.jpg", "IMG_1.jpg", "color_preview.png");
    write(folder / cover, photograph());
    const bool is_film = GENERATE(false, true);
    if (is_film)
        make_flat_clip(folder / "walk.mkv", 3, 25, kLossless);
    else
        for (const int number : {1, 2, 3}) {
            write_depth(folder / ("depth/" + std::to_string(number) + ".png"), number);
            write_colour(folder / ("rgb/" + std::to_string(number) + ".png"), number);
        }
    const auto media = open_depth(folder.path());
    CHECK(all_of(*media).size() == 3);
    if (is_film) CHECK(media->description().depth_path == folder / "walk.mkv");
}

TEST_CASE("colours of colour maps are told from photographs and from hues of one colour",
          "[beside]") {
    const int map = GENERATE(cv::COLORMAP_JET, cv::COLORMAP_TURBO, cv::COLORMAP_VIRIDIS,
                             cv::COLORMAP_INFERNO, cv::COLORMAP_MAGMA, cv::COLORMAP_PLASMA);
    CHECK(is_colour_mapped(painting(map)));
    const bool is_rainbow = map == cv::COLORMAP_JET || map == cv::COLORMAP_TURBO;
    CHECK(has_map_of_rising_brightness(painting(map)) != is_rainbow);
    CHECK_FALSE(is_colour_mapped(scene_photo()));
    CHECK_FALSE(is_colour_mapped(painted(scene_depth(), as_grey)));
    CHECK_FALSE(is_colour_mapped(cv::Mat(60, 60, CV_8UC3, cv::Scalar(0, 0, 255))));
    CHECK_FALSE(is_colour_mapped(cv::Mat()));
    CHECK_FALSE(has_two_levels(cv::Mat(60, 60, CV_8UC3, cv::Scalar(0, 0, 255))));
    CHECK_FALSE(has_two_levels(scene_photo()));
}

TEST_CASE("a picture and its depth with a white gap between are taken apart at the gap",
          "[beside]") {
    const TemporaryFolder folder;
    const cv::Mat gap(kSceneRows, 50, CV_8UC3, cv::Scalar::all(255));
    const cv::Mat grey = painted(scene_depth(), as_grey);
    cv::Mat figure;
    cv::hconcat(std::vector<cv::Mat>{scene_photo(), gap, grey}, figure);
    CHECK(gap_between_halves(figure, DepthPacking::left_right) == 50);
    CHECK(gap_between_halves(figure, DepthPacking::top_bottom) == 0);
    write(folder / "figure.png", figure);
    const auto media = open_media(folder / "figure.png", {}, {.find_out = true});
    CHECK(media->description().depth_columns == kSceneColumns);
    CHECK(media->description().colour_columns == kSceneColumns);
    CHECK(media->description().meaning->packing.value == DepthPacking::left_right);
    // As a session asks for it again.
    DepthRequest again{.find_out = true};
    again.recorded.packing = DepthPacking::left_right;
    again.recorded.code = DepthCode::grey;
    CHECK(open_media(folder / "figure.png", {}, again)->description().depth_columns ==
          kSceneColumns);
}

TEST_CASE("a picture beside a painting of its depth is named for what it is", "[beside]") {
    const TemporaryFolder folder;
    const cv::Mat gap(kSceneRows, 50, CV_8UC3, cv::Scalar::all(255));
    cv::Mat inferno;
    cv::Mat grey;
    cv::cvtColor(painted(scene_depth(), as_grey), grey, cv::COLOR_BGR2GRAY);
    cv::applyColorMap(grey, inferno, cv::COLORMAP_INFERNO);
    cv::Mat figure;
    cv::hconcat(std::vector<cv::Mat>{scene_photo(), gap, inferno}, figure);
    write(folder / "figure.png", figure);
    CHECK(contains(refusal([&] { (void)open_media(folder / "figure.png"); }),
                   "a picture beside a painting of its depth"));
}

TEST_CASE("an array file whose colours have a shape of no pictures opens its depth, and says so",
          "[beside]") {
    const TemporaryFolder folder;
    std::string depth;
    for (int k = 0; k < 12; ++k) append_bytes(depth, 1.0F + static_cast<float>(k));
    const auto [shape, colours] = GENERATE(table<std::string, bool>(
        {{"(1, 1, 3, 4, 3)", true}, {"(1, 3, 1, 3, 4)", false}, {"(2, 2, 3, 3, 1)", false}}));
    CAPTURE(shape);
    write_zip(folder / "both.npz",
              {{"depth.npy", npy("<f4", "(3, 4)", depth)},
               {"images.npy", npy("|u1", shape, std::string(36, '\7'))}},
              true);
    const auto media = open_media(folder / "both.npz");
    CHECK(media->description().colour_path.empty() != colours);
    CHECK(contains(media->description().notice, "only the depth is opened") != colours);
    CHECK(std::abs(media->next()->depth.at(3, 2) - 12.0F) < 1e-3F);
}
