// Which primitives meet which: integer arithmetic on (kind, i, j).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
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

/// The EDGE between two neighbouring VERTEXes.
[[nodiscard]] constexpr Primitive edge_between(int i, int j, int to_i, int to_j) noexcept {
    return edge(j == to_j   ? EdgeDirection::along_row
                : i == to_i ? EdgeDirection::along_column
                            : EdgeDirection::diagonal,
                std::min(i, to_i), std::min(j, to_j));
}

/// The corner of a TRIANGLE opposite its EDGE of this direction.
[[nodiscard]] constexpr Primitive corner_across(const Primitive& triangle,
                                                EdgeDirection direction) noexcept {
    const int far = triangle.side == TriangleSide::far_corner ? 1 : 0;
    switch (direction) {
        case EdgeDirection::along_row:
            return vertex(triangle.i + far, triangle.j + 1 - far);
        case EdgeDirection::along_column:
            return vertex(triangle.i + 1 - far, triangle.j + far);
        case EdgeDirection::diagonal:
            break;
    }
    return vertex(triangle.i + far, triangle.j + far);
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

/// Whether a point lies on the side of an EDGE's `first` TRIANGLE, seen from above.
[[nodiscard]] inline bool is_towards_first(const Primitive& edge, double x, double y) noexcept {
    switch (edge.direction) {
        case EdgeDirection::along_row:
            return y >= edge.j;
        case EdgeDirection::along_column:
            return x >= edge.i;
        case EdgeDirection::diagonal:
            break;
    }
    return x - edge.i + (y - edge.j) <= 1.0;
}

/// The TRIANGLE beside an EDGE on whose side a point of the image rectangle lies, seen from above.
[[nodiscard]] inline Primitive triangle_towards(const DepthSurface& surface, const Primitive& edge,
                                                double x, double y) noexcept {
    // Of `triangles_of`, without making two to take one.
    const bool first = is_towards_first(edge, x, y);
    const int i = edge.i;
    const int j = edge.j;
    switch (edge.direction) {
        case EdgeDirection::along_row:
            if (j == 0 || (first && j < surface.rows() - 1)) break;
            return triangle(TriangleSide::far_corner, i, j - 1);
        case EdgeDirection::along_column:
            if (i == 0 || (first && i < surface.columns() - 1)) break;
            return triangle(TriangleSide::far_corner, i - 1, j);
        case EdgeDirection::diagonal:
            if (first) break;
            return triangle(TriangleSide::far_corner, i, j);
    }
    return triangle(TriangleSide::near_origin, i, j);
}

/// The TRIANGLE around VERTEX (i, j) that lies in the direction of a point of the image rectangle.
[[nodiscard]] inline Primitive triangle_around(const DepthSurface& surface, const Primitive& vertex,
                                               double x, double y) noexcept {
    // On the border the point is never outwards of the VERTEX.
    const bool right = x >= vertex.i && vertex.i < surface.columns() - 1;
    const bool below = y >= vertex.j && vertex.j < surface.rows() - 1;
    const int i = right ? vertex.i : vertex.i - 1;
    const int j = below ? vertex.j : vertex.j - 1;
    const bool near_origin = right == below ? right : x - vertex.i + (y - vertex.j) <= 0.0;
    return triangle(near_origin ? TriangleSide::near_origin : TriangleSide::far_corner, i, j);
}

/// The VERTEX or EDGE of `active`, a TRIANGLE or an EDGE, that the point (x, y) in it lies on to
/// within `near_px`; else `active` itself.
[[nodiscard]] inline Primitive smallest_primitive_under(const Primitive& active, double x, double y,
                                                        double near_px) noexcept {
    // Not std::round: that is a call into the library, and no coordinate is below -0.5.
    const auto nearest_line = [](double along) {
        const double past_half = along + 0.5;
        return static_cast<int>(past_half);
    };
    const auto is_on_line = [&](double along) {
        return std::abs(along - nearest_line(along)) <= near_px;
    };
    const bool on_row = is_on_line(y);
    const bool on_column = is_on_line(x);
    if (on_row && on_column) {
        return vertex(nearest_line(x), nearest_line(y));
    }
    if (active.kind == PrimitiveKind::edge) return active;
    if (on_row) return edge_of(active, EdgeDirection::along_row);
    if (on_column) return edge_of(active, EdgeDirection::along_column);
    return is_on_line(x + y) ? edge_of(active, EdgeDirection::diagonal) : active;
}

/// From one VERTEX to another.
struct Step {
    int i, j;
};

/// From a VERTEX to its neighbours at the far ends of its six EDGEs, its *spokes*, once around it:
/// each is a neighbour of the one before.
inline constexpr std::array<Step, 6> kSpokes{{{1, 0}, {0, 1}, {-1, 1}, {-1, 0}, {0, -1}, {1, -1}}};

[[nodiscard]] constexpr EdgeDirection direction_of_spoke(std::size_t k) noexcept {
    return k % 3 == 0   ? EdgeDirection::along_row
           : k % 3 == 1 ? EdgeDirection::along_column
                        : EdgeDirection::diagonal;
}

/// The spoke that leads along an EDGE to its end, or to its begin.
[[nodiscard]] constexpr std::size_t spoke_along(EdgeDirection direction, bool to_begin) noexcept {
    return static_cast<std::size_t>(direction) + (to_begin ? 3 : 0);
}

/// The EDGE of a VERTEX along spoke k.
[[nodiscard]] constexpr Primitive edge_at(const Primitive& vertex, std::size_t k) noexcept {
    const int back_i = k == 2 || k == 3 ? 1 : 0;
    const int back_j = k >= 4 ? 1 : 0;
    return edge(direction_of_spoke(k), vertex.i - back_i, vertex.j - back_j);
}

}  // namespace dibhr
