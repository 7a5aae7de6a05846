// Touch maps with the outlines of regions as ridges on top of what is painted.
#pragma once

#include "core/haptics/touch_maps.hpp"
#include "core/video/guide/regions.hpp"

namespace dibhr {

/// `painted` with the ridges of a label picture added to its heights, for depth images of columns x
/// rows, ready to be used but for its version. Null: nothing is painted.
[[nodiscard]] TouchMaps with_ridges(const TouchMaps* painted, const Regions& regions, int picture,
                                    int columns, int rows);

}  // namespace dibhr
