#include "core/video/cleaning/fingertip/grounds.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "core/video/frames/vector_clones.hpp"

namespace dibhr::fingertip {

namespace {

constexpr int kAround = 4;          ///< farther VERTICES seldom change the result
constexpr int kNear = 4;            ///< beyond, distances are computed less exactly
constexpr float kRounding = 2e-6F;  ///< of levels, in all sums here and where pieces are raised

/// Two rows, equally far away, and how much lower or higher their levels count.
struct Pair {
    const float* one;
    const float* other;
    float change;
};
using Pairs = std::array<Pair, 4>;

struct Highest {
    [[gnu::always_inline]] static float of(float a, float b) { return a > b ? a : b; }
    [[gnu::always_inline]] static float from(float level, float change) { return level - change; }
};
struct Lowest {
    [[gnu::always_inline]] static float of(float a, float b) { return a < b ? a : b; }
    [[gnu::always_inline]] static float from(float level, float change) { return level + change; }
};

/// The most extreme of a row and four pairs, each looked at only once.
template <typename Most>
[[gnu::always_inline]] inline void find_most(const float* __restrict row, const Pairs& pairs,
                                             std::size_t count, float* __restrict most) {
    const Pair a = pairs[0];
    const Pair b = pairs[1];
    const Pair c = pairs[2];
    const Pair d = pairs[3];
    for (std::size_t i = 0; i < count; ++i) {
        const float of_a = Most::from(Most::of(a.one[i], a.other[i]), a.change);
        const float of_b = Most::from(Most::of(b.one[i], b.other[i]), b.change);
        const float of_c = Most::from(Most::of(c.one[i], c.other[i]), c.change);
        const float of_d = Most::from(Most::of(d.one[i], d.other[i]), d.change);
        most[i] = Most::of(row[i], Most::of(Most::of(of_a, of_b), Most::of(of_c, of_d)));
    }
}

DIBHR_VECTOR_CLONES void find_highest(const float* row, const Pairs& pairs, std::size_t count,
                                      float* highest) {
    find_most<Highest>(row, pairs, count, highest);
}

DIBHR_VECTOR_CLONES void find_lowest(const float* row, const Pairs& pairs, std::size_t count,
                                     float* lowest) {
    find_most<Lowest>(row, pairs, count, lowest);
}

/// Finds it for a row and the pairs 1 to `last`, of which `pair_at` gives each.
template <typename Find, typename PairAt>
void find_of_all(Find&& find, const float* row, int last, PairAt&& pair_at,
                 std::vector<float>& scratch, float* most) {
    if (last == 0) std::copy_n(row, scratch.size(), most);
    const float* from = row;
    for (int n = 1; n <= last; n += 4) {
        const Pairs pairs{pair_at(n), pair_at(std::min(n + 1, last)),
                          pair_at(std::min(n + 2, last)), pair_at(std::min(n + 3, last))};
        float* const to = (last - n) / 4 % 2 == 0 ? most : scratch.data();
        find(from, pairs, scratch.size(), to);
        from = to;
    }
}

DIBHR_VECTOR_CLONES void mark_from(const float* __restrict ground, float slack,
                                   const float* __restrict levels, std::size_t count,
                                   std::uint8_t* __restrict marks) {
    for (std::size_t i = 0; i < count; ++i) {
        const float least = ground[i] - (slack + kRounding * std::fabs(ground[i]));
        marks[i] = static_cast<std::uint8_t>(levels[i] >= least ? 1 : 0);
    }
}

}  // namespace

void Grounds::Rows::fit(std::size_t columns, int padding_px, int rows, float all) {
    padding = static_cast<std::size_t>(padding_px);
    count = static_cast<std::size_t>(rows);
    pitch = columns + 2 * padding;
    levels.assign(pitch * count, all);
}

void Grounds::prepare(const PaddedImage& image, int left, int columns, const Ball& ball,
                      const Squares& squares, int first, int last) {
    image_ = &image;
    left_ = left;
    squares_ = &squares;
    columns_ = static_cast<std::size_t>(columns);
    first_ = next_resting_ = first;
    last_ = last;
    around_ = std::min({kAround, static_cast<int>(0.4 * ball.radius_px) + 1,
                        static_cast<int>(ball.radius_px / std::sqrt(2.0))});
    marks_.assign(2 * columns_, 1);
    if (around_ == 0) return;
    // A ball touches up to a pixel nearer to itself than the VERTICES of what it touches are.
    const int reach = static_cast<int>(ball.radius_px) + 1;
    near_ = std::min(reach, kNear);
    strides_ = reach / (near_ + 1);
    next_near_ = first - near_;
    fall_at_least_ = static_cast<float>(0.5 / ball.radius_px * double{ball.levels_per_px});
    fall_at_most_ = static_cast<float>(double{ball.levels_per_px} /
                                       (ball.radius_px + ball.height_px(std::sqrt(2.0) * around_)));
    // Of a point between VERTICES the square of a distance is up to 1/2 below the mean of theirs.
    slack_ = 0.5F * fall_at_least_ + kOverlap_px * ball.levels_per_px;
    const int far = strides_ * (near_ + 1);
    highest_.fit(columns_, around_, 1, kNothing);
    resting_.fit(columns_, 0, 2 * near_ + 1, -kNothing);
    near_rows_.fit(columns_, 0, 2 * far + 1, -kNothing);
    beside_.fit(columns_, std::max(near_, far), 2, -kNothing);
    ground_.fit(columns_, 0, 1, -kNothing);
    nothing_.assign(columns_, -kNothing);
    scratch_.resize(columns_);
}

const std::uint8_t* Grounds::in_reach(int row, const float* levels) {
    std::uint8_t* const marks = marks_.data() + (row % 2 == 0 ? 0 : columns_);
    if (around_ == 0) return marks;
    find_ground(row);
    mark_from(ground_.row(0), slack_, levels, columns_, marks);
    return marks;
}

void Grounds::find_resting(int row) {
    const auto fall = [this](int away) { return fall_at_most_ * static_cast<float>(away * away); };
    float* const highest = highest_.row(0);
    float* const resting = resting_.row(row - first_);
    find_of_all(
        find_highest, image_->pixel(left_, row), around_,
        [&](int away) {
            return Pair{image_->pixel(left_, row - away), image_->pixel(left_, row + away),
                        fall(away)};
        },
        scratch_, highest);
    find_of_all(
        find_highest, highest, around_,
        [&](int away) {
            return Pair{highest - away, highest + away, fall(away)};
        },
        scratch_, resting);
    squares_->raise(row, left_, columns_, resting);
}

void Grounds::lower_down(Rows& rows, int row, int first, int last, int step, int times,
                         float* lowered) {
    const auto row_at = [&](int other) -> const float* {
        return other >= first && other < last ? rows.row(other - first) : nothing_.data();
    };
    find_of_all(
        find_lowest, row_at(row), times,
        [&](int n) {
            const int away = n * step;
            return Pair{row_at(row - away), row_at(row + away), rise(away)};
        },
        scratch_, lowered);
}

void Grounds::lower_along(const float* row, int step, int times, float* lowered) {
    find_of_all(
        find_lowest, row, times,
        [&](int n) {
            const int away = n * step;
            return Pair{row - away, row + away, rise(away)};
        },
        scratch_, lowered);
}

void Grounds::find_near(int row) {
    for (; next_resting_ < std::min(row + near_ + 1, last_); ++next_resting_)
        find_resting(next_resting_);
    lower_down(resting_, row, first_, last_, 1, near_, near_rows_.row(row - (first_ - near_)));
}

void Grounds::find_ground(int row) {
    const int stride = near_ + 1;
    const int first = first_ - near_;
    const int last = last_ + near_;
    for (; next_near_ < std::min(row + strides_ * stride + 1, last); ++next_near_)
        find_near(next_near_);
    lower_down(near_rows_, row, first, last, stride, strides_, beside_.row(0));
    lower_along(beside_.row(0), 1, near_, beside_.row(1));
    lower_along(beside_.row(1), stride, strides_, ground_.row(0));
}

}  // namespace dibhr::fingertip
