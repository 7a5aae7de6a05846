// How the plots look: colours that a colour-blind reader tells apart, and each algorithm's line and
// marker.
#pragma once

#include <string>
#include <vector>

#include "core/haptics/touch.hpp"
#include "core/plot/canvas.hpp"

namespace dibhr {

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

/// Nothing is said by colour alone: each algorithm has its own dashes and its own marker too.
struct SeriesLook {
    std::string name{};  ///< as a person reads it
    Stroke stroke{};
    Marker marker{Marker::none};
};

[[nodiscard]] SeriesLook look_of(Algorithm algorithm);
[[nodiscard]] SeriesLook look_of_exact();
[[nodiscard]] SeriesLook look_of_goal();

/// One entry under the other, from `corner` on: a piece of line with its marker, and the name.
void draw_legend(Canvas& canvas, Vec2 corner, const std::vector<SeriesLook>& entries);

/// The title and, under it in quieter ink, what it was measured with.
void draw_title(Canvas& canvas, const std::string& title, const std::string& settings);

}  // namespace dibhr
