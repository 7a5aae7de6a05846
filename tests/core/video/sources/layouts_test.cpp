// What belongs together, and what a layout says of depth: datasets' folders, patterns of names,
// folders of videos.
#include "core/video/sources/layouts/layouts.hpp"

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/video/sources/media.hpp"
#include "core/video/sources/media_names.hpp"
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

using Write = std::function<void(const fs::path&, int)>;

/// Of the size for which datasets' cameras are known.
void write_vga_depth(const fs::path& file, int number) {
    write_depth(file, number, 640, 480);
}

SourceFacts depth_facts(const fs::path& place) {
    return open_picture_source(place, PictureRole::depth)->facts();
}

void write_clip(const fs::path& file) {
    fs::create_directories(file.parent_path());
    const TemporaryFolder plain;
    make_flat_clip(plain / "clip.mkv", 3, 25, kLossless);
    fs::copy_file(plain / "clip.mkv", file);
}

}  // namespace

TEST_CASE("7-Scenes' names say millimetres, two levels of no data, and its camera", "[layouts]") {
    const TemporaryFolder folder;
    for (int number = 0; number < 2; ++number) {
        const std::string name = "frame-00000" + std::to_string(number);
        write_vga_depth(folder / (name + ".depth.png"), number);
        write_colour(folder / (name + ".color.png"), number);
        write_text(folder / (name + ".pose.txt"), "1 0 0 0\n");
    }
    const SourceFacts facts = depth_facts(folder.path());
    CHECK(stated_by(facts).unit == DepthUnit::mm);
    CHECK(stated_by(facts).scale == 1.0);
    CHECK(stated_by(facts).no_data == std::vector<double>{0.0, 65535.0});
    CHECK(stated_by(facts).intrinsics == Intrinsics{585.0, 585.0, 320.0, 240.0});
    CHECK(origins_of(facts.findings) == "7-Scenes names");
    CHECK(contains(open_media(folder.path(), {}, {.find_out = true})->description().notice,
                   "does not tell how they stand"));
    CHECK(all_of(*open_media(folder.path())).size() == 2);
}

TEST_CASE("tsdf-fusion's names say millimetres, and a file beside them the camera", "[layouts]") {
    const TemporaryFolder folder;
    write_vga_depth(folder / "frame-000000.depth.png", 1);
    write_colour(folder / "frame-000000.color.jpg", 1);
    CHECK(stated_by(depth_facts(folder.path())).unit == DepthUnit::mm);
    CHECK_FALSE(stated_by(depth_facts(folder.path())).intrinsics);
    write_text(folder / "camera-intrinsics.txt",
               " 5.1e+02 0 3.0e+02\n 0 5.2e+02 2.0e+02\n 0 0 1\n");
    CHECK(stated_by(depth_facts(folder.path())).intrinsics ==
          Intrinsics{510.0, 520.0, 300.0, 200.0});
}

TEST_CASE("ScanNet's folders say millimetres and the depth camera", "[layouts]") {
    const TemporaryFolder folder;
    for (const int number : {0, 1, 10}) {
        write_vga_depth(folder / "depth" / (std::to_string(number) + ".png"), number);
        write_colour(folder / "color" / (std::to_string(number) + ".jpg"), 20 * number);
    }
    fs::create_directories(folder / "intrinsic");
    write_text(folder / "intrinsic/intrinsic_depth.txt",
               "577.59 0 318.905 0\n0 578.73 242.684 0\n0 0 1 0\n0 0 0 1\n");
    const SourceFacts facts = depth_facts(folder.path());
    CHECK(stated_by(facts).unit == DepthUnit::mm);
    CHECK(stated_by(facts).no_data == std::vector<double>{0.0});
    CHECK(stated_by(facts).intrinsics == Intrinsics{577.59, 578.73, 318.905, 242.684});
    CHECK(origins_of(facts.findings) == "ScanNet's folders");
    const auto shown = all_of(*open_media(folder.path()));
    REQUIRE(shown.size() == 3);
    CHECK(shown[2].depth == 10);
    CHECK(shown[2].colour == 200);
}

