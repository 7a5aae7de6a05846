// Which vertices of the depth image are drawn, in what order, and where the relief is torn at
// silhouettes: there each triangle becomes a near and a far layer, and the fragment shader cuts
// them along the outline in the whole depth image. Numbers only, no OpenGL.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/haptics/depth_image.hpp"
#include "core/haptics/parameters.hpp"

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

/// One corner of a layer: it lies at `corner`, with the height and colour of the drawn vertex
/// `source` of the same face. Only the part within `tolerance_px` of the depth image is shown.
struct RimVertex {
    GridVertex corner{};
    GridVertex source{};
    float tolerance_px{0.0F};
};

/// The surface between two depth images of one size, without the bump map.
struct BlendedDepth {
    const DepthImage& from;
    const DepthImage& to;
    double blend{0.0};  ///< 0: from, 1: to
    double px_per_level{1.0};
};

/// The elevation [px] of every drawn vertex, row-major. The images have the grid's size.
void drawn_elevations(const BlendedDepth& depth, const ReliefGrid& grid,
                      std::vector<float>& elevations);

struct Rims {
    std::vector<RimVertex> layers{};  ///< three vertices a triangle; 120'000 at most
    std::vector<float> torn{};  ///< of each drawn vertex; 1: the cell to its lower right is torn
};

/// Tears the cells of the drawn grid in which the image is steeper than `slope_limit` [px/px] from
/// pixel to pixel, and cells that share a blurred vertex with one. So the silhouettes do not depend
/// on how coarse the drawn grid is. A part too thin to reach a drawn vertex is neither drawn nor
/// torn. `elevations`: those of drawn_elevations().
void tear_rims(const BlendedDepth& depth, const ReliefGrid& grid,
               const std::vector<float>& elevations, double slope_limit, Rims& rims);

}  // namespace dibhr
