// Spreads the ways of parts to pixels.
#pragma once

#include <memory>

#include "core/haptics/depth_image.hpp"
#include "core/haptics/surface_motion.hpp"
#include "core/video/frames/object_pool.hpp"
#include "core/video/motion/motion_cells.hpp"

namespace dibhr {

/// Every pixel takes the mean way of the parts around it that are alike it in depth, weighted by
/// nearness. Null: nothing moves. `step`: of the thinned-out pictures of the cells.
[[nodiscard]] std::shared_ptr<const MotionField> spread_motion(const DepthImage& depth,
                                                               const MotionCells& cells, int step,
                                                               const MotionWays& ways,
                                                               ObjectPool<MotionField>& fields);

}  // namespace dibhr
