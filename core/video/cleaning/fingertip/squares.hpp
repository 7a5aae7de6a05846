// A bound of where a wide ball rests, by squares of pixels.
#pragma once

#include <cstddef>
#include <vector>

#include "core/video/cleaning/fingertip/ball.hpp"

namespace dibhr::fingertip {

/// Each square's highest pixel bounds the level over all squares within the ball's reach.
class Squares {
  public:
    /// Does nothing for a narrow ball, whose bound would tell little.
    void find(const PaddedImage& image, int columns, int rows, const Ball& ball);

    /// Raises the levels of `count` pixels of a row to those below which the ball does not get.
    void raise(int row, int left, std::size_t count, float* levels) const;

  private:
    void find_highest(const PaddedImage& image, int columns, int rows);
    void find_resting(const Ball& narrow);

    [[nodiscard]] std::size_t at(int x, int y) const {
        return static_cast<std::size_t>(std::ptrdiff_t{y + margin_} * pitch_ + x + margin_);
    }

    bool wide_enough_{false};
    int squares_across_{0}, squares_down_{0}, margin_{0}, pitch_{0};
    std::vector<float> highest_{}, resting_{};
};

}  // namespace dibhr::fingertip
