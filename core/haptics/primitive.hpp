// The triangles, edges and vertices the depth image spans, named by integers.
#pragma once

namespace dibhr {

enum class PrimitiveKind { none, triangle, edge, vertex };

/// The diagonal of cell (i, j) joins (i+1, j) and (i, j+1), and so splits it into two triangles.
enum class TriangleSide {
    near_origin,  ///< corners (i, j), (i+1, j), (i, j+1)
    far_corner,   ///< corners (i+1, j+1), (i, j+1), (i+1, j)
};

enum class EdgeDirection {
    along_row,     ///< (i, j) to (i+1, j)
    along_column,  ///< (i, j) to (i, j+1)
    diagonal,      ///< (i+1, j) to (i, j+1)
};

/// The active primitive. `side` means something for a triangle, `direction` for an edge; (i, j) is
/// the cell of a triangle or diagonal, the first end of another edge, the vertex itself; (-1, -1)
/// for none.
struct Primitive {
    PrimitiveKind kind{PrimitiveKind::none};
    TriangleSide side{TriangleSide::near_origin};
    EdgeDirection direction{EdgeDirection::along_row};
    int i{-1};
    int j{-1};

    bool operator==(const Primitive&) const = default;
};

[[nodiscard]] constexpr Primitive triangle(TriangleSide side, int i, int j) noexcept {
    return {PrimitiveKind::triangle, side, EdgeDirection::along_row, i, j};
}
[[nodiscard]] constexpr Primitive edge(EdgeDirection direction, int i, int j) noexcept {
    return {PrimitiveKind::edge, TriangleSide::near_origin, direction, i, j};
}
[[nodiscard]] constexpr Primitive vertex(int i, int j) noexcept {
    return {PrimitiveKind::vertex, TriangleSide::near_origin, EdgeDirection::along_row, i, j};
}

/// "none", "triangle", "edge" or "vertex", as in the output rows.
[[nodiscard]] constexpr const char* name_of(PrimitiveKind kind) noexcept {
    switch (kind) {
        case PrimitiveKind::triangle:
            return "triangle";
        case PrimitiveKind::edge:
            return "edge";
        case PrimitiveKind::vertex:
            return "vertex";
        case PrimitiveKind::none:
            break;
    }
    return "none";
}

}  // namespace dibhr
