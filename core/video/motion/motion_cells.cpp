// Splits cells into a near and a far part, and sums over similar parts.
#include "core/video/motion/motion_cells.hpp"

#include <algorithm>
#include <cstdlib>

#include "core/video/frames/vector_clones.hpp"

namespace dibhr {

namespace {

constexpr float kStep = 10.0F;  // least gap between two surfaces in one cell

constexpr int kBins = 32;

/// visit(value) for each pixel of a cell.
template <typename Visit>
void visit_pixels(const MotionPlane& plane, int i, int j, Visit visit) {
    for (int y = 0; y < kMotionCell_px; ++y) {
        const float* row =
            plane.values.data() + plane.index(i * kMotionCell_px, j * kMotionCell_px + y);
        for (int x = 0; x < kMotionCell_px; ++x) visit(row[x]);
    }
}

/// The middle of the widest gap between the depths of a cell; below all depths if it is narrow.
float gap_between(const MotionPlane& depth, int i, int j, float lowest, float highest) {
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

/// The range of all pixels, for each cell of a row.
DIBHR_VECTOR_CLONES void find_range(const MotionPlane& depth, int j, float* __restrict lowest,
                                    float* __restrict highest) {
    const auto count = static_cast<std::ptrdiff_t>(depth.columns / kMotionCell_px);
    const float* const first = depth.row(j * kMotionCell_px);
    for (std::ptrdiff_t i = 0; i < count; ++i) {
        std::array<float, kMotionCell_px> low{}, high{};
        const float* row = first + i * kMotionCell_px;
        for (std::size_t x = 0; x < kMotionCell_px; ++x) low[x] = high[x] = row[x];
        for (int y = 1; y < kMotionCell_px; ++y) {
            row += depth.columns;
            for (std::size_t x = 0; x < kMotionCell_px; ++x) {
                low[x] = std::min(low[x], row[x]);
                high[x] = std::max(high[x], row[x]);
            }
        }
        lowest[i] = *std::min_element(low.begin(), low.end());
        highest[i] = *std::max_element(high.begin(), high.end());
    }
}

/// Splits a cell into a near and a far part, where there is a gap.
void split_cell(const MotionPlane& depth, MotionCells& cells, int i, int j) {
    const std::size_t k = cells.threshold.index(i, j);
    const float threshold =
        gap_between(depth, i, j, cells.lowest.of[0].values[k], cells.highest.of[0].values[k]);
    cells.threshold.values[k] = threshold;
    if (threshold < cells.lowest.of[0].values[k]) return;
    cells.split.push_back(static_cast<std::uint32_t>(k));
    std::array<float, 2> lowest{-MotionCells::kNoPart, -MotionCells::kNoPart};
    std::array<float, 2> highest{MotionCells::kNoPart, MotionCells::kNoPart};
    visit_pixels(depth, i, j, [&](float value) {
        const std::size_t part = value > threshold ? 0 : 1;
        lowest[part] = std::min(lowest[part], value);
        highest[part] = std::max(highest[part], value);
    });
    for (std::size_t part = 0; part < 2; ++part) {
        cells.lowest.of[part].values[k] = lowest[part];
        cells.highest.of[part].values[k] = highest[part];
    }
}

DIBHR_VECTOR_CLONES void find_alike(const float* __restrict lowest, const float* __restrict highest,
                                    const float* __restrict low, const float* __restrict high,
                                    float* __restrict alike, int count) {
    for (int i = 0; i < count; ++i)
        alike[i] = alike_across(std::max(lowest[i] - high[i], low[i] - highest[i]));
}

DIBHR_VECTOR_CLONES void add_alike(const float* __restrict alike, const float* __restrict source,
                                   float* __restrict sum, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) sum[i] += alike[i] * source[i];
}

void make_cells(const MotionPlane& depth, MotionCells& cells) {
    cells.columns = depth.columns / kMotionCell_px;
    cells.rows = depth.rows / kMotionCell_px;
    cells.threshold.resize(cells.columns, cells.rows);
    cells.lowest.resize(cells.columns, cells.rows);
    cells.highest.resize(cells.columns, cells.rows);
    cells.lowest.fill(-MotionCells::kNoPart);
    cells.highest.fill(MotionCells::kNoPart);
    cells.split.clear();
    for (int j = 0; j < cells.rows; ++j) {
        find_range(depth, j, cells.lowest.of[0].row(j), cells.highest.of[0].row(j));
        for (int i = 0; i < cells.columns; ++i) split_cell(depth, cells, i, j);
    }
}

/// Picks one value of four neighbours; at the right and the bottom of fewer.
template <typename Pick>
void pick_of_four(const MotionPlane& from, MotionPlane& to, const Pick& pick) {
    to.resize(from.columns, from.rows);
    for (int j = 0; j < from.rows; ++j) {
        const float* const upper = from.row(j);
        const float* const lower = from.row(std::min(j + 1, from.rows - 1));
        for (int i = 0; i < from.columns; ++i) {
            const int right = std::min(i + 1, from.columns - 1);
            to.row(j)[i] = pick(pick(upper[i], upper[right]), pick(lower[i], lower[right]));
        }
    }
}

}  // namespace

void split_into_cells(MotionSide& side) {
    make_cells(side.pictures.here[0], side.cells);
    side.lowest = side.cells.lowest.of[0];
    for (const std::uint32_t k : side.cells.split)
        side.lowest.values[k] = side.cells.lowest.of[1].values[k];
    side.highest = side.pictures.near.back();
    pick_of_four(side.lowest, side.lowest_of_four, [](float a, float b) { return std::min(a, b); });
    pick_of_four(side.highest, side.highest_of_four,
                 [](float a, float b) { return std::max(a, b); });
}

void SimilarParts::find_near(const MotionCells& cells, int right, int down) {
    float* const alike = near_.data() + tap(right, down) * count_;
    const int begin = std::max(-right, 0);
    const int end = cells.columns - std::max(right, 0);
    for (int j = std::max(-down, 0); j < cells.rows - std::max(down, 0) && begin < end; ++j)
        find_alike(cells.lowest.of[0].row(j) + begin, cells.highest.of[0].row(j) + begin,
                   cells.lowest.of[0].row(j + down) + begin + right,
                   cells.highest.of[0].row(j + down) + begin + right,
                   alike + cells.threshold.index(begin, j), end - begin);
}

void SimilarParts::find_far(const MotionCells& cells, int i, int j) {
    const auto here = static_cast<std::uint32_t>(cells.threshold.index(i, j));
    const float lowest = cells.lowest.of[1].values[here];
    const float highest = cells.highest.of[1].values[here];
    for (int y = std::max(j - kReach, 0); y <= std::min(j + kReach, cells.rows - 1); ++y)
        for (int x = std::max(i - kReach, 0); x <= std::min(i + kReach, cells.columns - 1); ++x) {
            const auto beside = static_cast<std::uint32_t>(cells.threshold.index(x, y));
            const int away = std::max({std::abs(x - i), std::abs(y - j), 1});
            std::vector<Edge>& edges = far_[static_cast<std::size_t>(away - 1)];
            for (const std::uint8_t part : {std::uint8_t{0}, std::uint8_t{1}}) {
                if (!cells.has(part, x, y)) continue;
                const float alike =
                    alike_across(std::max(lowest - cells.highest.of[part].values[beside],
                                          cells.lowest.of[part].values[beside] - highest));
                if (!(alike > 0.0F)) continue;
                const auto right = static_cast<std::int8_t>(x - i);
                const auto down = static_cast<std::int8_t>(y - j);
                edges.push_back({here, beside, alike, 1, part, right, down});
                if (part == 0)
                    edges.push_back({beside, here, alike, 0, 1, static_cast<std::int8_t>(-right),
                                     static_cast<std::int8_t>(-down)});
            }
        }
}

void SimilarParts::find(const MotionCells& cells) {
    columns_ = cells.columns;
    rows_ = cells.rows;
    count_ = cells.threshold.values.size();
    near_.assign(kSide * kSide * count_ + kMargin, 0.0F);
    for (int down = -kReach; down <= kReach; ++down)
        for (int right = -kReach; right <= kReach; ++right) find_near(cells, right, down);
    for (auto& edges : far_) edges.clear();
    split_ = cells.split;
    for (const std::uint32_t k : cells.split)
        find_far(cells, static_cast<int>(k) % columns_, static_cast<int>(k) / columns_);
}

void SimilarParts::gather(const MotionRows& rows, int reach, MotionMeasure measure,
                          const MotionSums& from, MotionSums& to) const {
    const auto sums = static_cast<std::size_t>(measure);
    to.resize(columns_, rows_);
    const std::ptrdiff_t begin = std::ptrdiff_t{rows.begin} * columns_;
    const std::ptrdiff_t end = std::ptrdiff_t{rows.end} * columns_;
    const auto count = static_cast<std::ptrdiff_t>(count_);
    for (std::size_t k = 0; k < sums; ++k) {
        const float* const source = from.of[k].of[0].values.data();
        float* const sum = to.of[k].of[0].values.data();
        std::fill(sum + begin, sum + end, 0.0F);
        for (const std::uint32_t at : split_) to.of[k].of[1].values[at] = 0.0F;
        for (int down = -reach; down <= reach; ++down)
            for (int right = -reach; right <= reach; ++right) {
                // Beyond the ends of a row nothing is alike.
                const std::ptrdiff_t away = std::ptrdiff_t{down} * columns_ + right;
                const std::ptrdiff_t first = std::max(begin, -away);
                const std::ptrdiff_t last = std::min(end, count - away);
                if (first < last)
                    add_alike(near_beside(right, down) + first, source + first + away, sum + first,
                              static_cast<std::size_t>(last - first));
            }
        for (int away = 0; away < reach; ++away)
            for (const Edge& edge : far_[static_cast<std::size_t>(away)])
                to.of[k].of[edge.to_part].values[edge.to] +=
                    edge.alike * from.of[k].of[edge.from_part].values[edge.from];
    }
}

}  // namespace dibhr
