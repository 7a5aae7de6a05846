// The plane of one TRIANGLE, and the EDGEs a straight way crosses from one to the next.
#pragma once

#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

#include "core/haptics/surface.hpp"
#include "core/haptics/vec.hpp"

namespace dibhr {

/// Barycentric coordinates of a point of the grid. All three >= 0: inside the TRIANGLE. Each is 0
/// on the EDGE opposite its corner, and is named after the direction of that EDGE.
struct Barycentric {
    double row;
    double column;
    double diagonal;

    [[nodiscard]] double across(EdgeDirection direction) const noexcept {
        switch (direction) {
            case EdgeDirection::along_row:
                return row;
            case EdgeDirection::along_column:
                return column;
            case EdgeDirection::diagonal:
                break;
        }
        return diagonal;
    }
};

/// Elevations at the begin and the end of an EDGE, as `ends_of` orders them [px].
struct EdgeElevations {
    double begin;
    double end;
};

/// A TRIANGLE by the corner of its right angle (i, j) and the side it lies on: towards +x and +y of
/// that corner (sign +1) or towards -x and -y (sign -1). Both kinds then follow the same formulas.
class Facet {
  public:
    Facet() = default;
    Facet(const DepthSurface& surface, const Primitive& triangle) noexcept {
        const int far = triangle.side == TriangleSide::far_corner ? 1 : 0;
        sign_ = 1 - 2 * far;
        i_ = triangle.i + far;
        j_ = triangle.j + far;
        corner_ = surface.elevation(i_, j_);
        beside_ = surface.elevation(i_ + sign_, j_);
        below_ = surface.elevation(i_, j_ + sign_);
    }

    /// `sign`, the corner (i, j) and its elevation, and those of the two corners next to it.
    Facet(int sign, int i, int j, double corner, double beside, double below) noexcept
        : i_(i), j_(j), sign_(sign), corner_(corner), beside_(beside), below_(below) {}

    [[nodiscard]] Primitive triangle() const noexcept {
        return sign_ > 0 ? dibhr::triangle(TriangleSide::near_origin, i_, j_)
                         : dibhr::triangle(TriangleSide::far_corner, i_ - 1, j_ - 1);
    }

    [[nodiscard]] int sign() const noexcept { return sign_; }
    [[nodiscard]] int corner_x() const noexcept { return i_; }
    [[nodiscard]] int corner_y() const noexcept { return j_; }

    [[nodiscard]] double slope_x() const noexcept { return sign_ * (beside_ - corner_); }
    [[nodiscard]] double slope_y() const noexcept { return sign_ * (below_ - corner_); }
    /// Upwards, of length >= 1.
    [[nodiscard]] Vec3 normal() const noexcept { return {-slope_x(), -slope_y(), 1.0}; }

    /// Of the plane over (x, y), inside the TRIANGLE or not [px].
    [[nodiscard]] double elevation_at(double x, double y) const noexcept {
        return corner_ + slope_x() * (x - i_) + slope_y() * (y - j_);
    }

    /// The goal relative to the plane.
    struct Projection {
        Vec3 foot{0.0};         ///< the plane's nearest point, inside the TRIANGLE or not
        double rise{0.0};       ///< of the goal above the plane, along z [px]
        double distance2{0.0};  ///< from the goal to the plane, squared
    };

    [[nodiscard]] Projection project(Vec3 goal) const noexcept {
        const double rise = goal.z - elevation_at(goal.x, goal.y);
        const double fall = rise / (1.0 + slope_x() * slope_x() + slope_y() * slope_y());
        const double x = goal.x + slope_x() * fall;
        const double y = goal.y + slope_y() * fall;
        return {{x, y, elevation_at(x, y)}, rise, rise * fall};
    }

    [[nodiscard]] EdgeElevations elevations_along(EdgeDirection direction) const noexcept {
        const double other = direction == EdgeDirection::along_row ? beside_ : below_;
        const double one = direction == EdgeDirection::diagonal ? beside_ : corner_;
        return sign_ > 0 ? EdgeElevations{one, other} : EdgeElevations{other, one};
    }

    [[nodiscard]] Barycentric barycentric(double x, double y) const noexcept {
        const double column = sign_ * (x - i_);
        const double row = sign_ * (y - j_);
        return {row, column, 1.0 - column - row};
    }

    /// Makes the sign a constant for the compiler, which specialises the code that follows.
    template <int kSign>
    void assume_sign() noexcept {
        sign_ = kSign;
    }

