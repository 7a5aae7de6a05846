// Which vertices of the depth image are drawn, and in what order. Numbers only, no OpenGL.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace dibhr {

/// The drawn grid: every `step`-th vertex of the image, and always the last column and row.
struct ReliefGrid {
    int image_columns{0};
    int image_rows{0};
    int step{1};

    [[nodiscard]] bool drawable() const noexcept { return image_columns >= 2 && image_rows >= 2; }
    [[nodiscard]] int columns() const noexcept { return (image_columns - 2 + step) / step + 1; }
    [[nodiscard]] int rows() const noexcept { return (image_rows - 2 + step) / step + 1; }
    [[nodiscard]] int image_i(int i) const noexcept;  ///< the image column of drawn column i
    [[nodiscard]] int image_j(int j) const noexcept;

    bool operator==(const ReliefGrid&) const = default;
};

/// The finest grid of at most `most_vertices` vertices and `most_side` columns and rows.
[[nodiscard]] ReliefGrid plan_grid(int image_columns, int image_rows, std::size_t most_vertices,
                                   int most_side);

/// One corner of the drawn grid.
struct GridVertex {
    std::uint16_t i{0};
    std::uint16_t j{0};
};

/// A part of the grid that is small enough for a vertex cache, with its own vertices in a row.
struct GridTile {
    int left{0}, top{0}, right{0}, bottom{0};  ///< vertices, all included
    std::uint32_t first_vertex{0};
    std::uint32_t first_index{0};
};

struct GridMesh {
    std::vector<GridVertex> vertices{};
    /// Three a triangle, counter-clockwise seen from above.
    std::vector<std::uint32_t> indices{};
    std::vector<GridTile> tiles{};  ///< row by row
};

/// Consecutive indices of a mesh.
struct IndexRun {
    std::uint32_t first{0};
    std::uint32_t count{0};
};

/// The triangles of a mesh without some of the grid's cells.
struct UncutMesh {
    std::vector<IndexRun> whole{};      ///< tiles without a cut cell, of the mesh's indices
    std::vector<std::uint32_t> rest{};  ///< the uncut cells of the other tiles
};

/// Two triangles a cell; the diagonal of cell (i, j) joins (i+1, j) and (i, j+1).
[[nodiscard]] GridMesh tile_grid(const ReliefGrid& grid);

/// `cut`: not 0 for each cut cell; a cell has the number of its upper left vertex, row by row.
/// Software takes fragments that are discarded as slowly as others, so a cut cell has none.
void leave_out(const std::vector<float>& cut, const ReliefGrid& grid,
               const std::vector<GridTile>& tiles, UncutMesh& uncut);

/// The border of the grid, once around, each vertex twice, the first again at the end: a triangle
/// strip for the walls at the relief's sides.
[[nodiscard]] std::vector<GridVertex> border_strip(const ReliefGrid& grid);

}  // namespace dibhr
