#include "core/video/cleaning/fingertip/squares.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/video/frames/vector_clones.hpp"

namespace dibhr::fingertip {

namespace {

constexpr int kSquare_px = 4;
constexpr double kLeast_px = 6.0;  ///< wider than a square's diagonal
constexpr double kMost_px = 40.0;  ///< wider balls use this bound, too: they get no deeper

DIBHR_VECTOR_CLONES void raise_to(const float* __restrict a, const float* __restrict b,
                                  std::size_t count, float* __restrict of) {
    for (std::size_t i = 0; i < count; ++i) of[i] = a[i] > b[i] ? a[i] : b[i];
}

/// Raises all to the others minus the fall, or lowers all to the others plus the fall.
DIBHR_VECTOR_CLONES void raise_all(const float* __restrict others, float fall, std::size_t count,
                                   float* __restrict all) {
    for (std::size_t i = 0; i < count; ++i) {
        const float other = others[i] - fall;
        all[i] = other > all[i] ? other : all[i];
    }
}
DIBHR_VECTOR_CLONES void lower_all(const float* __restrict others, float fall, std::size_t count,
                                   float* __restrict all) {
    for (std::size_t i = 0; i < count; ++i) {
        const float other = others[i] + fall;
        all[i] = other < all[i] ? other : all[i];
    }
}

float fall_levels(const Ball& ball, double x_px, double y_px) {
    const double away_px = std::hypot(x_px, y_px);
    if (away_px > ball.radius_px) return -kNothing;
    return static_cast<float>((ball.radius_px - ball.height_px(away_px)) *
                              double{ball.levels_per_px});
}

}  // namespace

/// Computed for a narrower ball inside the ball: where the ball touches, the narrower one does.
void Squares::find(const PaddedImage& image, int columns, int rows, const Ball& ball) {
    wide_enough_ = ball.radius_px >= kLeast_px;
    ground_.assign(static_cast<std::size_t>(columns), kNothing);
    if (!wide_enough_) return;
    Ball narrow = ball;
    narrow.radius_px = std::min(ball.radius_px, kMost_px);
    columns_ = (columns + kSquare_px - 1) / kSquare_px;
    rows_ = (rows + kSquare_px - 1) / kSquare_px;
    margin_ = static_cast<int>(narrow.radius_px) / kSquare_px + 2;
    pitch_ = columns_ + 2 * margin_;
    const std::size_t count =
        static_cast<std::size_t>(pitch_) * static_cast<std::size_t>(rows_ + 2 * margin_);
    highest_.assign(count, kNothing);
    resting_.assign(count, -kNothing);
    grounds_.assign(count, -kNothing);
    find_highest(image, columns, rows);
    find_resting(narrow);
    find_grounds(narrow, kOverlap_px * ball.levels_per_px);
}

const float* Squares::ground(int row) {
    if (wide_enough_ && row % kSquare_px == 0) {
        const float* const squares = grounds_.data() + at(0, row / kSquare_px);
        for (std::size_t i = 0; i < ground_.size(); ++i) ground_[i] = squares[i / kSquare_px];
    }
    return ground_.data();
}

void Squares::find_highest(const PaddedImage& image, int columns, int rows) {
    for (int y = 0; y < rows_; ++y) {
        const float* highest = image.pixel(0, y * kSquare_px);
        for (int j = y * kSquare_px + 1; j < std::min((y + 1) * kSquare_px, rows); ++j) {
            raise_to(highest, image.pixel(0, j), ground_.size(), ground_.data());
            highest = ground_.data();
        }
        float* const squares = highest_.data() + at(0, y);
        for (int i = 0; i < columns; ++i)
            squares[i / kSquare_px] = std::max(squares[i / kSquare_px], highest[i]);
    }
    std::fill(ground_.begin(), ground_.end(), kNothing);
}

/// The ball is no lower than on another square's highest pixel, wherever it is in the two squares.
void Squares::find_resting(const Ball& narrow) {
    const auto count = static_cast<std::size_t>(columns_);
    for (int y = 0; y < rows_; ++y) std::fill_n(resting_.data() + at(0, y), columns_, kNothing);
    for (int dy = 1 - margin_; dy < margin_; ++dy) {
        for (int dx = 1 - margin_; dx < margin_; ++dx) {
            const float fall = fall_levels(narrow, kSquare_px * (std::abs(dx) + 1),
                                           kSquare_px * (std::abs(dy) + 1));
            if (!(fall < -kNothing)) continue;
            for (int y = 0; y < rows_; ++y)
                raise_all(highest_.data() + at(dx, y + dy), fall, count,
                          resting_.data() + at(0, y));
        }
    }
}

/// The ball touches nothing below the resting levels of the squares that it reaches.
void Squares::find_grounds(const Ball& narrow, float slack) {
    const auto count = static_cast<std::size_t>(columns_);
    for (int dy = 1 - margin_; dy < margin_; ++dy) {
        for (int dx = 1 - margin_; dx < margin_; ++dx) {
            const float fall = fall_levels(narrow, kSquare_px * std::max(std::abs(dx) - 1, 0),
                                           kSquare_px * std::max(std::abs(dy) - 1, 0));
            if (!(fall < -kNothing)) continue;
            for (int y = 0; y < rows_; ++y)
                lower_all(resting_.data() + at(dx, y + dy), fall - slack, count,
                          grounds_.data() + at(0, y));
        }
    }
}

}  // namespace dibhr::fingertip
