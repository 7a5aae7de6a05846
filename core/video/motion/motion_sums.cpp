// Sums over the pixels of every part.
#include "core/video/motion/motion_sums.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <numeric>
#include <vector>

#include "core/video/frames/vector_clones.hpp"

namespace dibhr {

namespace {

constexpr float kCovered = 16.0F;  // if this much nearer, a place shows another surface
constexpr float kOutline = 20.0F;  // an outline's contrast, to each side
constexpr float kCliff = 8.0F;     // an outline's slope, over two pixels
constexpr float kLost2 = 400.0F;   // squared difference of pixels that cannot have moved there

/// Weights of four pixels for a place between them.
struct Between {
    float a, b, c, d;
};

/// For a place this far from a whole pixel, in [0, 1).
Between between(float right, float down) {
    return {(1.0F - right) * (1.0F - down), right * (1.0F - down), (1.0F - right) * down,
            right * down};
}

/// For a picture that is multiplied by `gain`.
Between gained(const Between& by, float gain) {
    return {gain * by.a, gain * by.b, gain * by.c, gain * by.d};
}

/// Pixels of one cell whose moved places are inside.
struct Block {
    // Of the first picture the first pixel; of the second one the pixel up left of its destination.
    const float *grey, *moved_grey;
    const float *level, *moved_level;
    const float *here, *moved_here;  ///< the second: the pixel nearest to the destination
    const float *near, *moved_near;  ///< likewise
    std::ptrdiff_t stride;
    std::ptrdiff_t above, below;  ///< to the rows for the slope down, at the picture's border 0
    int columns, rows;
    int at_left, at_right;  ///< 1: there is no pixel beyond that side
    Between weights;
    Between grey_weights;  ///< times the gain of the second picture
    float threshold;
    bool near_part, slopes, outline;
    bool colour;  ///< counts, too
};

// Always inline: only code inside DIBHR_VECTOR_CLONES functions is compiled for wider vectors.

/// kSide pixels of a row.
template <int kSide>
using Pixels [[gnu::vector_size(kSide * sizeof(float))]] = float;

template <int kSide>
[[gnu::always_inline]] inline void load(Pixels<kSide>& pixels, const float* from) {
    std::memcpy(&pixels, from, sizeof(pixels));
}

/// The sums, each in one lane for each column.
template <int kSide>
struct Lanes {
    Pixels<kSide> n{}, r{}, rr{}, x{}, y{}, xx{}, xy{}, yy{}, xr{}, yr{};
};

template <int kSide>
[[gnu::always_inline]] inline float sum_of(const Pixels<kSide>& pixels) {
    float lane[kSide];
    std::memcpy(lane, &pixels, sizeof(lane));
    float sum = (lane[0] + lane[1]) + (lane[2] + lane[3]);
    if constexpr (kSide == kMotionCell_px) sum += (lane[4] + lane[5]) + (lane[6] + lane[7]);
    return sum;
}

template <int kSide, bool kSlopes>
[[gnu::always_inline]] inline void put(const Lanes<kSide>& lanes, float* sums) {
    const auto sum = [sums](MotionSum which) -> float& {
        return sums[static_cast<std::size_t>(which)];
    };
    sum(MotionSum::n) = sum_of<kSide>(lanes.n);
    sum(MotionSum::r) = sum_of<kSide>(lanes.r);
    sum(MotionSum::rr) = sum_of<kSide>(lanes.rr);
    if (!kSlopes) return;
    sum(MotionSum::x) = sum_of<kSide>(lanes.x);
    sum(MotionSum::y) = sum_of<kSide>(lanes.y);
    sum(MotionSum::xx) = sum_of<kSide>(lanes.xx);
    sum(MotionSum::xy) = sum_of<kSide>(lanes.xy);
    sum(MotionSum::yy) = sum_of<kSide>(lanes.yy);
    sum(MotionSum::xr) = sum_of<kSide>(lanes.xr);
    sum(MotionSum::yr) = sum_of<kSide>(lanes.yr);
}

/// Interpolates the picture between pixels.
template <int kSide>
[[gnu::always_inline]] inline void load_between(Pixels<kSide>& pixels, const float* from,
                                                std::ptrdiff_t stride, const Between& weights) {
    Pixels<kSide> a, b, c, d;
    load<kSide>(a, from);
    load<kSide>(b, from + 1);
    load<kSide>(c, from + stride);
    load<kSide>(d, from + stride + 1);
    pixels = (weights.a * a + weights.b * b) + (weights.c * c + weights.d * d);
}

template <int kSide>
[[gnu::always_inline]] inline void load_slopes(Pixels<kSide>& x, Pixels<kSide>& y, const float* at,
                                               const float* above, const float* below) {
    Pixels<kSide> before, after;
    load<kSide>(before, at - 1);
    load<kSide>(after, at + 1);
    x = 0.5F * (after - before);
    load<kSide>(before, above);
    load<kSide>(after, below);
    y = 0.5F * (after - before);
}

/// Adds products of differences and slopes with weight `w`.
template <int kSide>
[[gnu::always_inline]] inline void add_products(const Pixels<kSide>& w, const Pixels<kSide>& r,
                                                const Pixels<kSide>& x, const Pixels<kSide>& y,
                                                Lanes<kSide>& lanes) {
    const Pixels<kSide> wx = w * x;
    const Pixels<kSide> wy = w * y;
    lanes.xx += wx * x;
    lanes.xy += wx * y;
    lanes.yy += wy * y;
    lanes.xr += wx * r;
    lanes.yr += wy * r;
}

/// Sums of a whole cell of one surface that nothing can cover.
template <int kSide, bool kSlopes>
[[gnu::always_inline]] inline void sum_plain(const Block& block, float* sums) {
    Lanes<kSide> lanes{};
    Pixels<kSide> grey, moved, x, y;
    for (int j = 0; j < kSide; ++j) {
        const std::ptrdiff_t at = j * block.stride;
        load<kSide>(grey, block.grey + at);
        load_between<kSide>(moved, block.moved_grey + at, block.stride, block.grey_weights);
        const Pixels<kSide> r = moved - grey;
        lanes.r += r;
        lanes.rr += r * r;
        if (!kSlopes) continue;
        const float* const here = block.grey + at;
        load_slopes<kSide>(x, y, here, here - block.stride, here + block.stride);
        lanes.x += x;
        lanes.y += y;
        lanes.xx += x * x;
        lanes.xy += x * y;
        lanes.yy += y * y;
        lanes.xr += x * r;
        lanes.yr += y * r;
    }
    lanes.n += static_cast<float>(kSide);
    put<kSide, kSlopes>(lanes, sums);
}

/// Adds the outline between near and far part, as a picture of fixed contrast.
template <int kSide, bool kSlopes>
[[gnu::always_inline]] inline void add_outline(const Block& block, Lanes<kSide>& lanes) {
    Pixels<kSide> level, after, near, x, y;
    for (int j = 0; j < kSide; ++j) {
        const std::ptrdiff_t at = j * block.stride;
        load<kSide>(level, block.level + at);
        load<kSide>(near, block.near + at);
        load_between<kSide>(after, block.moved_level + at, block.stride, block.weights);
        const Pixels<kSide> low = Pixels<kSide>{} - kOutline;
        const Pixels<kSide> high = Pixels<kSide>{} + kOutline;
        Pixels<kSide> before = level - block.threshold;
        const auto between = (before > low) & (before < high);
        after -= block.threshold;
        before = before < low ? low : before;
        before = before > high ? high : before;
        after = after < low ? low : after;
        after = after > high ? high : after;
        const Pixels<kSide> r = after - before;
        const Pixels<kSide> w = near > block.threshold ? Pixels<kSide>{} + 1.0F : Pixels<kSide>{};
        lanes.rr += w * (r * r);
        if (!kSlopes) continue;
        const float* const here = block.level + at;
        load_slopes<kSide>(x, y, here, here + (j == 0 ? block.above : -block.stride),
                           here + (j + 1 == kSide ? block.below : block.stride));
        x = between ? x : Pixels<kSide>{};
        y = between ? y : Pixels<kSide>{};
        add_products<kSide>(w, r, x, y, lanes);
    }
}

/// Sums of a whole cell.
template <int kSide, bool kSlopes>
[[gnu::always_inline]] inline void sum_whole(const Block& block, float* sums) {
    Lanes<kSide> lanes{};
    Pixels<kSide> grey, moved, here, near, moved_here, moved_near, x, y;
    const Pixels<kSide> none{};
    const Pixels<kSide> one = none + 1.0F;
    // Depths above the threshold are near, the others far.
    const Pixels<kSide> above = block.near_part ? one : none;
    const Pixels<kSide> not_above = one - above;
    for (int j = 0; j < kSide; ++j) {
        const std::ptrdiff_t at = j * block.stride;
        load<kSide>(here, block.here + at);
        load<kSide>(near, block.near + at);
        load<kSide>(moved_here, block.moved_here + at);
        load<kSide>(moved_near, block.moved_near + at);
        const Pixels<kSide> own = here > block.threshold ? above : not_above;
        const Pixels<kSide> lost = moved_near < here - kCovered ? own : none;
        const Pixels<kSide> w = moved_here > near + kCovered ? none : own - lost;
        load<kSide>(grey, block.grey + at);
        load_between<kSide>(moved, block.moved_grey + at, block.stride, block.grey_weights);
        const Pixels<kSide> r = moved - grey;
        lanes.n += w;
        if (!block.colour) continue;
        lanes.r += w * r;
        lanes.rr += w * (r * r) + lost * kLost2;
        if (!kSlopes) continue;
        const float* const row = block.grey + at;
        load_slopes<kSide>(x, y, row, row + (j == 0 ? block.above : -block.stride),
                           row + (j + 1 == kSide ? block.below : block.stride));
        lanes.x += w * x;
        lanes.y += w * y;
        add_products<kSide>(w, r, x, y, lanes);
    }
    if (block.outline) add_outline<kSide, kSlopes>(block, lanes);
    put<kSide, kSlopes>(lanes, sums);
}

/// Sums pixel by pixel, at the picture's border and in small pictures.
[[gnu::always_inline]] inline void sum_pixels(const Block& block, float* sums) {
    const auto sum = [sums](MotionSum which) -> float& {
        return sums[static_cast<std::size_t>(which)];
    };
    const auto slope = [&block](const float* at, int i, int j, bool down) {
        if (down)
            return 0.5F * (at[j + 1 == block.rows ? block.below : block.stride] -
                           at[j == 0 ? block.above : -block.stride]);
        return 0.5F * (at[i + 1 == block.columns ? 1 - block.at_right : 1] -
                       at[i == 0 ? block.at_left - 1 : -1]);
    };
    const auto moved = [&block](const float* at, const Between& k) {
        return (k.a * at[0] + k.b * at[1]) + (k.c * at[block.stride] + k.d * at[block.stride + 1]);
    };
    const auto contrast = [&block](float value) {
        return std::min(std::max(value - block.threshold, -kOutline), kOutline);
    };
    const auto add = [&](float w, float r, float x, float y) {
        sum(MotionSum::xx) += w * x * x;
        sum(MotionSum::xy) += w * x * y;
        sum(MotionSum::yy) += w * y * y;
        sum(MotionSum::xr) += w * x * r;
        sum(MotionSum::yr) += w * y * r;
    };
    for (int j = 0; j < block.rows; ++j)
        for (int i = 0; i < block.columns; ++i) {
            const std::ptrdiff_t at = j * block.stride + i;
            const bool own = (block.here[at] > block.threshold) == block.near_part;
            const bool lost = own && block.moved_near[at] < block.here[at] - kCovered;
            const bool covered = block.moved_here[at] > block.near[at] + kCovered;
            if (lost) sum(MotionSum::rr) += kLost2;
            if (own && !lost && !covered) {
                const float r = moved(block.moved_grey + at, block.grey_weights) - block.grey[at];
                sum(MotionSum::n) += 1.0F;
                if (block.colour) {
                    sum(MotionSum::r) += r;
                    sum(MotionSum::rr) += r * r;
                }
                if (block.colour && block.slopes) {
                    const float x = slope(block.grey + at, i, j, false);
                    const float y = slope(block.grey + at, i, j, true);
                    sum(MotionSum::x) += x;
                    sum(MotionSum::y) += y;
                    add(1.0F, r, x, y);
                }
            }
            if (!block.outline || !(block.near[at] > block.threshold)) continue;
            const float before = contrast(block.level[at]);
            const float r = contrast(moved(block.moved_level + at, block.weights)) - before;
            sum(MotionSum::rr) += r * r;
            if (block.slopes && before > -kOutline && before < kOutline)
                add(1.0F, r, slope(block.level + at, i, j, false),
                    slope(block.level + at, i, j, true));
        }
}

template <int kSide>
[[gnu::always_inline]] inline void sum_whole(const Block& block, float* sums) {
    if (block.slopes)
        sum_whole<kSide, true>(block, sums);
    else
        sum_whole<kSide, false>(block, sums);
}

DIBHR_VECTOR_CLONES void sum_plain_block(const Block& block, int side, float* sums) {
    if (side == kMotionCell_px && block.slopes)
        sum_plain<kMotionCell_px, true>(block, sums);
    else if (side == kMotionCell_px)
        sum_plain<kMotionCell_px, false>(block, sums);
    else if (block.slopes)
        sum_plain<kMotionCell_px / 2, true>(block, sums);
    else
        sum_plain<kMotionCell_px / 2, false>(block, sums);
}

/// `sums` must be 0 before.
DIBHR_VECTOR_CLONES void sum_block(const Block& block, float* sums) {
    const bool whole = block.at_left + block.at_right == 0 && block.rows == block.columns;
    if (whole && block.columns == kMotionCell_px)
        sum_whole<kMotionCell_px>(block, sums);
    else if (whole && block.columns == kMotionCell_px / 2)
        sum_whole<kMotionCell_px / 2>(block, sums);
    else
        sum_pixels(block, sums);
}

/// A row of a picture, with those above and below.
struct ThreeRows {
    const float *above, *here, *below;
};

/// Adds slopes and their products in each column.
DIBHR_VECTOR_CLONES void add_structure(const ThreeRows& grey, const ThreeRows& level, int count,
                                       float* __restrict n, float* __restrict x,
                                       float* __restrict y, float* __restrict xx,
                                       float* __restrict xy, float* __restrict yy) {
    const float* const grey_here = grey.here;
    const float* const grey_above = grey.above;
    const float* const grey_below = grey.below;
    const float* const level_here = level.here;
    const float* const level_above = level.above;
    const float* const level_below = level.below;
    for (int i = 1; i + 1 < count; ++i) {
        const float right = std::fabs(level_here[i + 1] - level_here[i - 1]);
        const float down = std::fabs(level_below[i] - level_above[i]);
        const float w = std::max(right, down) < kCliff ? 1.0F : 0.0F;
        const float slope_x = 0.5F * w * (grey_here[i + 1] - grey_here[i - 1]);
        const float slope_y = 0.5F * w * (grey_below[i] - grey_above[i]);
        n[i] += w;
        x[i] += slope_x;
        y[i] += slope_y;
        xx[i] += slope_x * slope_x;
        xy[i] += slope_x * slope_y;
        yy[i] += slope_y * slope_y;
    }
}

struct Span {
    int begin, end;
};

/// The pixels of [begin, end) that, moved by `way`, and the one after them, are within `count`.
Span inside(int begin, int end, int way, int count) {
    return {std::max(begin, -way), std::min(end, count - 1 - way)};
}

/// Computes the sums part by part.
class Summing {
  public:
    Summing(const MotionSides& sides, std::size_t size, bool slopes)
        : from_(sides.from),
          to_(sides.to),
          gain_(sides.gain),
          size_(size),
          halvings_(kMotionSizes - 1 - static_cast<int>(size)),
          side_(1 << halvings_),
          slopes_(slopes) {}

