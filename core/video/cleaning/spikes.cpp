// Finds pixels beyond all their neighbours, and islands of data in holes.
#include "core/video/cleaning/spikes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "core/video/frames/vector_clones.hpp"

namespace dibhr {

namespace {

// 8 levels of 255 stand out from a curved surface in 8 bits. A pit of 5 levels catches a point;
// smoothing may deepen a pit by one, so the limit is 4. 16 bits are mostly millimetres: 100 are far
// beyond a sensor's noise (up to 65 at 4 m).
constexpr double kSpike_share = 8.0 / 255.0;
constexpr double kPit_share = 4.0 / 255.0;
constexpr double kSpike_levels = 100.0;
/// Where levels are finer than that, noise is beyond all neighbours by so many deviations.
constexpr double kSpikeNoises = 3.0;
constexpr std::uint8_t kSpikeRounds = 16;  ///< a removed spike may leave another beside it
constexpr int kIslandsInWidth = 80;        ///< a smaller island than the width over this is removed
constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Sorts with a fixed order of comparisons (Batcher's odd-even mergesort).
void sort_eight(std::array<float, 8>& values) {
    // Two digits for each pair: the compiler knows all places.
    static constexpr std::array<std::size_t, 19> kPairs{1, 23, 45, 67, 2,  13, 46, 57, 12, 56,
                                                        4, 15, 26, 37, 24, 35, 12, 34, 56};
    for (const std::size_t pair : kPairs) {
        float& one = values[pair / 10];
        float& other = values[pair % 10];
        const float low = std::min(one, other);
        other = std::max(one, other);
        one = low;
    }
}

/// The levels of a pixel's neighbours that have data.
class Neighbours {
  public:
    Neighbours(const DepthImage& image, int i, int j) {
        if (i > 0 && j > 0 && i + 1 < image.columns && j + 1 < image.rows)
            add_all(image.levels.data() + image.index(i, j), image.columns);
        else
            add_inside(image, i, j);
    }

    /// Infinite without neighbours.
    [[nodiscard]] float lowest() const { return lowest_; }
    [[nodiscard]] float highest() const { return highest_; }
    /// NaN: there is none.
    [[nodiscard]] float median() {
        if (count_ == 0) return std::numeric_limits<float>::quiet_NaN();
        std::fill(levels_.begin() + static_cast<std::ptrdiff_t>(count_), levels_.end(), kInfinity);
        sort_eight(levels_);
        return levels_[count_ / 2];
    }

  private:
    void add(float level) {
        levels_[count_] = level;
        count_ += is_data(level) ? 1U : 0U;
        lowest_ = std::min(lowest_, level);  // NaN is ignored
        highest_ = std::max(highest_, level);
    }
    void add_all(const float* centre, std::ptrdiff_t columns) {
        for (const float* const row : {centre - columns, centre + columns})
            for (const std::ptrdiff_t k : {-1, 0, 1}) add(row[k]);
        add(centre[-1]);
        add(centre[1]);
    }
    void add_inside(const DepthImage& image, int i, int j) {
        for (int y = std::max(j - 1, 0); y <= std::min(j + 1, image.rows - 1); ++y)
            for (int x = std::max(i - 1, 0); x <= std::min(i + 1, image.columns - 1); ++x)
                if (x != i || y != j) add(image.at(x, y));
    }

    std::array<float, 8> levels_{};
    std::size_t count_{0};
    float lowest_{kInfinity}, highest_{-kInfinity};
};

/// As std::max and std::min, but a `level` of NaN is ignored.
float higher(float level, float most) {
    return level > most ? level : most;
}
float lower(float level, float least) {
    return level < least ? level : least;
}

/// The highest and lowest level of the rows above and below, by column.
DIBHR_VECTOR_CLONES void find_range(const float* up, const float* down, float* __restrict highest,
                                    float* __restrict lowest, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
        highest[i] = higher(up[i], higher(down[i], -kInfinity));
        lowest[i] = lower(up[i], lower(down[i], kInfinity));
    }
}

/// Marks the spikes among pixels [1, columns - 1) of a row. Returns whether there are any.
DIBHR_VECTOR_CLONES int mark_outlying(const float* row, const float* high, const float* low,
                                      float above, float below, std::uint8_t* __restrict outlying,
                                      std::size_t columns) {
    int found = 0;
    for (std::size_t i = 1; i + 1 < columns; ++i) {
        const float most = higher(
            row[i - 1], higher(row[i + 1], std::max(std::max(high[i - 1], high[i]), high[i + 1])));
        const float least = lower(
            row[i - 1], lower(row[i + 1], std::min(std::min(low[i - 1], low[i]), low[i + 1])));
        const int outlies = (row[i] > most + above ? 1 : 0) | (row[i] < least - below ? 1 : 0);
        outlying[i] = static_cast<std::uint8_t>(outlies);
        found |= outlies;
    }
    return found;
}

}  // namespace

/// Whole rows at a time; the pixels of the picture's border one by one.
void SpikeRemover::find_spikes(const DepthImage& image) {
    const int columns = image.columns;
    highest_.resize(static_cast<std::size_t>(columns));
    lowest_.resize(static_cast<std::size_t>(columns));
    outlying_.assign(static_cast<std::size_t>(columns), 0);
    for (int j = 1; j + 1 < image.rows; ++j) {
        const float* up = image.levels.data() + image.index(0, j - 1);
        const float* row = up + columns;
        const float* down = row + columns;
        find_range(up, down, highest_.data(), lowest_.data(), highest_.size());
        if (mark_outlying(row, highest_.data(), lowest_.data(), is_spike_.above, is_spike_.below,
                          outlying_.data(), outlying_.size()) == 0)
            continue;
        visit_marked(outlying_.data(), columns, [&](int begin, int end) {
            for (int i = begin; i < end; ++i)
                spikes_.push_back({i, j, Neighbours(image, i, j).median()});
        });
    }
    for (int i = 0; i < columns; ++i)
        for (const int j : {0, image.rows - 1}) check_for_spike(image, i, j);
    for (int j = 1; j + 1 < image.rows; ++j)
        for (const int i : {0, columns - 1}) check_for_spike(image, i, j);
}

void SpikeRemover::check_for_spike(const DepthImage& image, int i, int j) {
    Neighbours around(image, i, j);
    const float level = image.at(i, j);
    if (is_spike_(level, around.lowest(), around.highest()))
        spikes_.push_back({i, j, around.median()});
}

void SpikeRemover::remove(DepthImage& image, float noise) {
    forget();
    const double levels = std::max(kSpike_levels, kSpikeNoises * static_cast<double>(noise));
    is_spike_ = {static_cast<float>(std::min(kSpike_share * image.highest_level, levels)),
                 static_cast<float>(std::min(kPit_share * image.highest_level, levels))};
    remove_spikes(image);
    remove_islands(image);
}

void SpikeRemover::remove_spikes(DepthImage& image) {
    spikes_.clear();
    find_spikes(image);
    if (!spikes_.empty()) checked_in_round_.assign(image.levels.size(), 0);
    for (std::uint8_t round = 1; round <= kSpikeRounds && !spikes_.empty(); ++round) {
        for (const Spike& spike : spikes_) {
            image.at(spike.column, spike.row) = spike.level;
            if (std::isnan(spike.level)) rejected_.push_back(image.index(spike.column, spike.row));
        }
        removed_.swap(spikes_);
        spikes_.clear();
        for (const Spike& spike : removed_) check_neighbours(image, spike, round);
    }
}

/// Checks each neighbour once a round, except those so near to the spike's new level that they
/// cannot be spikes.
void SpikeRemover::check_neighbours(const DepthImage& image, const Spike& spike,
                                    std::uint8_t round) {
    for (int j = std::max(spike.row - 1, 0); j <= std::min(spike.row + 1, image.rows - 1); ++j) {
        for (int i = std::max(spike.column - 1, 0);
             i <= std::min(spike.column + 1, image.columns - 1); ++i) {
            const std::size_t at = image.index(i, j);
            const bool may_be_spike =
                std::isnan(spike.level) || is_spike_(image.levels[at], spike.level, spike.level);
            if (may_be_spike && std::exchange(checked_in_round_[at], round) != round)
                check_for_spike(image, i, j);
        }
    }
}

void SpikeRemover::remove_islands(DepthImage& image) {
    left_holes_ = has_holes(image);
    if (!left_holes_) return;
    const auto side = static_cast<std::size_t>(image.columns / kIslandsInWidth);
    patches_.find_data(image);
    for (const Patches::Run& run : patches_.runs()) {
        if (patches_.patch(run.patch).pixels >= side * side) continue;
        for (int i = run.begin; i < run.end; ++i) {
            image.at(i, run.row) = std::numeric_limits<float>::quiet_NaN();
            rejected_.push_back(image.index(i, run.row));
        }
    }
}

}  // namespace dibhr
