// Painting named regions: a stroke over label pictures, and by keyboard and mouse in the window.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "app/viewer/painting/paint_tint.hpp"
#include "app/viewer/painting/region_stroke.hpp"
#include "core/video/guide/regions_file.hpp"
#include "tests/app/program/desk.hpp"
#include "tests/app/viewer/two_halves.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/eventually.hpp"

using namespace dibhr;
using namespace dibhr::test;
namespace fs = std::filesystem;

namespace {

constexpr int kColumns = 60;
constexpr int kRows = 40;
constexpr double kRadius = 6.0;

std::string name_at(const Regions& regions, double x, double y, double media_s = 0.0) {
    const Region* const found = regions.at(x, y, kColumns, kRows, media_s);
    return found == nullptr ? "" : found->name;
}

Regions stroke_of(const Regions* before, const Region& region, const std::vector<Vec3>& places) {
    RegionStroke stroke(before, region, kRadius, kColumns, kRows);
    for (const Vec3& place : places) stroke.go_to(place);
    return stroke.regions();
}

void press_until(const WindowProgram& viewer, const std::string& key, const std::string& label) {
    constexpr int kMost = 250;
    for (int k = 0; k < kMost && !viewer.seen().focus.str().starts_with(label); ++k) {
        viewer.act("key " + key);
        viewer.wait_for_turn();
        viewer.wait_for_turn();
    }
    REQUIRE(viewer.seen().focus.str().starts_with(label));
}

/// By keyboard, as the Paint panel has it.
void choose_region_brush(const WindowProgram& viewer) {
    viewer.act("key g key F6 key F6");
    press_until(viewer, "Tab", "Paints");
    viewer.act("key Return");
    viewer.wait_until([](const Seen& now) { return now.focus_kind.str() == "entry"; });
    press_until(viewer, "Down", "Region");
    viewer.act("key Return");
    viewer.wait_until([](const Seen& now) { return now.focus.str() == "Paints"; });
}

}  // namespace

TEST_CASE("a region lies where the brush has passed and nowhere else", "[regions]") {
    const Regions regions = stroke_of(nullptr, {"Handle", "Of brass."}, {{20, 20, 0}, {40, 20, 0}});
    REQUIRE(regions.regions.size() == 1);
    CHECK(regions.regions.front().text == "Of brass.");
    for (int j = 0; j < kRows; ++j) {
        for (int i = 0; i < kColumns; ++i) {
            CAPTURE(i, j);
            const double away = std::hypot(i - std::clamp(i, 20, 40), j - 20);
            if (away < kRadius - 0.5) CHECK(name_at(regions, i, j) == "Handle");
            if (away > kRadius) CHECK(name_at(regions, i, j).empty());
        }
    }
}

TEST_CASE("a region is painted on top in every label picture of another size", "[regions]") {
    Regions before{kColumns / 2, kRows / 2, 3, 2.0, {}, {{"Cup", ""}}};
    before.labels.assign(std::size_t{3} * (kColumns / 2) * (kRows / 2), 1);
    const Regions regions = stroke_of(&before, {"Handle", ""}, {{30, 20, 0}});
    CHECK(regions.pictures == 3);
    for (const double media_s : {0.0, 0.6, 1.1}) {
        CHECK(name_at(regions, 30, 20, media_s) == "Handle");
        CHECK(name_at(regions, 35, 20, media_s) == "Handle");
        CHECK(name_at(regions, 38, 20, media_s) == "Cup");
    }
}

TEST_CASE("the same name adds to its region and gives it the newest text", "[regions]") {
    const Regions one = stroke_of(nullptr, {"Handle", "Old."}, {{10, 10, 0}});
    const Regions both = stroke_of(&one, {"Handle", "New."}, {{40, 30, 0}});
    REQUIRE(both.regions.size() == 1);
    CHECK(both.regions.front().text == "New.");
    CHECK(name_at(both, 10, 10) == "Handle");
    CHECK(name_at(both, 40, 30) == "Handle");
}

TEST_CASE("a stroke without a name erases and a region that is nowhere ends", "[regions]") {
    const Regions cup = stroke_of(nullptr, {"Cup", ""}, {{10, 20, 0}});
    const Regions both = stroke_of(&cup, {"Table", ""}, {{40, 20, 0}});
    const auto left = without_bare(stroke_of(&both, {}, {{10, 20, 0}}));
    REQUIRE(left);
    REQUIRE(left->regions.size() == 1);
    CHECK(name_at(*left, 10, 20).empty());
    CHECK(name_at(*left, 40, 20) == "Table");
    CHECK(without_bare(stroke_of(left.get(), {}, {{40, 20, 0}})) == nullptr);
}

