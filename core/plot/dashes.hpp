// Cuts a polyline into the pieces that a dash pattern leaves visible.
#pragma once

#include <span>
#include <vector>

#include "core/haptics/vec.hpp"
#include "core/plot/canvas.hpp"

namespace dibhr {

/// The visible pieces in order, each at least two points; a solid line is one piece. The pattern
/// grows with the line's width, so that dashes stay apart.
[[nodiscard]] std::vector<std::vector<Vec2>> dashes_of(std::span<const Vec2> points, Dash dash,
                                                       double width_px);

}  // namespace dibhr
