// Where the relief is torn at silhouettes: each steep triangle becomes a near and a far layer,
// which the fragment shader cuts along the outline in the whole depth image; numbers only, no
// OpenGL.
#pragma once

#include <vector>

#include "core/haptics/depth_image.hpp"
#include "core/haptics/parameters.hpp"
#include "render/relief_grid.hpp"

namespace dibhr {

/// One corner of a layer: it lies at `corner`, as high and as bright as the drawn vertex `source`
/// of the same face. Of the layer only what is within `tolerance_px` of the depth image is shown.
struct RimVertex {
    GridVertex corner{};
    GridVertex source{};
    float tolerance_px{0.0F};
};

/// The elevation [px] of every drawn vertex without the bump map, row-major. `from` and `to` have
/// the grid's size.
void drawn_elevations(const DepthImage& from, const DepthImage& to, double blend,
                      double px_per_level, const ReliefGrid& grid, std::vector<float>& elevations);

/// What is torn: all triangles steeper than the limit, and those that hang on a loose vertex.
struct Rims {
    std::vector<RimVertex> layers{};  ///< three vertices a triangle; 120'000 at most
    std::vector<float> loose{};  ///< 1: the drawn vertex is in the blur between two faces; else 0
};

/// Tears the drawn grid where it is steeper than `slope_limit` [px/px].
void tear_rims(const ReliefGrid& grid, const std::vector<float>& elevations, double slope_limit,
               Rims& rims);

}  // namespace dibhr
