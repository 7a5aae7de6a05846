// The plane of one TRIANGLE, and how to get to the next one.
#pragma once

#include <utility>

#include "core/haptics/primitive.hpp"
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
    /// x + y of the diagonal.
    [[nodiscard]] int diagonal_sum() const noexcept { return i_ + j_ + sign_; }

    [[nodiscard]] double slope_x() const noexcept { return sign_ * (beside_ - corner_); }
    [[nodiscard]] double slope_y() const noexcept { return sign_ * (below_ - corner_); }

    /// Of the plane over (x, y), inside the TRIANGLE or not [px].
    [[nodiscard]] double elevation_at(double x, double y) const noexcept {
        return corner_ + slope_x() * (x - i_) + slope_y() * (y - j_);
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

}  // namespace dibhr
