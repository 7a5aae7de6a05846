// Interpolates between the middles of four cells.
#include "core/video/motion/motion_spread.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "core/video/frames/vector_clones.hpp"

namespace dibhr {

namespace {

constexpr float kWhite = 255.0F;
constexpr float kLeastShare = 1e-3F;  // share of a cell whose middle is one cell away

/// The parts of four cells around some pixels.
struct Around {
    struct Part {
        float lowest, highest;
        MotionField::Way way;
        std::size_t corner;
    };
    std::array<Part, 8> parts{};
    std::size_t count{0};
    bool goes{false};  ///< any of them moves
};

Around parts_around(const MotionCells& cells, const MotionWays& ways, int i, int j) {
    Around around;
    for (std::size_t corner = 0; corner < 4; ++corner) {
        const int x = std::clamp(i + static_cast<int>(corner % 2), 0, cells.columns - 1);
        const int y = std::clamp(j + static_cast<int>(corner / 2), 0, cells.rows - 1);
        for (std::size_t part = 0; part < 2; ++part) {
            if (!cells.has(part, x, y)) continue;
            const MotionField::Way way{ways.right.of[part].row(y)[x], ways.down.of[part].row(y)[x]};
            around.goes = around.goes || way != MotionField::Way{};
            around.parts[around.count++] = {cells.lowest.of[part].row(y)[x],
                                            cells.highest.of[part].row(y)[x], way, corner};
        }
    }
    return around;
}

/// Where pixels of a row lie between the middles, in [0, 1]: each to the right, and the row down.
struct Between {
    const float* right;
    float down;
};

DIBHR_VECTOR_CLONES void fill_row(const Around& around, const float* __restrict levels, float scale,
                                  const Between& between, float px,
                                  MotionField::Way* __restrict ways) {
    std::array<float, kMotionCell_px> sum{}, right{}, down{};
    for (std::size_t k = 0; k < around.count; ++k) {
        const Around::Part& part = around.parts[k];
        // 1 - x or x.
        const float from_x = part.corner % 2 == 0 ? 1.0F : 0.0F;
        const float per_x = part.corner % 2 == 0 ? -1.0F : 1.0F;
        const float of_row = part.corner / 2 == 0 ? 1.0F - between.down : between.down;
        for (std::size_t i = 0; i < kMotionCell_px; ++i) {
            const float level = scale * levels[i];
            const float share = (of_row * (from_x + per_x * between.right[i]) + kLeastShare) *
                                alike_across(std::max(part.lowest - level, level - part.highest));
            sum[i] += share;
            right[i] += share * part.way.right;
            down[i] += share * part.way.down;
        }
    }
    for (std::size_t i = 0; i < kMotionCell_px; ++i) {
        const float inverse = sum[i] > 0.0F ? px / sum[i] : 0.0F;
        ways[i] = {inverse * right[i], inverse * down[i]};
    }
}

/// The pixels between the middles of cells (i, j) and (i + 1, j + 1).
struct Tile {
    int left, top, right, bottom;
};

Tile tile_of(const DepthImage& depth, int side, int i, int j) {
    const int half = side / 2;
    return {std::max(i * side + half, 0), std::max(j * side + half, 0),
            std::min((i + 1) * side + half, depth.columns),
            std::min((j + 1) * side + half, depth.rows)};
}

void fill_tile(const DepthImage& depth, const Around& around, const Tile& tile, int step,
               MotionField& field) {
    const int side = kMotionCell_px * step;
    const float scale = kWhite / static_cast<float>(depth.highest_level);
    const auto between = [side](int at) {
        const float cells = (static_cast<float>(at) + 0.5F) / static_cast<float>(side) + 0.5F;
        return cells - std::floor(cells);
    };
    const auto px = static_cast<float>(step);
    // Tiles at the picture's border are not whole.
    std::array<float, kMotionCell_px> levels{}, right{};
    std::array<MotionField::Way, kMotionCell_px> ways{};
    for (int begin = tile.left; begin < tile.right; begin += kMotionCell_px) {
        const auto count = static_cast<std::size_t>(std::min(tile.right - begin, kMotionCell_px));
        for (int x = 0; x < kMotionCell_px; ++x)
            right[static_cast<std::size_t>(x)] = between(begin + x);
        for (int j = tile.top; j < tile.bottom; ++j) {
            const std::size_t k = depth.index(begin, j);
            if (count == kMotionCell_px) {
                fill_row(around, depth.levels.data() + k, scale, {right.data(), between(j)}, px,
                         field.ways.data() + k);
                continue;
            }
            std::copy_n(depth.levels.data() + k, count, levels.data());
            fill_row(around, levels.data(), scale, {right.data(), between(j)}, px, ways.data());
            std::copy_n(ways.data(), count, field.ways.data() + k);
        }
    }
}

}  // namespace

std::shared_ptr<const MotionField> spread_motion(const DepthImage& depth, const MotionCells& cells,
                                                 int step, const MotionWays& ways,
                                                 ObjectPool<MotionField>& fields) {
    std::shared_ptr<MotionField> field;
    for (int j = -1; j < cells.rows; ++j)
        for (int i = -1; i < cells.columns; ++i) {
            const Around around = parts_around(cells, ways, i, j);
            if (!around.goes) continue;
            if (!field) {
                field = fields.take();
                field->columns = depth.columns;
                field->rows = depth.rows;
                field->ways.assign(depth.levels.size(), {});
            }
            fill_tile(depth, around, tile_of(depth, kMotionCell_px * step, i, j), step, *field);
        }
    return field;
}

}  // namespace dibhr