TEST_CASE("Open3D's camera file says the scale and the intrinsics, column by column", "[layouts]") {
    const TemporaryFolder folder;
    const std::string colour = GENERATE("color", "image", "rgb");
    write_vga_depth(folder / "depth/000001.png", 1);
    write_colour(folder / colour / "000001.png", 1);
    const auto said = depth_facts(folder.path());
    CHECK((stated_by(said).unit == DepthUnit::mm) ==
          (colour != "rgb"));  // TUM's folders are so, too
    write_text(folder / "camera_intrinsic.json",
               R"({"width": 640, "height": 480, "depth_scale": 4000,
                   "intrinsic_matrix": [525.0, 0, 0, 0, 526.0, 0, 319.5, 239.5, 1]})");
    const auto facts = depth_facts(folder.path());
    CHECK(stated_by(facts).unit == DepthUnit::mm);
    CHECK(stated_by(facts).scale == 0.25);
    CHECK(stated_by(facts).intrinsics == Intrinsics{525.0, 526.0, 319.5, 239.5});
}

TEST_CASE("a camera file that is broken or of other pictures says nothing", "[layouts]") {
    const TemporaryFolder folder;
    write_vga_depth(folder / "depth/000001.png", 1);
    write_colour(folder / "color/000001.png", 1);
    const std::string json = GENERATE("", "{", "[]", R"({"intrinsic_matrix": [1, 2]})",
                                      R"({"intrinsic_matrix": ["a", 0, 0, 0, 5, 0, 3, 2, 1]})",
                                      R"({"intrinsic_matrix": [-5, 0, 0, 0, 5, 0, 3, 2, 1]})",
                                      R"({"intrinsic_matrix": [1e999, 0, 0, 0, 5, 0, 3, 2, 1]})",
                                      R"({"width": 64, "height": 48,
                     "intrinsic_matrix": [525, 0, 0, 0, 526, 0, 319, 239, 1]})");
    CAPTURE(json);
    write_text(folder / "camera_intrinsic.json", json);
    const SourceFacts facts = depth_facts(folder.path());
    CHECK(stated_by(facts).unit == DepthUnit::mm);
    CHECK_FALSE(stated_by(facts).intrinsics);
    const bool is_read = contains(json, "-5") || contains(json, "width");
    CHECK(contains(facts.notice, "--intrinsics") == is_read);
}

TEST_CASE("a camera of the full pictures is scaled for depth that was made smaller", "[layouts]") {
    const TemporaryFolder folder;
    write_depth(folder / "depth/000001.png", 1, 424, 240);
    write_colour(folder / "color/000001.png", 1);
    write_text(folder / "camera_intrinsic.json", R"({"width": 848, "height": 480,
        "intrinsic_matrix": [424.5, 0, 0, 0, 425.5, 0, 423.5, 239.5, 1]})");
    const SourceFacts facts = depth_facts(folder.path());
    CHECK(stated_by(facts).intrinsics == Intrinsics{212.25, 212.75, 211.5, 119.5});
    CHECK(contains(facts.notice, "scaled to 424 x 240"));
}

TEST_CASE("a plain folder of 16-bit pictures says nothing, nor do 8 bits in a dataset's layout",
          "[layouts]") {
    const TemporaryFolder folder;
    write_vga_depth(folder / "walker/frame_00001.png", 1);
    CHECK(stated_by(depth_facts(folder / "walker")) == DepthStatement{});
    CHECK(origins_of(depth_facts(folder / "walker").findings).empty());
    fs::create_directories(folder / "set/depth");
    write_picture(folder / "set/depth/1.png", 16, 12, 8, 1, [](int, int, int) { return 7; });
    write_colour(folder / "set/color/1.png", 1);
    CHECK(stated_by(depth_facts(folder / "set")) == DepthStatement{});
}

