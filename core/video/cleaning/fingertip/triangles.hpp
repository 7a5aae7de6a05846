// Every TRIANGLE moved by the ball's radius along its normal: each is over one pixel at most.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/video/cleaning/fingertip/ball.hpp"

namespace dibhr::fingertip {

/// Offset of the ball's centre from where it touches a TRIANGLE, seen from above [px]; `both`: the
/// sum along both axes.
struct Offsets {
    std::vector<float> x{}, y{}, both{};

    void assign(std::size_t count, float x_of_all, float y_of_all);
};

/// A row of cells. Entry k of an array belongs to cell k - 1 if the array is `shifted`, else to
/// cell k. Entries without a cell are vertical walls beyond the border.
struct CellRow {
    Offsets near{};
    Offsets far{};  ///< shifted

    /// A row of walls beyond the first row (side -1) or the last one (side 1).
    void make_wall(int columns, float radius, float side);
    /// Resizes the arrays; Triangles::move fills them.
    void make_room(int columns, float radius);
};

class Triangles {
  public:
    void prepare(const Ball& ball, int columns, int pitch);
    /// Moves the TRIANGLEs of the cells between two rows of the image.
    void move(const float* above, const float* below, CellRow& cells);
    /// Raises pixels. `above_in_reach`, `below_in_reach`: 1 where the ball may touch a VERTEX of
    /// the two rows; `origin`: the pixel of the first cell's origin.
    void raise(const std::uint8_t* above_in_reach, const std::uint8_t* below_in_reach,
               float* origin);

  private:
    /// At most one for every TRIANGLE: its level (kNothing: none), and the offset from the cell to
    /// its pixel. As many as fill whole groups of kAtOnce.
    struct Candidates {
        std::vector<float> levels{};
        std::vector<int> to{};
    };

    Ball ball_{};
    int columns_{0};
    int pitch_{0};
    Candidates one_{}, other_{};
    std::vector<std::uint8_t> any_{};   ///< 1 where `one_` counts
    std::vector<std::uint8_t> both_{};  ///< 1 where `other_` counts, too
};

}  // namespace dibhr::fingertip
