#include "core/video/cleaning/fingertip/triangles.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "core/video/frames/vector_clones.hpp"

namespace dibhr::fingertip {

namespace {

/// Levels of a TRIANGLE's corners, in the order of a Facet.
struct Corners {
    float corner, beside, below;
};

/// A moved TRIANGLE: its offset, the pixel that it is over, and its level there.
struct Moved {
    float x, y;
    int to;
    float level;
};

struct Move {
    float radius, radius_levels, px_per_level;
    int pitch;
};

template <int kSign>
[[gnu::always_inline]] inline Moved moved(const Corners z, const Move move) {
    const float rise_x = z.beside - z.corner;
    const float rise_y = z.below - z.corner;
    const float slope_x = kSign * (rise_x * move.px_per_level);
    const float slope_y = kSign * (rise_y * move.px_per_level);
    const float upright = 1.0F / std::sqrt(1.0F + slope_x * slope_x + slope_y * slope_y);
    const float x = -slope_x * upright * move.radius;
    const float y = -slope_y * upright * move.radius;
    const int to_x = round_up(x);
    const int to_y = round_up(y);
    const float in_cell_x = static_cast<float>(to_x) - x;
    const float in_cell_y = static_cast<float>(to_y) - y;
    const float share_x = kSign > 0 ? in_cell_x : 1.0F - in_cell_x;
    const float share_y = kSign > 0 ? in_cell_y : 1.0F - in_cell_y;
    const float level =
        z.corner + rise_x * share_x + rise_y * share_y - move.radius_levels * (1.0F - upright);
    return {x, y, to_y * move.pitch + to_x, share_x + share_y <= 1.0F ? level : kNothing};
}

/// Moves both TRIANGLEs of the cells between two rows: near the origin, and at the far corner.
DIBHR_VECTOR_CLONES void move_both(const float* __restrict above, const float* __restrict below,
                                   const Move& how, std::size_t count, float* __restrict near_x,
                                   float* __restrict near_y, float* __restrict near_both,
                                   float* __restrict far_x, float* __restrict far_y,
                                   float* __restrict far_both, float* __restrict levels,
                                   int* __restrict to, float* __restrict other_levels,
                                   int* __restrict other_to) {
    const Move move = how;
    for (std::size_t i = 0; i < count; ++i) {
        const Moved near = moved<1>({above[i], above[i + 1], below[i]}, move);
        const Moved far = moved<-1>({below[i + 1], below[i], above[i + 1]}, move);
        near_x[i] = near.x;
        near_y[i] = near.y;
        near_both[i] = near.x + near.y;
        far_x[i] = far.x;
        far_y[i] = far.y;
        far_both[i] = far.x + far.y;
        levels[i] = near.level;
        to[i] = near.to;
        other_levels[i] = far.level;
        other_to[i] = far.to;
    }
}

/// Merges a cell's two candidates into the first list, as on a smooth surface they are over one
/// pixel. `both` is 1 where they are over two different pixels, `any` where one may be the highest.
DIBHR_VECTOR_CLONES void merge(float* __restrict levels, int* __restrict to,
                               const float* __restrict other_levels, const int* __restrict other_to,
                               const std::uint8_t* __restrict above_in_reach,
                               const std::uint8_t* __restrict below_in_reach, std::size_t count,
                               std::uint8_t* __restrict any, std::uint8_t* __restrict both) {
    for (std::size_t i = 0; i < count; ++i) {
        const int one = levels[i] > kNothing ? 1 : 0;
        const int other = other_levels[i] > kNothing ? 1 : 0;
        const int reached =
            above_in_reach[i] | above_in_reach[i + 1] | below_in_reach[i] | below_in_reach[i + 1];
        const int apart = to[i] == other_to[i] ? 0 : one & other;
        const float higher = other_levels[i] > levels[i] ? other_levels[i] : levels[i];
        levels[i] = apart != 0 ? levels[i] : higher;
        to[i] = one != 0 ? to[i] : other_to[i];
        any[i] = static_cast<std::uint8_t>((one | other) & reached);
        both[i] = static_cast<std::uint8_t>(apart & reached);
    }
}

/// Raises pixels, by kAtOnce of them where the surface is smooth.
DIBHR_VECTOR_CLONES void raise_pixels(const float* __restrict levels, const int* __restrict to,
                                      const std::uint8_t* __restrict any, std::size_t count,
                                      float* __restrict origin) {
    for (std::size_t first = 0; first < count; first += kAtOnce) {
        if (!any_flag(any + first)) continue;
        const float* const from = levels + first;
        const int* const ways = to + first;
        float* const pixels = origin + first;
        int apart = 0;
        for (int l = 0; l < kAtOnce; ++l) apart |= ways[l] ^ ways[0];
        if (apart == 0) {
            float* const moved = pixels + ways[0];
            for (int l = 0; l < kAtOnce; ++l) moved[l] = from[l] > moved[l] ? from[l] : moved[l];
        } else {
            for (int l = 0; l < kAtOnce; ++l) {
                float& level = pixels[l + ways[l]];
                level = from[l] > level ? from[l] : level;
            }
        }
    }
}

}  // namespace

void Offsets::assign(std::size_t count, float x_of_all, float y_of_all) {
    x.assign(count, x_of_all);
    y.assign(count, y_of_all);
    both.assign(count, x_of_all + y_of_all);
}

void CellRow::make_wall(int columns, float radius, float side) {
    const auto count = static_cast<std::size_t>(columns);
    near.assign(count, 0.0F, side * radius);
    far.assign(count, 0.0F, side * radius);
}

void CellRow::make_room(int columns, float radius) {
    const auto count = static_cast<std::size_t>(columns);
    for (Offsets* offsets : {&near, &far})
        for (std::vector<float>* along : {&offsets->x, &offsets->y, &offsets->both})
            along->resize(count);
    near.x.back() = radius;
    far.x.front() = -radius;
}

void Triangles::prepare(const Ball& ball, int columns, int pitch) {
    ball_ = ball;
    columns_ = columns;
    pitch_ = pitch;
    const std::size_t count = whole_flags(static_cast<std::size_t>(columns));
    for (Candidates* candidates : {&one_, &other_}) {
        candidates->levels.assign(count, kNothing);
        candidates->to.assign(count, 0);
    }
    any_.assign(count, 0);
    both_.assign(count, 0);
}

void Triangles::move(const float* above, const float* below, CellRow& cells) {
    cells.make_room(columns_, ball_.radius);
    const Move how{ball_.radius, ball_.radius_levels, ball_.px_per_level, pitch_};
    const auto count = static_cast<std::size_t>(columns_ - 1);
    move_both(above, below, how, count, cells.near.x.data(), cells.near.y.data(),
              cells.near.both.data(), cells.far.x.data() + 1, cells.far.y.data() + 1,
              cells.far.both.data() + 1, one_.levels.data(), one_.to.data(), other_.levels.data(),
              other_.to.data());
}

void Triangles::raise(const std::uint8_t* above_in_reach, const std::uint8_t* below_in_reach,
                      float* origin) {
    merge(one_.levels.data(), one_.to.data(), other_.levels.data(), other_.to.data(),
          above_in_reach, below_in_reach, static_cast<std::size_t>(columns_ - 1), any_.data(),
          both_.data());
    raise_pixels(one_.levels.data(), one_.to.data(), any_.data(), any_.size(), origin);
    static_assert(std::endian::native == std::endian::little);
    for (std::size_t first = 0; first < both_.size(); first += 8) {
        std::uint64_t eight = 0;
        std::memcpy(&eight, both_.data() + first, sizeof eight);
        for (; eight != 0; eight &= eight - 1) {
            const std::size_t i = first + static_cast<std::size_t>(std::countr_zero(eight)) / 8;
            float& level = origin[static_cast<std::ptrdiff_t>(i) + other_.to[i]];
            level = std::max(level, other_.levels[i]);
        }
    }
}

}  // namespace dibhr::fingertip
