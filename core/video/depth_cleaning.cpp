// Makes recorded depth pleasant and safe to touch: holes, spikes and 8-bit steps.
#include "core/video/depth_cleaning.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>

namespace dibhr {

namespace {

constexpr int kWidthsInImage = 20;  ///< a hole may be this part of the image's width
constexpr int kNone = -1;           ///< no row holds a level

// Of the highest level: 8 of 255 stand out of a curved surface seen in 8 bits; 16 bits are mostly
// millimetres, of which 100 are far beyond a sensor's noise (up to 65 at 4 m).
constexpr float kSpike8_levels = 8.0F;
constexpr float kSpike16_levels = 100.0F;
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

float median_of_neighbours(const DepthImage& image, int i, int j) {
    std::array<float, 8> around{image.at(i - 1, j - 1), image.at(i, j - 1),
                                image.at(i + 1, j - 1), image.at(i - 1, j),
                                image.at(i + 1, j),     image.at(i - 1, j + 1),
                                image.at(i, j + 1),     image.at(i + 1, j + 1)};
    std::nth_element(around.begin(), around.begin() + 4, around.end());
    return around[4];
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

void HoleFiller::fill(DepthImage& image) {
    find_runs(image);
    if (runs_.empty()) return;
    join_runs();
    keep_small(image);
    std::size_t pixels = 0;
    for (const Run& run : runs_) pixels += static_cast<std::size_t>(run.end - run.begin);
    sum_.assign(pixels, 0.0F);
    weight_.assign(pixels, 0.0F);
    weigh_rows(image);
    weigh_columns(image, 1);
    weigh_columns(image, -1);
    std::size_t k = 0;
    for (const Run& run : runs_)
        for (int i = run.begin; i < run.end; ++i, ++k)
            if (weight_[k] > 0.0F) image.at(i, run.row) = sum_[k] / weight_[k];
}

void HoleFiller::find_runs(const DepthImage& image) {
    runs_.clear();
    for (int j = 0; j < image.rows; ++j) {
        const float* row = image.levels.data() + image.index(0, j);
        const float* const end = row + image.columns;
        for (const float* at = std::find(row, end, 0.0F); at != end;
             at = std::find(at, end, 0.0F)) {
            const float* const stop =
                std::find_if(at, end, [](float level) { return level != 0.0F; });
            runs_.push_back({j, static_cast<int>(at - row), static_cast<int>(stop - row), 0});
            at = stop;
        }
    }
}

/// Each run begins as its own patch and joins those of the row above that it touches.
void HoleFiller::join_runs() {
    patches_.clear();
    std::size_t above = 0;
    for (std::size_t k = 0; k < runs_.size(); ++k) {
        Run& run = runs_[k];
        run.patch = static_cast<std::int32_t>(k);
        patches_.push_back({run.begin, run.end, run.row, run.row + 1, run.patch});
        while (above < k && (runs_[above].row < run.row - 1 ||
                             (runs_[above].row == run.row - 1 && runs_[above].end < run.begin)))
            ++above;
        for (std::size_t a = above;
             a < k && runs_[a].row == run.row - 1 && runs_[a].begin <= run.end; ++a)
            join(runs_[a].patch, run.patch);
    }
}

std::int32_t HoleFiller::root(std::int32_t patch) {
    const auto parent = [this](std::int32_t p) -> std::int32_t& {
        return patches_[static_cast<std::size_t>(p)].parent;
    };
    while (parent(patch) != patch) {
        parent(patch) = parent(parent(patch));
        patch = parent(patch);
    }
    return patch;
}

void HoleFiller::join(std::int32_t a, std::int32_t b) {
    a = root(a);
    b = root(b);
    if (a == b) return;
    Patch& first = patches_[static_cast<std::size_t>(a)];
    Patch& second = patches_[static_cast<std::size_t>(b)];
    second.parent = a;
    first.left = std::min(first.left, second.left);
    first.right = std::max(first.right, second.right);
    first.top = std::min(first.top, second.top);
    first.bottom = std::max(first.bottom, second.bottom);
}

/// Forgets the runs of patches that are too large to be filled.
void HoleFiller::keep_small(const DepthImage& image) {
    const int most = std::max(2, image.columns / kWidthsInImage);
    const auto large = [&](const Run& run) {
        const Patch& patch = patches_[static_cast<std::size_t>(root(run.patch))];
        return patch.right - patch.left > most || patch.bottom - patch.top > most;
    };
    runs_.erase(std::remove_if(runs_.begin(), runs_.end(), large), runs_.end());
}

void HoleFiller::weigh_rows(const DepthImage& image) {
    std::size_t k = 0;
    for (const Run& run : runs_) {
        const bool left = run.begin > 0;
        const bool right = run.end < image.columns;
        const float left_level = left ? image.at(run.begin - 1, run.row) : 0.0F;
        const float right_level = right ? image.at(run.end, run.row) : 0.0F;
        for (int i = run.begin; i < run.end; ++i, ++k) {
            const float from_left = left ? 1.0F / static_cast<float>(i - run.begin + 1) : 0.0F;
            const float from_right = right ? 1.0F / static_cast<float>(run.end - i) : 0.0F;
            sum_[k] += left_level * from_left + right_level * from_right;
            weight_[k] += from_left + from_right;
        }
    }
}

/// Walks the runs down (step 1) or up (-1). Where the pixel before is no hole it is the column's
/// nearest level from here on; where it is one, it belongs to the same patch and its column stands.
void HoleFiller::weigh_columns(const DepthImage& image, int step) {
    column_level_.assign(static_cast<std::size_t>(image.columns), 0.0F);
    column_row_.assign(static_cast<std::size_t>(image.columns), kNone);
    std::size_t before = step > 0 ? 0 : sum_.size();
    for (std::size_t n = 0; n < runs_.size(); ++n) {
        const Run& run = runs_[step > 0 ? n : runs_.size() - 1 - n];
        const auto length = static_cast<std::size_t>(run.end - run.begin);
        const std::size_t first = step > 0 ? before : before - length;
        const int previous = run.row - step;
        const bool inside = previous >= 0 && previous < image.rows;
        for (int i = run.begin; i < run.end; ++i) {
            const auto column = static_cast<std::size_t>(i);
            if (!inside) {
                column_row_[column] = kNone;
            } else if (const float level = image.at(i, previous); level != 0.0F) {
                column_level_[column] = level;
                column_row_[column] = previous;
            }
            if (column_row_[column] == kNone) continue;
            const std::size_t k = first + static_cast<std::size_t>(i - run.begin);
            const float near = 1.0F / static_cast<float>(std::abs(run.row - column_row_[column]));
            sum_[k] += column_level_[column] * near;
            weight_[k] += near;
        }
        before = step > 0 ? first + length : first;
    }
}

void DepthCleaner::remove_spikes(DepthImage& image) {
    const float threshold = is_eight_bit(image) ? kSpike8_levels : kSpike16_levels;
    const int columns = image.columns;
    highest_.resize(static_cast<std::size_t>(columns));
    lowest_.resize(static_cast<std::size_t>(columns));
    outlying_.assign(static_cast<std::size_t>(columns), 0);
    spikes_.clear();
    for (int j = 1; j + 1 < image.rows; ++j) {
        const float* up = image.levels.data() + image.index(0, j - 1);
        const float* row = up + columns;
        const float* down = row + columns;
        for (int i = 0; i < columns; ++i) {
            highest_[static_cast<std::size_t>(i)] = std::max(up[i], down[i]);
            lowest_[static_cast<std::size_t>(i)] = std::min(up[i], down[i]);
        }
        const float* high = highest_.data();
        const float* low = lowest_.data();
        int found = 0;
        for (int i = 1; i + 1 < columns; ++i) {
            const float most = std::max(std::max(std::max(high[i - 1], high[i]), high[i + 1]),
                                        std::max(row[i - 1], row[i + 1]));
            const float least = std::min(std::min(std::min(low[i - 1], low[i]), low[i + 1]),
                                         std::min(row[i - 1], row[i + 1]));
            const int outlies = (row[i] > most + threshold) | (row[i] < least - threshold);
            outlying_[static_cast<std::size_t>(i)] = outlies;
            found |= outlies;
        }
        for (int i = 1; found != 0 && i + 1 < columns; ++i)
            if (outlying_[static_cast<std::size_t>(i)] != 0 && row[i] != 0.0F)
                spikes_.push_back({image.index(i, j), median_of_neighbours(image, i, j)});
    }
    for (const Spike& spike : spikes_) image.levels[spike.index] = spike.level;
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
        high_[k] = level > 0.0F ? std::min(level + 0.5F, highest) : 0.0F;  // no data stays no data
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

void DepthCleaner::clean(DepthImage& image, const CleaningOptions& options) {
    if (image.columns < 2 || image.rows < 2) return;
    if (options.remove_spikes) remove_spikes(image);
    if (options.fill_holes) holes_.fill(image);
    if (options.smooth_steps && is_eight_bit(image)) smooth_steps(image);
}

}  // namespace dibhr
