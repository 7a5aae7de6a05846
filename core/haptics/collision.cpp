// The walk over the cells under a segment.
#include "core/haptics/collision.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "core/haptics/facet.hpp"

namespace dibhr {

namespace {

/// One family of grid lines, x = i or y = j, crossed by the segment one after the other.
class LineCrossings {
  public:
    LineCrossings(double start, double delta, int cells) noexcept
        : start_(start),
          per_delta_(delta == 0.0 ? 0.0 : 1.0 / delta),
          cells_(cells),
          step_(delta < 0.0 ? -1 : 1) {
        cell_ = static_cast<int>(start);
        if (delta < 0.0 && cell_ == start) --cell_;  // on a line: the cell it is about to enter
        cell_ = std::clamp(cell_, 0, cells - 1);
        find_next();
    }

    [[nodiscard]] int cell() const noexcept { return cell_; }
    [[nodiscard]] int step() const noexcept { return step_; }
    /// Segment parameter of the next line.
    [[nodiscard]] double next() const noexcept { return next_; }
    void advance() noexcept {
        cell_ += step_;
        find_next();
    }

  private:
    void find_next() noexcept {
        const int line = step_ > 0 ? cell_ + 1 : cell_;
        // The segment ends inside the image, whatever round-off says of the border.
        const bool never = per_delta_ == 0.0 || line <= 0 || line >= cells_;
        next_ = never ? std::numeric_limits<double>::infinity() : (line - start_) * per_delta_;
    }

    double start_;
    double per_delta_;
    double next_{0.0};
    int cell_{0};
    int cells_;
    int step_;
};

/// The four corners of the cell the walk is in; two of them are those of the cell before.
class CellCorners {
  public:
    CellCorners(const DepthSurface& surface, int i, int j) noexcept
        : first_row_{surface.elevation(i, j), surface.elevation(i + 1, j)},
          second_row_{surface.elevation(i, j + 1), surface.elevation(i + 1, j + 1)} {}

    void step_column(const DepthSurface& surface, int i, int j, int step) noexcept {
        const std::size_t old_side = step > 0 ? 0 : 1;
        const std::size_t new_side = 1 - old_side;
        const int column = step > 0 ? i + 1 : i;
        first_row_[old_side] = first_row_[new_side];
        second_row_[old_side] = second_row_[new_side];
        first_row_[new_side] = surface.elevation(column, j);
        second_row_[new_side] = surface.elevation(column, j + 1);
    }

    void step_row(const DepthSurface& surface, int i, int j, int step) noexcept {
        std::swap(first_row_, second_row_);
        auto& fresh = step > 0 ? second_row_ : first_row_;
        const int row = step > 0 ? j + 1 : j;
        fresh = {surface.elevation(i, row), surface.elevation(i + 1, row)};
    }

    /// One of the two TRIANGLEs of the cell, which is (i, j).
    [[nodiscard]] Facet facet(TriangleSide side, int i, int j) const noexcept {
        return side == TriangleSide::near_origin
                   ? Facet(1, i, j, first_row_[0], first_row_[1], second_row_[0])
                   : Facet(-1, i + 1, j + 1, second_row_[1], second_row_[0], first_row_[1]);
    }

    [[nodiscard]] double highest() const noexcept {
        return std::max(std::max(first_row_[0], first_row_[1]),
                        std::max(second_row_[0], second_row_[1]));
    }

  private:
    std::array<double, 2> first_row_;
    std::array<double, 2> second_row_;
};

/// Walks one segment cell by cell; `t_` is how far it has come.
class SegmentWalk {
  public:
    SegmentWalk(const DepthSurface& surface, Vec3 from, Vec3 to) noexcept
        : surface_(surface), from_(from), to_(to), delta_(to - from) {}

