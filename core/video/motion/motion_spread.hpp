// From the ways of parts to those of pixels.
#pragma once

#include <memory>

#include "core/haptics/depth_image.hpp"
#include "core/haptics/surface_motion.hpp"
#include "core/video/motion/motion_cells.hpp"
#include "core/video/motion/reused.hpp"

namespace dibhr {

/// Every pixel goes as the parts around it that are alike it in depth, the nearer the more. Null:
/// none goes anywhere. `step`: as the cells' pictures are thinned out.
[[nodiscard]] std::shared_ptr<const MotionField> spread_motion(const DepthImage& depth,
                                                               const MotionCells& cells, int step,
                                                               const MotionWays& ways,
                                                               Reused<MotionField>& fields);

}  // namespace dibhr