TEST_CASE("regions side by side are tinted apart and what has no name is as it was", "[regions]") {
    Regions regions{4, 1, 1, 0.0, {0, 1, 2, 3}, {{"A", ""}, {"B", ""}, {"C", ""}}};
    const ColourImage black{4, 1, std::vector<std::uint8_t>(12, 0)};
    const ColourImage tinted = with_regions(black, regions, 0);
    const auto colour = [&](std::size_t i) {
        return std::vector<int>(tinted.rgb.begin() + static_cast<std::ptrdiff_t>(3 * i),
                                tinted.rgb.begin() + static_cast<std::ptrdiff_t>(3 * i + 3));
    };
    CHECK(colour(0) == std::vector<int>{0, 0, 0});
    for (std::size_t one = 1; one < 4; ++one) {
        for (std::size_t other = one + 1; other < 4; ++other) {
            int apart = 0;
            for (std::size_t c = 0; c < 3; ++c)
                apart += std::abs(colour(one)[c] - colour(other)[c]);
            CHECK(apart > 80);
        }
    }
}

TEST_CASE("a region that is named and painted in the window is touched by its name and kept",
          "[regions]") {
    const Desk desk;
    const TemporaryFolder folder;
    write_depth_png(folder / "cup_depth.png", kWide, kHigh, 120);
    const auto kept = [&folder] {
        return fs::exists(folder / "cup_regions.png") && fs::exists(folder / "cup_regions.toml");
    };
    {
        WindowProgram viewer = desk.start_viewer(folder, cup_options({"--record", "a.dibhr"}));
        viewer.wait_for_surface();
        choose_region_brush(viewer);
        press_until(viewer, "Tab", "Name");
        viewer.act("key Return type handle key Return");
        viewer.wait_until([](const Seen& now) { return now.focus_value.str() == "handle"; });
        viewer.act(std::string(kLeft) + " mousedown 1 mousemove_relative 10 0 mouseup 1");
        viewer.wait_until([](const Seen& now) { return now.regions == 1 && now.can_undo; });
        CHECK(eventually(kept));
        viewer.act("key ctrl+z");
        viewer.wait_until([](const Seen& now) { return now.regions == 0; });
        CHECK(eventually([&] { return !fs::exists(folder / "cup_regions.toml"); }));
        viewer.act("key ctrl+shift+z");
        viewer.wait_until([](const Seen& now) { return now.regions == 1; });
        CHECK(eventually(kept));
        viewer.act("key g mousedown 1");
        viewer.wait_until([](const Seen& now) { return now.region.str() == "handle"; });
        viewer.act("mouseup 1");
        desk.press("key q");
        REQUIRE(viewer.wait() == 0);
    }
    const auto regions = read_regions(folder / "cup_depth.png", kWide, kHigh);
    REQUIRE(regions);
    CHECK(regions->regions.front().name == "handle");
    CHECK_FALSE(fs::exists(folder / "cup_stiffness.png"));
    require_same_bits(folder, folder / "a.dibhr");
}

TEST_CASE("without a name no region is painted and the window says what to do", "[regions]") {
    const Desk desk;
    const TemporaryFolder folder;
    write_depth_png(folder / "cup_depth.png", kWide, kHigh, 120);
    WindowProgram viewer = desk.start_viewer(folder, cup_options());
    viewer.wait_for_surface();
    choose_region_brush(viewer);
    viewer.act(std::string(kLeft) + " mousedown 1");
    viewer.wait_until([](const Seen& now) { return contains(now.message.str(), "no name"); });
    viewer.act("mouseup 1");
    CHECK(viewer.seen().regions == 0);
    CHECK_FALSE(viewer.seen().can_undo);
    desk.press("key Escape key q");
    REQUIRE(viewer.wait() == 0);
}

TEST_CASE("regions that cannot be read stay as they are and none is painted over them",
          "[regions]") {
    const Desk desk;
    const TemporaryFolder folder;
    write_depth_png(folder / "cup_depth.png", kWide, kHigh, 120);
    const std::string table = "# made by hand\n[[region]]\nname = 3\n";
    write_text(folder / "cup_regions.toml", table);
    WindowProgram viewer = desk.start_viewer(folder, cup_options());
    viewer.wait_until([](const Seen& now) { return !now.message.str().empty(); });
    viewer.act("key Escape");
    viewer.wait_for_surface();
    choose_region_brush(viewer);
    press_until(viewer, "Tab", "Name");
    viewer.act("key Return type handle key Return");
    viewer.wait_until([](const Seen& now) { return now.focus_value.str() == "handle"; });
    viewer.act(std::string(kLeft) + " mousedown 1");
    viewer.wait_until(
        [](const Seen& now) { return contains(now.message.str(), "No region can be painted"); });
    viewer.act("mouseup 1");
    CHECK(viewer.seen().regions == 0);
    desk.press("key Escape key q");
    REQUIRE(viewer.wait() == 0);
    CHECK(read_text(folder / "cup_regions.toml") == table);
    CHECK_FALSE(fs::exists(folder / "cup_regions.png"));
}

TEST_CASE("a stroke that erases nothing leaves the regions as they were", "[regions]") {
    const Regions cup = stroke_of(nullptr, {"Cup", ""}, {{10, 20, 0}});
    RegionStroke beside(&cup, {}, kRadius, kColumns, kRows);
    CHECK(beside.go_to({40, 20, 0}));
    CHECK_FALSE(beside.go_to({40, 20, 0}));
    CHECK_FALSE(beside.has_changed(&cup));
    beside.go_to({10, 20, 0});
    CHECK(beside.has_changed(&cup));
}
