// Finds the cells of the drawn grid in which an object ends before another: there the relief is
// cut.
#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <vector>

#include "render/blended_depth.hpp"
#include "render/relief_grid.hpp"

namespace dibhr {

/// Where the drawn grid is cut. Vertices and cells are numbered row by row; a cell has the number
/// of its upper left vertex.
struct SilhouetteCuts {
    std::vector<float> cut{};  ///< of each cell; 1: it is cut
    /// Which cells around each vertex are cut; the sum of 1: upper left, 2: upper right, 4: lower
    /// left, 8: lower right.
    std::vector<float> around{};
    std::vector<bool> between{};       ///< of each vertex: it lies in the blur between two faces
    std::vector<std::size_t> cells{};  ///< the cut ones
    std::vector<glm::vec2> ends_px{};  ///< of each of `cells`: where its far and near face end
};

/// Cuts a cell where the whole image has a step in it: from unit to unit (outline_unit()) steeper
/// than `slope_limit` [px/px], and over one to three units higher, by twice that limit, than the
/// slopes and curvatures on both sides lead to. So a slope that goes on for longer is whole,
/// however steep, and so is a fold. A part too thin to reach a drawn vertex is not cut.
/// `elevations`: of drawn_elevations().
void find_cuts(const BlendedDepth& depth, const ReliefGrid& grid,
               const std::vector<float>& elevations, double slope_limit, SilhouetteCuts& cuts);

}  // namespace dibhr
