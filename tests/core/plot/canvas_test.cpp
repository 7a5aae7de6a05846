// The canvas that plots are drawn on: where ink lands, what it covers, what is refused.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <pango/pangocairo.h>

#include "core/error.hpp"
#include "core/plot/canvas.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr;
using Catch::Matchers::WithinAbs;

namespace {

constexpr Ink kWhite{255, 255, 255};
constexpr Ink kBlack{0, 0, 0};

/// Darkness of a pixel's green channel, 0 white to 1 black.
double dark(const ColourImage& picture, int x, int y) {
    const std::size_t k =
        3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.columns) +
             static_cast<std::size_t>(x));
    return 1.0 - picture.rgb[k + 1] / 255.0;
}

struct Blot {
    double amount{0.0};  ///< pixels' worth of ink
    Vec2 centre{0.0};
    Box extent{1e9, 1e9, -1e9, -1e9};
};

/// What was drawn on white, as one blot.
Blot blot_of(const Canvas& canvas) {
    const ColourImage picture = canvas.finished();
    Blot blot;
    for (int y = 0; y < picture.rows; ++y) {
        for (int x = 0; x < picture.columns; ++x) {
            const double ink = dark(picture, x, y);
            if (ink == 0.0) continue;
            blot.amount += ink;
            blot.centre += ink * Vec2{x + 0.5, y + 0.5};
            blot.extent = {std::min(blot.extent.left, x + 0.0), std::min(blot.extent.top, y + 0.0),
                           std::max(blot.extent.right, x + 1.0),
                           std::max(blot.extent.bottom, y + 1.0)};
        }
    }
    if (blot.amount > 0.0) blot.centre /= blot.amount;
    return blot;
}

/// Runs of ink along a row of pixels, or a column.
int runs_of_ink(const ColourImage& picture, Vec2 from, Vec2 step, int count) {
    int runs = 0;
    bool inked = false;
    for (int k = 0; k < count; ++k) {
        const Vec2 at = from + step * static_cast<double>(k);
        const bool ink = dark(picture, static_cast<int>(at.x), static_cast<int>(at.y)) > 0.5;
        runs += ink && !inked;
        inked = ink;
    }
    return runs;
}

/// What XML does not allow: an element that does not close where it should; empty is as it is.
std::string unclosed_element(const std::string& xml) {
    std::vector<std::string> open;
    for (auto at = xml.find('<'); at != std::string::npos; at = xml.find('<', at + 1)) {
        const auto end = xml.find('>', at);
        if (end == std::string::npos) return xml.substr(at);
        if (xml[at + 1] == '?') continue;
        const bool closes = xml[at + 1] == '/';
        const auto begin = at + (closes ? 2 : 1);
        const std::string name = xml.substr(begin, xml.find_first_of(" />", begin) - begin);
        if (!closes && xml[end - 1] == '/') continue;
        if (!closes) {
            open.push_back(name);
        } else if (open.empty() || open.back() != name) {
            return name;
        } else {
            open.pop_back();
        }
    }
    return open.empty() ? "" : open.back();
}

/// Letters for which no font has a shape.
int missing_letters(const std::string& text) {
    PangoContext* const context = pango_font_map_create_context(pango_cairo_font_map_get_default());
    PangoLayout* const layout = pango_layout_new(context);
    pango_layout_set_text(layout, text.c_str(), -1);
    const int missing = pango_layout_get_unknown_glyphs_count(layout);
    g_object_unref(layout);
    g_object_unref(context);
    return missing;
}

}  // namespace

TEST_CASE("a canvas has the size and the paper it was asked for", "[canvas]") {
    const Canvas canvas(37, 21, {10, 20, 30});
    const ColourImage picture = canvas.finished();
    REQUIRE(picture.columns == 37);
    REQUIRE(picture.rows == 21);
    REQUIRE(picture.rgb.size() == std::size_t{37 * 21 * 3});
    for (std::size_t k = 0; k < picture.rgb.size(); k += 3) {
        REQUIRE(picture.rgb[k] == 10);
        REQUIRE(picture.rgb[k + 1] == 20);
        REQUIRE(picture.rgb[k + 2] == 30);
    }
}

