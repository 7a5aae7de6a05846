// How the window looks: its theme and the size of its text, in pictures of the real window.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "app/settings/settings.hpp"
#include "core/plot/axes.hpp"
#include "core/video/media.hpp"
#include "tests/app/program/desk.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;

namespace {

/// The last picture of a second of the sample.
ColourImage shown_with(const TemporaryFolder& folder, std::vector<std::string> options) {
    const Desk desk;
    options.insert(options.end(),
                   {"--device", "mouse", "--seconds", "1", "--screenshot", "look.png"});
    Process viewer = desk.start_viewer(folder, options);
    REQUIRE(viewer.wait() == 0);
    return open_media(folder / "look.png", folder / "look.png")->next()->colour;
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

/// Of the letters on the button that ends a recording, which is dark red: of what stands between
/// two pixels of it.
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

/// The last picture of the sample, after `O` was pressed over it.
ColourImage shown_after_o(const TemporaryFolder& folder, const std::string& algorithm) {
    const Desk desk;
    Process viewer =
        desk.start_viewer(folder, {"--device", "mouse", "--seconds", "30", "--algorithm", algorithm,
                                   "--screenshot", "look.png"});
    desk.act(
        "search --sync --onlyvisible --name dibhr mousemove 470 600 sleep 0.6 key o sleep 1.0 "
        "key q");
    REQUIRE(viewer.wait() == 0);
    return open_media(folder / "look.png", folder / "look.png")->next()->colour;
}

/// The part of a picture that the help sheet is in.
std::vector<int> help_sheet(const std::filesystem::path& file) {
    const ColourImage picture = open_media(file, file)->next()->colour;
    std::vector<int> part;
    for (int y = 120; y < picture.rows - 100; ++y)
        for (int x = 180; x < 600; ++x) part.push_back(lightness(picture, x, y));
    return part;
}

/// Whether the wheel moves the help sheet of a window of that size.
bool help_sheet_scrolls(const std::string& size) {
    const Desk desk;
    const TemporaryFolder folder;
    Process viewer = desk.start_viewer(
        folder, {"--device", "mouse", "--pause", "--size", size, "--screenshot-name", "sheet"});
    desk.act(
        "search --sync --onlyvisible --name dibhr sleep 0.6 key question mousemove 400 300 sleep "
        "0.5 key s sleep 0.5 click --delay 10 --repeat 20 5 sleep 0.5 key s key q");
    REQUIRE(viewer.wait() == 0);
    return help_sheet(folder / "sheet.png") != help_sheet(folder / "sheet-2.png");
}

}  // namespace

TEST_CASE("a key names all algorithms in the colours of the plots, another press takes them away",
          "[look]") {
    const TemporaryFolder folder;
    const ColourImage on = shown_after_o(folder, "pga");
    CHECK(load_settings(folder / "config/dibhr/settings.toml").others);
    const ColourImage off = shown_after_o(folder, "pga");
    CHECK_FALSE(load_settings(folder / "config/dibhr/settings.toml").others);
    for (const Algorithm algorithm : all_algorithms()) {
        CAPTURE(name_of(algorithm));
        CHECK(pixels_of(on, look_of(algorithm).stroke.ink) > 20);
        CHECK(pixels_of(off, look_of(algorithm).stroke.ink) == 0);
    }
}

TEST_CASE("the help sheet shows all keys at once, and scrolls in a window that is too small",
          "[look]") {
    CHECK_FALSE(help_sheet_scrolls("1280x800"));
    CHECK(help_sheet_scrolls("800x600"));
}

TEST_CASE("the wall and the panels are dark or light, as the theme says", "[look]") {
    const TemporaryFolder folder;
    const ColourImage dark = shown_with(folder, {});
    const ColourImage light = shown_with(folder, {"--theme", "light"});
    for (const int x : {20, 1276}) {  // wall, panels
        CHECK(lightness(dark, x, 790) < 70);
        CHECK(lightness(light, x, 790) > 180);
    }
    // The command line's theme is for once.
    CHECK(load_settings(folder / "config/dibhr/settings.toml").theme == Theme::dark);
}

TEST_CASE("the button that ends a recording is written white in every theme", "[look]") {
    const std::string theme = GENERATE("dark", "light");
    CAPTURE(theme);
    const TemporaryFolder folder;
    std::filesystem::create_directories(folder / "config/dibhr");
    write_text(folder / "config/dibhr/settings.toml",
               "[panels]\nvideo = false\ntouch = false\nsession = true\n");
    const ColourImage picture = shown_with(folder, {"--theme", theme, "--record", "hand.dibhr"});
    const Lightnesses letters = on_red_button(picture);
    CHECK(letters.lightest > 200);
    CHECK(letters.darkest > 60);
}

TEST_CASE("text twice as large takes panels twice as wide, and a window no larger than the display",
          "[look]") {
    const TemporaryFolder folder;
    const ColourImage usual = shown_with(folder, {});
    const ColourImage larger = shown_with(folder, {"--ui-scale", "1.5"});
    CHECK(usual.columns == 1280);
    CHECK(larger.columns == 1280);  // of a display that is as wide
    CHECK(usual.columns - panels_begin(usual) == 340);
    CHECK(larger.columns - panels_begin(larger) == 510);
}
