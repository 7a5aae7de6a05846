// Touch maps as pictures beside a recording: found by name, kept to the bit, limits stated.
#include "core/video/sources/touch_map_files.hpp"

#include <filesystem>
#include <opencv2/imgcodecs.hpp>

#include "core/error.hpp"
#include "core/video/sources/media_names.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;
using Catch::Matchers::Contains;
using Catch::Matchers::WithinAbs;
namespace fs = std::filesystem;

namespace {

TouchMap noisy_map(TouchMapKind kind, int columns, int rows, MapLimits limits) {
    TouchMap map = bare_map(kind, columns, rows);
    map.limits = limits;
    unsigned seed = 7;
    const auto next = [&seed] {
        seed = seed * 1664525U + 1013904223U;
        return static_cast<std::uint16_t>(seed >> 16U);
    };
    for (TouchMap::Pixel& pixel : map.pixels) {
        pixel.level = next();
        pixel.cover = next();
    }
    return map;
}

void write_grey(const fs::path& file, int columns, int rows, int level, int type = CV_8UC1) {
    REQUIRE(cv::imwrite(file.string(), cv::Mat(rows, columns, type, cv::Scalar(level))));
}

}  // namespace

TEST_CASE("touch maps that are written beside a recording are read again to the bit", "[maps]") {
    const TemporaryFolder folder;
    const fs::path depth = folder / "cup_depth.mp4";
    TouchMaps maps;
    maps.stiffness = noisy_map(TouchMapKind::stiffness, 31, 17, {0.1, 3.0});
    maps.height = noisy_map(TouchMapKind::height, 40, 30, {-4.0, 9.5});
    write_touch_maps(maps, depth);
    CHECK(names_in(folder.path()) ==
          std::vector<std::string>{"cup_height.png", "cup_maps.toml", "cup_stiffness.png"});
    const auto read = read_touch_maps(depth, 40, 30);
    REQUIRE(read);
    CHECK(read->stiffness == maps.stiffness);
    CHECK(read->height == maps.height);
    CHECK(read->friction.empty());
    CHECK(read->at_vertices.columns == 40);

    // What covers nothing any more leaves no file.
    maps.stiffness = bare_map(TouchMapKind::stiffness, 31, 17);
    maps.height = {};
    write_touch_maps(maps, depth);
    CHECK(names_in(folder.path()).empty());
    CHECK(read_touch_maps(depth, 40, 30) == nullptr);
}

TEST_CASE("a grey picture of anybody's is a map that covers all, linear between its limits",
          "[maps]") {
    const TemporaryFolder folder;
    const fs::path depth = folder / "depth.png";
    write_grey(folder / "depth_stiffness.png", 8, 6, 51);
    write_grey(folder / "depth_friction.png", 4, 3, 13107, CV_16UC1);
    const auto maps = read_touch_maps(depth, 8, 6);
    REQUIRE(maps);
    CHECK_THAT(map_value(maps->stiffness, 3.0, 3.0, 8, 6, 0.7), WithinAbs(0.4, 1e-9));
    CHECK_THAT(map_value(maps->friction, 3.0, 3.0, 8, 6, 0.7), WithinAbs(0.4, 1e-9));

    write_text(folder / "depth_maps.toml", "[stiffness]\nlowest = 1\nhighest = 6.0\n");
    const auto other = read_touch_maps(depth, 8, 6);
    CHECK_THAT(map_value(other->stiffness, 3.0, 3.0, 8, 6, 0.7), WithinAbs(2.0, 1e-9));
    CHECK_THAT(map_value(other->friction, 3.0, 3.0, 8, 6, 0.7), WithinAbs(0.4, 1e-9));
}

TEST_CASE("touch maps are called after what a recording is of, or by its whole name", "[maps]") {
    const TemporaryFolder folder;
    const auto name = [&](const char* depth) {
        return touch_map_file(folder / depth, TouchMapKind::friction).filename().string();
    };
    CHECK(name("cup_depth.mp4") == "cup_friction.png");
    CHECK(name("Cup-Depth.mkv") == "Cup_friction.png");
    CHECK(name("depth_cup.png") == "cup_friction.png");
    CHECK(name("depth.mp4") == "depth_friction.png");
    CHECK(name("take.mkv") == "take_friction.png");
    write_grey(folder / "cup_depth_friction.png", 4, 4, 10);
    CHECK(name("cup_depth.mp4") == "cup_depth_friction.png");
    CHECK(read_touch_maps(folder / "cup_depth.mp4", 4, 4) != nullptr);
}

TEST_CASE("touch maps are no recordings, and are not taken for the depth of one", "[maps]") {
    const TemporaryFolder folder;
    CHECK(names_touch_map(folder / "cup_stiffness.png"));
    CHECK(names_touch_map(folder / "cup_friction.png"));
    CHECK_FALSE(names_touch_map(folder / "cup_height.png"));  // many call their depth so
    write_text(folder / "cup_maps.toml", "");
    CHECK(names_touch_map(folder / "cup_height.png"));
    CHECK_FALSE(names_touch_map(folder / "cup_depth.png"));
    CHECK_FALSE(names_touch_map(folder / "_stiffness.png"));

    write_grey(folder / "cup_rgb.png", 4, 4, 10);
    write_grey(folder / "cup_height.png", 4, 4, 10);
    std::string looked_for;
    CHECK_FALSE(find_depth_beside(folder / "cup_rgb.png", looked_for));
    fs::remove(folder / "cup_maps.toml");
    CHECK(find_depth_beside(folder / "cup_rgb.png", looked_for) == folder / "cup_height.png");
}

TEST_CASE("a map that cannot be read says which file, and what to do", "[maps]") {
    const TemporaryFolder folder;
    const fs::path depth = folder / "depth.png";
    write_text(folder / "depth_stiffness.png", "no picture");
    CHECK_THROWS_WITH(read_touch_maps(depth, 8, 6), Contains("depth_stiffness.png"));
    write_grey(folder / "depth_stiffness.png", 8, 6, 51);
    for (const char* wrong :
         {"[stiffness]\nlowest = 3\nhighest = 1\n", "[stiffness]\nlowest = -1\n", "[stiffness\n",
          "[friction]\nhighest = inf\n"}) {
        write_text(folder / "depth_maps.toml", wrong);
        CAPTURE(wrong);
        CHECK_THROWS_WITH(read_touch_maps(depth, 8, 6), Contains("depth_maps.toml"));
    }
    CHECK_THROWS_AS(touch_map_in("no PNG", {}, "a session"), InputError);
}