    /// Elevation of the corner that the TRIANGLE across the EDGE has and this one has not; 0 past
    /// the image's border.
    template <EdgeDirection kThrough>
    [[nodiscard]] double elevation_across(const DepthSurface& surface) const noexcept {
        if constexpr (kThrough == EdgeDirection::along_row) {
            const bool is_border = !inside(j_ - sign_, surface.rows());
            return is_border ? 0.0 : surface.elevation(i_ + sign_, j_ - sign_);
        } else if constexpr (kThrough == EdgeDirection::along_column) {
            const bool is_border = !inside(i_ - sign_, surface.columns());
            return is_border ? 0.0 : surface.elevation(i_ - sign_, j_ + sign_);
        } else {
            return surface.elevation(i_ + sign_, j_ + sign_);
        }
    }

    /// What lies across an EDGE.
    enum class Across { border, same_plane, other_plane };

    /// Becomes the TRIANGLE across the EDGE, with the elevation across it, unless that is the
    /// image's border.
    template <EdgeDirection kThrough>
    Across step_across(const DepthSurface& surface, double elevation_across) noexcept {
        // In the same plane the neighbour, which lies the other way round, has the opposite
        // differences.
        const double opposite_x = corner_ - beside_;
        const double opposite_y = corner_ - below_;
        bool same = false;
        if constexpr (kThrough == EdgeDirection::along_row) {
            if (!inside(j_ - sign_, surface.rows())) return Across::border;
            i_ += sign_;
            below_ = elevation_across;
            std::swap(corner_, beside_);
            same = below_ - corner_ == opposite_y;
        } else if constexpr (kThrough == EdgeDirection::along_column) {
            if (!inside(i_ - sign_, surface.columns())) return Across::border;
            j_ += sign_;
            beside_ = elevation_across;
            std::swap(corner_, below_);
            same = beside_ - corner_ == opposite_x;
        } else {
            i_ += sign_;
            j_ += sign_;
            corner_ = elevation_across;
            std::swap(beside_, below_);
            same = beside_ - corner_ == opposite_x && below_ - corner_ == opposite_y;
        }
        sign_ = -sign_;
        return same ? Across::same_plane : Across::other_plane;
    }

  private:
    [[nodiscard]] static bool inside(int k, int count) noexcept {
        return static_cast<unsigned>(k) < static_cast<unsigned>(count);
    }

