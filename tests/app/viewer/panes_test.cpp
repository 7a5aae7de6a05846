// The colour picture and the depth above the relief.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "app/panels/panels.hpp"
#include "core/video/media.hpp"
#include "render/relief_paint.hpp"
#include "tests/app/program/command_program.hpp"
#include "tests/app/program/desk.hpp"
#include "tests/app/program/passing_ticks.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr;
using namespace dibhr::test;
using Catch::Matchers::WithinAbs;

namespace {

constexpr int kWidth = 800;
constexpr int kHeight = 600;
constexpr int kColumns = 64;
constexpr int kRows = 48;

/// A window without panels over a small picture.
ViewerState panes_on() {
    ViewerState state;
    state.settings.panels_visible = false;
    state.settings.panes = true;
    state.window_width = kWidth;
    state.window_height = kHeight;
    state.media.depth_columns = kColumns;
    state.media.depth_rows = kRows;
    return state;
}

std::array<int, 3> pixel(const ColourImage& picture, int x, int y) {
    std::array<int, 3> levels{};
    for (std::size_t c = 0; c < 3; ++c)
        levels[c] = picture.rgb[3 * static_cast<std::size_t>(y * kWidth + x) + c];
    return levels;
}

void check_near(const std::array<int, 3>& seen, const std::array<int, 3>& wanted) {
    for (std::size_t c = 0; c < 3; ++c) CHECK(std::abs(seen[c] - wanted[c]) <= 3);
}

}  // namespace

TEST_CASE("each pixel of the picture has its place on both panes, and none is beside them",
          "[panes]") {
    ViewerState state = panes_on();
    std::set<std::pair<int, int>> left, right;
    const float height = panes_height(state);
    CHECK(height > 0.2F * kHeight);
    CHECK(height < 0.5F * kHeight);
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
            const std::optional<Vec3> place = place_on_panes(state, {x + 0.5, y + 0.5});
            if (!place) continue;
            CHECK(static_cast<float>(y) < height);
            (x < kWidth / 2 ? left : right)
                .emplace(static_cast<int>(place->x), static_cast<int>(place->y));
        }
    }
    CHECK(left.size() == static_cast<std::size_t>(kColumns * kRows));
    CHECK(left == right);
    CHECK(*left.begin() == std::pair{0, 0});
    CHECK(*left.rbegin() == std::pair{kColumns - 1, kRows - 1});
    state.settings.panes = false;
    CHECK(panes_height(state) == 0.0F);
    CHECK_FALSE(place_on_panes(state, {200.0, 100.0}));
}

TEST_CASE("panes show the colour and the depth, the relief is touched below them, and they last",
          "[panes]") {
    const Desk desk;
    const TemporaryFolder folder;
    ColourImage red{kColumns, kRows, {}};
    for (int k = 0; k < kColumns * kRows; ++k) red.rgb.insert(red.rgb.end(), {254, 0, 0});
    write_png(red, folder / "flat_color.png");
    write_depth_png(folder / "flat_depth.png", kColumns, kRows, 128);
    std::filesystem::create_directories(folder / "config/dibhr");
    write_text(folder / "config/dibhr/settings.toml", "[window]\npanels-visible = false\n");
    const ViewerState state = panes_on();
    const int below = static_cast<int>(panes_height(state));
    const std::string middle =
        std::to_string(kWidth / 2) + " " + std::to_string((kHeight + below) / 2);
    WindowProgram viewer = desk.start_viewer(
        folder, {"flat_color.png", "flat_depth.png", "--raw-depth", "--device", "mouse", "--size",
                 "800x600", "--record", "hand.dibhr", "--screenshot", "last.png"});
    viewer.wait_for_surface();
    viewer.act("key k mousemove " + middle);
    wait_for_ticks(viewer, kTicksToRest);
    desk.press("key q");
    REQUIRE(viewer.wait() == 0);

    const Row last = read_session(folder / "hand.dibhr").back();
    CHECK_THAT(last.goal.x, WithinAbs(0.5 * (kColumns - 1), 1.5));
    CHECK_THAT(last.goal.y, WithinAbs(0.5 * (kRows - 1), 6.0));  // seen a little from above
    const ColourImage picture = read_colour_picture(folder / "last.png");
    REQUIRE(picture.columns == kWidth);
    REQUIRE(picture.rows == kHeight);
    check_near(pixel(picture, kWidth / 4, below / 4), {254, 0, 0});
    const auto ramp = depth_colours(ReliefPaint::turbo);
    check_near(pixel(picture, 3 * kWidth / 4, below / 4),
               {ramp->rgb[3 * 128], ramp->rgb[3 * 128 + 1], ramp->rgb[3 * 128 + 2]});
    CHECK(contains(read_text(folder / "config/dibhr/settings.toml"), "panes = true"));
}
