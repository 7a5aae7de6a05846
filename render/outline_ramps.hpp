// The steps in depth along the edges of the drawn grid, and the faces that end there.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>

#include "render/blended_depth.hpp"
#include "render/relief_grid.hpp"

namespace dibhr {

/// A vertex of the drawn grid, or the cell to its lower right.
struct GridPlace {
    int i{0};
    int j{0};
};

/// The corners of a cell: upper left, upper right, lower left, lower right.
[[nodiscard]] inline std::array<GridPlace, 4> corners_of(GridPlace cell) {
    return {cell, {cell.i + 1, cell.j}, {cell.i, cell.j + 1}, {cell.i + 1, cell.j + 1}};
}

/// The two faces of a cut cell.
struct CellFaces {
    glm::vec2 ends_px{0.0F};        ///< elevations of the far and the near face at the outline
    std::array<bool, 4> on_ramp{};  ///< which corners are in the blur between them
};

/// Finds steps by the whole image. A step may be blurred: to a ramp of some units (outline_unit()).
class OutlineRamps {
  public:
    OutlineRamps(const BlendedDepth& depth, const ReliefGrid& grid)
        : image_(depth.from), elevation_(depth), grid_(grid), unit_(outline_unit(depth.from)) {}

    /// Where the faces of a cell end; nothing where no step higher than `least_px` a unit crosses
    /// its edges and diagonals.
    [[nodiscard]] std::optional<CellFaces> in_cell(GridPlace cell, float least_px) const;

  private:
    struct Ramp {
        float low_px{0.0F}, high_px{0.0F};  ///< where it ends
        std::array<bool, 2> on_ramp{};      ///< whether the edge's ends are on it
    };
    class Line;

    [[nodiscard]] std::optional<Ramp> along(GridPlace from, GridPlace to, float least_px) const;

    const DepthImage& image_;  // used for the size only
    PixelElevation elevation_;
    const ReliefGrid& grid_;
    int unit_;
};

}  // namespace dibhr
