// Sums over each part of a picture, moved by its way: the difference from the other picture, and
// in which direction it falls.
#pragma once

#include "core/video/motion/motion_cells.hpp"
#include "core/video/motion/motion_pictures.hpp"

namespace dibhr {

/// The two frames, and what the second one's grey is multiplied by.
struct MotionSides {
    const MotionSide& from;
    const MotionSide& to;
    float gain;
};

/// Sums of every `wanted` part (above 0), moved by its way, in picture number `size` (0: the
/// largest): with slopes or without. Other parts keep theirs. Pixels that move out of the picture,
/// or behind something nearer, do not count. Of `plain` parts (above 0) with an outline it alone
/// counts: their colour at the outline is mixed with another surface's.
void sum_differences(const MotionSides& sides, std::size_t size, const MotionLayers& wanted,
                     const MotionLayers& plain, const MotionWays& ways, MotionMeasure measure,
                     MotionSums& sums);

/// The slopes of the parts' own colour, in picture number `size`: what an outline blurs is none of
/// it, nor are cells with two parts. The sums of differences become 0.
void sum_structure(const MotionSide& side, std::size_t size, MotionSums& sums);

}  // namespace dibhr
