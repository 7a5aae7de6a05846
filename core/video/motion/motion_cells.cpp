// Cells of one surface or two.
#include "core/video/motion/motion_cells.hpp"

#include <algorithm>

#include "core/video/vector_clones.hpp"

namespace dibhr {

namespace {

constexpr float kStep = 10.0F;  // between two surfaces in one cell; less is one

constexpr int kBins = 32;

/// The pixels of a cell.
template <typename Visit>
void visit_pixels(const MotionPlane& plane, int i, int j, Visit visit) {
    for (int y = 0; y < kMotionCell_px; ++y) {
        const float* row =
            plane.values.data() + plane.index(i * kMotionCell_px, j * kMotionCell_px + y);
        for (int x = 0; x < kMotionCell_px; ++x) visit(row[x]);
    }
}

/// In the middle of the widest gap between the depths of a cell; below all where that is narrow.
float gap_between(const MotionPlane& depth, int i, int j) {
    float lowest = depth.values[depth.index(i * kMotionCell_px, j * kMotionCell_px)];
    float highest = lowest;
    visit_pixels(depth, i, j, [&](float value) {
        lowest = std::min(lowest, value);
        highest = std::max(highest, value);
    });
    const float range = highest - lowest;
    if (!(range > kStep)) return lowest - 1.0F;
    std::array<bool, kBins> any{};
    const float bins_per_level = static_cast<float>(kBins - 1) / range;
    visit_pixels(depth, i, j, [&](float value) {
        any[static_cast<std::size_t>((value - lowest) * bins_per_level)] = true;
    });
    int widest = 0;
    int begin = 0;
    for (int bin = 0, last = 0; bin < kBins; ++bin) {
        if (!any[static_cast<std::size_t>(bin)]) continue;
        if (bin - last > widest) {
            widest = bin - last;
            begin = last;
        }
        last = bin;
    }
    const float gap = static_cast<float>(widest) / bins_per_level;
    if (!(gap > kStep)) return lowest - 1.0F;
    return lowest +
           (static_cast<float>(begin) + 0.5F * static_cast<float>(widest + 1)) / bins_per_level;
}

void make_cell(const MotionPlane& depth, MotionCells& cells, int i, int j) {
    const float between = gap_between(depth, i, j);
    cells.between.row(j)[i] = between;
    std::array<float, 2> lowest{-MotionCells::kNoPart, -MotionCells::kNoPart};
    std::array<float, 2> highest{MotionCells::kNoPart, MotionCells::kNoPart};
    visit_pixels(depth, i, j, [&](float value) {
        const std::size_t part = value > between ? 0 : 1;
        lowest[part] = std::min(lowest[part], value);
        highest[part] = std::max(highest[part], value);
    });
    if (lowest[1] <= highest[1]) cells.both[static_cast<std::size_t>(j)] = 1;
    for (std::size_t part = 0; part < 2; ++part) {
        cells.lowest.of[part].row(j)[i] = lowest[part];
        cells.highest.of[part].row(j)[i] = highest[part];
    }
}

struct Place {
    int j;
    std::size_t part;
};

/// What a row of parts gets of one beside it, `right` cells aside.
struct Pair {
    const MotionCells& cells;
    Place at, beside;
    int right;
    MotionSpan span;  ///< of the row
    std::size_t sums;
};

DIBHR_VECTOR_CLONES void add_alike(const Pair& pair, const MotionSums& from, MotionSums& to,
                                   float* __restrict alike) {
    const MotionCells& cells = pair.cells;
    const int begin = std::max(-pair.right, pair.span.begin);
    const int end = std::min(cells.columns - std::max(pair.right, 0), pair.span.end);
    const float* const lowest = cells.lowest.of[pair.at.part].row(pair.at.j);
    const float* const highest = cells.highest.of[pair.at.part].row(pair.at.j);
    const float* const low = cells.lowest.of[pair.beside.part].row(pair.beside.j) + pair.right;
    const float* const high = cells.highest.of[pair.beside.part].row(pair.beside.j) + pair.right;
    for (int i = begin; i < end; ++i)
        alike[i] = alike_across(std::max(lowest[i] - high[i], low[i] - highest[i]));
    for (std::size_t k = 0; k < pair.sums; ++k) {
        const float* __restrict source =
            from.of[k].of[pair.beside.part].row(pair.beside.j) + pair.right;
        float* __restrict sum = to.of[k].of[pair.at.part].row(pair.at.j);
        for (int i = begin; i < end; ++i) sum[i] += alike[i] * source[i];
    }
}

}  // namespace

void make_cells(const MotionPlane& depth, MotionCells& cells) {
    cells.columns = depth.columns / kMotionCell_px;
    cells.rows = depth.rows / kMotionCell_px;
    cells.between.resize(cells.columns, cells.rows);
    cells.lowest.resize(cells.columns, cells.rows);
    cells.highest.resize(cells.columns, cells.rows);
    cells.both.assign(static_cast<std::size_t>(cells.rows), 0);
    for (int j = 0; j < cells.rows; ++j)
        for (int i = 0; i < cells.columns; ++i) make_cell(depth, cells, i, j);
}

void gather_alike(const MotionCells& cells, const MotionSpans& spans, int reach,
                  MotionMeasure measure, const MotionSums& from, MotionSums& to) {
    const auto count = static_cast<std::size_t>(measure);
    to.resize(cells.columns, cells.rows);
    for (std::size_t k = 0; k < count; ++k) to.of[k].fill(0.0F);
    std::vector<float> alike(static_cast<std::size_t>(cells.columns));
    for (int j = 0; j < cells.rows; ++j) {
        const MotionSpan span = spans[static_cast<std::size_t>(j)];
        if (span.begin >= span.end) continue;
        for (int y = std::max(j - reach, 0); y <= std::min(j + reach, cells.rows - 1); ++y)
            for (std::size_t part = 0; part < 2; ++part)
                for (std::size_t other = 0; other < 2; ++other) {
                    if (!cells.any_in_row(part, j) || !cells.any_in_row(other, y)) continue;
                    for (int x = -reach; x <= reach; ++x)
                        add_alike({cells, {j, part}, {y, other}, x, span, count}, from, to,
                                  alike.data());
                }
    }
}

}  // namespace dibhr