TEST_CASE("a size that cannot be drawn is refused", "[canvas]") {
    CHECK_THROWS_AS(Canvas(0, 10, kWhite), InputError);
    CHECK_THROWS_AS(Canvas(10, -1, kWhite), InputError);
    CHECK_THROWS_AS(Canvas(16385, 10, kWhite), InputError);
}

TEST_CASE("a marker's ink lies around its point, wherever between the pixels that is", "[canvas]") {
    const Marker marker =
        GENERATE(Marker::circle, Marker::square, Marker::triangle, Marker::diamond);
    const Vec2 at = GENERATE(Vec2(30.0, 30.0), Vec2(30.25, 29.5), Vec2(29.8, 30.6));
    CAPTURE(static_cast<int>(marker), at.x, at.y);
    Canvas canvas(60, 60, kWhite);
    canvas.marker(at, marker, 10.0, kBlack, kWhite);
    const Blot blot = blot_of(canvas);
    CHECK_THAT(blot.centre.x, WithinAbs(at.x, 0.3));
    CHECK_THAT(blot.centre.y, WithinAbs(at.y, 0.3));
    CHECK(blot.amount > 50.0);
    CHECK(blot.extent.width() < 16.0);
}

TEST_CASE("a marker that is none leaves the paper clean", "[canvas]") {
    Canvas canvas(20, 20, kWhite);
    canvas.marker({10.0, 10.0}, Marker::none, 10.0, kBlack, kBlack);
    CHECK(blot_of(canvas).amount == 0.0);
}

TEST_CASE("a line's ink is its length times its width, at any slope", "[canvas]") {
    const double slope_rad = GENERATE(0.0, 0.3, 0.785398, 1.2, 1.5707963);
    CAPTURE(slope_rad);
    Canvas canvas(120, 120, kWhite);
    const Vec2 along{std::cos(slope_rad), std::sin(slope_rad)};
    canvas.line(Vec2(60.0) - 40.0 * along, Vec2(60.0) + 40.0 * along, {kBlack, 2.0, Dash::solid});
    const Blot blot = blot_of(canvas);
    CHECK_THAT(blot.centre.x, WithinAbs(60.0, 0.4));
    CHECK_THAT(blot.centre.y, WithinAbs(60.0, 0.4));
    CHECK(blot.amount > 80.0 * 2.0 * 0.8);
    CHECK(blot.amount < 80.0 * 2.0 * 1.5);
}

TEST_CASE("nothing is drawn outside the clip, however far the points are", "[canvas]") {
    const Box clip{20.0, 10.0, 70.0, 50.0};
    Canvas canvas(100, 80, kWhite);
    canvas.clip_to(clip);
    canvas.line({-1e9, -1e9}, {1e9, 1e9}, {kBlack, 3.0, Dash::solid});
    canvas.disc({20.0, 30.0}, 15.0, kBlack);
    canvas.fill({0.0, 40.0, 100.0, 80.0}, kBlack);
    canvas.text({15.0, 30.0}, "clipped", {kBlack, 12.0});
    canvas.marker({70.0, 30.0}, Marker::square, 20.0, kBlack, kBlack);
    const Blot blot = blot_of(canvas);
    CHECK(blot.amount > 100.0);
    CHECK(blot.extent.left >= clip.left);
    CHECK(blot.extent.top >= clip.top);
    CHECK(blot.extent.right <= clip.right);
    CHECK(blot.extent.bottom <= clip.bottom);

    canvas.clip_to_whole();
    canvas.fill({0.0, 0.0, 5.0, 5.0}, kBlack);
    CHECK(blot_of(canvas).extent.left == 0.0);
}

TEST_CASE("half-opaque ink leaves half of what is under it", "[canvas]") {
    Canvas canvas(20, 20, kWhite);
    canvas.fill({0.0, 0.0, 10.0, 20.0}, kBlack);
    canvas.fill(canvas.whole(), {200, 100, 0, 0.5});
    const ColourImage picture = canvas.finished();
    CHECK_THAT(dark(picture, 2, 10), WithinAbs(1.0 - 50.0 / 255.0, 0.01));
    CHECK_THAT(dark(picture, 17, 10), WithinAbs(1.0 - 177.5 / 255.0, 0.01));
}

