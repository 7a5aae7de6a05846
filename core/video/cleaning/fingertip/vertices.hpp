// A part of a ball around every convex VERTEX.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/video/cleaning/fingertip/ball.hpp"

namespace dibhr::fingertip {

/// The upper half of the ball, at whole pixels from its axis.
struct Cap {
    int reach{0};                 ///< rows and columns to each side
    int pitch{0};                 ///< columns, with some to the right without the ball
    std::vector<float> falls{};   ///< depth below the top [levels]
    std::vector<float> widths{};  ///< to each side, of every row [px]
    std::vector<int> rows{};      ///< from the middle to a row, in `falls`
    std::vector<int> steps{};     ///< the same in the padded image

    void shape(const Ball& ball, int image_pitch);
};

/// The VERTICES of a row that the ball may touch: their numbers and levels, the box of pixels that
/// they may raise, and the sines of the slopes of the EDGEs to the left and right. Pixels that
/// those EDGEs raise are left out.
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

    /// By the VERTICES of a row. `row`: the first one in the padded image; `in_reach`: 1 where the
    /// ball may touch it; `origin`: the same pixel of the raised image.
    void raise(const float* row, const std::uint8_t* in_reach, float* origin);

  private:
    void find(const float* row, const std::uint8_t* in_reach);
    void leave_out_empty();
    void narrow_wide(const float* row);
    void narrow(const float* row, int distance, TouchedVertices& vertices) const;

    Ball ball_{};
    std::size_t columns_{0};
    int pitch_{0};
    Cap cap_{};
    std::vector<std::uint8_t> flags_{};
    TouchedVertices vertices_{};
    TouchedVertices wide_{};       ///< those with a large box, and
    std::vector<int> wide_at_{};   ///< their places in `vertices_`
    std::vector<float> levels_{};  ///< of rows of boxes
    std::vector<int> falls_{}, to_{}, counts_{};
};

}  // namespace dibhr::fingertip
