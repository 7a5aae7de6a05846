// Finds the cells of the drawn grid in which an object ends before another.
#include "render/silhouette_cuts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

#include "render/outline_ramps.hpp"

namespace dibhr {
namespace {

constexpr int kWidestStep = 3;       // units; wider is a slope
constexpr float kLeastStep = 2.0F;   // limits; lower ones are folds
constexpr float kPartOfStep = 0.3F;  // of a step's mean rise: a unit that rises less is beside it
constexpr float kSameFaces = 0.5F;   // of a cell's highest rise: a lower one is another step

/// The elevations around the unit from a pixel to a later one in a row or a column, as many as
/// steps that contain the unit may depend on.
class StepSurroundings {
  public:
    /// The `unit` [px] from pixel `k` of `count`, whose first one is `first` of the image.
    StepSurroundings(const PixelElevation& elevation, std::size_t first, std::size_t stride,
                     int count, int k, int unit) {
        for (int n = 0; n < kValues; ++n) {
            const int clamped = std::clamp(k + (n - kBefore) * unit, 0, count - 1);
            values_[static_cast<std::size_t>(n)] =
                elevation(first + static_cast<std::size_t>(clamped) * stride);
        }
    }
    /// Whether a step of 1 to kWidestStep units that contains the unit is higher than `least_px`.
    [[nodiscard]] bool has_step(float least_px) const {
        for (int width = 1; width <= kWidestStep; ++width) {
            for (int from = 1 - width; from <= 0; ++from)
                if (unexplained(from, width) > least_px) return true;
        }
        return false;
    }

  private:
    static constexpr int kBefore = kWidestStep + 1;  // the step's begin, and two units before it
    static constexpr int kValues = 2 * kBefore + 2;

    /// The elevation `n` units from the unit's first pixel.
    [[nodiscard]] float at(int n) const { return values_[static_cast<std::size_t>(kBefore + n)]; }

    /// The height of a step from unit `from` to unit `from + width`, less what its sides explain
    /// [px]; 0 where this unit has no part in it, as beside a step, where filters overshoot.
    [[nodiscard]] float unexplained(int from, int width) const {
        const int to = from + width;
        const float rise = at(to) - at(from);
        const float sign = rise < 0.0F ? -1.0F : 1.0F;
        const auto rise_at = [this, sign](int k) { return sign * (at(k + 1) - at(k)); };
        if (rise_at(0) * static_cast<float>(width) < kPartOfStep * sign * rise) return 0.0F;
        const float explained = std::max(continued(rise_at(from - 1), rise_at(from - 2)),
                                         continued(rise_at(to), rise_at(to + 1)));
        return sign * rise - static_cast<float>(width) * explained;
    }

    /// The rise over the next unit that the two rises before it lead to [px].
    [[nodiscard]] static float continued(float rise, float rise_before) {
        const float curvature = std::clamp(rise - rise_before, 0.0F, std::max(rise, 0.0F));
        return std::max(rise + curvature, 0.0F);
    }

    std::array<float, kValues> values_{};
};

class CutFinder {
  public:
    CutFinder(const BlendedDepth& depth, const ReliefGrid& grid,
              const std::vector<float>& elevations, double slope_limit, SilhouetteCuts& cuts)
        : image_(depth.from),
          elevation_(depth),
          grid_(grid),
          columns_(grid.columns()),
          rows_(grid.rows()),
          unit_(outline_unit(depth.from)),
          limit_px_(static_cast<float>(slope_limit * unit_)),
          ramps_(depth, grid),
          elevations_(elevations),
          cuts_(cuts) {}

    void run() {
        cuts_.cells.clear();
        cuts_.ends_px.clear();
        cuts_.cut.assign(elevations_.size(), 0.0F);
        cuts_.between.assign(elevations_.size(), false);
        find_steps();
        // Cells are added while a corner of a cut one is in the blur.
        for (std::size_t k = 0; k < cuts_.cells.size(); ++k) join_faces(k);
        take_steps_of_neighbours();
        cuts_.around.assign(elevations_.size(), 0.0F);
        for (const std::size_t cell : cuts_.cells) {
            const std::size_t below = cell + static_cast<std::size_t>(columns_);
            cuts_.around[below + 1] += 1.0F;
            cuts_.around[below] += 2.0F;
            cuts_.around[cell + 1] += 4.0F;
            cuts_.around[cell] += 8.0F;
        }
    }

  private:
    [[nodiscard]] std::size_t index(GridPlace p) const {
        return static_cast<std::size_t>(p.j) * static_cast<std::size_t>(columns_) +
               static_cast<std::size_t>(p.i);
    }
    [[nodiscard]] GridPlace place(std::size_t index) const {
        const auto columns = static_cast<std::size_t>(columns_);
        return {static_cast<int>(index % columns), static_cast<int>(index / columns)};
    }
    [[nodiscard]] bool is_cell(GridPlace p) const {
        return p.i >= 0 && p.j >= 0 && p.i + 1 < columns_ && p.j + 1 < rows_;
    }

    void cut(GridPlace cell, glm::vec2 ends_px) {
        cuts_.cut[index(cell)] = 1.0F;
        cuts_.cells.push_back(index(cell));
        cuts_.ends_px.push_back(ends_px);
    }

