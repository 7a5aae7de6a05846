// A bound of how deep a ball can get, by squares of pixels.
#pragma once

#include <cstddef>
#include <vector>

#include "core/video/cleaning/fingertip/ball.hpp"

namespace dibhr::fingertip {

/// From a lower bound of where the ball rests follows one of the levels that it touches.
class Squares {
  public:
    void find(const PaddedImage& image, int columns, int rows, const Ball& ball);

    /// For every pixel of a row: the ball touches nothing below this level.
    [[nodiscard]] const float* ground(int row);

  private:
    void find_highest(const PaddedImage& image, int columns, int rows);
    void find_resting(const Ball& narrow);
    void find_grounds(const Ball& narrow, float slack);

    [[nodiscard]] std::size_t at(int x, int y) const {
        return static_cast<std::size_t>(std::ptrdiff_t{y + margin_} * pitch_ + x + margin_);
    }

    bool wide_enough_{false};
    int columns_{0}, rows_{0}, margin_{0}, pitch_{0};
    std::vector<float> highest_{}, resting_{}, grounds_{};
    std::vector<float> ground_{};
};

}  // namespace dibhr::fingertip
