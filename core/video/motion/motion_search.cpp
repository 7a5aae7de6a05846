// Tries all ways in the smallest pictures.
#include "core/video/motion/motion_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "core/video/frames/vector_clones.hpp"

namespace dibhr {

namespace {

constexpr int kAround = 2;  // cells to each side that are compared with one
constexpr int kSide = 2 * kAround + 1;
constexpr auto kPlanes = std::size_t{kSide} * std::size_t{kSide};
constexpr float kMostOff = 40.0F;   // upper limit of a difference, of grey and of depth
constexpr float kOutside = 20.0F;   // difference of cells that move out of the picture
constexpr float kPerCell = 0.02F;   // cost of a way for each cell of its length
constexpr float kStayShare = 0.9F;  // factor and offset that favour no motion
constexpr float kStayLess = 0.2F;

/// Index of the plane of weights for the cell this many away.
constexpr std::size_t tap_of(int right, int down) {
    return static_cast<std::size_t>(down + kAround) * kSide +
           static_cast<std::size_t>(right + kAround);
}

struct Compared {
    const float *grey, *moved_grey, *near, *moved_near;
    float gain;
};

DIBHR_VECTOR_CLONES void compare_row(const Compared& row, float* __restrict off, int begin,
                                     int end) {
    const float gain = row.gain;
    for (int i = begin; i < end; ++i) {
        const float grey = std::fabs(gain * row.moved_grey[i] - row.grey[i]);
        const float near = std::fabs(row.moved_near[i] - row.near[i]);
        off[i] = std::min(grey, kMostOff) + std::min(near, kMostOff);
    }
}

/// Differences and weights from a cell on; weights lie in planes.
struct Scored {
    const float* off;
    std::ptrdiff_t columns;
    const float* weights;
    std::size_t plane;
};

/// Cells in a row that are scored together, so that their sums stay in registers.
constexpr std::ptrdiff_t kAtOnce = 64;

DIBHR_VECTOR_CLONES void score_cells(const Scored& scored, float* __restrict score) {
    std::array<float, kAtOnce> sums{};
    for (int y = -kAround; y <= kAround; ++y)
        for (int x = -kAround; x <= kAround; ++x) {
            const float* const off = scored.off + y * scored.columns + x;
            const auto tap = tap_of(x, y);
            const float* const weights = scored.weights + tap * scored.plane;
            for (std::size_t i = 0; i < kAtOnce; ++i) sums[i] += weights[i] * off[i];
        }
    for (std::size_t i = 0; i < kAtOnce; ++i) score[i] = sums[i];
}

DIBHR_VECTOR_CLONES void take_better(const float* __restrict score, float share, float more,
                                     MotionField::Way way, float* __restrict best,
                                     float* __restrict right, float* __restrict down,
                                     std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
        const float off = share * score[i] + more;
        const bool better = off < best[i];
        best[i] = better ? off : best[i];
        right[i] = better ? way.right : right[i];
        down[i] = better ? way.down : down[i];
    }
}

}  // namespace

/// Weights of the cells around each cell, which add up to 1.
void MotionSearcher::weigh(const MotionSide& from, const SimilarParts& similar) {
    const std::size_t count = from.cells.threshold.values.size();
    const std::size_t plane = count + kAtOnce;
    weights_.assign(kPlanes * plane, 0.0F);
    std::vector<float>& sum = score_;
    sum.assign(plane, 0.0F);
    for (int y = -kAround; y <= kAround; ++y)
        for (int x = -kAround; x <= kAround; ++x) {
            const float* const alike = similar.near_beside(x, y);
            for (std::size_t k = 0; k < count; ++k) sum[k] += alike[k];
        }
    for (std::size_t k = 0; k < count; ++k) sum[k] = 1.0F / sum[k];  // > 0: each is like itself
    for (int y = -kAround; y <= kAround; ++y)
        for (int x = -kAround; x <= kAround; ++x) {
            const float* const alike = similar.near_beside(x, y);
            const auto tap = tap_of(x, y);
            float* const weights = weights_.data() + tap * plane;
            for (std::size_t k = 0; k < count; ++k) weights[k] = alike[k] * sum[k];
        }
}

/// Compares the wanted rows and those around. Values between rows and beyond them have weight 0.
void MotionSearcher::compare(const MotionPictures& from, const MotionPictures& to, float gain,
                             const MotionRows& rows, int right, int down) {
    const MotionPlane& grey = from.grey.back();
    const int columns = grey.columns;
    const int begin = std::clamp(-right, 0, columns);
    const int end = std::clamp(columns - right, begin, columns);
    for (int j = std::max(rows.begin - kAround, 0); j < std::min(rows.end + kAround, grey.rows);
         ++j) {
        float* const off = off_.data() + margin_ + std::ptrdiff_t{j} * columns;
        const bool inside = j + down >= 0 && j + down < grey.rows;
        const int first = inside ? begin : columns;
        std::fill(off, off + first, kOutside);
        if (!inside) continue;
        std::fill(off + end, off + columns, kOutside);
        const Compared row{grey.row(j), to.grey.back().row(j + down) + right,
                           from.near.back().row(j), to.near.back().row(j + down) + right, gain};
        compare_row(row, off, begin, end);
    }
}

