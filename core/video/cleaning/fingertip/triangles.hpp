// Every TRIANGLE moved by the ball's radius along its normal: each is over one pixel at most.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/video/cleaning/fingertip/ball.hpp"

namespace dibhr::fingertip {

/// How far the ball's centre is from where it touches one TRIANGLE, seen from above [px]; and along
/// both axes together.
struct Offsets {
    std::vector<float> x{}, y{}, both{};

    void assign(std::size_t count, float x_of_all, float y_of_all);
};

/// A row of cells. Of each array entry k belongs to cell k - 1 where it says `shifted`, else to
/// cell k; the others stand for what is beyond the border: vertical walls.
struct CellRow {
    Offsets near{};
    Offsets far{};  ///< shifted

    /// Beyond the first row (side -1) or the last one (side 1).
    void make_wall(int columns, float radius, float side);
    /// To be filled.
    void make_room(int columns, float radius);
};

class Triangles {
  public:
    void prepare(const Ball& ball, int columns, int pitch);
    /// Of the cells between two rows of the image.
    void move(const float* above, const float* below, CellRow& cells);
    /// `origin`: the pixel of the first cell's origin.
    void raise(float* origin) const;

  private:
    /// At most one for every TRIANGLE: the levels (kNothing: none), and from the TRIANGLE's cell to
    /// the pixel.
    struct Candidates {
        std::vector<float> levels{};
        std::vector<int> to{};
    };

    Ball ball_{};
    int columns_{0};
    int pitch_{0};
    Candidates one_{}, other_{};
    std::vector<std::uint8_t> both_{};  ///< 1 where the other is too; a multiple of 8
};

}  // namespace dibhr::fingertip
