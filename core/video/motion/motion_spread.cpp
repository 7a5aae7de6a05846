// Between the middles of four cells.
#include "core/video/motion/motion_spread.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace dibhr {

namespace {

constexpr float kWhite = 255.0F;
constexpr float kLeastShare = 1e-3F;  // of a cell whose middle is a whole cell away

/// The parts of four cells around some pixels.
struct Around {
    struct Part {
        float lowest, highest;
        MotionField::Way way;
        std::size_t corner;
    };
    std::array<Part, 8> parts{};
    std::size_t count{0};
    bool goes{false};  ///< any of them
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

/// `level` [0, 255], at (x, y) between the middles, in [0, 1].
MotionField::Way way_at(const Around& around, float level, float x, float y) {
    const std::array<float, 4> shares{(1.0F - x) * (1.0F - y), x * (1.0F - y), (1.0F - x) * y,
                                      x * y};
    float sum = 0.0F;
    MotionField::Way way{};
    for (std::size_t k = 0; k < around.count; ++k) {
        const Around::Part& part = around.parts[k];
        const float share = (shares[part.corner] + kLeastShare) *
                            alike_across(std::max(part.lowest - level, level - part.highest));
        sum += share;
        way.right += share * part.way.right;
        way.down += share * part.way.down;
    }
    if (!(sum > 0.0F)) return {};
    return {way.right / sum, way.down / sum};
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
    for (int j = tile.top; j < tile.bottom; ++j)
        for (int i = tile.left; i < tile.right; ++i) {
            const std::size_t k = depth.index(i, j);
            const MotionField::Way way =
                way_at(around, scale * depth.levels[k], between(i), between(j));
            field.ways[k] = {px * way.right, px * way.down};
        }
}

}  // namespace

std::shared_ptr<const MotionField> spread_motion(const DepthImage& depth, const MotionCells& cells,
                                                 int step, const MotionWays& ways) {
    std::shared_ptr<MotionField> field;
    for (int j = -1; j < cells.rows; ++j)
        for (int i = -1; i < cells.columns; ++i) {
            const Around around = parts_around(cells, ways, i, j);
            if (!around.goes) continue;
            if (!field) {
                field = std::make_shared<MotionField>();
                field->columns = depth.columns;
                field->rows = depth.rows;
                field->ways.resize(depth.levels.size());
            }
            fill_tile(depth, around, tile_of(depth, kMotionCell_px * step, i, j), step, *field);
        }
    return field;
}

}  // namespace dibhr
