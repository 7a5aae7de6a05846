// A pyramid of pairs of opposite pixels; what it takes is weighed against the noise, band by band.
#include "core/video/cleaning/noise_smoothing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "core/video/cleaning/patches.hpp"
#include "core/video/frames/vector_clones.hpp"

namespace dibhr {

namespace {

constexpr int kTile_px = TimeEvidence::kTile_px;
constexpr std::size_t kScales = 5;            ///< pairs up to 2 * 2 * 2^4 = 64 px apart
constexpr float kLeastNoise = 0.1F / 255.0F;  ///< of the highest level
constexpr float kBound = 5.0F;                ///< standard deviations
constexpr float kRate = 0.2F;  ///< of the change towards four pairs; stable up to 0.25
/// Where fewer frames agree than that, of those that are, the image's own roughness tells of noise,
/// too: what stands still in more is shape. At least kLeastMany, so that one picture is rough.
constexpr float kManyFrames = 8.0F, kManyShare = 0.75F, kLeastMany = 4.0F;

/// Factor for the roughness, since its tails are heavier than a normal distribution's.
constexpr float kRoughShare = 2.5F;
/// A tile with an outline is rough because of it. Noise beyond so many times the variance that is
/// known would let smoothing cross the outline.
constexpr float kMostRough = 4.0F;
/// For a normal distribution: the mean of absolute values cut at twice that mean, times the
/// deviation of a pixel from the mean of four others.
constexpr float kOfRoughness = 1.0F / (0.735F * 1.118F);
constexpr int kClippings = 5;
/// A pixel farther from its median is a true shape: limits in bounds of the image, and in
/// deviations of the clip's noise, as its codec may add noise of its own.
constexpr float kMedianBounds = 4.0F, kMedianNoises = 12.0F;
constexpr int kBorder_px = 2;  ///< of medians of medians
/// Noise that may be left, of the highest level: a third of what a finger feels.
constexpr float kStatedNoise = 0.05F / 255.0F;
/// Of the noise's variance: what means in time have in the finest band beyond its share, where
/// neighbours share noise. Each has frames of its own that are beyond the noise.
constexpr float kFinestOfMeans = 0.03F;
/// Of the noise's variance, where frames are alike: codecs repeat pixels.
constexpr float kLeastShown = 0.3F;

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

DIBHR_VECTOR_CLONES void find_taken(const float* before, const float* now, float* __restrict taken,
                                    std::ptrdiff_t count) {
    for (std::ptrdiff_t i = 0; i < count; ++i) taken[i] = before[i] - now[i];
}

DIBHR_VECTOR_CLONES void add_within(const float* base, const float* shapes, float lowest,
                                    float highest, float* __restrict out, std::ptrdiff_t count) {
    for (std::ptrdiff_t i = 0; i < count; ++i)
        out[i] = std::min(std::max(base[i] + shapes[i], lowest), highest);
}

/// A pixel beyond all eight around it takes the level of the one that is next.
DIBHR_VECTOR_CLONES void keep_among(const float* up, const float* row, const float* down,
                                    float* __restrict out, std::ptrdiff_t columns) {
    for (std::ptrdiff_t i = 1; i + 1 < columns; ++i) {
        const float low_up = std::min(std::min(up[i - 1], up[i]), up[i + 1]);
        const float low_down = std::min(std::min(down[i - 1], down[i]), down[i + 1]);
        const float high_up = std::max(std::max(up[i - 1], up[i]), up[i + 1]);
        const float high_down = std::max(std::max(down[i - 1], down[i]), down[i + 1]);
        const float lowest = std::min(std::min(low_up, low_down), std::min(row[i - 1], row[i + 1]));
        const float highest =
            std::max(std::max(high_up, high_down), std::max(row[i - 1], row[i + 1]));
        out[i] = std::min(std::max(row[i], lowest), highest);
    }
}

DIBHR_VECTOR_CLONES void add_to(const float* more, float* __restrict sums, std::ptrdiff_t count) {
    for (std::ptrdiff_t i = 0; i < count; ++i) sums[i] += more[i];
}

/// The variance of the mean of so many frames, of every second pixel. `per_weight`: of one of them
/// over the others, for noise that neighbouring frames share.
DIBHR_VECTOR_CLONES void share_among(const float* variances, const float* weights, float per_weight,
                                     float* __restrict out, std::ptrdiff_t columns) {
    for (std::ptrdiff_t i = 0; i < columns; ++i)
        out[i] = variances[i] / std::max(weights[2 * i] * per_weight, 1.0F);
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

/// The variance of a frame's noise, of tiles, each with those around it.
void NoiseSmoother::find_variances(const DepthImage& image, const DepthNoise& noise,
                                   const TimeEvidence& evidence) {
    const auto columns = static_cast<std::size_t>(tile_columns_);
    const auto rows = static_cast<std::size_t>(tile_rows_);
    const NoiseBound least({}, 1.0F, kLeastNoise, image.highest_level);
    const float least_variance = least(0.0F) * least(0.0F);
    variances_.resize(columns * rows);
    if (evidence.variances.empty()) {
        const float shown = 1.0F - (4.0F - noise.character.kept) * noise.character.kept / 3.0F;
        const NoiseBound deviation(noise, 1.0F / std::sqrt(std::max(shown, kLeastShown)),
                                   kLeastNoise, image.highest_level);
        for (std::size_t k = 0; k < variances_.size(); ++k) {
            const int i = static_cast<int>(k % columns) * kTile_px + kTile_px / 2;
            const int j = static_cast<int>(k / columns) * kTile_px + kTile_px / 2;
            const float of =
                deviation(image.at(std::min(i, image.columns - 1), std::min(j, image.rows - 1)));
            variances_[k] = of * of;
        }
        return;
    }
    const auto seen = [&](std::size_t x, std::size_t y) {
        return std::max(evidence.variances[y * columns + x], least_variance);
    };
    for (std::size_t y = 0; y < rows; ++y) {
        const std::size_t above = y - std::min<std::size_t>(y, 1);
        const std::size_t below = std::min(y + 1, rows - 1);
        const auto of_column = [&](std::size_t x) {
            return 0.25F * (seen(x, above) + seen(x, below)) + 0.5F * seen(x, y);
        };
        for (std::size_t x = 0; x < columns; ++x)
            variances_[y * columns + x] = 0.25F * (of_column(x - std::min<std::size_t>(x, 1)) +
                                                   of_column(std::min(x + 1, columns - 1))) +
                                          0.5F * of_column(x);
    }
}

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

/// What a row of tiles has in space, as variances: where neighbours in time tell little.
void NoiseSmoother::find_roughness(const DepthImage& image, int y) {
    const int top = std::max(y * kTile_px, 1);
    const int bottom = std::min((y + 1) * kTile_px, image.rows - 1);
    rough_.assign(static_cast<std::size_t>(image.columns) * kTile_px, 0.0F);
    for (int j = top; j < bottom; ++j) {
        const float* const row = image.levels.data() + image.index(0, j);
        roughness(row - image.columns, row, row + image.columns,
                  rough_.data() + std::ptrdiff_t{j - y * kTile_px} * image.columns, image.columns);
    }
    clip_to_twice_the_mean(image.columns, bottom - y * kTile_px, top - y * kTile_px);
    for (float& cap : caps_) {
        const float deviation = kRoughShare * kOfRoughness * cap / 2.0F;
        cap = deviation * deviation;
    }
}

/// How much noise is in the image: of every second pixel for the bands, of tiles for the bounds.
void NoiseSmoother::find_noise(const DepthImage& image, const DepthNoise& noise,
                               const TimeEvidence& evidence) {
    tile_columns_ = (image.columns + kTile_px - 1) / kTile_px;
    tile_rows_ = (image.rows + kTile_px - 1) / kTile_px;
    find_variances(image, noise, evidence);
    const NoiseCharacter& character = noise.character;
    left_.moving_shares = character.bands;
    if (!evidence.variances.empty()) left_.moving_shares.front() += kFinestOfMeans;
    left_.standing_shares = character.standing;
    const float many =
        std::clamp(kManyShare * static_cast<float>(evidence.near_frames), kLeastMany, kManyFrames);
    left_.stated = kStatedNoise * static_cast<float>(image.highest_level);
    float stands = 0.0F;
    for (const float share : character.standing) stands += share;
    left_.moving.set_size((image.columns + 1) / 2, (image.rows + 1) / 2);
    left_.standing.set_size(stands > 0.0F ? left_.moving.columns : 0, left_.moving.rows);
    const float per_weight = (1.0F - character.kept) / (1.0F + character.kept);
    constexpr int kHalf = kTile_px / 2;
    row_.resize(static_cast<std::size_t>(tile_columns_ * kHalf));
    per_bound_of_tile_.resize(variances_.size());
    few_frames_.resize(variances_.size());
    for (int y = 0; y < tile_rows_; ++y) {
        const float* const variances = variances_.data() + std::ptrdiff_t{y} * tile_columns_;
        for (int x = 0; x < tile_columns_ * kHalf; ++x)
            row_[static_cast<std::size_t>(x)] = variances[x / kHalf];
        tiles_.assign(static_cast<std::size_t>(tile_columns_), 0.0F);
        const int bottom = std::min((y + 1) * kHalf, left_.moving.rows);
        for (int j = y * kHalf; j < bottom; ++j) {
            float* const out = left_.moving.row(j);
            if (evidence.variances.empty())
                std::copy_n(row_.begin(), left_.moving.columns, out);
            else
                share_among(row_.data(), evidence.weights.data() + image.index(0, 2 * j),
                            per_weight, out, left_.moving.columns);
            if (stands > 0.0F)
                std::copy_n(row_.begin(), left_.moving.columns, left_.standing.row(j));
            for (int x = 0; x < left_.moving.columns; ++x)
                tiles_[static_cast<std::size_t>(x / kHalf)] += out[x];
        }
        std::uint8_t any = 0;
        for (int x = 0; x < tile_columns_; ++x) {
            const int width = std::min(kHalf, left_.moving.columns - x * kHalf);
            float& left = tiles_[static_cast<std::size_t>(x)];
            left /= static_cast<float>(width * (bottom - y * kHalf));
            const std::uint8_t few = variances[x] < many * left ? 1 : 0;
            few_frames_[static_cast<std::size_t>(y * tile_columns_ + x)] = few;
            any |= few;
        }
        if (any != 0) {
            find_roughness(image, y);
            for (int x = 0; x < tile_columns_; ++x) {
                const auto at = static_cast<std::size_t>(x);
                const float frames = variances[x] / tiles_[at];
                const float share = std::clamp(2.0F - 2.0F * frames / many, 0.0F, 1.0F);
                const float rough = std::min(share * caps_[at], kMostRough * variances[x]);
                tiles_[at] += rough;
                std::fill_n(row_.begin() + std::ptrdiff_t{x} * kHalf, kHalf, rough);
            }
            for (int j = y * kHalf; j < bottom; ++j)
                add_to(row_.data(), left_.moving.row(j), left_.moving.columns);
        }
        for (int x = 0; x < tile_columns_; ++x) {
            const float variance = tiles_[static_cast<std::size_t>(x)] + stands * variances[x];
            per_bound_of_tile_[static_cast<std::size_t>(y * tile_columns_ + x)] =
                1.0F / (kBound * std::sqrt(variance));
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
void NoiseSmoother::smooth_to_finer(Scale& fine, const Scale* coarse) {
    for (Ring* ring : {&first_, &bounds_}) ring->resize(fine.columns);
    bounds_made_ = 0;
    const auto levels = [&](int j) { return fine.levels.data() + fine.index(0, j); };
    const auto once = [&](int j) -> const float* { return first_.row(j); };
    for (int tick = 0; tick < fine.rows + 4; ++tick) {
        if (coarse != nullptr && tick < fine.rows) add_coarse(fine, *coarse, tick);
        if (const int j = tick - 2; j >= 0 && j < fine.rows)
            pass(fine, levels, j, 2, first_.row(j));
        // The row that the first pass has just read for the last time.
        if (const int j = tick - 4; j >= 0) pass(fine, once, j, 1, levels(j));
    }
}

/// Smooths from fine to coarse and back.
void NoiseSmoother::smooth_scales(std::size_t number, const float* from) {
    Scale& fine = scales_[number];
    Scale* const coarse = number + 1 < scales_.size() ? &scales_[number + 1] : nullptr;
    if (coarse != nullptr) {
        coarse->before.resize(coarse->index(0, coarse->rows));
        coarse->per_bound.resize(coarse->before.size());
    }
    smooth_to_coarser(fine, from, coarse);
    if (coarse != nullptr) smooth_scales(number + 1, coarse->before.data());
    smooth_to_finer(fine, coarse);
}

/// Levels stay within those that were given.
void NoiseSmoother::put_back(DepthImage& image) {
    const std::vector<float>& base = scales_.front().levels;
    const auto count = static_cast<std::ptrdiff_t>(base.size());
    lows_.assign(image.levels.begin(), image.levels.begin() + image.columns);
    highs_ = lows_;
    for (int j = 0; j < image.rows; ++j)
        find_range(image.levels.data() + image.index(0, j), lows_.data(), highs_.data(),
                   image.columns);
    taken_.set_size(image.columns, image.rows);
    find_taken(image.levels.data(), base.data(), taken_.values.data(), count);
    bands_.keep_shapes(taken_, left_);
    add_within(base.data(), taken_.values.data(), *std::min_element(lows_.begin(), lows_.end()),
               *std::max_element(highs_.begin(), highs_.end()), image.levels.data(), count);
}

/// The median of nine, twice, also removes outliers of two pixels by two. It takes ridges too, so
/// it is for tiles of which few frames tell.
void NoiseSmoother::take_medians(DepthImage& image, const DepthNoise& noise) {
    const auto tile_columns = static_cast<std::ptrdiff_t>(tile_columns_);
    medians_.resize(image.levels.size());
    bounds_.resize(image.columns);
    bounds_made_ = 0;
    const NoiseBound most(noise, kMedianNoises, 0.0F, image.highest_level);
    const auto picture = [&](std::vector<float>& levels, int top, int bottom) {
        return cv::Mat(bottom - top, image.columns, CV_32F, levels.data() + image.index(0, top));
    };
    const auto has_few = [&](int y) {
        const auto few = few_frames_.begin() + y * tile_columns;
        return y < tile_rows_ && std::find(few, few + tile_columns, 1) != few + tile_columns;
    };
    for (int y = 0; y < tile_rows_; ++y) {
        const int first = y;
        while (has_few(y)) ++y;
        if (y == first) continue;
        // With the rows beside them that medians of medians depend on.
        const int top = std::max(first * kTile_px - kBorder_px, 0);
        const int bottom = std::min(y * kTile_px + kBorder_px, image.rows);
        cv::Mat medians;
        cv::medianBlur(picture(image.levels, top, bottom), medians, 3);
        cv::medianBlur(medians, medians, 3);
        const int end = std::min(y * kTile_px, image.rows);
        for (int j = first * kTile_px; j < end; ++j)
            std::copy_n(medians.ptr<float>(j - top), image.columns,
                        medians_.begin() + static_cast<std::ptrdiff_t>(image.index(0, j)));
    }
    // At the border a slope's median is not on the slope.
    for (int j = kBorder_px; j < image.rows - kBorder_px; ++j) {
        const std::uint8_t* const few = few_frames_.data() + j / kTile_px * tile_columns;
        const float* bounds = nullptr;
        visit_marked(few, tile_columns_, [&](int begin, int end) {
            if (bounds == nullptr) bounds = bounds_of(scales_.front(), j);
            const int left = std::max(begin * kTile_px, kBorder_px);
            const int right = std::min(end * kTile_px, image.columns - kBorder_px);
            if (left >= right) return;
            const std::size_t at = image.index(left, j);
            move_to_medians(medians_.data() + at, bounds + left, most, image.levels.data() + at,
                            right - left);
        });
    }
}

/// What stands out alone is an outlier, which would be an edge for the next step.
void NoiseSmoother::remove_outliers(DepthImage& image) {
    const auto columns = static_cast<std::ptrdiff_t>(image.columns);
    lows_.assign(image.levels.begin(), image.levels.begin() + columns);
    highs_.resize(lows_.size());
    for (int j = 1; j + 1 < image.rows; ++j) {  // lows_: the row above, highs_: this one, as given
        float* const row = image.levels.data() + image.index(0, j);
        std::copy(row, row + columns, highs_.begin());
        keep_among(lows_.data(), highs_.data(), row + columns, row, columns);
        lows_.swap(highs_);
    }
}

void NoiseSmoother::smooth(DepthImage& image, const DepthNoise& noise,
                           const TimeEvidence& evidence) {
    find_noise(image, noise, evidence);
    scales_.resize(kScales);
    int columns = image.columns;
    int rows = image.rows;
    for (Scale& scale : scales_) {
        scale.columns = columns;
        scale.rows = rows;
        columns = (columns + 1) / 2;
        rows = (rows + 1) / 2;
    }
    take_medians(image, noise);
    remove_outliers(image);
    smooth_scales(0, image.levels.data());
    put_back(image);
}

}  // namespace dibhr