void MotionSearcher::attempt(const MotionRows& rows, int right, int down, MotionWays& ways) {
    const std::size_t plane = score_.size();
    const auto end = static_cast<std::size_t>(rows.end * columns_);
    const auto begin = static_cast<std::size_t>(rows.begin * columns_);
    for (std::size_t at = begin; at < end; at += kAtOnce)
        score_cells({off_.data() + margin_ + at, columns_, weights_.data() + at, plane},
                    score_.data() + at);
    const bool stays = right == 0 && down == 0;
    const float far = kPerCell * static_cast<float>(std::abs(right) + std::abs(down));
    const MotionField::Way way{static_cast<float>(right * kMotionCell_px),
                               static_cast<float>(down * kMotionCell_px)};
    take_better(score_.data() + begin, stays ? kStayShare : 1.0F, stays ? -kStayLess : far, way,
                best_.data() + begin, ways.right.of[0].values.data() + begin,
                ways.down.of[0].values.data() + begin, end - begin);
}

/// A group's differences are added up: parts of its outline alone leave the way along it open.
void MotionSearcher::attempt_groups(const PlainParts& plain, int right, int down) {
    group_score_.assign(plain.groups(),
                        kPerCell * static_cast<float>(std::abs(right) + std::abs(down)));
    for (const PlainParts::Part& part : plain.parts())
        if (part.part == 0) group_score_[part.group] += score_[part.k];
    for (std::size_t group = 0; group < plain.groups(); ++group) {
        if (!(group_score_[group] < group_best_[group])) continue;
        group_best_[group] = group_score_[group];
        group_ways_[group] = {static_cast<float>(right * kMotionCell_px),
                              static_cast<float>(down * kMotionCell_px)};
    }
}

/// Far parts take the way of the most similar near part around.
void MotionSearcher::follow(const MotionCells& cells, MotionWays& ways) const {
    for (const std::uint32_t k : cells.split) {
        const int i = static_cast<int>(k) % cells.columns;
        const int j = static_cast<int>(k) / cells.columns;
        float most = 0.0F;
        for (int y = std::max(j - kAround, 0); y <= std::min(j + kAround, cells.rows - 1); ++y)
            for (int x = std::max(i - kAround, 0); x <= std::min(i + kAround, cells.columns - 1);
                 ++x) {
                const std::size_t beside = cells.threshold.index(x, y);
                const float gap =
                    std::max(cells.lowest.of[1].values[k] - cells.highest.of[0].values[beside],
                             cells.lowest.of[0].values[beside] - cells.highest.of[1].values[k]);
                const auto away = static_cast<float>(std::abs(x - i) + std::abs(y - j));
                const float weight = alike_across(gap) / (1.0F + away);
                if (!(weight > most)) continue;
                most = weight;
                ways.right.of[1].values[k] = ways.right.of[0].values[beside];
                ways.down.of[1].values[k] = ways.down.of[0].values[beside];
            }
    }
}

void MotionSearcher::search(const MotionSide& from, const MotionSide& to, float gain,
                            const SimilarParts& similar, const PlainParts& plain,
                            const MotionRows& rows, int reach, MotionWays& ways) {
    const MotionCells& cells = from.cells;
    ways.resize(cells.columns, cells.rows);
    ways.fill(0.0F);
    best_.assign(cells.threshold.values.size(), 1e9F);
    columns_ = cells.columns;
    margin_ = static_cast<std::size_t>(kAround * (columns_ + 1));
    off_.assign(best_.size() + 2 * margin_ + kAtOnce, kOutside);
    group_best_.assign(plain.groups(), 1e9F);
    group_ways_.assign(plain.groups(), {});
    weigh(from, similar);
    for (int down = -reach; down <= reach; ++down)
        for (int right = -reach; right <= reach; ++right) {
            compare(from.pictures, to.pictures, gain, rows, right, down);
            attempt(rows, right, down, ways);
            attempt_groups(plain, right, down);
        }
    follow(cells, ways);
    // Far parts alone have no score: they keep what they follow.
    std::vector<std::uint8_t> has_near(plain.groups(), 0);
    for (const PlainParts::Part& part : plain.parts())
        if (part.part == 0) has_near[part.group] = 1;
    for (const PlainParts::Part& part : plain.parts()) {
        if (has_near[part.group] == 0) continue;
        ways.right.of[part.part].values[part.k] = group_ways_[part.group].right;
        ways.down.of[part.part].values[part.k] = group_ways_[part.group].down;
    }
}

}  // namespace dibhr
