// Which primitives meet which: integer arithmetic on (kind, i, j).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/haptics/surface.hpp"
#include "core/haptics/vec.hpp"

namespace dibhr {

/// The two VERTEXes of an EDGE.
struct EdgeEnds {
    int begin_i, begin_j, end_i, end_j;
};

[[nodiscard]] constexpr EdgeEnds ends_of(const Primitive& edge) noexcept {
    const int i = edge.i;
    const int j = edge.j;
    switch (edge.direction) {
        case EdgeDirection::along_row:
            return {i, j, i + 1, j};
        case EdgeDirection::along_column:
            return {i, j, i, j + 1};
        case EdgeDirection::diagonal:
            break;
    }
    return {i + 1, j, i, j + 1};
}

/// The EDGE of a TRIANGLE that runs in this direction.
[[nodiscard]] constexpr Primitive edge_of(const Primitive& triangle,
                                          EdgeDirection direction) noexcept {
    const int far = triangle.side == TriangleSide::far_corner ? 1 : 0;
    switch (direction) {
        case EdgeDirection::along_row:
            return edge(direction, triangle.i, triangle.j + far);
        case EdgeDirection::along_column:
            return edge(direction, triangle.i + far, triangle.j);
        case EdgeDirection::diagonal:
            break;
    }
    return edge(direction, triangle.i, triangle.j);
}

/// The TRIANGLEs on both sides of an EDGE: `first` towards +x, +y (near the diagonal's origin side
/// for a diagonal), `second` opposite. One is missing on the image's border.
struct TrianglePair {
    std::optional<Primitive> first{};
    std::optional<Primitive> second{};
};

[[nodiscard]] inline TrianglePair triangles_of(const DepthSurface& surface,
                                               const Primitive& edge) noexcept {
    const int i = edge.i;
    const int j = edge.j;
    TrianglePair pair;
    switch (edge.direction) {
        case EdgeDirection::along_row:
            if (j < surface.rows() - 1) pair.first = triangle(TriangleSide::near_origin, i, j);
            if (j > 0) pair.second = triangle(TriangleSide::far_corner, i, j - 1);
            break;
        case EdgeDirection::along_column:
            if (i < surface.columns() - 1) pair.first = triangle(TriangleSide::near_origin, i, j);
            if (i > 0) pair.second = triangle(TriangleSide::far_corner, i - 1, j);
            break;
        case EdgeDirection::diagonal:
            pair.first = triangle(TriangleSide::near_origin, i, j);
            pair.second = triangle(TriangleSide::far_corner, i, j);
            break;
    }
    return pair;
}

/// The TRIANGLE beside an EDGE on whose side a point of the image rectangle lies, seen from above.
[[nodiscard]] inline Primitive triangle_towards(const DepthSurface& surface, const Primitive& edge,
                                                double x, double y) noexcept {
    const TrianglePair pair = triangles_of(surface, edge);
    if (!pair.first) return *pair.second;
    if (!pair.second) return *pair.first;
    const bool towards_first = edge.direction == EdgeDirection::along_row ? y >= edge.j
                               : edge.direction == EdgeDirection::along_column
                                   ? x >= edge.i
                                   : x - edge.i + (y - edge.j) <= 1.0;
    return towards_first ? *pair.first : *pair.second;
}

/// The TRIANGLE around VERTEX (i, j) that lies in the direction of a point of the image rectangle.
[[nodiscard]] inline Primitive triangle_around(const DepthSurface& surface, const Primitive& vertex,
                                               double x, double y) noexcept {
    const double dx = x - vertex.i;
    const double dy = y - vertex.j;
    const double reach = std::max(std::abs(dx), std::abs(dy));
    const double step = reach > 0.0 ? 0.25 / reach : 0.0;
    return surface.triangle_at(vertex.i + step * dx, vertex.j + step * dy);
}

/// The VERTEX or EDGE of `active`, a TRIANGLE or an EDGE, that the point (x, y) in it lies on to
/// within `near_px`; else `active` itself.
[[nodiscard]] inline Primitive lowest_under(const Primitive& active, double x, double y,
                                            double near_px) noexcept {
    const auto is_on_line = [&](double along) {
        return std::abs(along - std::round(along)) <= near_px;
    };
    const bool on_row = is_on_line(y);
    const bool on_column = is_on_line(x);
    if (on_row && on_column) {
        return vertex(static_cast<int>(std::round(x)), static_cast<int>(std::round(y)));
    }
    if (active.kind == PrimitiveKind::edge) return active;
    if (on_row) return edge_of(active, EdgeDirection::along_row);
    if (on_column) return edge_of(active, EdgeDirection::along_column);
    return is_on_line(x + y) ? edge_of(active, EdgeDirection::diagonal) : active;
}

/// One of the six EDGEs of a VERTEX, and the VERTEX at its far end (which may lie outside the
/// image).
struct VertexSpoke {
    Primitive edge;
    int far_i, far_j;
};

[[nodiscard]] constexpr std::array<VertexSpoke, 6> spokes_of(const Primitive& vertex) noexcept {
    const int i = vertex.i;
    const int j = vertex.j;
    return {{
        {edge(EdgeDirection::along_row, i, j), i + 1, j},
        {edge(EdgeDirection::along_column, i, j), i, j + 1},
        {edge(EdgeDirection::diagonal, i - 1, j), i - 1, j + 1},
        {edge(EdgeDirection::along_row, i - 1, j), i - 1, j},
        {edge(EdgeDirection::along_column, i, j - 1), i, j - 1},
        {edge(EdgeDirection::diagonal, i, j - 1), i + 1, j - 1},
    }};
}

}  // namespace dibhr