TEST_CASE("a picture fills its box, its first pixel top left", "[canvas]") {
    const ColourImage two{2, 1, {0, 0, 0, 255, 255, 255}};
    Canvas canvas(40, 40, {255, 128, 255});
    canvas.picture(two, {10.0, 10.0, 30.0, 30.0}, 1.0);
    const ColourImage picture = canvas.finished();
    CHECK(dark(picture, 11, 11) == 1.0);
    CHECK(dark(picture, 19, 29) == 1.0);
    CHECK(dark(picture, 20, 11) == 0.0);
    CHECK_THAT(dark(picture, 31, 11), WithinAbs(0.5, 0.01));
    canvas.picture(two, {-1e6, -1e6, 1e6, 1e6}, 1.0);  // far larger than the canvas
    CHECK(dark(canvas.finished(), 0, 0) == 0.0);       // its right half begins left of the canvas
    canvas.picture(two, {10.0, 10.0, 30.0, 30.0}, 1.0);
    canvas.picture({}, canvas.whole(), 1.0);  // nothing to show
    CHECK(dark(canvas.finished(), 11, 11) == 1.0);
}

TEST_CASE("text is as wide as announced, as high as asked, and stands on its point", "[canvas]") {
    const TextStyle style{kBlack, 12.0};
    Canvas canvas(200, 60, kWhite);
    canvas.text({20.0, 40.0}, "HHHHH", style);
    const Blot blot = blot_of(canvas);
    CHECK_THAT(blot.extent.width(), WithinAbs(text_width("HHHHH", style), 8.0));
    CHECK_THAT(blot.extent.height(), WithinAbs(style.cap_px, 3.0));
    CHECK_THAT(blot.extent.bottom, WithinAbs(40.0, 2.0));
    CHECK_THAT(blot.extent.left, WithinAbs(20.0, 4.0));
}

TEST_CASE("text is aligned at its point, upwards too", "[canvas]") {
    const bool upwards = GENERATE(false, true);
    TextStyle style{kBlack, 10.0, Align::centre, false, upwards};
    CAPTURE(upwards);
    Canvas centred(200, 200, kWhite);
    centred.text({100.0, 100.0}, "middle", style);
    const Blot middle = blot_of(centred);
    const double along = upwards ? middle.centre.y : middle.centre.x;
    CHECK_THAT(along, WithinAbs(100.0, 4.0));
    CHECK((middle.extent.height() > middle.extent.width()) == upwards);

    Canvas ending(200, 200, kWhite);
    style.align = Align::right;
    ending.text({100.0, 100.0}, "end", style);
    const Blot end = blot_of(ending);
    if (upwards)
        CHECK_THAT(end.extent.top, WithinAbs(100.0, 4.0));
    else
        CHECK_THAT(end.extent.right, WithinAbs(100.0, 4.0));
}

TEST_CASE("dashes leave gaps, go round corners and cover the line from its start", "[canvas]") {
    const Dash dash = GENERATE(Dash::dashed, Dash::dotted, Dash::dash_dot);
    CAPTURE(static_cast<int>(dash));
    const std::vector<Vec2> corner{{10.0, 10.0}, {90.0, 10.0}, {90.0, 90.0}};
    const auto drawn = [&](Dash as) {
        Canvas canvas(100, 100, kWhite);
        canvas.polyline(corner, {kBlack, 2.0, as});
        return canvas;
    };
    const Canvas dashed = drawn(dash);
    CHECK(runs_of_ink(dashed.finished(), {5.0, 9.0}, {1.0, 0.0}, 90) > 5);
    CHECK(runs_of_ink(dashed.finished(), {90.0, 5.0}, {0.0, 1.0}, 90) > 5);
    CHECK(dark(dashed.finished(), 10, 10) > 0.5);
    const Canvas solid = drawn(Dash::solid);
    CHECK(runs_of_ink(solid.finished(), {5.0, 9.0}, {1.0, 0.0}, 90) == 1);
    CHECK(blot_of(dashed).amount > 0.0);
    CHECK(blot_of(dashed).amount < 0.7 * blot_of(solid).amount);
    Canvas empty(100, 100, kWhite);
    empty.polyline({}, {kBlack, 2.0, dash});
    CHECK(blot_of(empty).amount == 0.0);
}

