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
#include "core/video/sources/media.hpp"
#include "core/video/sources/picture_files.hpp"
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
    state.ui.window_width = kWidth;
    state.ui.window_height = kHeight;
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

TEST_CASE("paused between two frames, panes and relief show the colour of the same one",
          "[panes]") {
    const Desk desk;
    const TemporaryFolder folder;
    const std::string film = "ffmpeg -nostdin -v error -f lavfi -i nullsrc=s=64x48:r=5:d=2,";
    run_shell(
        folder,
        film + "geq=r='255*eq(mod(N\\,2)\\,0)':g='255*mod(N\\,2)':b=0 -c:v ffv1 film_color.mkv");
    run_shell(folder, film + "geq=lum=128,format=gray -c:v ffv1 film_depth.mkv");
    std::filesystem::create_directories(folder / "config/dibhr");
    write_text(folder / "config/dibhr/settings.toml",
               "[look]\npanes = true\n[window]\npanels-visible = false\n");
    WindowProgram viewer = desk.start_viewer(
        folder, {"film_color.mkv", "film_depth.mkv", "--raw-depth", "--device", "mouse", "--size",
                 "800x600", "--in-betweens", "off", "--speed", "0.1", "--screenshot", "last.png"});
    viewer.wait_for_surface();
    // Of each 2 s in which a frame is shown, the second half: the next one is nearer.
    viewer.wait_until([](const Seen& now) { return now.drawn_frame == 1 && now.media_s < 0.2; });
    viewer.act("key space");
    viewer.wait_until([](const Seen& now) { return !now.playing; });
    const double media_s = viewer.seen().media_s;
    desk.press("key q");
    REQUIRE(viewer.wait() == 0);
    const ColourImage picture = read_colour_picture(folder / "last.png");
    const int below = static_cast<int>(panes_height(panes_on()));
    const auto in_pane = pixel(picture, kWidth / 4, below / 4);
    const auto in_relief = pixel(picture, kWidth / 2, (kHeight + below) / 2);
    CAPTURE(media_s, in_pane, in_relief);
    REQUIRE(std::abs(in_pane[0] - in_pane[1]) > 100);
    REQUIRE(std::abs(in_relief[0] - in_relief[1]) > 50);
    CHECK((in_pane[0] > in_pane[1]) == (in_relief[0] > in_relief[1]));
}
