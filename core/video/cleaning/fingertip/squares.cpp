#include "core/video/cleaning/fingertip/squares.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/video/cleaning/fingertip/levels.hpp"

namespace dibhr::fingertip {

namespace {

constexpr int kSquare_px = 4;
constexpr double kLeast_px = 16.0;  ///< narrower balls are bounded by the pixels around
constexpr double kMost_px = 64.0;   ///< wider balls use this bound, too: they get no deeper

float fall_levels(const Ball& ball, double x_px, double y_px) {
    const double away_px = std::hypot(x_px, y_px);
    if (away_px > ball.radius_px) return -kNothing;
    return static_cast<float>((ball.radius_px - ball.height_px(away_px)) *
                              double{ball.levels_per_px});
}

}  // namespace

/// Computed for a narrower ball: the same point of a wider one gets no deeper.
void Squares::find(const PaddedImage& image, int columns, int rows, const Ball& ball) {
    wide_enough_ = ball.radius_px >= kLeast_px;
    if (!wide_enough_) return;
    Ball narrow = ball;
    narrow.radius_px = std::min(ball.radius_px, kMost_px);
    squares_across_ = (columns + kSquare_px - 1) / kSquare_px;
    squares_down_ = (rows + kSquare_px - 1) / kSquare_px;
    margin_ = static_cast<int>(narrow.radius_px) / kSquare_px + 2;
    pitch_ = squares_across_ + 2 * margin_;
    const std::size_t count =
        static_cast<std::size_t>(pitch_) * static_cast<std::size_t>(squares_down_ + 2 * margin_);
    highest_.assign(count, kNothing);
    resting_.assign(count, kNothing);
    find_highest(image, columns, rows);
    find_resting(narrow);
}

void Squares::raise(int row, int left, std::size_t count, float* levels) const {
    if (!wide_enough_) return;
    const float* const squares = resting_.data() + at(0, row / kSquare_px);
    const auto first = static_cast<std::size_t>(left);
    for (std::size_t i = 0; i < count; ++i)
        levels[i] = std::max(levels[i], squares[(first + i) / kSquare_px]);
}

void Squares::find_highest(const PaddedImage& image, int columns, int rows) {
    const auto count = static_cast<std::size_t>(columns);
    std::vector<float> highest(count);
    for (int y = 0; y < squares_down_; ++y) {
        std::copy_n(image.pixel(0, y * kSquare_px), count, highest.data());
        for (int j = y * kSquare_px + 1; j < std::min((y + 1) * kSquare_px, rows); ++j)
            raise_all(image.pixel(0, j), 0.0F, count, highest.data());
        float* const squares = highest_.data() + at(0, y);
        for (int i = 0; i < columns; ++i)
            squares[i / kSquare_px] =
                std::max(squares[i / kSquare_px], highest[static_cast<std::size_t>(i)]);
    }
}

/// The ball is no lower than on another square's highest pixel, wherever it is in the two squares.
void Squares::find_resting(const Ball& narrow) {
    const auto count = static_cast<std::size_t>(squares_across_);
    for (int dy = 1 - margin_; dy < margin_; ++dy) {
        for (int dx = 1 - margin_; dx < margin_; ++dx) {
            const float fall = fall_levels(narrow, kSquare_px * (std::abs(dx) + 1),
                                           kSquare_px * (std::abs(dy) + 1));
            if (!(fall < -kNothing)) continue;
            for (int y = 0; y < squares_down_; ++y)
                raise_all(highest_.data() + at(dx, y + dy), fall, count,
                          resting_.data() + at(0, y));
        }
    }
}

}  // namespace dibhr::fingertip
