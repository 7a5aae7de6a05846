// Searches a rough way for every part: tries all ways.
#pragma once

#include <cstddef>
#include <vector>

#include "core/video/motion/motion_cells.hpp"
#include "core/video/motion/motion_pictures.hpp"
#include "core/video/motion/motion_plain.hpp"

namespace dibhr {

/// Tries all ways in the smallest pictures, by grey and depth. Keeps scratch memory.
class MotionSearcher {
  public:
    /// The ways of the parts in the rows, by whole cells, at most `reach` to each side; 0 where no
    /// way is much better. In the smallest picture a cell is a pixel of its near part; a far part
    /// takes the way of the most similar near part around it. Plain parts all take the way that is
    /// best for their group. The second picture's grey is multiplied by `gain`.
    void search(const MotionSide& from, const MotionSide& to, float gain,
                const SimilarParts& similar, const PlainParts& plain, const MotionRows& rows,
                int reach, MotionWays& ways);

  private:
    void weigh(const MotionSide& from, const SimilarParts& similar);
    void compare(const MotionPictures& from, const MotionPictures& to, float gain,
                 const MotionRows& rows, int right, int down);
    void attempt(const MotionRows& rows, int right, int down, MotionWays& ways);
    void attempt_groups(const PlainParts& plain, int right, int down);
    void follow(const MotionCells& cells, MotionWays& ways) const;

    std::ptrdiff_t columns_{0};
    std::size_t margin_{0};
    std::vector<float> off_{};      ///< difference of each cell, with a margin before and after
    std::vector<float> weights_{};  ///< of the cells around each cell, a plane for each neighbour
    std::vector<float> score_{}, best_{};
    // Of groups of plain parts.
    std::vector<float> group_score_{}, group_best_{};
    std::vector<MotionField::Way> group_ways_{};
};

}  // namespace dibhr