TEST_CASE("text of any alphabet is drawn with the letters of a font that has them", "[canvas]") {
    const std::string title =
        GENERATE(as<std::string>(), "J\u00fcrgen \u00e9 \u03bc \u2264 \u00d7",
                 "\u041f\u0440\u0438\u0432\u0435\u0442", "\u0645\u062d\u0645\u062f",
                 "\u3053\u3093\u306b\u3061\u306f \u4e16\u754c");
    CAPTURE(title);
    const TextStyle style{kBlack, 12.0};
    Canvas canvas(300, 60, kWhite);
    canvas.text({20.0, 40.0}, title, style);
    CHECK(blot_of(canvas).amount > 20.0);
    CHECK(text_width(title, style) > 20.0);
    const bool japanese = title.find("\u4e16") != std::string::npos;
    if (!japanese) {  // the fonts that dibhr asks for have these
        CHECK(missing_letters(title) == 0);
    } else if (missing_letters(title) > 0) {
        WARN("no font for Japanese is installed: its letters are boxes");
    }
}

TEST_CASE("bytes that are no text are drawn as such, and nothing fails", "[canvas]") {
    Canvas canvas(100, 40, kWhite);
    canvas.text({5.0, 30.0}, "a\xFF\x01\n", {kBlack, 10.0});
    canvas.text({5.0, 30.0}, "", {kBlack, 10.0});
    CHECK(blot_of(canvas).amount > 5.0);
    CHECK(text_width("", {kBlack, 10.0}) == 0.0);
}

TEST_CASE("text leaves no line to what is drawn after it", "[canvas]") {
    Canvas canvas(200, 60, kWhite);
    canvas.text({5.0, 50.0}, "l", {kBlack, 6.0});
    canvas.disc({180.0, 10.0}, 5.0, kBlack);
    const ColourImage picture = canvas.finished();
    for (int x = 30; x < 170; ++x) REQUIRE(runs_of_ink(picture, Vec2(x, 0.0), {0.0, 1.0}, 60) == 0);
}

TEST_CASE("a drawing is a PNG, an SVG or a PDF of one page", "[canvas]") {
    const auto drawn = [] {
        Canvas canvas(300, 100, kWhite);
        canvas.text({10.0, 50.0}, "\u041f\u0440\u0438 <1> & 2", {kBlack, 10.0});
        canvas.line({0.0, 0.0}, {300.0, 100.0}, {kBlack, 2.0, Dash::dotted});
        canvas.picture({2, 1, {0, 0, 0, 255, 255, 255}}, {10.0, 60.0, 30.0, 70.0}, 1.0);
        return canvas;
    };
    const PlotFormat format = GENERATE(PlotFormat::png, PlotFormat::svg, PlotFormat::pdf);
    CAPTURE(name_of(format));
    const std::string bytes = drawn().encoded(format);
    // Cairo numbers an SVG's parts through the life of the program.
    if (format != PlotFormat::svg) CHECK(bytes == drawn().encoded(format));
    switch (format) {
        case PlotFormat::png:
            CHECK(bytes.starts_with("\x89PNG"));
            break;
        case PlotFormat::svg:
            CHECK(bytes.starts_with("<?xml"));
            CHECK(bytes.find("width=\"300") != std::string::npos);
            CHECK(bytes.find(">\u041f\u0440\u0438 &lt;1&gt; &amp; 2</text>") != std::string::npos);
            CHECK(bytes.find("<path") != std::string::npos);
            CHECK(unclosed_element(bytes) == "");
            break;
        case PlotFormat::pdf:
            CHECK(bytes.starts_with("%PDF"));
            CHECK(bytes.find("/Count 1") != std::string::npos);
            break;
    }
}
