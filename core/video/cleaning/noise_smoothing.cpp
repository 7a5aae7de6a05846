// Medians, then a pyramid of pairs of opposite pixels.
#include "core/video/cleaning/noise_smoothing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "core/video/frames/vector_clones.hpp"

namespace dibhr {

namespace {

constexpr int kTile_px = 8;
constexpr std::size_t kScales = 5;            ///< pairs up to 2 * 2 * 2^4 = 64 px apart
constexpr float kLeastNoise = 0.1F / 255.0F;  ///< of the highest level
constexpr float kBound = 3.0F;                ///< standard deviations
/// A pixel farther from its median is a true shape: limits in bounds of the image, and in
/// deviations of the clip's noise, as its codec may add noise of its own.
constexpr float kMedianBounds = 4.0F, kMedianNoises = 12.0F;
constexpr int kBorder_px = 2;  ///< of medians of medians
/// Factor for the roughness, since its tails are heavier than a normal distribution's.
constexpr float kRoughShare = 2.0F;
/// Part of the clip's noise that is left after the filter in time: of grain, and of blotches.
constexpr float kGrainLeft = 0.35F, kBlotchesLeft = 1.0F;
/// For a normal distribution: the mean of absolute values cut at twice that mean, times the
/// deviation of a pixel from the mean of four others.
constexpr float kOfRoughness = 1.0F / (0.735F * 1.118F);
constexpr int kClippings = 5;
constexpr float kRate = 0.2F;  ///< of the change towards four pairs; stable up to 0.25

/// Shapes beyond this many deviations of noise, after a binomial filter of 5 x 5, are added again.
/// The filter leaves 0.27 of grain, but all of blotches: with those shapes must be much larger.
constexpr float kPutBackBeyond = 2.2F / kRoughShare;
constexpr float kBinomialLeaves = 0.27F;
/// Part of grain that is left in every second pixel: the next scale's noise. Blotches stay.
constexpr float kLeftByTwoPasses = 0.35F;
constexpr std::array<float, 5> kBinomial{1.0F / 16, 4.0F / 16, 6.0F / 16, 4.0F / 16, 1.0F / 16};

/// Change towards the mean of two opposite pixels, smaller the farther that is from the centre.
inline float towards(float one, float other, float centre, float per_bound) {
    const float off = 0.5F * (one + other) - centre;
    return std::max(1.0F - std::fabs(off * per_bound), 0.0F) * off;
}

/// Pixels [begin, end) of a row, which have all eight neighbours at the reach.
DIBHR_VECTOR_CLONES void smooth_inside(const float* up, const float* row, const float* down,
                                       const float* per_bound, float* __restrict out,
                                       std::ptrdiff_t begin, std::ptrdiff_t end,
                                       std::ptrdiff_t reach) {
    for (std::ptrdiff_t i = begin; i < end; ++i) {
        const float centre = row[i];
        const float bound = per_bound[i];
        const float change = towards(row[i - reach], row[i + reach], centre, bound) +
                             towards(up[i], down[i], centre, bound) +
                             towards(up[i - reach], down[i + reach], centre, bound) +
                             towards(up[i + reach], down[i - reach], centre, bound);
        out[i] = centre + kRate * change;
    }
}

/// At the border only the pairs along it count.
void smooth_at_border(const float* one, const float* row, const float* other,
                      const float* per_bound, float* out, std::ptrdiff_t begin,
                      std::ptrdiff_t end) {
    for (std::ptrdiff_t i = begin; i < end; ++i)
        out[i] = row[i] + kRate * towards(one[i], other[i], row[i], per_bound[i]);
}

DIBHR_VECTOR_CLONES void roughness(const float* up, const float* row, const float* down,
                                   float* __restrict out, std::ptrdiff_t columns) {
    for (std::ptrdiff_t i = 1; i + 1 < columns; ++i)
        out[i] = std::fabs(row[i] - 0.25F * (row[i - 1] + row[i + 1] + up[i] + down[i]));
}

/// Twice the means of whole tiles side by side (kTile_px columns, `rows` rows), with values cut at
/// twice the mean. `values`: rows of `columns`.
DIBHR_VECTOR_CLONES void clipped_means(const float* values, std::ptrdiff_t columns,
                                       std::ptrdiff_t rows, float* __restrict twice_means,
                                       std::ptrdiff_t tiles) {
    const float pixels = static_cast<float>(kTile_px * std::max<std::ptrdiff_t>(rows, 1));
    for (std::ptrdiff_t x = 0; x < tiles; ++x) {
        float cap = std::numeric_limits<float>::infinity();
        for (int k = 0; k < kClippings; ++k) {
            std::array<float, kTile_px> sums{};
            const float* row = values + x * kTile_px;
            for (std::ptrdiff_t j = 0; j < rows; ++j, row += columns)
                for (std::size_t i = 0; i < kTile_px; ++i) sums[i] += std::min(row[i], cap);
            float sum = 0.0F;
            for (const float one : sums) sum += one;
            cap = 2.0F * sum / pixels;
        }
        twice_means[x] = cap;
    }
}

DIBHR_VECTOR_CLONES void mix(const float* one, const float* other, float share,
                             float* __restrict out, std::ptrdiff_t count) {
    for (std::ptrdiff_t i = 0; i < count; ++i) out[i] = one[i] + share * (other[i] - one[i]);
}

DIBHR_VECTOR_CLONES void add_changes(const float* now_above, const float* before_above,
                                     const float* now_below, const float* before_below,
                                     float* __restrict changes, std::ptrdiff_t columns) {
    for (std::ptrdiff_t i = 0; i < columns; ++i)
        changes[i] = 0.5F * ((now_above[i] - before_above[i]) + (now_below[i] - before_below[i]));
}

/// What smoothing removed, at most three deviations: an outlier is no shape.
DIBHR_VECTOR_CLONES void taken_away(const float* before, const float* now, const float* per_bound,
                                    float* __restrict out, std::ptrdiff_t count) {
    for (std::ptrdiff_t i = 0; i < count; ++i) {
        const float most = (3.0F / kBound) / per_bound[i];
        out[i] = std::min(std::max(before[i] - now[i], -most), most);
    }
}

DIBHR_VECTOR_CLONES void sum_of_five(const std::array<const float*, 5>& rows, float* __restrict out,
                                     std::ptrdiff_t begin, std::ptrdiff_t end) {
    const float *a = rows[0], *b = rows[1], *c = rows[2], *d = rows[3], *e = rows[4];
    for (std::ptrdiff_t i = begin; i < end; ++i)
        out[i] = kBinomial[0] * (a[i] + e[i]) + kBinomial[1] * (b[i] + d[i]) + kBinomial[2] * c[i];
}

/// Adds nearly all of shapes far beyond the noise, nothing of those within it (the non-negative
/// garrote).
DIBHR_VECTOR_CLONES void add_beyond(const float* shape, const float* per_bound, float noise_part,
                                    const float* now, float* __restrict out,
                                    std::ptrdiff_t columns) {
    for (std::ptrdiff_t i = 0; i < columns; ++i) {
        const float most = noise_part / per_bound[i];
        const float size = std::max(std::fabs(shape[i]), 1e-20F);
        const float part = most / size;
        out[i] = now[i] + shape[i] * std::max(1.0F - part * part, 0.0F);
    }
}

/// Levels become their medians, unless they are farther away than outliers are.
DIBHR_VECTOR_CLONES void move_to_medians(const float* medians, const float* per_bound,
                                         const NoiseBound& most, float* __restrict levels,
                                         std::ptrdiff_t columns) {
    for (std::ptrdiff_t i = 0; i < columns; ++i) {
        const float off = std::fabs(levels[i] - medians[i]);
        const bool is_within = off * per_bound[i] < kMedianBounds && off < most(medians[i]);
        levels[i] = is_within ? medians[i] : levels[i];
    }
}

DIBHR_VECTOR_CLONES void clamp_row(float* levels, float lowest, float highest,
                                   std::ptrdiff_t columns) {
    for (std::ptrdiff_t i = 0; i < columns; ++i)
        levels[i] = std::min(std::max(levels[i], lowest), highest);
}

DIBHR_VECTOR_CLONES void find_range(const float* levels, float* __restrict lowest,
                                    float* __restrict highest, std::ptrdiff_t columns) {
    for (std::ptrdiff_t i = 0; i < columns; ++i) {
        lowest[i] = std::min(lowest[i], levels[i]);
        highest[i] = std::max(highest[i], levels[i]);
    }
}

DIBHR_VECTOR_CLONES void take_every_second(const float* fine, float* __restrict coarse,
                                           std::ptrdiff_t columns) {
    for (std::ptrdiff_t i = 0; i < columns; ++i) coarse[i] = fine[2 * i];
}

/// Adds the coarse scale's changes, interpolated; there is one more than half of the columns.
DIBHR_VECTOR_CLONES void add_between(const float* changes, float* __restrict levels,
                                     std::ptrdiff_t columns) {
    for (std::ptrdiff_t x = 0; x < columns / 2; ++x) {
        levels[2 * x] += 0.5F * (changes[x] + changes[x]);
        levels[2 * x + 1] += 0.5F * (changes[x] + changes[x + 1]);
    }
    if (columns % 2 != 0) levels[columns - 1] += changes[columns / 2];
}

/// Interpolates from the middle of each tile to that of the next.
DIBHR_VECTOR_CLONES void spread(const float* tiles, std::ptrdiff_t count, float* __restrict out) {
    for (std::ptrdiff_t x = 0; x < count; ++x) {
        const float from = tiles[x];
        const float step = (tiles[x + 1] - from) / kTile_px;
        for (std::ptrdiff_t k = 0; k < kTile_px; ++k)
            out[x * kTile_px + k] = from + step * (static_cast<float>(k) + 0.5F);
    }
}

}  // namespace

/// For one row of tiles: means of the absolute differences from the pixels around, cut at twice the
/// mean, so that outlines count less. Rows [first_row, rows) of the row of tiles are known.
void NoiseSmoother::clip_to_twice_the_mean(int columns, int rows, int first_row) {
    const std::ptrdiff_t width = columns;
    const float* const rough = rough_.data() + first_row * width;
    // The first tile and the last ones are not whole: roughness is not known at the border.
    const std::ptrdiff_t whole = std::max<std::ptrdiff_t>((width - 1) / kTile_px, 1);
    caps_.resize(static_cast<std::size_t>(tile_columns_));
    clipped_means(rough + kTile_px, width, rows - first_row, caps_.data() + 1, whole - 1);
    const auto clip_part = [&](std::ptrdiff_t x) {
        const std::ptrdiff_t begin = std::max<std::ptrdiff_t>(x * kTile_px, 1);
        const std::ptrdiff_t end = std::min<std::ptrdiff_t>((x + 1) * kTile_px, width - 1);
        const std::ptrdiff_t pixels =
            std::max<std::ptrdiff_t>((end - begin) * (rows - first_row), 1);
        float cap = std::numeric_limits<float>::infinity();
        for (int k = 0; k < kClippings; ++k) {
            float sum = 0.0F;
            for (std::ptrdiff_t i = begin; i < end; ++i) {
                float of_column = 0.0F;
                for (std::ptrdiff_t j = 0; j < rows - first_row; ++j)
                    of_column += std::min(rough[j * width + i], cap);
                sum += of_column;
            }
            cap = 2.0F * sum / static_cast<float>(pixels);
        }
        caps_[static_cast<std::size_t>(x)] = cap;
    };
    clip_part(0);
    for (std::ptrdiff_t x = whole; x < tile_columns_; ++x) clip_part(x);
}

void NoiseSmoother::measure_tiles(const DepthImage& image, const DepthNoise& noise) {
    tile_columns_ = (image.columns + kTile_px - 1) / kTile_px;
    tile_rows_ = (image.rows + kTile_px - 1) / kTile_px;
    per_bound_of_tile_.clear();
    rough_.assign(static_cast<std::size_t>(image.columns) * kTile_px, 0.0F);
    lows_.assign(image.levels.begin(), image.levels.begin() + image.columns);
    highs_ = lows_;
    const float left_share =
        kGrainLeft + (kBlotchesLeft - kGrainLeft) * std::min(noise.correlation, 1.0F);
    const NoiseBound left(noise, left_share, kLeastNoise, image.highest_level);
    for (int y = 0; y < tile_rows_; ++y) {
        for (int j = y * kTile_px; j < std::min((y + 1) * kTile_px, image.rows); ++j)
            find_range(image.levels.data() + image.index(0, j), lows_.data(), highs_.data(),
                       image.columns);
        const int top = std::max(y * kTile_px, 1);
        const int bottom = std::min(y * kTile_px + kTile_px, image.rows - 1);
        for (int j = top; j < bottom; ++j) {
            const float* row = image.levels.data() + image.index(0, j);
            roughness(row - image.columns, row, row + image.columns,
                      rough_.data() + std::ptrdiff_t{j - y * kTile_px} * image.columns,
                      image.columns);
        }
        clip_to_twice_the_mean(image.columns, bottom - y * kTile_px, top - y * kTile_px);
        const int middle = std::min(y * kTile_px + kTile_px / 2, image.rows - 1);
        for (int x = 0; x < tile_columns_; ++x) {
            const int i = std::min(x * kTile_px + kTile_px / 2, image.columns - 1);
            const float rough =
                caps_[static_cast<std::size_t>(x)] / 2.0F * kOfRoughness * kRoughShare;
            per_bound_of_tile_.push_back(1.0F /
                                         (kBound * std::max(rough, left(image.at(i, middle)))));
        }
    }
}

/// Bounds of the finest scale are interpolated between tiles, once a row, in order of the rows.
const float* NoiseSmoother::bounds_of(const Scale& scale, int row) {
    if (&scale != scales_.data()) return scale.per_bound.data() + scale.index(0, row);
    for (; bounds_made_ <= row; ++bounds_made_)
        spread_bounds(bounds_made_, bounds_.row(bounds_made_));
    return bounds_.row(row);
}

void NoiseSmoother::spread_bounds(int row, float* out) {
    const std::ptrdiff_t columns = scales_.front().columns;
    tiles_.resize(static_cast<std::size_t>(tile_columns_));
    const float at = (static_cast<float>(row) + 0.5F) / kTile_px - 0.5F;
    const float held = std::clamp(at, 0.0F, static_cast<float>(tile_rows_ - 1));
    const int above = static_cast<int>(held);
    const int below = std::min(above + 1, tile_rows_ - 1);
    const float* tile = per_bound_of_tile_.data();
    mix(tile + std::ptrdiff_t{above} * tile_columns_, tile + std::ptrdiff_t{below} * tile_columns_,
        held - static_cast<float>(above), tiles_.data(), tile_columns_);
    constexpr std::ptrdiff_t kHalf = kTile_px / 2;
    std::fill(out, out + std::min(kHalf, columns), tiles_.front());
    const std::ptrdiff_t whole = std::max<std::ptrdiff_t>(columns - kHalf, 0) / kTile_px;
    const std::ptrdiff_t spans = std::min<std::ptrdiff_t>(whole, tile_columns_ - 1);
    spread(tiles_.data(), spans, out + kHalf);
    std::ptrdiff_t done = spans * kTile_px + kHalf;
    if (spans + 1 < tile_columns_) {
        std::array<float, kTile_px> last{};
        spread(tiles_.data() + spans, 1, last.data());
        for (const float bound : last)
            if (done < columns) out[done++] = bound;
    }
    if (done < columns) std::fill(out + done, out + columns, tiles_.back());
}

/// One row of a pass; `rows(j)`: row j of its input.
template <typename Rows>
void NoiseSmoother::pass(const Scale& scale, const Rows& rows, int j, int reach, float* out) {
    const std::ptrdiff_t columns = scale.columns;
    const std::ptrdiff_t begin = std::min<std::ptrdiff_t>(reach, columns);
    const std::ptrdiff_t end = std::max(begin, columns - reach);
    const float* const row = rows(j);
    const float* const bound = bounds_of(scale, j);
    if (j >= reach && j + reach < scale.rows) {
        const float* const up = rows(j - reach);
        const float* const down = rows(j + reach);
        smooth_at_border(up, row, down, bound, out, 0, begin);
        smooth_inside(up, row, down, bound, out, begin, end, reach);
        smooth_at_border(up, row, down, bound, out, end, columns);
    } else {
        std::copy(row, row + columns, out);
        smooth_at_border(row - reach, row, row + reach, bound, out, begin, end);
    }
}

/// Both passes of a scale and the reduction to the next one run row by row together, so that the
/// few rows between them stay in the cache.
void NoiseSmoother::smooth_to_coarser(Scale& fine, const float* from, Scale* coarse) {
    fine.levels.resize(fine.index(0, fine.rows));
    const auto given = [&](int j) { return from + fine.index(0, j); };
    const auto once = [&](int j) -> const float* { return first_.row(j); };
    for (Ring* ring : {&first_, &bounds_}) ring->resize(fine.columns);
    bounds_made_ = 0;
    for (int tick = 0; tick < fine.rows + 2; ++tick) {
        if (tick < fine.rows) pass(fine, given, tick, 1, first_.row(tick));
        const int j = tick - 2;
        if (j < 0) continue;
        float* const out = fine.levels.data() + fine.index(0, j);
        pass(fine, once, j, 2, out);
        if (coarse == nullptr || j % 2 != 0) continue;
        const std::size_t at = coarse->index(0, j / 2);
        take_every_second(out, coarse->before.data() + at, coarse->columns);
        take_every_second(bounds_of(fine, j), coarse->per_bound.data() + at, coarse->columns);
    }
}

/// Adds the coarse scale's changes, interpolated between its pixels.
void NoiseSmoother::add_coarse(Scale& fine, const Scale& coarse, int j) {
    const std::size_t above = coarse.index(0, j / 2);
    const std::size_t below = coarse.index(0, std::min((j + 1) / 2, coarse.rows - 1));
    row_.resize(static_cast<std::size_t>(coarse.columns) + 1);
    add_changes(coarse.levels.data() + above, coarse.before.data() + above,
                coarse.levels.data() + below, coarse.before.data() + below, row_.data(),
                coarse.columns);
    row_.back() = row_[row_.size() - 2];
    add_between(row_.data(), fine.levels.data() + fine.index(0, j), fine.columns);
}

/// The way back to the finer scale, again row by row together.
void NoiseSmoother::smooth_to_finer(Scale& fine, const float* before, const Scale* coarse) {
    for (Ring* ring : {&first_, &second_, &taken_, &bounds_}) ring->resize(fine.columns);
    bounds_made_ = 0;
    const auto levels = [&](int j) { return fine.levels.data() + fine.index(0, j); };
    const auto once = [&](int j) -> const float* { return first_.row(j); };
    for (int tick = 0; tick < fine.rows + 5; ++tick) {
        if (coarse != nullptr && tick < fine.rows) add_coarse(fine, *coarse, tick);
        if (const int j = tick - 2; j >= 0 && j < fine.rows)
            pass(fine, levels, j, 2, first_.row(j));
        if (const int j = tick - 3; j >= 0 && j < fine.rows) {
            pass(fine, once, j, 1, second_.row(j));
            taken_away(before + fine.index(0, j), second_.row(j), bounds_of(fine, j), taken_.row(j),
                       fine.columns);
        }
        if (const int j = tick - 5; j >= 0) put_back(fine, j, levels(j));
    }
}

void NoiseSmoother::put_back(const Scale& scale, int j, float* out) {
    const std::ptrdiff_t columns = scale.columns;
    across_.resize(static_cast<std::size_t>(columns));
    both_.resize(static_cast<std::size_t>(columns));
    std::array<const float*, 5> rows{};
    for (int k = 0; k < 5; ++k)
        rows[static_cast<std::size_t>(k)] = taken_.row(std::clamp(j + k - 2, 0, scale.rows - 1));
    sum_of_five(rows, across_.data(), 0, columns);
    const float* const centre = across_.data();
    const std::ptrdiff_t begin = std::min<std::ptrdiff_t>(2, columns);
    const std::ptrdiff_t end = std::max<std::ptrdiff_t>(columns - 2, begin);
    std::copy(centre, centre + begin, both_.begin());
    sum_of_five({centre - 2, centre - 1, centre, centre + 1, centre + 2}, both_.data(), begin, end);
    std::copy(centre + end, centre + columns, both_.begin() + end);
    add_beyond(both_.data(), bounds_of(scale, j), scale.noise_part, second_.row(j), out, columns);
}

/// Smooths from fine to coarse and back. `before`: the scale's levels, `from`: without outliers.
void NoiseSmoother::smooth_scales(std::size_t number, const float* from, const float* before) {
    Scale& fine = scales_[number];
    Scale* const coarse = number + 1 < scales_.size() ? &scales_[number + 1] : nullptr;
    if (coarse != nullptr) {
        coarse->before.resize(coarse->index(0, coarse->rows));
        coarse->per_bound.resize(coarse->before.size());
    }
    smooth_to_coarser(fine, from, coarse);
    if (coarse != nullptr) smooth_scales(number + 1, coarse->before.data(), coarse->before.data());
    smooth_to_finer(fine, before, coarse);
}

/// The median of nine, twice, also removes outliers of two pixels by two. The median of 25 would
/// cost four times as much and remove more small shapes.
void NoiseSmoother::take_medians(DepthImage& image, const DepthNoise& noise) {
    medians_.resize(image.levels.size());
    before_ = image.levels;
    const auto picture = [&](std::vector<float>& levels) {
        return cv::Mat(image.rows, image.columns, CV_32F, levels.data());
    };
    cv::Mat medians = picture(medians_);
    cv::medianBlur(picture(image.levels), medians, 3);
    cv::medianBlur(medians, medians, 3);
    bounds_.resize(image.columns);
    bounds_made_ = 0;
    const NoiseBound most(noise, kMedianNoises, 0.0F, image.highest_level);
    // At the border a slope's median is not on the slope.
    for (int j = kBorder_px; j < image.rows - kBorder_px; ++j) {
        const std::size_t at = image.index(kBorder_px, j);
        move_to_medians(medians_.data() + at, bounds_of(scales_.front(), j) + kBorder_px, most,
                        image.levels.data() + at, image.columns - 2 * kBorder_px);
    }
}

void NoiseSmoother::smooth(DepthImage& image, const DepthNoise& noise) {
    measure_tiles(image, noise);
    const float lowest = *std::min_element(lows_.begin(), lows_.end());
    const float highest = *std::max_element(highs_.begin(), highs_.end());
    scales_.resize(kScales);
    int columns = image.columns;
    int rows = image.rows;
    const float grain = 1.0F - std::min(noise.correlation, 0.99F);
    const float left = std::lerp(1.0F, kLeftByTwoPasses, grain);
    float noise_part = kPutBackBeyond * kBinomialLeaves / (grain * grain) / kBound;
    for (Scale& scale : scales_) {
        scale.noise_part = noise_part;
        noise_part *= left;
        scale.columns = columns;
        scale.rows = rows;
        columns = (columns + 1) / 2;
        rows = (rows + 1) / 2;
    }
    take_medians(image, noise);
    smooth_scales(0, image.levels.data(), before_.data());
    Scale& finest = scales_.front();
    clamp_row(finest.levels.data(), lowest, highest,
              static_cast<std::ptrdiff_t>(finest.levels.size()));
    finest.levels.swap(image.levels);
}

}  // namespace dibhr
