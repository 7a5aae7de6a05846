// How the window looks: its theme and the size of its text, in pictures of the real window.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <string>
#include <vector>

#include "app/settings/settings.hpp"
#include "core/plot/axes.hpp"
#include "core/video/frames/frame_window.hpp"
#include "tests/app/program/desk.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/eventually.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;

namespace {

/// What is on the display.
ColourImage picture_of(const Desk& desk) {
    const std::string rgb = desk.picture();
    ColourImage picture;
    picture.columns = 1280;
    picture.rows = 800;
    picture.rgb.assign(rgb.begin(), rgb.end());
    return picture;
}

/// Mean of the three channels.
int lightness(const ColourImage& picture, int x, int y) {
    const std::size_t first =
        3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.columns) +
             static_cast<std::size_t>(x));
    return (picture.rgb.at(first) + picture.rgb.at(first + 1) + picture.rgb.at(first + 2)) / 3;
}

/// Where the panels begin: their ground is one colour from top to bottom, the wall is not.
int panels_begin(const ColourImage& picture) {
    const int last = picture.columns - 40;  // left of the scroll bar
    int x = last;
    while (x > 0 && lightness(picture, x, 2) == lightness(picture, last, 2)) --x;
    return x + 1;
}

/// How many pixels of the legend's corner are of this colour.
int pixels_of(const ColourImage& picture, const Ink& ink) {
    constexpr int kWide = 60;
    constexpr int kHigh = 120;
    int count = 0;
    for (int y = 0; y < kHigh; ++y) {
        for (int x = 0; x < kWide; ++x) {
            const std::uint8_t* const at =
                picture.rgb.data() + 3 * (static_cast<std::ptrdiff_t>(y) * picture.columns + x);
            const auto near = [](int a, int b) { return std::abs(a - b) <= 4; };
            count +=
                near(at[0], ink.red) && near(at[1], ink.green) && near(at[2], ink.blue) ? 1 : 0;
        }
    }
    return count;
}

struct Lightnesses {
    int darkest{255}, lightest{0};
};

/// Lightness of the letters on the dark red button that ends a recording: of the pixels between two
/// red ones.
Lightnesses on_red_button(const ColourImage& picture) {
    const auto is_red = [&picture](int x, int y) {
        const std::uint8_t* const at =
            picture.rgb.data() + 3 * (static_cast<std::ptrdiff_t>(y) * picture.columns + x);
        return at[0] > 120 && at[0] < 180 && at[1] < 60 && at[2] < 60;
    };
    Lightnesses seen;
    const int begin = panels_begin(picture);
    for (int y = 0; y < picture.rows; ++y) {
        int last = -1;
        for (int x = begin; x < picture.columns; ++x) {
            if (!is_red(x, y)) continue;
            for (int letter = last + 1; last >= 0 && letter < x; ++letter) {
                seen.darkest = std::min(seen.darkest, lightness(picture, letter, y));
                seen.lightest = std::max(seen.lightest, lightness(picture, letter, y));
            }
            last = x;
        }
    }
    return seen;
}

/// How a window looks that is recording, its Session panel in sight.
struct Look {
    ColourImage picture{};
    int columns{0};
    Settings kept{};  ///< afterwards
};

Look look_with(const std::vector<std::string>& options) {
    const Desk desk;
    const TemporaryFolder folder;
    std::filesystem::create_directories(folder / "config/dibhr");
    write_text(folder / "config/dibhr/settings.toml",
               "[panels]\nvideo = false\ntouch = false\nsession = true\n");
    std::vector<std::string> arguments{"--device", "mouse", "--pause", "--record", "hand.dibhr"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    WindowProgram viewer = desk.start_viewer(folder, arguments);
    viewer.wait_until([](const Seen& now) { return now.surface && now.recorded_rows > 0; });
    viewer.wait_for_turn();
    Look look{.picture = picture_of(desk), .columns = viewer.seen().columns};
    desk.press("key q");
    REQUIRE(viewer.wait() == 0);
    look.kept = load_settings(folder / "config/dibhr/settings.toml");
    return look;
}

/// The part of a picture that the help sheet is in.
std::vector<int> help_sheet(const ColourImage& picture, int window_rows) {
    std::vector<int> part;
    for (int y = 120; y < window_rows - 100; ++y)
        for (int x = 180; x < 600; ++x) part.push_back(lightness(picture, x, y));
    return part;
}

/// Whether the wheel moves the help sheet.
bool help_sheet_scrolls(const Desk& desk, const WindowProgram& viewer) {
    const int rows = viewer.seen().rows;
    const std::vector<int> before = help_sheet(picture_of(desk), rows);
    desk.press("click 5 click 5 click 5 click 5");
    viewer.wait_for_turn();
    viewer.wait_for_turn();
    return help_sheet(picture_of(desk), rows) != before;
}

}  // namespace

TEST_CASE(
    "a key names all algorithms in the colours of the plots, another press takes them away; "
    "the help sheet shows all keys at once, and scrolls in a window that is too small",
    "[look]") {
    const Desk desk;
    const TemporaryFolder folder;
    WindowProgram viewer =
        desk.start_viewer(folder, {"--device", "mouse", "--pause", "--algorithm", "pga"});
    viewer.wait_for_surface();
    viewer.act("mousemove 470 600");
    const auto algorithms = all_algorithms();
    const auto named = [&] {
        const ColourImage picture = picture_of(desk);
        return std::count_if(algorithms.begin(), algorithms.end(), [&](Algorithm algorithm) {
            return pixels_of(picture, style_of(algorithm).stroke.ink) > 20;
        });
    };
    const auto coloured = [&] {
        const ColourImage picture = picture_of(desk);
        return std::count_if(algorithms.begin(), algorithms.end(), [&](Algorithm algorithm) {
            return pixels_of(picture, style_of(algorithm).stroke.ink) > 0;
        });
    };
    viewer.act("key o");
    CHECK(eventually([&] { return named() == std::ssize(algorithms); }));
    viewer.act("key o");
    CHECK(eventually([&] { return coloured() == 0; }));

    viewer.act("key question mousemove 400 300");
    REQUIRE(viewer.seen().help);
    CHECK_FALSE(help_sheet_scrolls(desk, viewer));
    viewer.act("windowsize 800 600");
    viewer.wait_until([](const Seen& now) { return now.columns == 800; });
    viewer.wait_for_turn();
    CHECK(help_sheet_scrolls(desk, viewer));

    viewer.act("key Escape key o");
    desk.press("key q");
    REQUIRE(viewer.wait() == 0);
    CHECK(load_settings(folder / "config/dibhr/settings.toml").others);
}

TEST_CASE(
    "wall and panels are dark or light, as the theme says, and wide as their text is large; "
    "the button that ends a recording is written white",
    "[look]") {
    const Look dark = look_with({});
    const Look light = look_with({"--theme", "light", "--ui-scale", "1.5"});
    for (const int x : {20, 1276}) {  // wall, panels
        CHECK(lightness(dark.picture, x, 790) < 70);
        CHECK(lightness(light.picture, x, 790) > 180);
    }
    for (const Look* const look : {&dark, &light}) {
        const Lightnesses letters = on_red_button(look->picture);
        CHECK(letters.lightest > 200);
        CHECK(letters.darkest > 60);
        CHECK(look->columns == 1280);  // of a display that is no wider
    }
    CHECK(dark.columns - panels_begin(dark.picture) == 340);
    CHECK(light.columns - panels_begin(light.picture) == 510);
    // The command line's theme is not saved.
    CHECK(light.kept.theme == Theme::dark);
}