    Flight over(int most_cells) noexcept {
        const auto begin = enters_ceiling();
        if (!begin) return {to_};
        t_ = *begin;
        const Vec3 start = at(t_);
        LineCrossings columns(start.x, delta_.x, surface_.columns() - 1);
        LineCrossings rows(start.y, delta_.y, surface_.rows() - 1);
        CellCorners corners(surface_, columns.cell(), rows.cell());
        const double begin_t = t_;  // crossings count from `start`
        Flight flight{to_};
        const auto ends_in_cell = [&](double next) {
            if (flight.cells == most_cells) {
                flight.end = at(t_);
                flight.cut_short = true;
                return true;
            }
            ++flight.cells;
            const double t_end = std::min(begin_t + next, 1.0);
            const double lowest = from_.z + (delta_.z < 0.0 ? t_end : t_) * delta_.z;
            if (corners.highest() >= lowest &&
                in_cell(corners, columns.cell(), rows.cell(), t_end, flight))
                return true;
            t_ = t_end;
            return t_end >= 1.0;
        };
        for (;;) {
            if (columns.next() <= rows.next()) {
                if (ends_in_cell(columns.next())) return flight;
                columns.advance();
                corners.step_column(surface_, columns.cell(), rows.cell(), columns.step());
            } else {
                if (ends_in_cell(rows.next())) return flight;
                rows.advance();
                corners.step_row(surface_, columns.cell(), rows.cell(), rows.step());
            }
        }
    }

  private:
    [[nodiscard]] Vec3 at(double t) const noexcept { return from_ + t * delta_; }

    /// Parameter from which on the segment may be below the highest vertex.
    [[nodiscard]] std::optional<double> enters_ceiling() const noexcept {
        const double above = from_.z - surface_.ceiling();
        if (above <= 0.0) return 0.0;
        if (delta_.z >= 0.0 || above > -delta_.z) return std::nullopt;
        return above / -delta_.z;
    }

    /// True: the flight has met a TRIANGLE of the cell.
    [[nodiscard]] bool in_cell(const CellCorners& corners, int i, int j, double t_end,
                               Flight& flight) noexcept {
        // x + y grows or falls along the segment: at most one crossing of the cell's diagonal.
        const double across_begin = at(t_).x - i + (at(t_).y - j) - 1.0;
        const double across_end = at(t_end).x - i + (at(t_end).y - j) - 1.0;
        const auto side_of = [](double across) {
            return across <= 0.0 ? TriangleSide::near_origin : TriangleSide::far_corner;
        };
        if (across_begin * across_end >= 0.0) {
            return in_triangle(corners.facet(side_of(across_begin + across_end), i, j), t_end,
                               flight);
        }
        const double t_diagonal = t_ + (t_end - t_) * (across_begin / (across_begin - across_end));
        return in_triangle(corners.facet(side_of(across_begin), i, j), t_diagonal, flight) ||
               in_triangle(corners.facet(side_of(across_end), i, j), t_end, flight);
    }

    [[nodiscard]] bool in_triangle(const Facet& facet, double t_end, Flight& flight) noexcept {
        const Vec3 end = at(t_end);
        const double height = end.z - facet.elevation_at(end.x, end.y);
        if (height >= -kTouchDepth_px) {
            t_ = t_end;
            return false;
        }
        const Vec3 start = at(t_);
        const double height_before = std::max(0.0, start.z - facet.elevation_at(start.x, start.y));
        Vec3 position = start + (end - start) * (height_before / (height_before - height));
        position = surface_.clamped_to_frame(position);
        position.z = facet.elevation_at(position.x, position.y);
        flight.end = position;
        flight.ground = facet.triangle();
        return true;
    }

    const DepthSurface& surface_;
    Vec3 from_;
    Vec3 to_;
    Vec3 delta_;
    double t_{0.0};
};

}  // namespace

Flight fly(const DepthSurface& surface, Vec3 from, Vec3 to, int most_cells) noexcept {
    return SegmentWalk(surface, from, to).over(most_cells);
}

std::optional<Hit> first_hit(const DepthSurface& surface, Vec3 from, Vec3 to) noexcept {
    const Flight flight = fly(surface, from, to, std::numeric_limits<int>::max());
    if (!flight.ground) return std::nullopt;
    return Hit{flight.end, *flight.ground};
}

}  // namespace dibhr
