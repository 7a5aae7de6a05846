// Makes recorded depth pleasant and safe to touch: holes, spikes and 8-bit steps.
#include "core/video/depth/depth_cleaning.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

namespace dibhr {

namespace {

// 8 levels of 255 stand out of a curved surface seen in 8 bits. 5 below it are a pit in which a
// point is caught; smoothing may deepen one by a level, so 4 are one too many. 16 bits are mostly
// millimetres, of which 100 are far beyond a sensor's noise (up to 65 at 4 m).
constexpr double kSpike_share = 8.0 / 255.0;
constexpr double kPit_share = 4.0 / 255.0;
constexpr double kSpike_levels = 100.0;
constexpr std::uint8_t kSpikeRounds = 16;  ///< one that is gone may leave another beside it
constexpr int kIslandsInWidth = 80;        ///< squares side by side
constexpr float kSmoothing = 0.2F;  ///< of the second difference, per axis; stable below 0.25

/// One pass of smoothing between pixels `px` apart; a larger difference than `edge_levels` is an
/// edge or a curve, not a terrace. Chosen on planes, on a waved surface and on real 8-bit
/// recordings.
struct Reach {
    int px;
    float edge_levels;
};
constexpr std::array<Reach, 9> kReaches{{{1, 4.0F},
                                         {2, 4.0F},
                                         {4, 2.5F},
                                         {8, 1.5F},
                                         {16, 1.5F},
                                         {8, 1.5F},
                                         {4, 2.5F},
                                         {2, 4.0F},
                                         {1, 4.0F}}};

bool is_eight_bit(const DepthImage& image) {
    return image.highest_level < 256.0;
}

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// The levels of the pixels around one that have data.
class Neighbours {
  public:
    Neighbours(const DepthImage& image, int i, int j) {
        for (int y = std::max(j - 1, 0); y <= std::min(j + 1, image.rows - 1); ++y) {
            for (int x = std::max(i - 1, 0); x <= std::min(i + 1, image.columns - 1); ++x) {
                const float level = image.at(x, y);
                if ((x == i && y == j) || std::isnan(level)) continue;
                levels_[count_++] = level;
                lowest_ = std::min(lowest_, level);
                highest_ = std::max(highest_, level);
            }
        }
    }

    /// Infinite without neighbours.
    [[nodiscard]] float lowest() const { return lowest_; }
    [[nodiscard]] float highest() const { return highest_; }
    /// NaN: there is none.
    [[nodiscard]] float median() {
        if (count_ == 0) return std::numeric_limits<float>::quiet_NaN();
        auto* const median = levels_.data() + count_ / 2;
        std::nth_element(levels_.data(), median, levels_.data() + count_);
        return *median;
    }

  private:
    std::array<float, 8> levels_{};
    std::size_t count_{0};
    float lowest_{kInfinity}, highest_{-kInfinity};
};

/// How far beyond all its neighbours a pixel stands out of them.
struct Outstanding {
    explicit Outstanding(double highest_level)
        : above(static_cast<float>(std::min(kSpike_share * highest_level, kSpike_levels))),
          below(static_cast<float>(std::min(kPit_share * highest_level, kSpike_levels))) {}

    /// `least` and `most`: of the neighbours. Not of a `level` that is NaN.
    [[nodiscard]] bool operator()(float level, float least, float most) const {
        return level > most + above || level < least - below;
    }

