// Sums over each part of a picture, moved by its way: the difference from the other picture, and
// in which direction it falls.
#pragma once

#include "core/video/motion/motion_cells.hpp"
#include "core/video/motion/motion_pictures.hpp"

namespace dibhr {

/// Sums of every `wanted` part (above 0), moved by its way, in picture number `size` (0: the
/// largest): with slopes or without. Other parts keep theirs. Pixels that move out of the picture,
/// or behind something nearer, do not count.
void sum_differences(const MotionSide& from, const MotionSide& to, std::size_t size,
                     const MotionLayers& wanted, const MotionWays& ways, MotionMeasure measure,
                     MotionSums& sums);

}  // namespace dibhr
