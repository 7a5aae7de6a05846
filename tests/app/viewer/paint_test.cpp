// Painting on the relief: a stroke is laid, felt, replayed, found again and removed.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "app/viewer/painting/map_stroke.hpp"
#include "app/viewer/painting/paint_tint.hpp"
#include "core/video/sources/touch_map_files.hpp"
#include "tests/app/program/command_program.hpp"
#include "tests/app/program/desk.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/eventually.hpp"

using namespace dibhr;
using namespace dibhr::test;
using Catch::Matchers::WithinAbs;
namespace fs = std::filesystem;

namespace {

constexpr int kWide = 60;
constexpr int kHigh = 40;

constexpr const char* kSize = "640x480";
/// Of the brush over the middle of the relief, which is left of the panels.
constexpr const char* kStroke = "mousemove 150 240 key g mousedown 1 mousemove 160 242 mouseup 1";

Lay lays(TouchMapKind kind, double value) {
    return {kind, [value](int, int) { return value; }};
}

double felt(const TouchMap& map, double x, double y) {
    return map_value(map, x, y, map.columns, map.rows, 0.5);
}

MapStroke stroke_of(const TouchMaps& before, Lay lay, const std::vector<Vec3>& places,
                    double strength = 1.0) {
    MapStroke stroke(before, {std::move(lay)}, {6.0, strength}, kWide, kHigh);
    for (const Vec3& place : places) stroke.go_to(place);
    return stroke;
}

/// The force along z [N] of a press at a pixel, as `dibhr touch` has it.
double pressed_force(const TemporaryFolder& folder, int x, int y,
                     const std::vector<std::string>& options = {}) {
    const std::string at = std::to_string(x) + "," + std::to_string(y);
    write_text(folder / "goals.csv", "t,x,y,z\n0," + at + ",300\n0.001," + at + ",110\n");
    std::vector<std::string> arguments{"touch",   "--depth",   "cup_depth.png",
                                       "--goals", "goals.csv", "--raw-depth"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const ProgramResult result = run_dibhr(folder, arguments);
    REQUIRE(result.exit_code == 0);
    const std::vector<std::string> rows = split(result.output, '\n');
    return std::stod(split(rows.at(2), ',').at(9));
}

/// The pixel in the middle of the paint.
glm::ivec2 middle_of_paint(const TouchMap& map) {
    glm::dvec2 sum{0.0};
    double weight = 0.0;
    for (int j = 0; j < map.rows; ++j) {
        for (int i = 0; i < map.columns; ++i) {
            sum += static_cast<double>(map.at(i, j).cover) * glm::dvec2(i, j);
            weight += map.at(i, j).cover;
        }
    }
    return glm::ivec2(sum / weight);
}

}  // namespace

TEST_CASE("painted materials have their own tints and other paint is orange") {
    const std::vector<PaintedMaterial> materials{{0.8, 0.9, {0.4F, 0.2F, 0.1F}},
                                                 {1.1, 0.05, {0.8F, 0.9F, 1.0F}}};
    TouchMaps maps;
    maps.stiffness = bare_map(TouchMapKind::stiffness, 4, 1);
    maps.friction = bare_map(TouchMapKind::friction, 4, 1);
    const auto paint = [&](int i, double stiffness, double friction) {
        maps.stiffness.at(i, 0) = {maps.stiffness.level_of(stiffness), 65535};
        maps.friction.at(i, 0) = {maps.friction.level_of(friction), 65535};
    };
    paint(1, 0.8, 0.9);
    paint(2, 1.1, 0.05);
    paint(3, 0.5, 0.9);
    const ColourImage black{8, 2, std::vector<std::uint8_t>(3 * 16, 0)};
    const ColourImage tinted = with_paint(black, maps, BrushLayer::material, materials);
    const auto colour = [&](int i) {
        const std::uint8_t* rgb = &tinted.rgb[3 * static_cast<std::size_t>(2 * i)];
        return std::vector<int>{rgb[0], rgb[1], rgb[2]};
    };
    CHECK(colour(0) == std::vector<int>{0, 0, 0});
    CHECK(colour(1) == std::vector<int>{66, 33, 17});
    CHECK(colour(2) == std::vector<int>{133, 149, 166});
    CHECK(colour(3) == std::vector<int>{157, 91, 8});
}

TEST_CASE("a stroke lays its value whole under the middle of the brush and nothing beyond its edge",
          "[paint]") {
    const TouchMaps painted =
        stroke_of({}, lays(TouchMapKind::friction, 1.25), {{20, 20, 0}, {40, 20, 0}}).maps();
    for (int i = 20; i <= 40; ++i) {
        CHECK_THAT(felt(painted.friction, i, 20), WithinAbs(1.25, 2e-5));
        CHECK_THAT(felt(painted.friction, i, 24), WithinAbs(1.25, 2e-5));  // 0.7 of the radius
        CHECK(felt(painted.friction, i, 26) == 0.5);
        CHECK(felt(painted.friction, i, 14) == 0.5);
    }
    double last = 1.25;
    for (int j = 20; j <= 26; ++j) {
        CHECK(felt(painted.friction, 30, j) <= last + 2e-5);
        last = felt(painted.friction, 30, j);
    }
    CHECK(painted.stiffness.empty());
    CHECK(painted.height.empty());
}

TEST_CASE("passing over a place again in one stroke lays no more, another stroke does", "[paint]") {
    const Lay lay = lays(TouchMapKind::stiffness, 1.5);
    const TouchMaps once = stroke_of({}, lay, {{20, 20, 0}, {30, 20, 0}}, 0.4).maps();
    const TouchMaps twice =
        stroke_of({}, lay, {{20, 20, 0}, {30, 20, 0}, {20, 20, 0}, {30, 20, 0}}, 0.4).maps();
    CHECK(once.stiffness == twice.stiffness);
    CHECK_THAT(felt(once.stiffness, 25, 20), WithinAbs(0.5 + 0.4 * 1.0, 1e-4));
    const TouchMaps again = stroke_of(once, lay, {{20, 20, 0}, {30, 20, 0}}, 0.4).maps();
    CHECK_THAT(felt(again.stiffness, 25, 20), WithinAbs(0.5 + 0.64 * 1.0, 1e-4));
}

TEST_CASE("nothing as paint takes away what lies there, and only there", "[paint]") {
    TouchMaps maps =
        stroke_of({}, lays(TouchMapKind::height, 9.0), {{10, 20, 0}, {50, 20, 0}}).maps();
    const double before = map_value(maps.height, 12, 20, kWide, kHigh, 0.0);
    CHECK_THAT(before, WithinAbs(9.0, 1e-3));
    CHECK_THAT(maps.at_vertices.heights_px.at(20 * kWide + 12), WithinAbs(9.0, 1e-3));
    maps = stroke_of(maps, {TouchMapKind::height}, {{45, 20, 0}}).maps();
    CHECK(map_value(maps.height, 45, 20, kWide, kHigh, 0.0) == 0.0);
    CHECK(map_value(maps.height, 12, 20, kWide, kHigh, 0.0) == before);
}

TEST_CASE("a map of another resolution is painted over as it was felt", "[paint]") {
    TouchMaps maps;
    maps.friction = bare_map(TouchMapKind::friction, 6, 4);
    for (int j = 0; j < 4; ++j) {
        for (int i = 0; i < 6; ++i) {
            maps.friction.at(i, j) = {maps.friction.level_of(0.2 * i),
                                      static_cast<std::uint16_t>(i > 1 ? 65535 : 0)};
        }
    }
    const TouchMaps painted =
        stroke_of(maps, lays(TouchMapKind::friction, 2.0), {{55, 35, 0}}).maps();
    CHECK_THAT(felt(painted.friction, 55, 35), WithinAbs(2.0, 2e-5));
    for (int i = 0; i < 45; ++i) {
        const double was = map_value(maps.friction, i, 10, kWide, kHigh, 0.5);
        CHECK_THAT(felt(painted.friction, i, 10), WithinAbs(was, 1e-4));
    }
}

TEST_CASE(
    "what is painted in the window is taken back, files and all, painted again, felt there, "
    "replayed to the same bits, and found again",
    "[paint]") {
    const Desk desk;
    const TemporaryFolder folder;
    write_depth_png(folder / "cup_depth.png", 160, 120, 120);
    const double bare_newton = pressed_force(folder, 32, 24);
    const auto kept = [&folder] {
        return fs::exists(folder / "cup_stiffness.png") &&
               fs::exists(folder / "cup_friction.png") && fs::exists(folder / "cup_height.png") &&
               fs::exists(folder / "cup_maps.toml");
    };
    const auto gone = [&folder] {
        return !fs::exists(folder / "cup_stiffness.png") && !fs::exists(folder / "cup_maps.toml");
    };
    {
        WindowProgram viewer =
            desk.start_viewer(folder, {"cup_depth.png", "--raw-depth", "--device", "mouse",
                                       "--no-sync", "--size", kSize, "--record", "a.dibhr"});
        viewer.wait_for_surface();
        viewer.act(kStroke);
        viewer.wait_until([](const Seen& now) { return now.painted && now.can_undo; });
        CHECK(eventually(kept));
        viewer.act("key ctrl+z");
        viewer.wait_until([](const Seen& now) { return !now.painted && !now.can_undo; });
        CHECK(eventually(gone));
        viewer.act("key ctrl+shift+z");
        viewer.wait_until([](const Seen& now) { return now.painted; });
        CHECK(eventually(kept));
        viewer.act("key g mousedown 1");
        viewer.wait_until([](const Seen& now) { return !now.brush && now.contact; });
        viewer.act("mousemove_relative -20 0");
        const std::uint64_t rows = viewer.seen().recorded_rows;
        viewer.wait_until([rows](const Seen& now) { return now.recorded_rows > rows; });
        viewer.act("mouseup 1");
        desk.press("key q");
        REQUIRE(viewer.wait() == 0);
    }
    CHECK(kept());
    const auto maps = read_touch_maps(folder / "cup_depth.png", 160, 120);
    REQUIRE(maps);
    CHECK(maps->stiffness.covers_anything());
    require_same_bits(folder, folder / "a.dibhr");
    double most_newton = 0.0;
    for (const Row& row : read_session(folder / "a.dibhr"))
        most_newton = std::max(most_newton, row.spring_newton.z);
    CHECK(most_newton > 0.0);

    // Over the same files, and over files without the maps: a session has its own maps.
    const glm::ivec2 painted = middle_of_paint(maps->stiffness);
    CAPTURE(painted.x, painted.y);
    CHECK(pressed_force(folder, painted.x, painted.y) > bare_newton + 0.01);
    CHECK(pressed_force(folder, painted.x, painted.y, {"--maps", "off"}) == bare_newton);
    CHECK(pressed_force(folder, 4, 4) == bare_newton);
    for (const char* file : {"cup_stiffness.png", "cup_friction.png", "cup_height.png"})
        fs::rename(folder / file, folder / (std::string(file) + ".away"));
    require_same_bits(folder, folder / "a.dibhr");
    CHECK(pressed_force(folder, 32, 24) == bare_newton);
}

TEST_CASE("maps that cannot be read are told, and are not painted over", "[paint]") {
    const Desk desk;
    const TemporaryFolder folder;
    write_depth_png(folder / "cup_depth.png", 64, 48, 120);
    write_text(folder / "cup_stiffness.png", "somebody's work");
    WindowProgram viewer = desk.start_viewer(
        folder, {"cup_depth.png", "--device", "mouse", "--no-sync", "--size", kSize});
    viewer.wait_for_surface();
    CHECK(contains(viewer.seen().message.str(), "cup_stiffness.png"));
    viewer.act("key Escape");
    viewer.act(kStroke);
    CHECK_FALSE(viewer.seen().brush);
    CHECK_FALSE(viewer.seen().painted);
    desk.press("key q");
    REQUIRE(viewer.wait() == 0);
    CHECK(read_text(folder / "cup_stiffness.png") == "somebody's work");
    CHECK_FALSE(fs::exists(folder / "cup_height.png"));
}
