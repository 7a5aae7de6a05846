// Sums over the pixels of every part.
#include "core/video/motion/motion_sums.hpp"

#include <algorithm>
#include <cmath>

#include "core/video/vector_clones.hpp"

namespace dibhr {

namespace {

constexpr float kCovered = 16.0F;  // so much nearer than it was it is something else
constexpr float kOutline = 20.0F;  // an outline's contrast, to each side
constexpr float kLost2 = 400.0F;   // the difference of what cannot have gone there, squared

/// A picture's value and the one half a pixel aside, as weights of four pixels.
struct Between {
    float a, b, c, d;
};

/// Pixels of one cell whose moved places are inside.
struct Block {
    // Of the first picture, the first pixel; of the second one, up left of where it goes.
    const float *grey, *moved_grey;
    const float *level, *moved_level;
    const float *here, *moved_here;  ///< the second: the pixel nearest to where it goes
    const float *near, *moved_near;  ///< as `here`
    std::ptrdiff_t stride;
    std::ptrdiff_t above, below;  ///< to the rows for the slope down, at the picture's border 0
    int columns, rows;
    int at_left, at_right;  ///< 1: there is no pixel beyond that side
    Between weights;
    float between;
    bool near_part, slopes, outline;
};

/// A row of differences and of slopes, and whether a pixel counts.
struct Line {
    float w[kMotionCell_px];
    float r[kMotionCell_px];
    float x[kMotionCell_px];
    float y[kMotionCell_px];
    float lost[kMotionCell_px];
};

using Lanes = float[kMotionSums][kMotionCell_px];

// What is not part of its caller is not compiled for wider vectors.

/// `kWide`: a whole row; 0: what the block says.
template <int kWide>
[[gnu::always_inline]] inline void read_grey(const Block& block, int j, Line& line) {
    const int columns = kWide > 0 ? kWide : block.columns;
    const std::ptrdiff_t at = j * block.stride;
    const float* const grey = block.grey + at;
    const float* const here = block.here + at;
    const float* const moved_here = block.moved_here + at;
    const float* const near = block.near + at;
    const float* const moved_near = block.moved_near + at;
    const float* const moved = block.moved_grey + at;
    const float* const lower = moved + block.stride;
    const Between& k = block.weights;
    const float near_part = block.near_part ? 1.0F : 0.0F;
    for (int i = 0; i < columns; ++i) {
        const float is_near = here[i] > block.between ? 1.0F : 0.0F;
        const float own = is_near == near_part ? 1.0F : 0.0F;
        const float covered = moved_here[i] > near[i] + kCovered ? 1.0F : 0.0F;
        const float lost = moved_near[i] < here[i] - kCovered ? 1.0F : 0.0F;
        line.w[i] = own * (1.0F - covered) * (1.0F - lost);
        line.lost[i] = own * lost;
        line.r[i] =
            (k.a * moved[i] + k.b * moved[i + 1]) + (k.c * lower[i] + k.d * lower[i + 1]) - grey[i];
    }
}

template <int kWide>
[[gnu::always_inline]] inline void read_slopes(const Block& block, const float* first, int j,
                                               Line& line) {
    const int columns = kWide > 0 ? kWide : block.columns;
    const float* const at = first + j * block.stride;
    const float* const above = at + (j == 0 ? block.above : -block.stride);
    const float* const below = at + (j + 1 == block.rows ? block.below : block.stride);
    for (int i = 0; i < columns; ++i) line.y[i] = 0.5F * (below[i] - above[i]);
    if (kWide > 0) {
        for (int i = 0; i < columns; ++i) line.x[i] = 0.5F * (at[i + 1] - at[i - 1]);
        return;
    }
    for (int i = 0; i < columns; ++i) {
        const int left = i == 0 ? block.at_left - 1 : i - 1;
        const int right = i + 1 == columns ? columns - block.at_right : i + 1;
        line.x[i] = 0.5F * (at[right] - at[left]);
    }
}

template <int kWide>
[[gnu::always_inline]] inline void add_grey(const Block& block, const Line& line, Lanes& lanes) {
    const int columns = kWide > 0 ? kWide : block.columns;
    const auto lane = [&lanes](MotionSum sum) { return lanes[static_cast<std::size_t>(sum)]; };
    for (int i = 0; i < columns; ++i) {
        const float w = line.w[i];
        const float r = line.r[i];
        lane(MotionSum::n)[i] += w;
        lane(MotionSum::r)[i] += w * r;
        lane(MotionSum::rr)[i] += w * (r * r) + line.lost[i] * kLost2;
    }
    if (!block.slopes) return;
    for (int i = 0; i < columns; ++i) {
        lane(MotionSum::x)[i] += line.w[i] * line.x[i];
        lane(MotionSum::y)[i] += line.w[i] * line.y[i];
    }
}

template <int kWide>
[[gnu::always_inline]] inline void add_products(const Block& block, const Line& line,
                                                Lanes& lanes) {
    const int columns = kWide > 0 ? kWide : block.columns;
    const auto lane = [&lanes](MotionSum sum) { return lanes[static_cast<std::size_t>(sum)]; };
    for (int i = 0; i < columns; ++i) {
        const float wx = line.w[i] * line.x[i];
        const float wy = line.w[i] * line.y[i];
        lane(MotionSum::xx)[i] += wx * line.x[i];
        lane(MotionSum::xy)[i] += wx * line.y[i];
        lane(MotionSum::yy)[i] += wy * line.y[i];
        lane(MotionSum::xr)[i] += wx * line.r[i];
        lane(MotionSum::yr)[i] += wy * line.r[i];
    }
}

/// The outline between the near part and the far one, as a picture of one contrast.
[[gnu::always_inline]] inline void add_outline(const Block& block, int j, Lanes& lanes) {
    const std::ptrdiff_t at = j * block.stride;
    const float* const level = block.level + at;
    const float* const moved = block.moved_level + at;
    const float* const lower = moved + block.stride;
    const Between& k = block.weights;
    const auto contrast = [&block](float value) {
        return std::min(std::max(value - block.between, -kOutline), kOutline);
    };
    Line line{};
    read_slopes<0>(block, block.level, j, line);
    for (int i = 0; i < block.columns; ++i) {
        const float off = level[i] - block.between;
        const bool between = off > -kOutline && off < kOutline;
        const float after =
            (k.a * moved[i] + k.b * moved[i + 1]) + (k.c * lower[i] + k.d * lower[i + 1]);
        line.w[i] = block.near[at + i] > block.between ? 1.0F : 0.0F;
        line.r[i] = contrast(after) - contrast(level[i]);
        line.x[i] = between ? line.x[i] : 0.0F;
        line.y[i] = between ? line.y[i] : 0.0F;
        lanes[static_cast<std::size_t>(MotionSum::rr)][i] += line.w[i] * (line.r[i] * line.r[i]);
    }
    if (block.slopes) add_products<0>(block, line, lanes);
}

template <int kWide>
[[gnu::always_inline]] inline void sum_rows(const Block& block, Lanes& lanes) {
    Line line{};
    for (int j = 0; j < block.rows; ++j) {
        read_grey<kWide>(block, j, line);
        if (block.slopes) read_slopes<kWide>(block, block.grey, j, line);
        add_grey<kWide>(block, line, lanes);
        if (block.slopes) add_products<kWide>(block, line, lanes);
        if (block.outline) add_outline(block, j, lanes);
    }
}

DIBHR_VECTOR_CLONES void sum_block(const Block& block, float* sums) {
    Lanes lanes{};
    const bool is_inside = block.at_left + block.at_right == 0;
    if (block.columns == kMotionCell_px && is_inside)
        sum_rows<kMotionCell_px>(block, lanes);
    else if (block.columns == kMotionCell_px / 2 && is_inside)
        sum_rows<kMotionCell_px / 2>(block, lanes);
    else
        sum_rows<0>(block, lanes);
    const std::size_t count = block.slopes ? kMotionSums : 3;
    for (std::size_t k = 0; k < count; ++k) {
        const float* const lane = lanes[k];
        sums[k] = ((lane[0] + lane[1]) + (lane[2] + lane[3])) +
                  ((lane[4] + lane[5]) + (lane[6] + lane[7]));
    }
}

struct Span {
    int begin, end;
};

/// The pixels of [begin, end) that stay, with the one after them, within `count`.
Span inside(int begin, int end, int way, int count) {
    return {std::max(begin, -way), std::min(end, count - 1 - way)};
}

struct Part {
    int i, j;
    std::size_t layer;
};

void sum_part(const MotionPictures& from, const MotionPictures& to, std::size_t size,
              const MotionCells& cells, const MotionWays& ways, const Part& part, bool slopes,
              float* sums) {
    const MotionPlane& grey = from.grey[size];
    const int side = kMotionCell_px >> size;
    const float scale = 1.0F / static_cast<float>(1 << size);
    const float right = scale * ways.right.of[part.layer].row(part.j)[part.i];
    const float down = scale * ways.down.of[part.layer].row(part.j)[part.i];
    const int whole_right = static_cast<int>(std::floor(right));
    const int whole_down = static_cast<int>(std::floor(down));
    const Span x = inside(part.i * side, (part.i + 1) * side, whole_right, grey.columns);
    const Span y = inside(part.j * side, (part.j + 1) * side, whole_down, grey.rows);
    std::fill_n(sums, kMotionSums, 0.0F);
    if (x.begin >= x.end || y.begin >= y.end) return;
    const float u = right - static_cast<float>(whole_right);
    const float v = down - static_cast<float>(whole_down);
    const std::ptrdiff_t first = grey.row(y.begin) + x.begin - grey.values.data();
    const std::ptrdiff_t moved =
        first + static_cast<std::ptrdiff_t>(whole_down) * grey.columns + whole_right;
    const std::ptrdiff_t nearest = (v < 0.5F ? 0 : grey.columns) + (u < 0.5F ? 0 : 1);
    Block block{};
    block.grey = grey.values.data() + first;
    block.moved_grey = to.grey[size].values.data() + moved;
    block.level = from.level[size].values.data() + first;
    block.moved_level = to.level[size].values.data() + moved;
    block.here = from.here[size].values.data() + first;
    block.moved_here = to.here[size].values.data() + moved + nearest;
    block.near = from.near[size].values.data() + first;
    block.moved_near = to.near[size].values.data() + moved + nearest;
    block.stride = grey.columns;
    block.above = y.begin > 0 ? -block.stride : 0;
    block.below = y.end < grey.rows ? block.stride : 0;
    block.columns = x.end - x.begin;
    block.rows = y.end - y.begin;
    block.at_left = x.begin == 0 ? 1 : 0;
    block.at_right = x.end == grey.columns ? 1 : 0;
    block.weights = {(1.0F - u) * (1.0F - v), u * (1.0F - v), (1.0F - u) * v, u * v};
    block.between = cells.between.row(part.j)[part.i];
    block.near_part = part.layer == 0;
    block.slopes = slopes;
    block.outline = block.near_part && cells.has(0, part.i, part.j) && cells.has(1, part.i, part.j);
    sum_block(block, sums);
}

}  // namespace

void sum_differences(const MotionPictures& from, const MotionPictures& to, std::size_t size,
                     const MotionCells& cells, const MotionLayers& wanted, const MotionWays& ways,
                     MotionMeasure measure, MotionSums& sums) {
    const auto count = static_cast<std::size_t>(measure);
    const bool slopes = measure == MotionMeasure::slopes;
    std::array<float, kMotionSums> of_part{};
    for (std::size_t layer = 0; layer < 2; ++layer)
        for (int j = 0; j < cells.rows; ++j)
            for (int i = 0; i < cells.columns; ++i) {
                if (!(wanted.of[layer].row(j)[i] > 0.0F)) continue;
                sum_part(from, to, size, cells, ways, {i, j, layer}, slopes, of_part.data());
                const std::size_t at = cells.between.index(i, j);
                for (std::size_t k = 0; k < count; ++k)
                    sums.of[k].of[layer].values[at] = of_part[k];
            }
}

}  // namespace dibhr
