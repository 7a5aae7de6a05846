// The way of every part, roughly, of all ways that there are.
#pragma once

#include <vector>

#include "core/video/motion/motion_cells.hpp"
#include "core/video/motion/motion_pictures.hpp"

namespace dibhr {

/// Tries every way in the smallest pictures, by grey and depth. Keeps scratch memory.
class MotionSearcher {
  public:
    /// Of the parts in the spans, whole cells to each side, at most `reach`; to stay where nothing
    /// is much better.
    void search(const MotionPictures& from, const MotionPictures& to, const MotionCells& cells,
                const MotionSpans& spans, int reach, MotionWays& ways);

  private:
    void weigh(const MotionCells& cells, const MotionSpans& spans);
    void compare(const MotionPictures& from, const MotionPictures& to, int right, int down);
    void attempt(const MotionCells& cells, const MotionSpans& spans, int right, int down,
                 MotionWays& ways);

    MotionPlane off_{};             ///< with a margin
    std::vector<float> weights_{};  ///< of the parts around, for each part
    MotionLayers score_{}, best_{};
};

}  // namespace dibhr
