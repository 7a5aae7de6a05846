// A part of a ball around every convex VERTEX.
#pragma once

#include <cstddef>
#include <vector>

#include "core/video/cleaning/fingertip/ball.hpp"

namespace dibhr::fingertip {

/// The upper half of the ball, at whole pixels from its axis.
struct Cap {
    int reach{0};                 ///< rows and columns to each side
    int pitch{0};                 ///< some more to the right, over which there is no ball
    std::vector<float> falls{};   ///< from its top [levels]
    std::vector<float> widths{};  ///< to each side, of every row [px]
    std::vector<int> rows{};      ///< from the middle to a row, in `falls`
    std::vector<int> steps{};     ///< and in the image with room around it

    void shape(const Ball& ball, int image_pitch);
};

/// Of those VERTICES of a row that the ball may touch: which they are, and the pixels in a box
/// around them that they may raise, without those that are rather the EDGEs' in their row, by the
/// sines by which these lean.
struct TouchedVertices {
    std::vector<int> number{};
    std::vector<float> level{};
    std::vector<float> left_sine{}, right_sine{};
    std::vector<int> left{}, right{}, top{}, bottom{};
    std::size_t count{0};

    void make_room(std::size_t most);
};

/// Raises pixels by the VERTICES.
class VertexPass {
  public:
    void prepare(const Ball& ball, int columns, int pitch);

    /// Those of a row, from the first one in the image with room around it; `origin`: the same
    /// pixel of what is raised.
    void raise(const float* row, const float* ground, float* origin);

  private:
    void find(const float* row, const float* ground);
    void narrow_wide(const float* row);
    void narrow(const float* row, int distance, TouchedVertices& vertices) const;

    Ball ball_{};
    std::size_t columns_{0};
    int pitch_{0};
    Cap cap_{};
    std::vector<int> flags_{};
    TouchedVertices vertices_{};
    TouchedVertices wide_{};       ///< what is said to be so, and
    std::vector<int> wide_at_{};   ///< where it is among all
    std::vector<float> levels_{};  ///< of rows of boxes
    std::vector<int> falls_{}, to_{}, counts_{};
};

}  // namespace dibhr::fingertip