TEST_CASE("names of colour and depth beside each other are told apart in many words", "[layouts]") {
    const TemporaryFolder folder;
    const auto [colour, depth] = GENERATE(
        table<std::string, std::string>({{"Bark014_albedo_1024.jpg", "Bark014_displacement.png"},
                                         {"rock_diff_1k.jpg", "rock_disp_1k.png"},
                                         {"stone_Color.png", "stone_Height.png"},
                                         {"image/0001.png", "mono_depth/0001.png"},
                                         {"left/0001.png", "disparity/0001.png"},
                                         {"FARBE/0001.png", "TIEFE/0001.png"},
                                         {"couleur_1.png", "profondeur_1.png"},
                                         {"房间.png", "房间_深度.png"},
                                         {"color/1.png", "profundidad/1.png"},
                                         {"colore/1.png", "profondita/1.png"},
                                         {"0001.png", "0001_depth.png"},
                                         {"img_7.png", "disp_7.png"},
                                         {"im0.png", "disp0.png"},
                                         {"photo/25.png", "depth/25.png"},
                                         {"image_left/1.png", "depth_left/1.png"},
                                         {"results/frame1.png", "results/depth1.png"}}));
    CAPTURE(colour, depth);
    write_colour(folder / colour, 7);
    write_vga_depth(folder / depth, 3);
    const auto shown = all_of(*open_media(folder.path()));
    REQUIRE(shown.size() == 1);
    CHECK(shown[0].depth == 3);
    CHECK(shown[0].colour == 7);
}

TEST_CASE("a stereo pair, and words inside other words, are not taken for colour and depth",
          "[layouts]") {
    const TemporaryFolder folder;
    write_colour(folder / "left/1.png", 1);
    write_colour(folder / "right/1.png", 1);
    CHECK_FALSE(refusal([&] { (void)open_media(folder.path()); }).empty());
    CHECK_FALSE(named_depth("display.mp4"));
    CHECK_FALSE(named_depth("heights_of_abraham.mp4"));
    CHECK_FALSE(named_depth("stiefel.mp4"));
    CHECK_FALSE(named_colour("different.mp4"));
    CHECK(named_depth("Rock035_Height.png"));
    CHECK(named_depth("disp0.png"));
}

TEST_CASE("16-bit pictures called images are depth where nothing else is", "[layouts]") {
    const TemporaryFolder folder;
    write_vga_depth(folder / "image_0001.png", 1);
    write_vga_depth(folder / "image_0002.png", 2);
    CHECK(all_of(*open_depth(folder.path())).size() == 2);
}

TEST_CASE("a printf pattern names pictures from any number on, with gaps, in order", "[layouts]") {
    const TemporaryFolder folder;
    for (const int number : {9, 10, 100}) {
        const std::string text = std::to_string(number);
        write_vga_depth(
            folder / "d" / ("depth_" + std::string(4 - text.size(), '0') + text + "_16.png"),
            number);
        write_colour(folder / "c" / (text + ".jpg"), 2 * number);
    }
    write_colour(folder / "c/cover.jpg", 1);
    write_vga_depth(folder / "d/other_0001_16.png", 1);
    const auto media = open_media(folder / "c/%d.jpg", folder / "d/depth_%04d_16.png");
    const auto shown = all_of(*media);
    REQUIRE(shown.size() == 3);
    CHECK(shown[0].depth == 9);
    CHECK(shown[2].depth == 100);
    CHECK(shown[2].colour == 200);
    CHECK(all_of(*open_depth(folder / "d/depth_%04d_16.png")).size() == 3);
    CHECK(all_of(*open_depth(folder / "d/*.png")).size() == 4);
    CHECK(all_of(*open_depth(folder / "d/depth*16*")).size() == 3);
    CHECK(contains(refusal([&] { (void)open_depth(folder / "d/x_%d.png"); }), "pattern"));
    CHECK(contains(refusal([&] { (void)open_depth(folder / "d/*x*x*x*.png"); }), "pattern"));
}

TEST_CASE("a file whose name looks like a pattern is that file", "[layouts]") {
    const TemporaryFolder folder;
    write_vga_depth(folder / "100%d.png", 5);
    write_vga_depth(folder / "1001.png", 6);
    CHECK(all_of(*open_depth(folder / "100%d.png")).front().depth == 5);
}

TEST_CASE("a folder that holds a colour and a depth video opens them, whatever else is there",
          "[layouts]") {
    const TemporaryFolder folder;
    const auto [colour, depth] = GENERATE(table<std::string, std::string>(
        {{"color.mkv", "depth.mkv"},
         {"My Ünïcode 'take' rgb.mkv", "my ünïcode 'take' depth.mkv"},
         {"take2.mkv", "take2_depth.mkv"},
         {"the_color.mkv", "a_disparity.mkv"}}));
    CAPTURE(colour, depth);
    write_clip(folder / colour);
    write_clip(folder / depth);
    write_vga_depth(folder / "derived/depth/1.png", 1);
    write_colour(folder / "derived/rgb/1.png", 1);
    const auto media = open_media(folder.path());
    CHECK(media->description().colour_path == folder / colour);
    CHECK(media->description().depth_path == folder / depth);
    CHECK(media->description().notice.empty());
    CHECK(open_depth(folder.path())->description().depth_path == folder / depth);
    CHECK(describe_media(folder.path()).depth_path == folder / depth);
}

