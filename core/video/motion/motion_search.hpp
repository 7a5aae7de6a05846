// The way of every part, roughly, of all ways that there are.
#pragma once

#include <cstddef>
#include <vector>

#include "core/video/motion/motion_cells.hpp"
#include "core/video/motion/motion_pictures.hpp"

namespace dibhr {

/// Tries every way in the smallest pictures, by grey and depth. Keeps scratch memory.
class MotionSearcher {
  public:
    /// Of the parts in the rows, whole cells to each side, at most `reach`; to stay where nothing
    /// is much better. In the smallest picture a cell is a pixel of its near part: a far one goes
    /// as the near one around it that is most alike.
    void search(const MotionSide& from, const MotionSide& to, const MotionKin& kin,
                const MotionRows& rows, int reach, MotionWays& ways);

  private:
    void weigh(const MotionSide& from, const MotionKin& kin);
    void compare(const MotionPictures& from, const MotionPictures& to, const MotionRows& rows,
                 int right, int down);
    void attempt(const MotionRows& rows, int right, int down, MotionWays& ways);
    void follow(const MotionCells& cells, MotionWays& ways) const;

    std::ptrdiff_t columns_{0};
    std::size_t margin_{0};
    std::vector<float> off_{};      ///< of each cell, with a margin before and after them
    std::vector<float> weights_{};  ///< in planes: of the cells around, for each cell
    std::vector<float> score_{}, best_{};
};

}  // namespace dibhr
