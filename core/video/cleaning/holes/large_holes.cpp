// Near data the lowest level there; farther away the background, from a pyramid of levels.
#include "core/video/cleaning/holes/large_holes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "core/video/cleaning/holes/small_holes.hpp"
#include "core/video/cleaning/patches.hpp"
#include "core/video/frames/vector_clones.hpp"

namespace dibhr {

namespace {

/// A fingertip's reach: within it of data the surface must not fall away.
constexpr int kReach_px = 10;
/// Of the highest level: a level this much lower than all around is felt as a pit (4 of 255 px).
constexpr float kPit = 0.015F;
constexpr float kReach_squares = 3.25F;  ///< kReach_px between centres of squares, rounded up
/// A hole with room for a disc of this radius (a part of the width) is open: it is not bridged.
constexpr double kOpenInWidth = 16.0;

constexpr float kWideMargin_squares = 2.0F;  ///< a wide hole goes this far beyond its discs

constexpr std::size_t kChunk = 64;  ///< pixels of a row that are checked together
constexpr std::size_t kDiscRows = 2 * kReach_px + 1;
/// A disc's rows reach 10, 9, 9, 9, 9, 8, 8, 7, 6, 4, 0 pixels to both sides, from the middle row
/// on. kSpanOfRow: as indices of spans, which reach 0, 4, 6, 7, 8, 9 and 10 pixels.
constexpr std::size_t kSpans = 7;
constexpr std::array<std::size_t, kReach_px + 1> kSpanOfRow{6, 5, 5, 5, 5, 4, 4, 3, 2, 1, 0};

std::size_t chunks_in(int columns) {
    return (static_cast<std::size_t>(columns) + kChunk - 1) / kChunk;
}

constexpr float kAbove = std::numeric_limits<float>::infinity();

/// Above 0 where discs of this radius without data have room, and `more` around them. Values may be
/// interpolated between two squares.
void room_for_discs(const cv::Mat1f& to_data, float radius, float more, std::vector<float>& room) {
    // A square's distance to data is from centre to centre: half a square more than to its rim.
    cv::Mat1b no_centre;
    cv::compare(to_data, radius + 0.5, no_centre, cv::CMP_LE);
    room.assign(to_data.total(), -1.0F);
    if (cv::countNonZero(no_centre) == static_cast<int>(no_centre.total())) return;
    cv::Mat1f to_centre(to_data.rows, to_data.cols, room.data());
    cv::distanceTransform(no_centre, to_centre, cv::DIST_L2, cv::DIST_MASK_5);
    to_centre = radius + more - to_centre;
}

/// Whether every pixel of the row has data.
bool has_data(const DepthImage& image, int row) {
    return !has_holes(image.levels.data() + image.index(0, row),
                      static_cast<std::size_t>(image.columns));
}

/// The lowest of each level and the seven after it.
DIBHR_VECTOR_CLONES void lowest_of_eight(const float* levels, float* __restrict lowest,
                                         std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
        const float* const at = levels + i;
        lowest[i] = std::min(std::min(std::min(at[0], at[1]), std::min(at[2], at[3])),
                             std::min(std::min(at[4], at[5]), std::min(at[6], at[7])));
    }
}

/// The lower of two rows, and of three.
DIBHR_VECTOR_CLONES void lower_of(const float* a, const float* b, float* __restrict lowest,
                                  std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) lowest[i] = std::min(a[i], b[i]);
}

DIBHR_VECTOR_CLONES void lower_of(const float* a, const float* b, const float* c,
                                  float* __restrict lowest, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) lowest[i] = std::min(std::min(a[i], b[i]), c[i]);
}

/// The lowest levels within the spans of each pixel, from the row `padded` by kReach_px on both
/// sides and from its lowest_of_eight.
void find_lowest_of_spans(const float* padded, const float* eight,
                          const std::array<float*, kSpans>& spans, std::size_t count) {
    std::copy_n(padded + 10, count, spans[0]);
    lower_of(eight + 6, padded + 14, spans[1], count);
    lower_of(eight + 4, eight + 9, spans[2], count);
    lower_of(eight + 3, eight + 10, spans[3], count);
    lower_of(eight + 2, eight + 10, padded + 18, spans[4], count);
    lower_of(eight + 1, eight + 9, eight + 12, spans[5], count);
    lower_of(eight, eight + 8, eight + 13, spans[6], count);
}