    int i_{0}, j_{0};
    int sign_{1};
    double corner_{0.0};  ///< elevation of the right angle's corner
    double beside_{0.0};  ///< of the corner next to it along the row
    double below_{0.0};   ///< of the corner next to it along the column
};

/// The EDGE by which a straight way leaves a TRIANGLE, with the way's parameter t there (0 at its
/// begin, 1 at its end).
struct Exit {
    EdgeDirection through{EdgeDirection::diagonal};
    double t{std::numeric_limits<double>::infinity()};
};

/// From anywhere in the TRIANGLE: the first of three EDGEs, by the shares of the corners.
[[nodiscard]] inline Exit exit_of(const Facet& facet, Vec3 begin, Vec3 end) noexcept {
    const Barycentric at_begin = facet.barycentric(begin.x, begin.y);
    const Barycentric at_end = facet.barycentric(end.x, end.y);
    Exit exit;
    const auto cross = [&exit](EdgeDirection direction, double share, double share_at_end) {
        const double fall = share - share_at_end;
        if (fall > 0.0 && share < exit.t * fall) exit = {direction, share / fall};
    };
    cross(EdgeDirection::diagonal, at_begin.diagonal, at_end.diagonal);
    cross(EdgeDirection::along_column, at_begin.column, at_end.column);
    cross(EdgeDirection::along_row, at_begin.row, at_end.row);
    return exit;
}

/// The same from the EDGE by which the way came in: the first of the other two.
template <EdgeDirection kBehind>
[[nodiscard, gnu::always_inline]] inline Exit exit_of(const Barycentric& at_begin,
                                                      const Barycentric& at_end) noexcept {
    constexpr bool kFromDiagonal = kBehind == EdgeDirection::diagonal;
    constexpr bool kFromRow = kBehind == EdgeDirection::along_row;
    constexpr auto kOne = kFromDiagonal ? EdgeDirection::along_column : EdgeDirection::diagonal;
    constexpr auto kOther = kFromRow ? EdgeDirection::along_column : EdgeDirection::along_row;
    const double share = at_begin.across(kOne);
    const double fall = share - at_end.across(kOne);
    const double other_share = at_begin.across(kOther);
    const double other_fall = other_share - at_end.across(kOther);
    const double t = fall > 0.0 ? share / fall : std::numeric_limits<double>::infinity();
    if (other_fall > 0.0 && other_share < t * other_fall) return {kOther, other_share / other_fall};
    return {kOne, t};
}

/// The same in the second TRIANGLE of a plane, with the bits that StraightWay gives there. Small
/// planes need no StraightWay.
template <EdgeDirection kBehind>
[[nodiscard, gnu::always_inline]] inline Exit exit_on_plane(const Facet& facet, Vec3 begin,
                                                            Vec3 end) noexcept {
    constexpr double kNever = std::numeric_limits<double>::infinity();
    const double dx = end.x - begin.x;
    const double dy = end.y - begin.y;
    const double to_row = facet.corner_y() - begin.y;
    const double to_column = facet.corner_x() - begin.x;
    const int sign = facet.sign();
    double row = kNever;
    double column = kNever;
    double diagonal = kNever;
    if (kBehind != EdgeDirection::along_row && dy * -sign > 0.0) row = to_row / dy;
    if (kBehind != EdgeDirection::along_column && dx * -sign > 0.0) column = to_column / dx;
    if (kBehind != EdgeDirection::diagonal && (dx + dy) * sign > 0.0) {
        diagonal = (to_row + to_column + sign) / (dx + dy);
    }
    if (diagonal <= row && diagonal <= column) return {EdgeDirection::diagonal, diagonal};
    if (column < row) return {EdgeDirection::along_column, column};
    return {EdgeDirection::along_row, row};
}

/// A straight way over TRIANGLEs, seen from above. It crosses three families of parallel lines,
/// each at even steps of its parameter (Amanatides and Woo, Eurographics 1987), so that a TRIANGLE
/// needs no division.
class StraightWay {
  public:
    /// The way through the TRIANGLE `facet` and on; crossings before `facet` are left out.
    StraightWay(Vec3 begin, Vec3 end, const Facet& facet) noexcept {
        const double dx = end.x - begin.x;
        const double dy = end.y - begin.y;
        const double to_row = facet.corner_y() - begin.y;
        const double to_column = facet.corner_x() - begin.x;
        const double to_sum = to_row + to_column;
        const int sign = facet.sign();
        // A TRIANGLE lies between two neighbouring lines of each family; its EDGE is on the first
        // one.
        rows_ = Lines(dy, to_row, to_row + sign, -sign, -1);
        columns_ = Lines(dx, to_column, to_column + sign, -sign, -1);
        diagonals_ = Lines(dx + dy, to_sum + sign, to_sum, sign, 1);
    }

    /// Calls `cross(direction, t)` for the EDGE by which the way leaves a TRIANGLE of this sign,
    /// with its parameter t (0 at the begin, 1 at the end), and steps over it. Never the EDGE by
    /// which the way came in. A branch for each direction, not a table: the processor predicts
    /// branches.
    template <typename Cross>
    auto over_next_edge(int sign, Cross&& cross) noexcept {
        const int side = sign > 0 ? 1 : 0;
        const double row = rows_.next + rows_.never[side];
        const double column = columns_.next + columns_.never[side];
        const double diagonal = diagonals_.next + diagonals_.never[side];
        if (diagonal <= row && diagonal <= column) {
            diagonals_.next += diagonals_.step;
            return cross(std::integral_constant<EdgeDirection, EdgeDirection::diagonal>{},
                         diagonal);
        }
        if (column < row) {
            columns_.next += columns_.step;
            return cross(std::integral_constant<EdgeDirection, EdgeDirection::along_column>{},
                         column);
        }
        rows_.next += rows_.step;
        return cross(std::integral_constant<EdgeDirection, EdgeDirection::along_row>{}, row);
    }

  private:
    static constexpr double kNever = std::numeric_limits<double>::infinity();

    struct Lines {
        Lines() = default;
        /// `outwards`: the sign of `delta` that leaves the first TRIANGLE; `outwards_plus`: one of
        /// sign +1.
        Lines(double delta, double to_edge, double to_other, int outwards,
              int outwards_plus) noexcept
            : next(delta == 0.0 ? kNever : (delta * outwards > 0.0 ? to_edge : to_other) / delta),
              step(std::abs(1.0 / delta)),
              never{delta * outwards_plus < 0.0 ? 0.0 : kNever,
                    delta * outwards_plus > 0.0 ? 0.0 : kNever} {}

        double next{kNever};
        double step{0.0};
        /// Added to `next` where the line does not bound the TRIANGLE.
        double never[2]{kNever, kNever};
    };

    Lines rows_, columns_, diagonals_;
};

}  // namespace dibhr
