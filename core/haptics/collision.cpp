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
        const double floor = std::floor(start);
        cell_ = static_cast<int>(floor);
        if (delta < 0.0 && floor == start) --cell_;  // on a line: the cell it is about to enter
        cell_ = std::clamp(cell_, 0, cells - 1);
        find_next();
    }

    [[nodiscard]] int cell() const noexcept { return cell_; }
    [[nodiscard]] int step() const noexcept { return step_; }
    /// Segment parameter of the next line.
    [[nodiscard]] double next() const noexcept { return next_; }
    /// False: out of the image.
    [[nodiscard]] bool advance() noexcept {
        cell_ += step_;
        find_next();
        return cell_ >= 0 && cell_ < cells_;
    }

  private:
    void find_next() noexcept {
        const int line = step_ > 0 ? cell_ + 1 : cell_;
        next_ = per_delta_ == 0.0 ? std::numeric_limits<double>::infinity()
                                  : (line - start_) * per_delta_;
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
        : surface_(surface), from_(from), delta_(to - from) {}

    std::optional<Hit> first_hit() noexcept {
        const auto begin = enters_ceiling();
        if (!begin) return std::nullopt;
        t_ = *begin;
        const Vec3 start = at(t_);
        LineCrossings columns(start.x, delta_.x, surface_.columns() - 1);
        LineCrossings rows(start.y, delta_.y, surface_.rows() - 1);
        CellCorners corners(surface_, columns.cell(), rows.cell());
        const double begin_t = t_;  // crossings count from `start`
        std::optional<Hit> hit;
        const auto ends_in_cell = [&](double next) {
            const double t_end = std::min(begin_t + next, 1.0);
            const double lowest = from_.z + (delta_.z < 0.0 ? t_end : t_) * delta_.z;
            if (corners.highest() >= lowest) hit = in_cell(columns.cell(), rows.cell(), t_end);
            t_ = t_end;
            return hit || t_end >= 1.0;
        };
        for (;;) {
            if (columns.next() <= rows.next()) {
                if (ends_in_cell(columns.next()) || !columns.advance()) return hit;
                corners.step_column(surface_, columns.cell(), rows.cell(), columns.step());
            } else {
                if (ends_in_cell(rows.next()) || !rows.advance()) return hit;
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

    [[nodiscard]] std::optional<Hit> in_cell(int i, int j, double t_end) noexcept {
        // x + y grows or falls along the segment: at most one crossing of the cell's diagonal.
        const double across_begin = at(t_).x - i + (at(t_).y - j) - 1.0;
        const double across_end = at(t_end).x - i + (at(t_end).y - j) - 1.0;
        const auto side_of = [](double across) {
            return across <= 0.0 ? TriangleSide::near_origin : TriangleSide::far_corner;
        };
        if (across_begin * across_end < 0.0) {
            const double t_diagonal =
                t_ + (t_end - t_) * (across_begin / (across_begin - across_end));
            if (auto hit = in_triangle(triangle(side_of(across_begin), i, j), t_diagonal))
                return hit;
            return in_triangle(triangle(side_of(across_end), i, j), t_end);
        }
        return in_triangle(triangle(side_of(across_begin + across_end), i, j), t_end);
    }

    [[nodiscard]] std::optional<Hit> in_triangle(const Primitive& which, double t_end) noexcept {
        const Facet facet(surface_, which);
        const Vec3 end = at(t_end);
        const double height = end.z - facet.elevation_at(end.x, end.y);
        if (height >= -kTouchDepth_px) {
            t_ = t_end;
            return std::nullopt;
        }
        const Vec3 start = at(t_);
        const double height_before = std::max(0.0, start.z - facet.elevation_at(start.x, start.y));
        Vec3 position = start + (end - start) * (height_before / (height_before - height));
        position = surface_.clamped_to_frame(position);
        position.z = facet.elevation_at(position.x, position.y);
        return Hit{position, which};
    }

    const DepthSurface& surface_;
    Vec3 from_;
    Vec3 delta_;
    double t_{0.0};
};

}  // namespace

std::optional<Hit> first_hit(const DepthSurface& surface, Vec3 from, Vec3 to) noexcept {
    return SegmentWalk(surface, from, to).first_hit();
}

}  // namespace dibhr