/// Lowers levels to the lowest of seven rows.
DIBHR_VECTOR_CLONES void lower(const float* const* rows, std::size_t at, float* __restrict level,
                               std::size_t count) {
    const float *a = rows[0] + at, *b = rows[1] + at, *c = rows[2] + at, *d = rows[3] + at,
                *e = rows[4] + at, *f = rows[5] + at, *g = rows[6] + at;
    for (std::size_t i = 0; i < count; ++i)
        level[i] = std::min(std::min(std::min(level[i], a[i]), std::min(b[i], c[i])),
                            std::min(std::min(d[i], e[i]), std::min(f[i], g[i])));
}

/// Copies levels; no data becomes infinity.
DIBHR_VECTOR_CLONES void make_holes_infinite(const float* levels, float* __restrict out,
                                             std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) out[i] = levels[i] == levels[i] ? levels[i] : kAbove;
}

DIBHR_VECTOR_CLONES void fill_holes(float* __restrict levels, std::uint8_t* __restrict unseen,
                                    const float* filled, const float* wide, const float* open,
                                    const float* farthest, float outline, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
        const bool hole = levels[i] != levels[i];
        const float behind = open[i] > 0.0F ? 0.0F : filled[i];
        const float lowered = std::min(behind, farthest[i] + outline);
        unseen[i] = static_cast<std::uint8_t>(hole && wide[i] > 0.0F ? 1 : unseen[i]);
        levels[i] = hole ? lowered : levels[i];
    }
}

/// Pixels that had no data are at most a pit lower than the data around.
DIBHR_VECTOR_CLONES void lift(const float* seen, const float* farthest, float pit,
                              float* __restrict levels, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
        const float lifted = std::max(levels[i], farthest[i] - pit);
        const bool in_reach = seen[i] != seen[i] && farthest[i] < kAbove;
        levels[i] = in_reach ? lifted : levels[i];
    }
}

}  // namespace

void LargeHoleFiller::fill(DepthImage& image, const DepthImage& seen,
                           std::span<const std::size_t> rejected,
                           std::vector<std::uint8_t>& unseen) {
    if (!has_holes(seen)) return;
    if (has_holes(image) && !find_behind(image)) {  // no data at all
        std::fill(image.levels.begin(), image.levels.end(), 0.0F);
        std::fill(unseen.begin(), unseen.end(), std::uint8_t{1});
        return;
    }
    widened_ = 0;
    chunks_.assign(chunks_in(image.columns), 1);
    for (int j = 0; j < image.rows; ++j) {
        if (has_data(seen, j)) continue;
        find_farthest(seen, j, chunks_.data());
        if (!has_data(image, j)) fill_row(image, j, unseen);
        lift_row(image, seen, j);
    }
    lift_beside(image, seen, rejected);
}

/// Finds the background of holes, in squares. False: there is no data anywhere.
bool LargeHoleFiller::find_behind(const DepthImage& image) {
    if (!behind_.build(image)) return false;
    find_wide_and_open(image.columns);
    behind_.fill();
    return true;
}

/// Finds, in squares, where discs without data have room: discs too wide for a small hole (wide),
/// and discs too wide to be bridged (open).
void LargeHoleFiller::find_wide_and_open(int columns) {
    const DepthImage& grid = behind_.squares();
    cv::Mat1b empty(grid.rows, grid.columns);
    std::transform(grid.levels.begin(), grid.levels.end(), empty.begin(),
                   [](float level) { return is_data(level) ? 0 : 255; });
    cv::Mat1f to_data;
    cv::distanceTransform(empty, to_data, cv::DIST_L2, cv::DIST_MASK_5);
    const auto squares = [columns](double part) {
        return static_cast<float>(columns / part / LevelPyramid::kSquare_px);
    };
    room_for_discs(to_data, squares(2.0 * kSmallInWidth), kWideMargin_squares, wide_);
    room_for_discs(to_data, squares(kOpenInWidth), 0.0F, open_);
    // Not open within a fingertip's reach of data.
    std::transform(to_data.begin(), to_data.end(), open_.begin(), open_.begin(),
                   [](float away, float room) { return std::min(away - kReach_squares, room); });
}

/// Computes the spans of the rows within reach of row `row`: the lowest level of each pixel's
/// neighbours left and right, for each width that a row of the disc has.
void LargeHoleFiller::widen(const DepthImage& seen, int row) {
    const auto columns = static_cast<std::size_t>(seen.columns);
    spans_.resize(kDiscRows * kSpans * columns);
    padded_.assign(columns + 2 * std::size_t{kReach_px}, kAbove);
    eight_.resize(padded_.size() - 7);
    above_.assign(columns, kAbove);
    widened_ = std::max(widened_, row - kReach_px);
    for (; widened_ < std::min(row + kReach_px + 1, seen.rows); ++widened_) {
        make_holes_infinite(seen.levels.data() + seen.index(0, widened_),
                            padded_.data() + kReach_px, columns);
        lowest_of_eight(padded_.data(), eight_.data(), eight_.size());
        std::array<float*, kSpans> spans{};
        for (std::size_t k = 0; k < kSpans; ++k) spans[k] = span_of(widened_, k, columns);
        find_lowest_of_spans(padded_.data(), eight_.data(), spans, columns);
    }
}

