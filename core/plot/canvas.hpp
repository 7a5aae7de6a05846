// A drawing surface for plots: lines, shapes, pictures and text, kept as vectors and written as
// PNG, SVG or PDF.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "core/haptics/vec.hpp"
#include "core/video/frames/frame_window.hpp"

namespace dibhr {

/// A colour to draw with, 8 bits a channel; opacity in [0, 1].
struct Ink {
    std::uint8_t red{0};
    std::uint8_t green{0};
    std::uint8_t blue{0};
    double opacity{1.0};
};

enum class Dash { solid, dashed, dotted, dash_dot };
enum class Marker { none, circle, square, triangle, diamond };
enum class Align { left, centre, right };

/// The file format of a plot. Text in an SVG or a PDF can be selected and searched; a PDF is one
/// page as wide as a paper's text.
enum class PlotFormat { png, svg, pdf };

inline constexpr PlotFormat kPlotFormats[]{PlotFormat::png, PlotFormat::svg, PlotFormat::pdf};

/// "png": its name on the command line, and a file's ending without the dot.
[[nodiscard]] std::string_view name_of(PlotFormat format) noexcept;

struct Stroke {
    Ink ink{};
    double width_px{1.5};
    Dash dash{Dash::solid};
};

/// Pixels of the canvas, y down; a pixel's corners are whole numbers.
struct Box {
    double left{0.0};
    double top{0.0};
    double right{0.0};
    double bottom{0.0};

    [[nodiscard]] double width() const noexcept { return right - left; }
    [[nodiscard]] double height() const noexcept { return bottom - top; }
    [[nodiscard]] bool holds(Vec2 p) const noexcept {
        return p.x >= left && p.x <= right && p.y >= top && p.y <= bottom;
    }
};

struct TextStyle {
    Ink ink{};
    double cap_px{9.0};  ///< height of a capital letter
    Align align{Align::left};
    bool bold{false};
    bool upwards{false};  ///< reads from the bottom to the top
};

/// Draws only inside the clip, which is the whole canvas at first; points may be any finite number.
/// Later strokes cover earlier ones. Needs no display, and writes no dates.
class Canvas {
  public:
    /// Throws InputError for a size that is not positive or beyond 16383.
    Canvas(int columns, int rows, Ink paper);
    ~Canvas();
    Canvas(Canvas&& other) noexcept;

    [[nodiscard]] Box whole() const noexcept;
    void clip_to(Box box) noexcept;
    void clip_to_whole() noexcept { clip_to(whole()); }

    void line(Vec2 from, Vec2 to, const Stroke& stroke);
    void polyline(std::span<const Vec2> points, const Stroke& stroke);
    void polygon(std::span<const Vec2> corners, Ink ink);
    void fill(Box box, Ink ink);
    void outline(Box box, const Stroke& stroke);
    void disc(Vec2 centre, double radius_px, Ink ink);
    void ring(Vec2 centre, double radius_px, const Stroke& stroke);
    /// A small shape of about `size_px` across, with a thin rim of `rim` around it.
    void marker(Vec2 centre, Marker marker, double size_px, Ink ink, Ink rim);
    /// The picture stretched over the box, its pixels kept as squares when enlarged.
    void picture(const ColourImage& picture, Box box, double opacity);
    /// One line of any alphabet, in UTF-8; `where` is the baseline's left end, middle or right end,
    /// as aligned.
    void text(Vec2 where, std::string_view text, const TextStyle& style);

    /// The drawing so far, at the canvas's size.
    [[nodiscard]] ColourImage finished() const;
    /// The drawing so far as a file's bytes.
    [[nodiscard]] std::string encoded(PlotFormat format) const;

  private:
    struct Drawing;
    std::unique_ptr<Drawing> drawing_;
};

/// How wide the text will be [px].
[[nodiscard]] double text_width(std::string_view text, const TextStyle& style);

}  // namespace dibhr
