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

/// Triangles in tiles small enough for a vertex cache; each tile has its own vertices in a row.
struct GridMesh {
    std::vector<GridVertex> vertices{};
    /// Three a triangle, counter-clockwise seen from above. The last one tells the fragments their
    /// cell: of the two triangles of cell (i, j) it is (i, j), and (i+1, j+1).
    std::vector<std::uint32_t> indices{};
};

/// Two triangles a cell; the diagonal of cell (i, j) joins (i+1, j) and (i, j+1).
[[nodiscard]] GridMesh tile_grid(const ReliefGrid& grid);

/// The border of the grid, once around, each vertex twice, the first again at the end: a triangle
/// strip for the walls at the relief's sides.
[[nodiscard]] std::vector<GridVertex> border_strip(const ReliefGrid& grid);

}  // namespace dibhr
