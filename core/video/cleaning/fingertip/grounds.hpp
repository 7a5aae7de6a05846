// How deep a ball can get: which VERTICES it may touch.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/video/cleaning/fingertip/ball.hpp"
#include "core/video/cleaning/fingertip/squares.hpp"

namespace dibhr::fingertip {

/// From a lower bound of where the ball rests follows one of the levels that it touches.
///
/// A ball is at least away^2 / (2 radius) above its lowest point `away` from its axis. With
/// `resting(p)`, a lower bound of the ball's level over pixel p, it thus touches nothing below
///     ground(q) = min over p of resting(p) + |p - q|^2 / (2 radius).
/// Up to D from its axis a ball is at most away^2 / (radius + sqrt(radius^2 - D^2)) above that
/// point: resting(p) is the highest VERTEX around p less that. Squares add up, so one pass along
/// columns and one along rows give each bound.
class Grounds {
  public:
    /// For balls that rest over `columns` pixels from `left` on, in rows from `first` to before
    /// `last`. `squares` bounds where they rest, too.
    void prepare(const PaddedImage& image, int left, int columns, const Ball& ball,
                 const Squares& squares, int first, int last);

    /// For every VERTEX of those columns in a row 1 where it may be in the ball's reach, else 0:
    /// the ball touches no piece of the surface between VERTICES that are all 0. The row after the
    /// last call's, or any one first. The marks are valid until the call after the next.
    [[nodiscard]] const std::uint8_t* in_reach(int row) {
        return in_reach(row, image_->pixel(left_, row));
    }
    /// Likewise, if the VERTICES may be as high as those levels.
    [[nodiscard]] const std::uint8_t* in_reach(int row, const float* levels);

  private:
    /// Rows of levels with padding on both sides, each in place of the one that is `count` earlier.
    struct Rows {
        std::size_t pitch{0}, padding{0}, count{1};
        std::vector<float> levels{};

        void fit(std::size_t columns, int padding_px, int rows, float all);
        [[nodiscard]] float* row(int number) {
            return levels.data() + static_cast<std::size_t>(number) % count * pitch + padding;
        }
    };

    void find_resting(int row);
    void find_near(int row);
    void find_ground(int row);
    /// Lowers a row by rows `step` and more times that away, of those from `first` to before
    /// `last`.
    void lower_down(Rows& rows, int row, int first, int last, int step, int times, float* lowered);
    void lower_along(const float* row, int step, int times, float* lowered);
    [[nodiscard]] float rise(int away) const {
        return fall_at_least_ * static_cast<float>(away * away);
    }

    const PaddedImage* image_{nullptr};
    const Squares* squares_{nullptr};
    int left_{0};
    std::size_t columns_{0};
    int first_{0}, last_{0};
    int around_{0};   ///< VERTICES to each side of a ball that tell where it rests; 0: no bound
    int near_{0};     ///< pixels to each side of a VERTEX whose distances are exact, and
    int strides_{0};  ///< how many times as many and one more are looked at beyond
    int next_resting_{0}, next_near_{0};
    float fall_at_least_{0.0F}, fall_at_most_{0.0F};  ///< of the ball, one pixel away [levels]
    float slack_{0.0F};                               ///< [levels]
    Rows highest_{}, resting_{}, near_rows_{}, beside_{}, ground_{};
    std::vector<float> nothing_{};  ///< a row where no ball rests
    std::vector<float> scratch_{};
    std::vector<std::uint8_t> marks_{};  ///< of two rows, by turns
};

}  // namespace dibhr::fingertip
