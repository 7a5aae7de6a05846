#include "core/video/cleaning/fingertip/vertices.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "core/video/cleaning/fingertip/narrowing.hpp"
#include "core/video/frames/vector_clones.hpp"

namespace dibhr::fingertip {

namespace {

constexpr int kWide = 60;  ///< a VERTEX whose box has this area, without its sides, is narrowed

/// Flags VERTICES in reach that are convex in three directions. Those straight in one are left to
/// the EDGEs.
DIBHR_VECTOR_CLONES void flag_convex(const float* __restrict row,
                                     const std::uint8_t* __restrict in_reach, int pitch,
                                     std::size_t count, std::uint8_t* __restrict flags) {
    const float* const above = row - pitch;
    const float* const below = row + pitch;
    const float* const before = row - 1;
    const float* const below_before = below - 1;
    for (std::size_t i = 0; i < count; ++i) {
        const float z = row[i];
        const int in_row = z - before[i] > row[i + 1] - z ? 1 : 0;
        const int in_column = z - above[i] > below[i] - z ? 1 : 0;
        const int across = z - above[i + 1] > below_before[i] - z ? 1 : 0;
        flags[i] = static_cast<std::uint8_t>(in_row & in_column & across & in_reach[i]);
    }
}

DIBHR_VECTOR_CLONES void flag_wide(const int* __restrict left, const int* __restrict right,
                                   const int* __restrict top, const int* __restrict bottom,
                                   std::size_t count, std::uint8_t* __restrict flags) {
    for (std::size_t k = 0; k < count; ++k) {
        const int area = (right[k] - left[k]) * (bottom[k] - top[k]);
        flags[k] = static_cast<std::uint8_t>(area >= kWide ? 1 : 0);
    }
}

struct Lean {
    float sine, cosine;
};

[[gnu::always_inline]] inline Lean lean_of(float rise, float px_per_level) {
    const float slope = clamped(rise * px_per_level, kSteepest);
    const float cosine = 1.0F / std::sqrt(1.0F + slope * slope);
    return {slope * cosine, cosine};
}

/// How far to the left (or above) the ball's centre may be so that it touches the VERTEX and not
/// the EDGE before it. The ball's reach is `least` where it leans most in the other direction.
[[gnu::always_inline]] inline float least_of(float sine, float reach, float least) {
    return -sine * (sine > 0.0F ? reach : least);
}
[[gnu::always_inline]] inline float most_of(float sine, float reach, float least) {
    return -sine * (sine < 0.0F ? reach : least);
}

/// The boxes of pixels between the EDGEs in rows and columns.
DIBHR_VECTOR_CLONES void box_in(const float* __restrict row, int pitch, const Ball& ball,
                                const int* __restrict number, std::size_t count,
                                float* __restrict level, float* __restrict left_sine,
                                float* __restrict right_sine, int* __restrict left,
                                int* __restrict right, int* __restrict top,
                                int* __restrict bottom) {
    const float* const above = row - pitch;
    const float* const below = row + pitch;
    const float* const before = row - 1;
    const float* const after = row + 1;
    const float radius = ball.radius;
    const float px_per_level = ball.px_per_level;
    for (std::size_t k = 0; k < count; ++k) {
        const int i = number[k];
        const float z = row[i];
        const Lean l = lean_of(z - before[i], px_per_level);
        const Lean r = lean_of(after[i] - z, px_per_level);
        const Lean a = lean_of(z - above[i], px_per_level);
        const Lean b = lean_of(below[i] - z, px_per_level);
        const float low_x = radius * (a.cosine < b.cosine ? a.cosine : b.cosine);
        const float low_y = radius * (l.cosine < r.cosine ? l.cosine : r.cosine);
        level[k] = z;
        left_sine[k] = l.sine;
        right_sine[k] = r.sine;
        left[k] = round_up(clamped(least_of(l.sine, radius, low_x) - kOverlap_px, radius));
        right[k] = round_down(clamped(most_of(r.sine, radius, low_x) + kOverlap_px, radius));
        top[k] = round_up(clamped(least_of(a.sine, radius, low_y) - kOverlap_px, radius));
        bottom[k] = round_down(clamped(most_of(b.sine, radius, low_y) + kOverlap_px, radius));
    }
}

struct Opposite {
    const float* row;
    const float* before;  ///< neighbours to the left, `after` as far to the right; or up and down
    const float* after;
    float px_per_level;
    Neighbour neighbour;
};

/// Flags boxes with pixels.
DIBHR_VECTOR_CLONES void flag_any(const int* __restrict left, const int* __restrict right,
                                  const int* __restrict top, const int* __restrict bottom,
                                  std::size_t count, std::uint8_t* __restrict flags) {
    for (std::size_t k = 0; k < count; ++k) {
        const int across = left[k] <= right[k] ? 1 : 0;
        const int down = top[k] <= bottom[k] ? 1 : 0;
        flags[k] = static_cast<std::uint8_t>(across & down);
    }
}

/// Narrows the boxes to the left and right, or at the top and bottom, so that the ball does not
/// enter the neighbours there. `low` and `high`, the other two sides, bound its reach.
DIBHR_VECTOR_CLONES void narrow_sides(const Opposite& opposite, const int* __restrict number,
                                      const int* __restrict low, const int* __restrict high,
                                      std::size_t count, int* __restrict first,
                                      int* __restrict last) {
    const Opposite of = opposite;
    for (std::size_t k = 0; k < count; ++k) {
        const int i = number[k];
        const float z = of.row[i];
        const int away = -low[k] > high[k] ? -low[k] : high[k];
        const auto away_px = static_cast<float>(away);
        const float reach2 = of.neighbour.radius2 - away_px * away_px;
        const float least2 = reach2 > 0.0F ? reach2 : 0.0F;
        const float before =
            of.neighbour.most_lean_of_less((of.before[i] - z) * of.px_per_level, least2);
        const float after =
            of.neighbour.most_lean_of_less((of.after[i] - z) * of.px_per_level, least2);
        const int least = -round_down(before + kOverlap_px);
        const int most = round_down(after + kOverlap_px);
        first[k] = first[k] > least ? first[k] : least;
        last[k] = last[k] < most ? last[k] : most;
    }
}

struct CapTable {
    const float* widths;
    const int* rows;
    const int* steps;
    int reach;
};

/// For each row of each box: index of its first fall, its first pixel, and how many pixels it has.
DIBHR_VECTOR_CLONES std::size_t lay_rows(const CapTable& table, const TouchedVertices& vertices,
                                         float* __restrict levels, int* __restrict falls,
                                         int* __restrict to, int* __restrict counts) {
    const CapTable cap = table;
    std::size_t count = 0;
    for (std::size_t k = 0; k < vertices.count; ++k) {
        const float level = vertices.level[k];
        const float left_sine = vertices.left_sine[k];
        const float right_sine = vertices.right_sine[k];
        const int left = vertices.left[k];
        const int right = vertices.right[k];
        const int number = vertices.number[k];
        const int bottom = left <= right ? vertices.bottom[k] : -cap.reach - 1;
        for (int top = vertices.top[k]; top <= bottom; top += kAtOnce) {
            for (int l = 0; l < kAtOnce; ++l) {
                const int y = top + l;
                const float width = cap.widths[y];
                const int from_edge = round_up(clamped(-left_sine * width - kOverlap_px, width));
                const int to_edge = round_down(clamped(-right_sine * width + kOverlap_px, width));
                const int first = from_edge > left ? from_edge : left;
                const int last = to_edge < right ? to_edge : right;
                const std::size_t n = count + static_cast<std::size_t>(l);
                levels[n] = level;
                falls[n] = cap.rows[y] + first;
                to[n] = number + cap.steps[y] + first;
                counts[n] = last - first + 1;
            }
            const int rows = bottom - top + 1;
            count += static_cast<std::size_t>(rows < kAtOnce ? rows : kAtOnce);
        }
    }
    return count;
}

/// Raises the pixels of each row, by kAtOnce: the surplus ones may be raised by the VERTEX, too.
DIBHR_VECTOR_CLONES void raise_chunks(const float* __restrict cap_middle,
                                      const float* __restrict levels, const int* __restrict falls,
                                      const int* __restrict to, const int* __restrict counts,
                                      std::size_t rows, float* __restrict origin) {
    for (std::size_t n = 0; n < rows; ++n) {
        for (int done = 0; done < counts[n]; done += kAtOnce) {
            float* const pixels = origin + to[n] + done;
            const float* const fall = cap_middle + falls[n] + done;
            for (int l = 0; l < kAtOnce; ++l) {
                const float candidate = levels[n] - fall[l];
                pixels[l] = candidate > pixels[l] ? candidate : pixels[l];
            }
        }
    }
}

}  // namespace

void Cap::shape(const Ball& ball, int image_pitch) {
    reach = static_cast<int>(ball.radius_px);
    pitch = 2 * reach + 1 + kAtOnce;
    falls.clear();
    widths.clear();
    rows.clear();
    steps.clear();
    for (int y = -reach; y <= reach; ++y) {
        rows.push_back(y * pitch);
        steps.push_back(y * image_pitch);
        widths.push_back(static_cast<float>(ball.height_px(y)));
        for (int x = -reach; x < pitch - reach; ++x) {
            const double away_px = std::hypot(x, y);
            const double fall_px = ball.radius_px - ball.height_px(away_px);
            falls.push_back(away_px > ball.radius_px
                                ? -kNothing
                                : static_cast<float>(fall_px * double{ball.levels_per_px}));
        }
    }
    widths.insert(widths.end(), kAtOnce, 0.0F);
    for (std::vector<int>* of : {&rows, &steps}) of->insert(of->end(), kAtOnce, 0);
}

void TouchedVertices::make_room(std::size_t most) {
    for (std::vector<float>* of : {&level, &left_sine, &right_sine}) of->resize(most);
    for (std::vector<int>* of : {&number, &left, &right, &top, &bottom}) of->resize(most);
}

void VertexPass::prepare(const Ball& ball, int columns, int pitch) {
    if (!(ball == ball_) || pitch != pitch_) cap_.shape(ball, pitch);
    ball_ = ball;
    columns_ = static_cast<std::size_t>(columns);
    pitch_ = pitch;
    vertices_.make_room(whole_flags(columns_));
    wide_.make_room(whole_flags(columns_));
    wide_at_.resize(whole_flags(columns_));
    const std::size_t rows = columns_ * (2 * static_cast<std::size_t>(cap_.reach) + 1) + kAtOnce;
    if (levels_.size() >= rows) return;
    levels_.resize(rows);
    for (std::vector<int>* of : {&falls_, &to_, &counts_}) of->resize(rows);
}

void VertexPass::raise(const float* row, const std::uint8_t* in_reach, float* origin) {
    find(row, in_reach);
    const CapTable table{cap_.widths.data() + cap_.reach, cap_.rows.data() + cap_.reach,
                         cap_.steps.data() + cap_.reach, cap_.reach};
    const std::size_t rows =
        lay_rows(table, vertices_, levels_.data(), falls_.data(), to_.data(), counts_.data());
    raise_chunks(cap_.falls.data() + std::ptrdiff_t{cap_.reach} * cap_.pitch + cap_.reach,
                 levels_.data(), falls_.data(), to_.data(), counts_.data(), rows, origin);
}

void VertexPass::find(const float* row, const std::uint8_t* in_reach) {
    flags_.assign(whole_flags(columns_), 0);
    flag_convex(row, in_reach, pitch_, columns_, flags_.data());
    vertices_.count = number_flagged(flags_, vertices_.number.data());
    box_in(row, pitch_, ball_, vertices_.number.data(), vertices_.count, vertices_.level.data(),
           vertices_.left_sine.data(), vertices_.right_sine.data(), vertices_.left.data(),
           vertices_.right.data(), vertices_.top.data(), vertices_.bottom.data());
    leave_out_empty();
    narrow_wide(row);
}

/// On a smooth surface most boxes lie between pixels.
void VertexPass::leave_out_empty() {
    TouchedVertices& all = vertices_;
    flags_.assign(whole_flags(all.count), 0);
    flag_any(all.left.data(), all.right.data(), all.top.data(), all.bottom.data(), all.count,
             flags_.data());
    all.count = number_flagged(flags_, wide_at_.data());
    for (std::size_t n = 0; n < all.count; ++n) {
        const auto k = static_cast<std::size_t>(wide_at_[n]);
        all.number[n] = all.number[k];
        all.level[n] = all.level[k];
        all.left_sine[n] = all.left_sine[k];
        all.right_sine[n] = all.right_sine[k];
        all.left[n] = all.left[k];
        all.right[n] = all.right[k];
        all.top[n] = all.top[k];
        all.bottom[n] = all.bottom[k];
    }
}

/// VERTICES with a large box are narrowed by neighbours.
void VertexPass::narrow_wide(const float* row) {
    TouchedVertices& all = vertices_;
    flags_.assign(whole_flags(all.count), 0);
    flag_wide(all.left.data(), all.right.data(), all.top.data(), all.bottom.data(), all.count,
              flags_.data());
    wide_.count = number_flagged(flags_, wide_at_.data());
    if (wide_.count == 0) return;
    for (std::size_t w = 0; w < wide_.count; ++w) {
        const auto k = static_cast<std::size_t>(wide_at_[w]);
        wide_.number[w] = all.number[k];
        wide_.left[w] = all.left[k];
        wide_.right[w] = all.right[k];
        wide_.top[w] = all.top[k];
        wide_.bottom[w] = all.bottom[k];
    }
    for (const int distance : kDistances)
        if (distance <= ball_.radius_px) narrow(row, distance, wide_);
    for (std::size_t w = 0; w < wide_.count; ++w) {
        const auto k = static_cast<std::size_t>(wide_at_[w]);
        all.left[k] = wide_.left[w];
        all.right[k] = wide_.right[w];
        all.top[k] = wide_.top[w];
        all.bottom[k] = wide_.bottom[w];
    }
}

void VertexPass::narrow(const float* row, int distance, TouchedVertices& of) const {
    const Neighbour neighbour(distance, ball_);
    const std::ptrdiff_t below = std::ptrdiff_t{distance} * pitch_;
    const Opposite in_row{row, row - distance, row + distance, ball_.px_per_level, neighbour};
    const Opposite in_column{row, row - below, row + below, ball_.px_per_level, neighbour};
    narrow_sides(in_row, of.number.data(), of.top.data(), of.bottom.data(), of.count,
                 of.left.data(), of.right.data());
    narrow_sides(in_column, of.number.data(), of.left.data(), of.right.data(), of.count,
                 of.top.data(), of.bottom.data());
}

}  // namespace dibhr::fingertip
