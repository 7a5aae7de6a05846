// A straight way over the grid, and the EDGEs it crosses one after the other.
#pragma once

#include <cmath>
#include <limits>
#include <type_traits>

#include "core/haptics/facet.hpp"
#include "core/haptics/vec.hpp"

namespace dibhr {

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
        double never[2]{kNever,
                        kNever};  ///< added to `next` where the line does not bound the TRIANGLE
    };

    Lines rows_, columns_, diagonals_;
};

}  // namespace dibhr