    void sum(const MotionPart& part, float right, float down, bool colour, float* sums) const;

  private:
    /// The moved pixels of a part [px of the picture].
    struct Moved {
        Span x{}, y{};
        int right, down;  ///< whole pixels
    };
    [[nodiscard]] bool is_plain(const MotionPart& part, const Moved& moved) const;
    void sum_plain(const Moved& to, const Between& weights, float* sums) const;
    void sum_any(const MotionPart& part, const Moved& to, const Between& weights,
                 std::ptrdiff_t nearest, bool colour, float* sums) const;

    const MotionSide& from_;
    const MotionSide& to_;
    float gain_;
    std::size_t size_;
    int halvings_;  ///< of a cell
    int side_;      ///< of a cell [px]
    bool slopes_;
};

/// Whether the part is a whole cell of one surface, about as deep as all at its destination.
bool Summing::is_plain(const MotionPart& part, const Moved& moved) const {
    const MotionPlane& grey = from_.pictures.grey[size_];
    if (halvings_ < 2 || part.part != 0 || moved.x.end - moved.x.begin < side_ ||
        moved.y.end - moved.y.begin < side_ || moved.x.begin == 0 || moved.y.begin == 0 ||
        moved.x.end == grey.columns || moved.y.end == grey.rows)
        return false;
    const std::size_t here = from_.cells.threshold.index(part.i, part.j);
    const std::size_t there = from_.cells.threshold.index(
        (moved.x.begin + moved.right) >> halvings_, (moved.y.begin + moved.down) >> halvings_);
    return std::max(from_.highest.values[here], to_.highest_of_four.values[there]) -
               std::min(from_.lowest.values[here], to_.lowest_of_four.values[there]) <
           kCovered;
}

void Summing::sum_plain(const Moved& to, const Between& weights, float* sums) const {
    const MotionPlane& grey = from_.pictures.grey[size_];
    Block block;
    block.grey = grey.values.data() + grey.index(to.x.begin, to.y.begin);
    block.moved_grey = to_.pictures.grey[size_].values.data() +
                       grey.index(to.x.begin + to.right, to.y.begin + to.down);
    block.stride = grey.columns;
    block.grey_weights = gained(weights, gain_);
    block.slopes = slopes_;
    sum_plain_block(block, side_, sums);
}

void Summing::sum_any(const MotionPart& part, const Moved& to, const Between& weights,
                      std::ptrdiff_t nearest, bool colour, float* sums) const {
    const MotionPictures& pictures = from_.pictures;
    const MotionPictures& others = to_.pictures;
    const MotionPlane& grey = pictures.grey[size_];
    const std::size_t first = grey.index(to.x.begin, to.y.begin);
    const std::size_t moved = grey.index(to.x.begin + to.right, to.y.begin + to.down);
    Block block;
    block.grey = grey.values.data() + first;
    block.moved_grey = others.grey[size_].values.data() + moved;
    block.level = pictures.level[size_].values.data() + first;
    block.moved_level = others.level[size_].values.data() + moved;
    block.here = pictures.here[size_].values.data() + first;
    block.moved_here = others.here[size_].values.data() + moved + nearest;
    block.near = pictures.near[size_].values.data() + first;
    block.moved_near = others.near[size_].values.data() + moved + nearest;
    block.stride = grey.columns;
    block.above = to.y.begin > 0 ? -block.stride : 0;
    block.below = to.y.end < grey.rows ? block.stride : 0;
    block.columns = to.x.end - to.x.begin;
    block.rows = to.y.end - to.y.begin;
    block.at_left = to.x.begin == 0 ? 1 : 0;
    block.at_right = to.x.end == grey.columns ? 1 : 0;
    block.weights = weights;
    block.grey_weights = gained(weights, gain_);
    block.threshold = from_.cells.threshold.row(part.j)[part.i];
    block.near_part = part.part == 0;
    block.slopes = slopes_;
    block.outline = block.near_part && from_.cells.has(1, part.i, part.j);
    block.colour = colour || !block.outline;
    sum_block(block, sums);
}

/// `right`, `down`: the way in pixels of the picture.
void Summing::sum(const MotionPart& part, float right, float down, bool colour, float* sums) const {
    const MotionPlane& grey = from_.pictures.grey[size_];
    Moved to{};
    to.right = static_cast<int>(std::floor(right));
    to.down = static_cast<int>(std::floor(down));
    to.x = inside(part.i * side_, (part.i + 1) * side_, to.right, grey.columns);
    to.y = inside(part.j * side_, (part.j + 1) * side_, to.down, grey.rows);
    const float u = right - static_cast<float>(to.right);
    const float v = down - static_cast<float>(to.down);
    if (is_plain(part, to)) return sum_plain(to, between(u, v), sums);
    std::fill_n(sums, kMotionSums, 0.0F);
    if (to.x.begin >= to.x.end || to.y.begin >= to.y.end) return;
    const std::ptrdiff_t nearest = (v < 0.5F ? 0 : grey.columns) + (u < 0.5F ? 0 : 1);
    sum_any(part, to, between(u, v), nearest, colour, sums);
}

}  // namespace

void sum_differences(const MotionSides& sides, std::size_t size, const MotionLayers& wanted,
                     const MotionLayers& plain, const MotionWays& ways, MotionMeasure measure,
                     MotionSums& sums) {
    const auto count = static_cast<std::size_t>(measure);
    const Summing summing(sides, size, measure == MotionMeasure::slopes);
    const float scale = 1.0F / static_cast<float>(1 << size);
    const MotionCells& cells = sides.from.cells;
    std::array<float, kMotionSums> of_part{};
    const auto sum = [&](std::size_t layer, std::size_t at) {
        if (!(wanted.of[layer].values[at] > 0.0F)) return;
        summing.sum(cells.part_at(layer, at), scale * ways.right.of[layer].values[at],
                    scale * ways.down.of[layer].values[at], !(plain.of[layer].values[at] > 0.0F),
                    of_part.data());
        for (std::size_t k = 0; k < count; ++k) sums.of[k].of[layer].values[at] = of_part[k];
    };
    for (std::size_t at = 0; at < wanted.of[0].values.size(); ++at) sum(0, at);
    for (const std::uint32_t at : cells.split) sum(1, at);
}

void sum_structure(const MotionSide& side, std::size_t size, MotionSums& sums) {
    const MotionPlane& grey = side.pictures.grey[size];
    const MotionPlane& level = side.pictures.level[size];
    const int cell = kMotionCell_px >> size;
    constexpr std::array kKinds{MotionSum::n,  MotionSum::x,  MotionSum::y,
                                MotionSum::xx, MotionSum::xy, MotionSum::yy};
    std::array<std::vector<float>, kKinds.size()> columns;
    sums.fill(0.0F);
    for (int j = 0; j < side.cells.rows; ++j) {
        for (auto& each : columns) each.assign(static_cast<std::size_t>(grey.columns), 0.0F);
        for (int y = std::max(j * cell, 1); y < std::min((j + 1) * cell, grey.rows - 1); ++y)
            add_structure({grey.row(y - 1), grey.row(y), grey.row(y + 1)},
                          {level.row(y - 1), level.row(y), level.row(y + 1)}, grey.columns,
                          columns[0].data(), columns[1].data(), columns[2].data(),
                          columns[3].data(), columns[4].data(), columns[5].data());
        for (std::size_t kind = 0; kind < kKinds.size(); ++kind) {
            const float* of_cell = columns[kind].data();
            float* const to = sums[kKinds[kind]].of[0].row(j);
            for (int i = 0; i < side.cells.columns; ++i, of_cell += cell)
                to[i] = std::accumulate(of_cell, of_cell + cell, 0.0F);
        }
    }
    for (const std::uint32_t k : side.cells.split)
        for (MotionLayers& layers : sums.of) layers.of[0].values[k] = 0.0F;
}

}  // namespace dibhr
