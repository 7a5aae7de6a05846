// A few pixels of a path magnified: grid, goals, exact orbit, proxies and one update's springs.
#pragma once

#include <cstddef>

#include "core/experiment/experiment.hpp"
#include "core/plot/canvas.hpp"

namespace dibhr {

/// The square part of the image around one update.
struct MagnifiedPlace {
    Vec2 centre{0.0};
    double side_px{14.0};   ///< of the image
    std::size_t update{0};  ///< whose springs are drawn
};

/// Among the updates that the other plots show: where the algorithms differ as much as they do in
/// half of the updates in contact; it holds the goal and the proxies of that update.
[[nodiscard]] MagnifiedPlace typical_place(const PathRun& path);

/// Updates from one marker to the next, so that a slow hand's markers do not cover each other.
[[nodiscard]] std::size_t updates_a_marker(const PathRun& path, const MagnifiedPlace& place);

/// How far apart the proxies were in this update, seen from above, summed over the runs [px].
[[nodiscard]] double separation_px(const PathRun& path, std::size_t update);

/// Draws the place into `area`, which must be square; `under` as in plot_paths.
void draw_magnified(Canvas& canvas, Box area, const PathRun& path, const MagnifiedPlace& place,
                    const ColourImage* under);

}  // namespace dibhr
