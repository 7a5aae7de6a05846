// Which vertices of the depth image are drawn.
#include "render/relief_grid.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace dibhr {

namespace {

// 10 x 17 cells are 340 triangles on 198 vertices. Mesa's software pipeline shades vertices in runs
// of 1023 indices (341 triangles) with a map of 256 vertices, so a tile fits one run.
constexpr int kTileColumns = 17;
constexpr int kTileRows = 10;

void add_cell(const GridTile& tile, int i, int j, std::vector<std::uint32_t>& indices) {
    const auto width = static_cast<std::uint32_t>(tile.right - tile.left + 1);
    const auto here = tile.first_vertex + static_cast<std::uint32_t>(j - tile.top) * width +
                      static_cast<std::uint32_t>(i - tile.left);
    const auto below = here + width;
    indices.insert(indices.end(), {here, below, here + 1, below, below + 1, here + 1});
}

void add_tile(GridMesh& mesh, int left, int top, int right, int bottom) {
    const GridTile tile{left,
                        top,
                        right,
                        bottom,
                        static_cast<std::uint32_t>(mesh.vertices.size()),
                        static_cast<std::uint32_t>(mesh.indices.size())};
    mesh.tiles.push_back(tile);
    for (int j = top; j <= bottom; ++j) {
        for (int i = left; i <= right; ++i) {
            mesh.vertices.push_back({static_cast<std::uint16_t>(i), static_cast<std::uint16_t>(j)});
        }
    }
    for (int j = top; j < bottom; ++j)
        for (int i = left; i < right; ++i) add_cell(tile, i, j, mesh.indices);
}

std::uint32_t index_count(const GridTile& tile) {
    constexpr int kOfCell = 6;
    return static_cast<std::uint32_t>(kOfCell * (tile.right - tile.left) *
                                      (tile.bottom - tile.top));
}

/// Calls `visit` with column, row and whether the cell is cut; false from it ends the loop.
template <class Visit>
void each_cell(const GridTile& tile, const ReliefGrid& grid, const std::vector<float>& cut,
               const Visit& visit) {
    const auto columns = static_cast<std::size_t>(grid.columns());
    for (int j = tile.top; j < tile.bottom; ++j) {
        const float* const row = cut.data() + static_cast<std::size_t>(j) * columns;
        for (int i = tile.left; i < tile.right; ++i)
            if (!visit(i, j, row[i] > 0.0F)) return;
    }
}

}  // namespace

int ReliefGrid::image_i(int i) const noexcept {
    return std::min(i * step, image_columns - 1);
}
int ReliefGrid::image_j(int j) const noexcept {
    return std::min(j * step, image_rows - 1);
}

ReliefGrid plan_grid(int image_columns, int image_rows, std::size_t most_vertices, int most_side) {
    ReliefGrid grid{image_columns, image_rows, 1};
    if (!grid.drawable()) return grid;
    const int side = std::clamp(most_side, 2, 65536);
    const auto vertices = std::max<std::size_t>(most_vertices, 4);
    while (static_cast<std::size_t>(grid.columns()) * static_cast<std::size_t>(grid.rows()) >
               vertices ||
           std::max(grid.columns(), grid.rows()) > side) {
        ++grid.step;
    }
    return grid;
}

GridMesh tile_grid(const ReliefGrid& grid) {
    GridMesh mesh;
    if (!grid.drawable()) return mesh;
    const auto cells =
        static_cast<std::size_t>(grid.columns()) * static_cast<std::size_t>(grid.rows());
    mesh.vertices.reserve(cells + cells / 4);
    mesh.indices.reserve(cells * 6);
    for (int top = 0; top < grid.rows() - 1; top += kTileRows) {
        for (int left = 0; left < grid.columns() - 1; left += kTileColumns) {
            add_tile(mesh, left, top, std::min(left + kTileColumns, grid.columns() - 1),
                     std::min(top + kTileRows, grid.rows() - 1));
        }
    }
    return mesh;
}

void leave_out(const std::vector<float>& cut, const ReliefGrid& grid,
               const std::vector<GridTile>& tiles, UncutMesh& uncut) {
    uncut.whole.clear();
    uncut.rest.clear();
    bool continues = false;
    for (const GridTile& tile : tiles) {
        bool whole = true;
        each_cell(tile, grid, cut, [&whole](int, int, bool is_cut) { return whole = !is_cut; });
        if (whole && continues)
            uncut.whole.back().count += index_count(tile);
        else if (whole)
            uncut.whole.push_back({tile.first_index, index_count(tile)});
        else
            each_cell(tile, grid, cut, [&](int i, int j, bool is_cut) {
                if (!is_cut) add_cell(tile, i, j, uncut.rest);
                return true;
            });
        continues = whole;
    }
}

std::vector<GridVertex> border_strip(const ReliefGrid& grid) {
    std::vector<GridVertex> strip;
    if (!grid.drawable()) return strip;
    const int right = grid.columns() - 1;
    const int bottom = grid.rows() - 1;
    const auto add = [&](int i, int j) {
        const GridVertex vertex{static_cast<std::uint16_t>(i), static_cast<std::uint16_t>(j)};
        strip.insert(strip.end(), {vertex, vertex});
    };
    for (int i = 0; i < right; ++i) add(i, 0);
    for (int j = 0; j < bottom; ++j) add(right, j);
    for (int i = right; i > 0; --i) add(i, bottom);
    for (int j = bottom; j >= 0; --j) add(0, j);
    return strip;
}

}  // namespace dibhr
