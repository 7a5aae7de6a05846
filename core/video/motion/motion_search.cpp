// All ways, in the smallest pictures.
#include "core/video/motion/motion_search.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "core/video/vector_clones.hpp"

namespace dibhr {

namespace {

constexpr int kAround = 2;  // cells to each side that are compared with one
constexpr int kSide = 2 * kAround + 1;
constexpr auto kPlanes = std::size_t{kSide} * std::size_t{kSide};
constexpr float kMostOff = 40.0F;   // of grey, and of depth: what is farther off is as bad
constexpr float kOutside = 20.0F;   // of what goes beyond the picture
constexpr float kPerCell = 0.02F;   // what a longer way must be better by
constexpr float kStayShare = 0.9F;  // of what staying is off
constexpr float kStayLess = 0.2F;

struct Compared {
    const float *grey, *moved_grey, *near, *moved_near;
};

DIBHR_VECTOR_CLONES void compare_row(const Compared& row, float* __restrict off, int begin,
                                     int end) {
    for (int i = begin; i < end; ++i) {
        const float grey = std::fabs(row.moved_grey[i] - row.grey[i]);
        const float near = std::fabs(row.moved_near[i] - row.near[i]);
        off[i] = std::min(grey, kMostOff) + std::min(near, kMostOff);
    }
}

/// Begins kAround cells up left of the first one; weights lie in planes.
struct Scored {
    const float* off;
    int off_stride;
    const float* weights;
    std::size_t plane;
};

DIBHR_VECTOR_CLONES void score_row(const Scored& scored, int count, float* __restrict score) {
    for (int i = 0; i < count; ++i) score[i] = 0.0F;
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
            const float* __restrict from =
                scored.off + static_cast<std::ptrdiff_t>(y) * scored.off_stride + x;
            const float* __restrict weight =
                scored.weights + static_cast<std::size_t>(y * kSide + x) * scored.plane;
            for (int i = 0; i < count; ++i) score[i] += weight[i] * from[i];
        }
}

}  // namespace

/// In the smallest picture a cell is a pixel of its near part.
void MotionSearcher::weigh(const MotionCells& cells, const MotionSpans& spans) {
    const std::size_t plane = cells.lowest.of[0].values.size();
    weights_.assign(2 * kPlanes * plane, 0.0F);
    for (std::size_t part = 0; part < 2; ++part)
        for (int j = 0; j < cells.rows; ++j) {
            const MotionSpan span = spans[static_cast<std::size_t>(j)];
            for (int i = span.begin; i < span.end; ++i) {
                if (!cells.has(part, i, j)) continue;
                const std::size_t at = cells.between.index(i, j);
                float* const weights = weights_.data() + part * kPlanes * plane + at;
                const float lowest = cells.lowest.of[part].values[at];
                const float highest = cells.highest.of[part].values[at];
                float sum = 0.0F;
                for (int y = std::max(j - kAround, 0); y <= std::min(j + kAround, cells.rows - 1);
                     ++y)
                    for (int x = std::max(i - kAround, 0);
                         x <= std::min(i + kAround, cells.columns - 1); ++x) {
                        const float low = cells.lowest.of[0].row(y)[x];
                        const float high = cells.highest.of[0].row(y)[x];
                        const int k = (y - j + kAround) * kSide + x - i + kAround;
                        const float alike = alike_across(std::max(lowest - high, low - highest));
                        weights[static_cast<std::size_t>(k) * plane] = alike;
                        sum += alike;
                    }
                for (std::size_t k = 0; sum > 0.0F && k < kPlanes; ++k)
                    weights[k * plane] *= 1.0F / sum;
            }
        }
}

void MotionSearcher::compare(const MotionPictures& from, const MotionPictures& to, int right,
                             int down) {
    const MotionPlane& grey = from.grey.back();
    std::fill(off_.values.begin(), off_.values.end(), kOutside);
    for (int j = std::max(-down, 0); j < grey.rows - std::max(down, 0); ++j) {
        const Compared row{grey.row(j), to.grey.back().row(j + down) + right,
                           from.near.back().row(j), to.near.back().row(j + down) + right};
        float* const off = off_.row(j + kAround) + kAround;
        compare_row(row, off, std::max(-right, 0), grey.columns - std::max(right, 0));
    }
}

void MotionSearcher::attempt(const MotionCells& cells, const MotionSpans& spans, int right,
                             int down, MotionWays& ways) {
    const int rows = score_.of[0].rows;
    const std::size_t plane = score_.of[0].values.size();
    const bool stays = right == 0 && down == 0;
    const float far = kPerCell * static_cast<float>(std::abs(right) + std::abs(down));
    for (std::size_t part = 0; part < 2; ++part)
        for (int j = 0; j < rows; ++j) {
            const MotionSpan span = spans[static_cast<std::size_t>(j)];
            if (span.begin >= span.end || !cells.any_in_row(part, j)) continue;
            const std::size_t at = cells.between.index(span.begin, j);
            float* const score = score_.of[part].row(j);
            const Scored scored{off_.row(j) + span.begin, off_.columns,
                                weights_.data() + part * kPlanes * plane + at, plane};
            score_row(scored, span.end - span.begin, score + span.begin);
            for (int i = span.begin; i < span.end; ++i) {
                const float off = stays ? kStayShare * score[i] - kStayLess : score[i] + far;
                if (!(off < best_.of[part].row(j)[i])) continue;
                best_.of[part].row(j)[i] = off;
                ways.right.of[part].row(j)[i] = static_cast<float>(right * kMotionCell_px);
                ways.down.of[part].row(j)[i] = static_cast<float>(down * kMotionCell_px);
            }
        }
}

void MotionSearcher::search(const MotionPictures& from, const MotionPictures& to,
                            const MotionCells& cells, const MotionSpans& spans, int reach,
                            MotionWays& ways) {
    ways.resize(cells.columns, cells.rows);
    ways.fill(0.0F);
    score_.resize(cells.columns, cells.rows);
    best_.resize(cells.columns, cells.rows);
    best_.fill(1e9F);
    off_.resize(cells.columns + 2 * kAround, cells.rows + 2 * kAround);
    weigh(cells, spans);
    for (int down = -reach; down <= reach; ++down)
        for (int right = -reach; right <= reach; ++right) {
            compare(from, to, right, down);
            attempt(cells, spans, right, down, ways);
        }
}

}  // namespace dibhr
