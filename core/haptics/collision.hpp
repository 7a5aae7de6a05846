// Where a straight path first meets the surface: walks the cells under the segment.
#pragma once

#include <optional>

#include "core/haptics/surface.hpp"
#include "core/haptics/vec.hpp"

namespace dibhr {

/// A segment must dive this far below the surface to hit it [px]: more than round-off at the
/// steepest cliff of an 8K image, less than anybody can feel. A path along the surface does not hit
/// it.
inline constexpr double kTouchDepth_px = 1e-10;

/// How a flight along a segment ended.
struct Flight {
    Vec3 end{0.0};                      ///< the last place of the flight
    std::optional<Primitive> ground{};  ///< the TRIANGLE that it met there
    int cells{0};                       ///< number of cells crossed
    bool cut_short{false};              ///< `most_cells` was reached: go on from `end`
};

/// From `from` to `to` or the first point at which the segment dives below the surface, over at
/// most `most_cells`. Both ends are in grid space with (x, y) inside the image rectangle; a start
/// on the surface counts as outside. Cost: one visit a cell crossed, only where the segment is
/// below the surface's ceiling.
[[nodiscard]] Flight fly(const DepthSurface& surface, Vec3 from, Vec3 to, int most_cells) noexcept;

struct Hit {
    Vec3 position{0.0};
    Primitive triangle{};
};

/// The first point at which the segment dives below the surface, or nothing; however long it is.
[[nodiscard]] std::optional<Hit> first_hit(const DepthSurface& surface, Vec3 from,
                                           Vec3 to) noexcept;

}  // namespace dibhr
