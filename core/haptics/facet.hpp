// The plane of one TRIANGLE, and the EDGEs a straight way crosses from one to the next.
#pragma once

#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

#include "core/haptics/surface.hpp"
#include "core/haptics/vec.hpp"

namespace dibhr {

/// How much of each corner a point of the grid is. All three >= 0: inside. Each is 0 on the EDGE
/// opposite its corner, and is named after the direction of that EDGE.
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

/// At the begin and the end of an EDGE, as `ends_of` orders them [px].
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

    /// The goal as the plane sees it.
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

    /// What lies across an EDGE.
    enum class Across { border, same_plane, other_plane };

    /// Becomes the TRIANGLE across the EDGE, unless that is the image's border. Two of the
    /// neighbour's elevations are known already: one is read.
    Across step_across(const DepthSurface& surface, EdgeDirection through) noexcept {
        int i = i_ + sign_;
        int j = j_ + sign_;
        // In the same plane the neighbour, which lies the other way round, has the opposite
        // differences.
        const double opposite_x = corner_ - beside_;
        const double opposite_y = corner_ - below_;
        bool same = false;
        switch (through) {
            case EdgeDirection::along_row:
                if (!inside(j_ - sign_, surface.rows())) return Across::border;
                j = j_;
                below_ = surface.elevation(i, j_ - sign_);
                std::swap(corner_, beside_);
                same = below_ - corner_ == opposite_y;
                break;
            case EdgeDirection::along_column:
                if (!inside(i_ - sign_, surface.columns())) return Across::border;
                i = i_;
                beside_ = surface.elevation(i_ - sign_, j);
                std::swap(corner_, below_);
                same = beside_ - corner_ == opposite_x;
                break;
            case EdgeDirection::diagonal:
                corner_ = surface.elevation(i, j);
                std::swap(beside_, below_);
                same = beside_ - corner_ == opposite_x && below_ - corner_ == opposite_y;
                break;
        }
        i_ = i;
        j_ = j;
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

/// The EDGE by which a straight way leaves the TRIANGLE it begins in, with its parameter t (0 at
/// the begin, 1 at the end).
struct FirstExit {
    EdgeDirection through{EdgeDirection::diagonal};
    double t{std::numeric_limits<double>::infinity()};
};

/// By the shares of the corners: cheaper than a StraightWay where every TRIANGLE is of another
/// plane, so that no way is longer than this.
[[nodiscard]] inline FirstExit first_exit(const Facet& facet, Vec3 begin, Vec3 end) noexcept {
    const Barycentric at_begin = facet.barycentric(begin.x, begin.y);
    const Barycentric at_end = facet.barycentric(end.x, end.y);
    FirstExit exit;
    const auto cross = [&exit](EdgeDirection direction, double share, double share_at_end) {
        const double fall = share - share_at_end;
        if (fall > 0.0 && share < exit.t * fall) exit = {direction, share / fall};
    };
    cross(EdgeDirection::diagonal, at_begin.diagonal, at_end.diagonal);
    cross(EdgeDirection::along_column, at_begin.column, at_end.column);
    cross(EdgeDirection::along_row, at_begin.row, at_end.row);
    return exit;
}

/// Seen from above: three families of parallel lines, each crossed at even steps of the way's
/// parameter (as a ray is walked through voxels: Amanatides and Woo, Eurographics 1987). No
/// division a TRIANGLE.
class StraightWay {
  public:
    /// The way goes through the TRIANGLE `facet`; what is before that is left out.
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
    /// with its parameter t (0 at the begin, 1 at the end), and goes over it. Never the EDGE it
    /// came in by. A branch for each direction, not a table: what follows is predicted, not waited
    /// for.
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
