// How far two pictures are from each other when each part of one is moved, and which way they come
// nearer.
#pragma once

#include "core/video/motion/motion_cells.hpp"
#include "core/video/motion/motion_pictures.hpp"

namespace dibhr {

/// Of every part that is `wanted` (above 0), moved by its way, at size `size` (0: the largest):
/// slopes too, or the difference alone. Others keep theirs. Pixels that go beyond the picture, or
/// behind what is nearer, are left out.
void sum_differences(const MotionSide& from, const MotionSide& to, std::size_t size,
                     const MotionLayers& wanted, const MotionWays& ways, MotionMeasure measure,
                     MotionSums& sums);

}  // namespace dibhr