float* LargeHoleFiller::span_of(int row, std::size_t number, std::size_t columns) {
    const auto line = static_cast<std::size_t>(row % static_cast<int>(kDiscRows)) * kSpans + number;
    return spans_.data() + line * columns;
}

/// The lowest level within reach, in those chunks of the row that are marked and have holes.
void LargeHoleFiller::find_farthest(const DepthImage& seen, int row, const std::uint8_t* chunks) {
    widen(seen, row);
    const auto columns = static_cast<std::size_t>(seen.columns);
    farthest_.assign(columns, kAbove);
    std::array<const float*, kDiscRows> disc{};
    for (std::size_t n = 0; n < kDiscRows; ++n) {
        const int k = static_cast<int>(n) - kReach_px;
        const int j = row + k;
        disc[n] = j < 0 || j >= seen.rows
                      ? above_.data()
                      : span_of(j, kSpanOfRow[static_cast<std::size_t>(std::abs(k))], columns);
    }
    const float* levels = seen.levels.data() + seen.index(0, row);
    for (std::size_t begin = 0; begin < columns; begin += kChunk) {
        const std::size_t count = std::min(kChunk, columns - begin);
        if (chunks[begin / kChunk] == 0 || !has_holes(levels + begin, count)) continue;
        for (std::size_t k = 0; k < kDiscRows; k += 7)
            lower(disc.data() + k, begin, farthest_.data() + begin, count);
    }
}

void LargeHoleFiller::fill_row(DepthImage& image, int row, std::vector<std::uint8_t>& unseen) {
    behind_.spread(behind_.squares().levels, row, level_row_);
    behind_.spread(wide_, row, wide_row_);
    behind_.spread(open_, row, open_row_);
    const std::size_t at = image.index(0, row);
    fill_holes(image.levels.data() + at, unseen.data() + at, level_row_.data(), wide_row_.data(),
               open_row_.data(), farthest_.data(), outline_levels(image),
               static_cast<std::size_t>(image.columns));
}

void LargeHoleFiller::lift_row(DepthImage& image, const DepthImage& seen, int row) const {
    const std::size_t at = image.index(0, row);
    lift(seen.levels.data() + at, farthest_.data(), kPit * static_cast<float>(image.highest_level),
         image.levels.data() + at, static_cast<std::size_t>(image.columns));
}

/// Refused pixels count with their new level, so the surface does not fall away beside them.
void LargeHoleFiller::lift_beside(DepthImage& image, const DepthImage& seen,
                                  std::span<const std::size_t> rejected) {
    if (rejected.empty()) return;
    given_ = seen;
    for (const std::size_t pixel : rejected) given_.levels[pixel] = image.levels[pixel];
    mark_chunks(image, rejected);
    const std::size_t across = chunks_in(image.columns);
    std::vector<std::uint8_t> near(across);
    widened_ = 0;
    for (int j = 0; j < image.rows; ++j) {
        std::fill(near.begin(), near.end(), std::uint8_t{0});
        for (int y = std::max(j - kReach_px, 0); y <= std::min(j + kReach_px, image.rows - 1); ++y)
            for (std::size_t x = 0; x < across; ++x)
                near[x] = static_cast<std::uint8_t>(
                    near[x] | chunks_[static_cast<std::size_t>(y) * across + x]);
        if (std::memchr(near.data(), 1, across) == nullptr || has_data(seen, j)) continue;
        find_farthest(given_, j, near.data());
        lift_row(image, seen, j);
    }
}

/// Marks chunks that have a refused pixel of their row within reach.
void LargeHoleFiller::mark_chunks(const DepthImage& image, std::span<const std::size_t> rejected) {
    const auto columns = static_cast<std::size_t>(image.columns);
    const std::size_t across = chunks_in(image.columns);
    chunks_.assign(across * static_cast<std::size_t>(image.rows), 0);
    for (const std::size_t pixel : rejected) {
        const std::size_t column = pixel % columns;
        const std::size_t first = column - std::min<std::size_t>(column, kReach_px);
        const std::size_t last = std::min(column + kReach_px, columns - 1);
        for (std::size_t x = first / kChunk; x <= last / kChunk; ++x)
            chunks_[pixel / columns * across + x] = 1;
    }
}

}  // namespace dibhr
