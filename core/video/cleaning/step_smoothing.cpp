// Smooths by second differences at growing and then falling distances.
#include "core/video/cleaning/step_smoothing.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "core/video/frames/vector_clones.hpp"

namespace dibhr {

namespace {

/// Levels are counted in 128ths, so that the difference of any two fits into 16 bits: 16 to 32 are
/// computed at a time.
constexpr float kSubdivision = 128.0F;
constexpr std::uint16_t kHalf = 64;

/// One pass of smoothing between pixels `px` apart; a larger difference than `edge` is an edge or a
/// curve, not a terrace. Chosen on planes, on a waved surface and on real 8-bit recordings.
struct Reach {
    int px;
    int edge;  ///< [level / 128]
};
constexpr std::array<Reach, 9> kReaches{
    {{1, 512}, {2, 512}, {4, 320}, {8, 192}, {16, 192}, {8, 192}, {4, 320}, {2, 512}, {1, 512}}};

constexpr std::size_t kFarthest = 16;  ///< pixels
/// How many rows the last pass is behind the first.
constexpr int kDelay = [] {
    int rows = -kReaches.front().px;
    for (const Reach& reach : kReaches) rows += reach.px;
    return rows;
}();

/// Second difference of a pixel and its two neighbours; 0 across an edge.
std::int16_t second_difference(std::uint16_t before, std::uint16_t centre, std::uint16_t after,
                               std::uint16_t edge) {
    const auto back = static_cast<std::int16_t>(before - centre);
    const auto on = static_cast<std::int16_t>(after - centre);
    // As unsigned numbers, [-edge, edge] becomes [0, 2 edge], and all else is above.
    const auto back_above = static_cast<std::uint16_t>(back + edge);
    const auto on_above = static_cast<std::uint16_t>(on + edge);
    const auto sum = static_cast<std::int16_t>(back + on);
    return std::max(back_above, on_above) <= static_cast<std::uint16_t>(2 * edge) ? sum
                                                                                  : std::int16_t{0};
}

/// 13/64 of the difference, rounded: stable below 1/4. Computed so that all fits into 16 bits.
std::int16_t smoothing(std::int16_t difference) {
    const auto thrice = static_cast<std::int16_t>(difference * 3);
    const auto quarter = static_cast<std::int16_t>(difference >> 2);
    const auto sixteen_changes = static_cast<std::int16_t>(thrice + quarter);
    return static_cast<std::int16_t>(static_cast<std::int16_t>(sixteen_changes + 8) >> 4);
}

/// Pixels that are smoothed together, so that all vectors of a row are whole.
constexpr std::size_t kTogether = 32;

/// Smooths one row. `up`, `down`: the rows at the reach; `limits`: the largest difference along the
/// row at each pixel. Pixels stay within half a level of `given`, and the back wall stays. No pixel
/// leaves the range of its neighbours, so the range of levels needs no check.
DIBHR_VECTOR_CLONES void smooth_row(const std::uint16_t* up, const std::uint16_t* row,
                                    const std::uint16_t* down, const std::uint16_t* given,
                                    const std::uint16_t* limits, Reach reach,
                                    std::uint16_t* __restrict out, std::size_t columns) {
    const auto edge = static_cast<std::uint16_t>(reach.edge);
    const std::uint16_t* const before = row - reach.px;
    const std::uint16_t* const after = row + reach.px;
    for (std::size_t begin = 0; begin < columns; begin += kTogether) {
        for (std::size_t i = begin; i < begin + kTogether; ++i) {
            const auto difference = static_cast<std::int16_t>(
                second_difference(up[i], row[i], down[i], edge) +
                second_difference(before[i], row[i], after[i], limits[i]));
            const std::uint16_t here = given[i];
            const auto most = static_cast<std::int16_t>(here > 0 ? kHalf : 0);
            const auto least = static_cast<std::int16_t>(-std::min(here, kHalf));
            const auto change = static_cast<std::int16_t>(row[i] + smoothing(difference) - here);
            out[i] = static_cast<std::uint16_t>(here + std::min(std::max(change, least), most));
        }
    }
}

/// Levels to 128ths. Real numbers may be outside the range of levels.
DIBHR_VECTOR_CLONES void count_levels(const float* levels, std::uint16_t* __restrict counted,
                                      std::size_t count, float highest_level) {
    const float highest = highest_level;
    for (std::size_t i = 0; i < count; ++i) {
        const float level = std::min(std::max(levels[i], 0.0F), highest);
        const int halves = static_cast<int>(level * (2.0F * kSubdivision));
        counted[i] = static_cast<std::uint16_t>((halves + 1) >> 1);
    }
}

/// From 128ths back to levels, within half a level of the old ones: those, and the highest level,
/// may lie between two 128ths.
DIBHR_VECTOR_CLONES void take_levels(const std::uint16_t* counted, float* __restrict levels,
                                     std::size_t count, float highest_level) {
    const float highest = highest_level;
    for (std::size_t i = 0; i < count; ++i) {
        const float level = static_cast<float>(counted[i]) / kSubdivision;
        const float bounded = std::min(std::max(level, levels[i] - 0.5F), levels[i] + 0.5F);
        levels[i] = std::min(std::max(bounded, 0.0F), highest);
    }
}

}  // namespace

void StepSmoother::Rows::set_size(std::size_t columns, int rows) {
    const std::size_t whole = (columns + kTogether - 1) / kTogether * kTogether;
    stride = whole + 2 * kFarthest;
    count = rows;
    levels.resize(stride * static_cast<std::size_t>(rows));
}

std::uint16_t* StepSmoother::Rows::row(int number) {
    return levels.data() + static_cast<std::size_t>(number % count) * stride + kFarthest;
}

/// Rows are kept as long as they are read: given rows until the last pass, rows of a pass within
/// the reach of the next one.
void StepSmoother::set_size(std::size_t columns) {
    columns_ = 0;  // until all memory is there
    given_.set_size(columns, kDelay + 2 * kReaches.front().px + 1);
    limits_.set_size(columns, static_cast<int>(kReaches.size()));
    passes_.resize(kReaches.size());
    for (std::size_t n = 0; n < kReaches.size(); ++n) {
        const Reach reach = kReaches[n];
        passes_[n].set_size(columns, n + 1 < kReaches.size() ? 2 * kReaches[n + 1].px + 1 : 1);
        // At the sides nothing is smoothed along the row.
        const auto px = static_cast<std::size_t>(reach.px);
        std::uint16_t* const limits = limits_.row(static_cast<int>(n));
        std::fill_n(limits, columns, std::uint16_t{0});
        if (columns > 2 * px)
            std::fill(limits + px, limits + columns - px, static_cast<std::uint16_t>(reach.edge));
    }
    columns_ = columns;
}

/// All passes run row by row together, each one behind the one before by its reach, so that the few
/// rows between them stay in the cache.
void StepSmoother::smooth(DepthImage& image) {
    const auto columns = static_cast<std::size_t>(image.columns);
    const auto highest = static_cast<float>(image.highest_level);
    const auto levels = [&](int row) { return image.levels.data() + image.index(0, row); };
    if (columns != columns_) set_size(columns);
    int counted = 0;
    for (int tick = 0; tick < image.rows + kDelay; ++tick) {
        int j = tick + kReaches.front().px;
        for (; counted <= std::min(j, image.rows - 1); ++counted)
            count_levels(levels(counted), given_.row(counted), columns, highest);
        for (std::size_t n = 0; n < kReaches.size(); ++n) {
            const Reach reach = kReaches[n];
            j -= reach.px;
            if (j < 0 || j >= image.rows) continue;
            const int px = j >= reach.px && j + reach.px < image.rows ? reach.px : 0;
            Rows& before = n == 0 ? given_ : passes_[n - 1];
            smooth_row(before.row(j - px), before.row(j), before.row(j + px), given_.row(j),
                       limits_.row(static_cast<int>(n)), reach, passes_[n].row(j), columns);
        }
        if (j >= 0) take_levels(passes_.back().row(j), levels(j), columns, highest);
    }
}

}  // namespace dibhr