    void find_steps() {
        const auto units = static_cast<float>(grid_.step) / static_cast<float>(unit_);
        const float least_rise = limit_px_ * std::min(units, 1.0F);
        for (int j = 0; j + 1 < rows_; ++j) {
            const float* const above = &elevations_[index({0, j})];
            const float* const below = above + columns_;
            for (int i = 0; i + 1 < columns_; ++i) {
                const float low =
                    std::min(std::min(above[i], above[i + 1]), std::min(below[i], below[i + 1]));
                const float high =
                    std::max(std::max(above[i], above[i + 1]), std::max(below[i], below[i + 1]));
                if (high - low > least_rise && has_step({i, j})) cut({i, j}, {low, high});
            }
        }
    }

    [[nodiscard]] bool has_step(GridPlace cell) const {
        const int left = grid_.image_i(cell.i);
        const int right = grid_.image_i(cell.i + 1);
        const int top = grid_.image_j(cell.j);
        const int bottom = grid_.image_j(cell.j + 1);
        const auto stride = static_cast<std::size_t>(image_.columns);
        const auto in_row = [&](int y) {
            return has_step_along(image_.index(0, y), 1, image_.columns, left, right);
        };
        const auto in_column = [&](int x) {
            return has_step_along(image_.index(x, 0), stride, image_.rows, top, bottom);
        };
        for (int y = top; y < bottom; y += unit_)
            if (in_row(y)) return true;
        for (int x = left; x < right; x += unit_)
            if (in_column(x)) return true;
        return in_row(bottom) || in_column(right);  // an outline may touch one corner only
    }

    /// Whether the row or column that begins at pixel `first`, of `count` pixels, has a step
    /// between its pixels `from` and `to`.
    [[nodiscard]] bool has_step_along(std::size_t first, std::size_t stride, int count, int from,
                                      int to) const {
        const auto at = [&](int k) {
            return elevation_(first + static_cast<std::size_t>(std::min(k, count - 1)) * stride);
        };
        for (int k = from; k < to; k += unit_) {
            const int begin = std::max(std::min(k, to - unit_), 0);  // not beyond the cell
            const bool steep = std::abs(at(begin + unit_) - at(begin)) > limit_px_;
            if (steep && StepSurroundings(elevation_, first, stride, count, begin, unit_)
                             .has_step(kLeastStep * limit_px_))
                return true;
        }
        return false;
    }

    [[nodiscard]] static float rise(glm::vec2 ends_px) { return ends_px.y - ends_px.x; }

    /// Finds where the faces of a cut cell end; without a step on its edges, they are known
    /// already. A corner in the blur between them is on none: no uncut cell may hang on it, so all
    /// cells around it are cut.
    void join_faces(std::size_t number) {
        const GridPlace cell = place(cuts_.cells[number]);
        const auto faces = ramps_.in_cell(cell, limit_px_);
        if (!faces || rise(faces->ends_px) < kSameFaces * rise(cuts_.ends_px[number])) return;
        cuts_.ends_px[number] = faces->ends_px;
        const std::array<GridPlace, 4> corners = corners_of(cell);
        for (std::size_t k = 0; k < corners.size(); ++k) {
            const GridPlace corner = corners[k];
            if (!faces->on_ramp[k] || cuts_.between[index(corner)]) continue;
            cuts_.between[index(corner)] = true;
            for (const GridPlace around :
                 {corner, GridPlace{corner.i - 1, corner.j}, GridPlace{corner.i, corner.j - 1},
                  GridPlace{corner.i - 1, corner.j - 1}})
                if (is_cell(around) && cuts_.cut[index(around)] == 0.0F)
                    cut(around, faces->ends_px);
        }
    }

    /// A cell may be cut for a step that does not cross its own edges.
    void take_steps_of_neighbours() {
        std::vector<std::uint32_t> numbers(elevations_.size(), 0);  // of each cell, from 1
        for (std::size_t k = 0; k < cuts_.cells.size(); ++k)
            numbers[cuts_.cells[k]] = static_cast<std::uint32_t>(k + 1);
        for (std::size_t k = 0; k < cuts_.cells.size(); ++k) {
            if (rise(cuts_.ends_px[k]) > kLeastStep * limit_px_) continue;
            const GridPlace middle = place(cuts_.cells[k]);
            for (int j = middle.j - 1; j <= middle.j + 1; ++j) {
                for (int i = middle.i - 1; i <= middle.i + 1; ++i) {
                    const std::uint32_t number = is_cell({i, j}) ? numbers[index({i, j})] : 0;
                    if (number == 0) continue;
                    const glm::vec2 other = cuts_.ends_px[number - 1];
                    if (rise(other) > rise(cuts_.ends_px[k])) cuts_.ends_px[k] = other;
                }
            }
        }
    }

    const DepthImage& image_;  // used for the size only
    PixelElevation elevation_;
    const ReliefGrid& grid_;
    int columns_;
    int rows_;
    int unit_;        // [px]
    float limit_px_;  // of a unit's rise
    OutlineRamps ramps_;
    const std::vector<float>& elevations_;
    SilhouetteCuts& cuts_;
};

}  // namespace

void find_cuts(const BlendedDepth& depth, const ReliefGrid& grid,
               const std::vector<float>& elevations, double slope_limit, SilhouetteCuts& cuts) {
    CutFinder(depth, grid, elevations, slope_limit, cuts).run();
}

}  // namespace dibhr
