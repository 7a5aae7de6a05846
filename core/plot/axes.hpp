// A plot's frame: axes with round tick marks, and the mapping from values to the canvas. The style
// of the plots: colours that colour-blind readers can distinguish, each algorithm's line and
// marker.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/haptics/parameters.hpp"
#include "core/haptics/vec.hpp"
#include "core/plot/canvas.hpp"

namespace dibhr {

/// From `low` to `high`; low > high turns the axis around, as for an image's rows.
struct ValueSpan {
    double low{0.0};
    double high{1.0};
};

/// Multiples of 1, 2 or 5 times a power of ten inside the span, ascending, at most `most` of them
/// (at least 2).
[[nodiscard]] std::vector<double> round_ticks(ValueSpan span, int most);

/// Powers of ten inside the span, both ends positive, ascending, at most `most` (at least 2).
[[nodiscard]] std::vector<double> decade_ticks(ValueSpan span, int most);

/// Short and exact for a round number: "0.05", "20".
[[nodiscard]] std::string tick_text(double value);

/// A power of ten: "0.01" to "1000" in full, others as "1e-12".
[[nodiscard]] std::string decade_text(double value);

/// `value` with so many digits after the point; "0" for an exact zero.
[[nodiscard]] std::string fixed_text(double value, int digits);

struct Axis {
    ValueSpan span{};
    std::string label{};  ///< with its unit
    bool logarithmic{false};
    bool numbered{true};
    int most_ticks{7};
    std::vector<double> ticks{};  ///< empty: round ones are chosen
};

/// The axes around `area`. A value outside the spans lies outside the area; a logarithmic axis
/// takes what is not positive as its low end.
class Axes {
  public:
    Axes(Box area, Axis x, Axis y);

    [[nodiscard]] const Box& area() const noexcept { return area_; }
    /// Where (x, y) is on the canvas.
    [[nodiscard]] Vec2 at(double x, double y) const noexcept;
    [[nodiscard]] Vec2 at(Vec2 value) const noexcept { return at(value.x, value.y); }

    /// Ground and grid lines, before the data.
    void draw_ground(Canvas& canvas) const;
    /// Frame, ticks, numbers and labels, after it.
    void draw_frame(Canvas& canvas) const;

    /// A line through the values over rising x, inside the area; a NaN value breaks it. Where many
    /// values share a pixel only their range is drawn.
    void draw_series(Canvas& canvas, std::span<const Vec2> values, const Stroke& stroke) const;

  private:
    /// As at(), but at a pixel's centre: a thin line along an axis is not blurred over two pixels.
    [[nodiscard]] Vec2 sharp_at(double x, double y) const noexcept;

    Box area_;
    Axis x_;
    Axis y_;
};

inline constexpr Ink kPaper{255, 255, 255};
inline constexpr Ink kPlotGround{250, 250, 248};
inline constexpr Ink kGridInk{226, 226, 222};
inline constexpr Ink kQuietInk{100, 100, 100};
inline constexpr Ink kTextInk{35, 35, 35};
inline constexpr Ink kExactInk{196, 196, 190};
inline constexpr Ink kGoalInk{60, 60, 60};

inline constexpr double kTitleCap_px = 13.0;
inline constexpr double kLabelCap_px = 10.0;
inline constexpr double kNumberCap_px = 9.0;

/// An algorithm's style: not colour alone, also its own dashes and its own marker.
struct SeriesStyle {
    std::string name{};  ///< as shown in the legend
    Stroke stroke{};
    Marker marker{Marker::none};
};

[[nodiscard]] SeriesStyle style_of(Algorithm algorithm);

/// One entry under the other, from `corner` on: a piece of line with its marker, and the name.
void draw_legend(Canvas& canvas, Vec2 corner, const std::vector<SeriesStyle>& entries);

/// The title and, under it in paler ink, the settings of the measurement.
void draw_title(Canvas& canvas, const std::string& title, const std::string& settings);

}  // namespace dibhr