TEST_CASE("of several pairs of videos the first in natural order is opened, and the others told",
          "[layouts]") {
    const TemporaryFolder folder;
    for (const std::string take : {"2", "10"}) {
        write_clip(folder / ("take" + take + "_color.mkv"));
        write_clip(folder / ("take" + take + "_depth.mkv"));
    }
    write_clip(folder / "lonely_depth.mkv");
    const auto media = open_media(folder.path());
    CHECK(media->description().colour_path == folder / "take2_color.mkv");
    CHECK(media->description().depth_path == folder / "take2_depth.mkv");
    CHECK(contains(media->description().notice, "'take10_color.mkv' with 'take10_depth.mkv'"));
    CHECK(describe_media(folder.path()).notice == media->description().notice);
}

TEST_CASE("a folder of one video is that video", "[layouts]") {
    const TemporaryFolder folder;
    write_clip(folder / "scan.mkv");
    CHECK(open_depth(folder.path())->description().depth_path == folder / "scan.mkv");
    CHECK(contains(refusal([&] { (void)open_media(folder.path()); }), "scan.mkv"));
}

TEST_CASE("colour and depth that are given the other way round by their names are swapped and told",
          "[layouts]") {
    const TemporaryFolder folder;
    write_clip(folder / "my_depth.mkv");
    write_clip(folder / "my_color.mkv");
    const auto swapped = open_media(folder / "my_depth.mkv", folder / "my_color.mkv");
    CHECK(swapped->description().depth_path == folder / "my_depth.mkv");
    CHECK(contains(swapped->description().notice, "'my_color.mkv' as colour"));
    const auto right = open_media(folder / "my_color.mkv", folder / "my_depth.mkv");
    CHECK(right->description().notice.empty());
    write_vga_depth(folder / "depth/1.png", 4);
    write_colour(folder / "rgb/1.png", 9);
    const auto patterns = all_of(*open_media(folder / "depth/%d.png", folder / "rgb/%d.png"));
    REQUIRE(patterns.size() == 1);
    CHECK(patterns[0].depth == 4);
    CHECK(patterns[0].colour == 9);
}

TEST_CASE("names that say both, or nothing, are taken as they are given", "[layouts]") {
    const TemporaryFolder folder;
    write_clip(folder / "depth_of_color.mkv");
    write_clip(folder / "color_depth.mkv");
    write_clip(folder / "a.mkv");
    const auto both = open_media(folder / "depth_of_color.mkv", folder / "color_depth.mkv");
    CHECK(both->description().colour_path == folder / "depth_of_color.mkv");
    const auto one = open_media(folder / "color_depth.mkv", folder / "a.mkv");
    CHECK(one->description().colour_path == folder / "color_depth.mkv");
}

TEST_CASE("the depth beside a file is found also where only its name has a word", "[layouts]") {
    const TemporaryFolder folder;
    std::string looked_for;
    write_text(folder / "IMG_1234.mov", "c");
    write_text(folder / "IMG_1234_depth.mov", "d");
    write_text(folder / "IMG_1235_depth.mov", "d");
    write_text(folder / "IMG_1234_depth.txt", "no media");
    CHECK(find_depth_beside(folder / "IMG_1234.mov", looked_for) == folder / "IMG_1234_depth.mov");
    CHECK(find_colour_beside(folder / "IMG_1234_depth.mov") == folder / "IMG_1234.mov");
    CHECK_FALSE(find_colour_beside(folder / "IMG_1235_depth.mov"));
    write_text(folder / "Bark_albedo.jpg", "c");
    write_text(folder / "Bark_displacement.jpg", "d");
    CHECK(find_depth_beside(folder / "Bark_albedo.jpg", looked_for) ==
          folder / "Bark_displacement.jpg");
}