    float above, below;
};

/// As std::max and std::min, of a `level` that may be NaN: then it is passed over.
float higher(float level, float most) {
    return level > most ? level : most;
}
float lower(float level, float least) {
    return level < least ? level : least;
}

/// Change that draws `centre` towards the straight line between its two neighbours; none across an
/// edge.
float towards_line(float before, float centre, float after, float edge_levels) {
    const float back = before - centre;
    const float on = after - centre;
    const float largest = std::max(std::fabs(back), std::fabs(on));
    const float change = kSmoothing * (back + on);
    return largest <= edge_levels ? change : 0.0F;
}

/// One row: away from the sides both axes are smoothed; `up` and `down` are the rows at the reach.
/// Pixels stay in [low, high].
void smooth_row(const float* up, const float* row, const float* down, const float* low,
                const float* high, float* __restrict out, int columns, Reach reach) {
    const int px = reach.px;
    const float edge = reach.edge_levels;
    const auto bounded = [&](int i, float level) {
        return std::min(std::max(level, low[i]), high[i]);
    };
    const auto vertical = [&](int i) {
        return row[i] + towards_line(up[i], row[i], down[i], edge);
    };
    const int inner_end = std::max(px, columns - px);
    for (int i = 0; i < std::min(px, columns); ++i) out[i] = bounded(i, vertical(i));
    for (int i = px; i < inner_end; ++i)
        out[i] = bounded(i, vertical(i) + towards_line(row[i - px], row[i], row[i + px], edge));
    for (int i = inner_end; i < columns; ++i) out[i] = bounded(i, vertical(i));
}

}  // namespace

/// All rows at once but for the picture's border.
void DepthCleaner::find_spikes(const DepthImage& image) {
    const Outstanding stands_out(image.highest_level);
    const int columns = image.columns;
    highest_.resize(static_cast<std::size_t>(columns));
    lowest_.resize(static_cast<std::size_t>(columns));
    outlying_.assign(static_cast<std::size_t>(columns), 0);
    for (int j = 1; j + 1 < image.rows; ++j) {
        const float* up = image.levels.data() + image.index(0, j - 1);
        const float* row = up + columns;
        const float* down = row + columns;
        for (int i = 0; i < columns; ++i) {
            highest_[static_cast<std::size_t>(i)] = higher(up[i], higher(down[i], -kInfinity));
            lowest_[static_cast<std::size_t>(i)] = lower(up[i], lower(down[i], kInfinity));
        }
        const float* high = highest_.data();
        const float* low = lowest_.data();
        int found = 0;
        for (int i = 1; i + 1 < columns; ++i) {
            const float most =
                higher(row[i - 1],
                       higher(row[i + 1], std::max(std::max(high[i - 1], high[i]), high[i + 1])));
            const float least = lower(
                row[i - 1], lower(row[i + 1], std::min(std::min(low[i - 1], low[i]), low[i + 1])));
            const int outlies =
                (row[i] > most + stands_out.above) | (row[i] < least - stands_out.below);
            outlying_[static_cast<std::size_t>(i)] = outlies;
            found |= outlies;
        }
        for (int i = 1; found != 0 && i + 1 < columns; ++i)
            if (outlying_[static_cast<std::size_t>(i)] != 0) look_for_spike(image, i, j);
    }
    for (int i = 0; i < columns; ++i)
        for (const int j : {0, image.rows - 1}) look_for_spike(image, i, j);
    for (int j = 1; j + 1 < image.rows; ++j)
        for (const int i : {0, columns - 1}) look_for_spike(image, i, j);
}

void DepthCleaner::look_for_spike(const DepthImage& image, int i, int j) {
    Neighbours around(image, i, j);
    const float level = image.at(i, j);
    if (Outstanding(image.highest_level)(level, around.lowest(), around.highest()))
        spikes_.push_back({i, j, around.median()});
}

void DepthCleaner::remove_spikes(DepthImage& image) {
    spikes_.clear();
    find_spikes(image);
    looked_at_.assign(image.levels.size(), 0);
    for (std::uint8_t round = 1; round <= kSpikeRounds && !spikes_.empty(); ++round) {
        for (const Spike& spike : spikes_) {
            image.at(spike.column, spike.row) = spike.level;
            if (std::isnan(spike.level)) refused_.push_back(image.index(spike.column, spike.row));
        }
        removed_.swap(spikes_);
        spikes_.clear();
        for (const Spike& spike : removed_) look_around(image, spike, round);
    }
}

/// At each pixel once a round.
void DepthCleaner::look_around(const DepthImage& image, const Spike& spike, std::uint8_t round) {
    for (int j = std::max(spike.row - 1, 0); j <= std::min(spike.row + 1, image.rows - 1); ++j) {
        for (int i = std::max(spike.column - 1, 0);
             i <= std::min(spike.column + 1, image.columns - 1); ++i) {
            if (std::exchange(looked_at_[image.index(i, j)], round) != round)
                look_for_spike(image, i, j);
        }
    }
}

void DepthCleaner::remove_islands(DepthImage& image) {
    if (std::all_of(image.levels.begin(), image.levels.end(), is_data)) return;
    const auto side = static_cast<std::size_t>(image.columns / kIslandsInWidth);
    patches_.find_data(image);
    for (const Patches::Run& run : patches_.runs()) {
        if (patches_.patch(run.patch).pixels >= side * side) continue;
        for (int i = run.begin; i < run.end; ++i) {
            image.at(i, run.row) = std::numeric_limits<float>::quiet_NaN();
            refused_.push_back(image.index(i, run.row));
        }
    }
}

void DepthCleaner::smooth_steps(DepthImage& image) {
    const std::size_t pixels = image.levels.size();
    const auto highest = static_cast<float>(image.highest_level);
    low_.resize(pixels);
    high_.resize(pixels);
    other_.resize(pixels);
    for (std::size_t k = 0; k < pixels; ++k) {
        const float level = image.levels[k];
        low_[k] = std::max(level - 0.5F, 0.0F);
        high_[k] = level > 0.0F ? std::min(level + 0.5F, highest) : 0.0F;  // the back wall stands
    }
    for (const Reach reach : kReaches) {
        for (int j = 0; j < image.rows; ++j) {
            const bool inner = j >= reach.px && j + reach.px < image.rows;
            const std::size_t at = image.index(0, j);
            const float* row = image.levels.data() + at;
            const std::ptrdiff_t stride = static_cast<std::ptrdiff_t>(reach.px) * image.columns;
            smooth_row(inner ? row - stride : row, row, inner ? row + stride : row,
                       low_.data() + at, high_.data() + at, other_.data() + at, image.columns,
                       reach);
        }
        image.levels.swap(other_);
    }
}

std::vector<std::uint8_t> DepthCleaner::clean(DepthImage& image, const CleaningOptions& options,
                                              std::span<const HeldLevel> held) {
    std::vector<std::uint8_t> unseen(image.levels.size(), 0);
    const bool touchable = image.columns >= 2 && image.rows >= 2;
    refused_.clear();
    if (touchable && options.remove_spikes) {
        remove_spikes(image);
        remove_islands(image);
    }
    if (touchable && options.fill_holes) {
        seen_ = image;
        held_.fill(image, held);
        small_holes_.fill(image);
        large_holes_.fill(image, seen_, refused_, unseen);
    }
    for (std::size_t k = 0; k < image.levels.size(); ++k) {
        if (!std::isnan(image.levels[k])) continue;
        image.levels[k] = 0.0F;
        unseen[k] = 1;
    }
    if (touchable && options.smooth_steps && is_eight_bit(image)) smooth_steps(image);
    if (std::find(unseen.begin(), unseen.end(), 1) == unseen.end()) unseen.clear();
    return unseen;
}

CleanedDepth DepthCleaner::cleaned(DepthImage image, const CleaningOptions& options,
                                   std::span<const HeldLevel> held) {
    CleanedDepth done;
    std::vector<std::uint8_t> unseen = clean(image, options, held);
    if (!unseen.empty())
        done.unseen = std::make_shared<const std::vector<std::uint8_t>>(std::move(unseen));
    done.depth = std::make_shared<const DepthImage>(std::move(image));
    return done;
}

}  // namespace dibhr
