// Smooths by second differences at growing and then falling distances.
#include "core/video/cleaning/step_smoothing.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "core/video/frames/vector_clones.hpp"

namespace dibhr {

namespace {

/// Levels of 8 bits are counted in 128ths of a step, so that the difference of any two fits into 16
/// bits: 16 to 32 are computed at a time. More steps are counted in fewer parts.
constexpr int kFinest = 128;
constexpr float kSubdivision = kFinest;
constexpr float kMostParts = 32640.0F;

/// One pass of smoothing between pixels `px` apart; a larger difference than `edge` is an edge or a
/// curve, not a terrace. Chosen on planes, on a waved surface and on real 8-bit recordings.
struct Reach {
    int px;
    int edge;  ///< [step / 128]
};
constexpr std::array<Reach, 9> kReaches{
    {{1, 512}, {2, 512}, {4, 320}, {8, 192}, {16, 192}, {8, 192}, {4, 320}, {2, 512}, {1, 512}}};

constexpr std::size_t kFarthest = 16;    ///< pixels
constexpr int kHalfOfNumbers = 1 << 15;  ///< of 16 bits
/// Measured steps: a larger difference is an edge. A ledge of two steps is the thing's.
constexpr int kEdgeOfMeasured = 192;  ///< [step / 128]
/// A measured step below this part of the highest level is not felt (0.1 px of 255).
constexpr float kLeastStep = 0.1F / 255.0F;
/// With more noise than this part of a step, means over time lie between steps, and show more than
/// slopes would keep.
constexpr float kMostNoise = 0.1F;
/// How many rows the last pass is behind the first.
constexpr int kDelay = [] {
    int rows = -kReaches.front().px;
    for (const Reach& reach : kReaches) rows += reach.px;
    return rows;
}();

/// Second difference of a pixel and its two neighbours; 0 where one of them is across an edge.
/// `base`: the pixel less the edge and half of all numbers, so that the differences from it to
/// [-edge, edge] are the lowest numbers with a sign, up to `most`. All is counted modulo 2^16.
std::int16_t second_difference(std::uint16_t before, std::uint16_t base, std::uint16_t after,
                               std::int16_t most, std::uint16_t twice_edge) {
    const auto back = static_cast<std::int16_t>(before - base);
    const auto on = static_cast<std::int16_t>(after - base);
    const auto sum = static_cast<std::int16_t>(back + on - twice_edge);
    return std::max(back, on) > most ? std::int16_t{0} : sum;
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
/// row at each pixel, the edge or 0. Pixels stay within `half` a step of `given`, and the back wall
/// stays. No pixel leaves the range of its neighbours, so the range of levels needs no check.
DIBHR_VECTOR_CLONES void smooth_row(const std::uint16_t* up, const std::uint16_t* row,
                                    const std::uint16_t* down, const std::uint16_t* given,
                                    const std::uint16_t* limits, Reach reach, std::int16_t half,
                                    std::uint16_t* __restrict out, std::size_t columns) {
    const auto below = static_cast<std::uint16_t>(reach.edge + kHalfOfNumbers);
    const auto twice = static_cast<std::uint16_t>(2 * reach.edge);
    const auto most = static_cast<std::int16_t>(2 * reach.edge - kHalfOfNumbers);
    const std::uint16_t* const before = row - reach.px;
    const std::uint16_t* const after = row + reach.px;
    for (std::size_t begin = 0; begin < columns; begin += kTogether) {
        for (std::size_t i = begin; i < begin + kTogether; ++i) {
            const auto base = static_cast<std::uint16_t>(row[i] - below);
            const auto along = second_difference(before[i], base, after[i], most, twice);
            const auto difference =
                static_cast<std::int16_t>(second_difference(up[i], base, down[i], most, twice) +
                                          (limits[i] == 0 ? std::int16_t{0} : along));
            const auto here = static_cast<std::int16_t>(given[i]);
            const auto least = static_cast<std::int16_t>(std::max(here, half) - half);
            const auto highest = static_cast<std::int16_t>(here + (here > 0 ? half : 0));
            const auto smoothed = static_cast<std::int16_t>(row[i] + smoothing(difference));
            out[i] = static_cast<std::uint16_t>(std::min(std::max(smoothed, least), highest));
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

/// Counts steps from the lowest level on. Steps vary slowly from level to level: between the nodes
/// of the table the count is a straight line.
class StepTable {
  public:
    StepTable(const DepthNoise& noise, double highest_level)
        : highest_(static_cast<float>(highest_level)) {
        double count = 0.0;
        for (std::size_t k = 0; k <= kNodes; ++k) {
            const float height = static_cast<float>(k) / kNodes;
            const float step = noise.step.at(height);
            const bool is_felt = step >= kLeastStep && noise.at(height) < kMostNoise * step;
            counts_[k] = static_cast<float>(count);
            widths_[k] = is_felt ? step * highest_ : 0.0F;
            has_steps_ = has_steps_ || is_felt;
            const float middle = noise.step.at(height + 0.5F / kNodes);
            count += 1.0 / kNodes / static_cast<double>(std::max(middle, kLeastStep));
        }
        parts_ = std::min(kFinest, static_cast<int>(kMostParts / counts_[kNodes]));
    }

    [[nodiscard]] bool has_steps() const { return has_steps_; }
    [[nodiscard]] int parts() const { return parts_; }  ///< of a step, that are counted

    void count_levels(const float* levels, std::uint16_t* counted, std::size_t count) const {
        const auto parts = static_cast<float>(parts_);
        for (std::size_t i = 0; i < count; ++i) {
            const float at = place_of(levels[i]);
            const std::size_t k = node_of(at);
            const float steps =
                counts_[k] + (at - static_cast<float>(k)) * (counts_[k + 1] - counts_[k]);
            counted[i] = static_cast<std::uint16_t>(steps * parts + 0.5F);
        }
    }

    /// Moves levels as far as their counts were smoothed, at most half a step.
    void take_levels(const std::uint16_t* given, const std::uint16_t* smoothed, float* levels,
                     std::size_t count) const {
        const float of_part = 1.0F / static_cast<float>(parts_);
        for (std::size_t i = 0; i < count; ++i) {
            if (given[i] == smoothed[i]) continue;
            const float steps =
                of_part * static_cast<float>(static_cast<int>(smoothed[i]) - int{given[i]});
            const float moved = levels[i] + std::clamp(steps, -0.5F, 0.5F) *
                                                widths_[node_of(place_of(levels[i]) + 0.5F)];
            levels[i] = std::clamp(moved, 0.0F, highest_);
        }
    }

  private:
    static constexpr std::size_t kNodes = 1024;

    [[nodiscard]] float place_of(float level) const {
        return std::clamp(level / highest_, 0.0F, 1.0F) * static_cast<float>(kNodes);
    }
    [[nodiscard]] static std::size_t node_of(float place) {
        return std::min(static_cast<std::size_t>(place), kNodes - 1);
    }

    float highest_;
    std::array<float, kNodes + 1> counts_{};  ///< of steps below each node
    std::array<float, kNodes + 1> widths_{};  ///< of a step [levels]; 0: none is smoothed
    bool has_steps_{false};
    int parts_{kFinest};
};

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
void StepSmoother::set_size(std::size_t columns, int parts, int most_edge) {
    if (columns == columns_ && parts == parts_ && most_edge == most_edge_) return;
    columns_ = 0;  // until all memory is there
    given_.set_size(columns, kDelay + 2 * kReaches.front().px + 1);
    limits_.set_size(columns, static_cast<int>(kReaches.size()));
    passes_.resize(kReaches.size());
    edges_.resize(kReaches.size());
    for (std::size_t n = 0; n < kReaches.size(); ++n) {
        const Reach reach = kReaches[n];
        edges_[n] = std::min(reach.edge, most_edge) * parts / kFinest;
        passes_[n].set_size(columns, n + 1 < kReaches.size() ? 2 * kReaches[n + 1].px + 1 : 1);
        // At the sides nothing is smoothed along the row.
        const auto px = static_cast<std::size_t>(reach.px);
        std::uint16_t* const limits = limits_.row(static_cast<int>(n));
        std::fill_n(limits, columns, std::uint16_t{0});
        if (columns > 2 * px)
            std::fill(limits + px, limits + columns - px, static_cast<std::uint16_t>(edges_[n]));
    }
    columns_ = columns;
    parts_ = parts;
    most_edge_ = most_edge;
}

/// All passes run row by row together, each one behind the one before by its reach, so that the few
/// rows between them stay in the cache. count(levels, counted) and take(given, smoothed, levels)
/// are of a row.
template <typename Count, typename Take>
void StepSmoother::smooth_rows(DepthImage& image, const Count& count, const Take& take) {
    const auto levels = [&](int row) { return image.levels.data() + image.index(0, row); };
    const auto half = static_cast<std::int16_t>(parts_ / 2);
    int counted = 0;
    for (int tick = 0; tick < image.rows + kDelay; ++tick) {
        int j = tick + kReaches.front().px;
        for (; counted <= std::min(j, image.rows - 1); ++counted)
            count(levels(counted), given_.row(counted));
        for (std::size_t n = 0; n < kReaches.size(); ++n) {
            const Reach reach{kReaches[n].px, edges_[n]};
            j -= reach.px;
            if (j < 0 || j >= image.rows) continue;
            const int px = j >= reach.px && j + reach.px < image.rows ? reach.px : 0;
            Rows& before = n == 0 ? given_ : passes_[n - 1];
            smooth_row(before.row(j - px), before.row(j), before.row(j + px), given_.row(j),
                       limits_.row(static_cast<int>(n)), reach, half, passes_[n].row(j), columns_);
        }
        if (j >= 0) take(given_.row(j), passes_.back().row(j), levels(j));
    }
}

void StepSmoother::smooth(DepthImage& image) {
    const auto columns = static_cast<std::size_t>(image.columns);
    const auto highest = static_cast<float>(image.highest_level);
    set_size(columns, kFinest, kReaches.front().edge);
    smooth_rows(
        image,
        [&](const float* levels, std::uint16_t* counted) {
            count_levels(levels, counted, columns, highest);
        },
        [&](const std::uint16_t*, const std::uint16_t* smoothed, float* levels) {
            take_levels(smoothed, levels, columns, highest);
        });
}

void StepSmoother::smooth_measured(DepthImage& image, const DepthNoise& noise) {
    const StepTable table(noise, image.highest_level);
    if (!table.has_steps()) return;
    const auto columns = static_cast<std::size_t>(image.columns);
    set_size(columns, table.parts(), kEdgeOfMeasured);
    smooth_rows(
        image,
        [&](const float* levels, std::uint16_t* counted) {
            table.count_levels(levels, counted, columns);
        },
        [&](const std::uint16_t* given, const std::uint16_t* smoothed, float* levels) {
            table.take_levels(given, smoothed, levels, columns);
        });
}

}  // namespace dibhr
