// Finds the cells of the drawn grid in which an object ends before another.
#include "render/silhouette_cuts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace dibhr {
namespace {

constexpr int kWidestStep = 3;      // pixels; wider is a slope
constexpr float kLeastStep = 2.0F;  // limits; lower ones are folds
constexpr float kOnSlope =
    0.2F;  // share of a step; a vertex this near a face's slope is on the face

/// The elevations around the edge from a pixel to the next one in a row or a column, as many as
/// steps that contain the edge may depend on.
class StepSurroundings {
  public:
    /// The edge from pixel `k` of `count`, whose first one is `first` of the image.
    StepSurroundings(const PixelElevation& elevation, std::size_t first, std::size_t stride,
                     int count, int k) {
        for (int n = 0; n < kValues; ++n) {
            const int clamped = std::clamp(k - kBefore + n, 0, count - 1);
            values_[static_cast<std::size_t>(n)] =
                elevation(first + static_cast<std::size_t>(clamped) * stride);
        }
    }
    /// Whether a step of 1 to kWidestStep pixels that contains the edge is higher than `least_px`.
    [[nodiscard]] bool has_step(float least_px) const {
        for (int width = 1; width <= kWidestStep; ++width) {
            for (int from = 1 - width; from <= 0; ++from)
                if (unexplained(from, width) > least_px) return true;
        }
        return false;
    }

  private:
    static constexpr int kBefore = kWidestStep + 1;  // the step's begin, and two pixels before it
    static constexpr int kValues = 2 * kBefore + 2;

    /// The elevation `n` pixels from the edge's first one.
    [[nodiscard]] float at(int n) const { return values_[static_cast<std::size_t>(kBefore + n)]; }

    /// The height of a step from pixel `from` to pixel `from + width`, less what its sides explain
    /// [px].
    [[nodiscard]] float unexplained(int from, int width) const {
        const int to = from + width;
        const float rise = at(to) - at(from);
        const float sign = rise < 0.0F ? -1.0F : 1.0F;
        const auto rise_at = [this, sign](int k) { return sign * (at(k + 1) - at(k)); };
        const float explained = std::max(continued(rise_at(from - 1), rise_at(from - 2)),
                                         continued(rise_at(to), rise_at(to + 1)));
        return sign * rise - static_cast<float>(width) * explained;
    }

    /// The rise to the next pixel that the two rises before it lead to [px].
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
          limit_px_(static_cast<float>(slope_limit)),
          elevations_(elevations),
          cuts_(cuts) {}

    void run() {
        cuts_.cells.clear();
        cuts_.cut.assign(elevations_.size(), 0.0F);
        cuts_.between.assign(elevations_.size(), false);
        find_steps();
        const std::size_t steps = cuts_.cells.size();
        for (std::size_t k = 0; k < steps; ++k) mark_between(cuts_.cells[k]);
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
    struct Place {
        int i{0};
        int j{0};
    };

    [[nodiscard]] std::size_t index(Place p) const {
        return static_cast<std::size_t>(p.j) * static_cast<std::size_t>(columns_) +
               static_cast<std::size_t>(p.i);
    }
    [[nodiscard]] Place place(std::size_t index) const {
        const auto columns = static_cast<std::size_t>(columns_);
        return {static_cast<int>(index % columns), static_cast<int>(index / columns)};
    }
    [[nodiscard]] float at(Place p) const { return elevations_[index(p)]; }
    [[nodiscard]] bool is_cell(Place p) const {
        return p.i >= 0 && p.j >= 0 && p.i + 1 < columns_ && p.j + 1 < rows_;
    }

    template <class Visit>
    void each_around(Place middle, const Visit& visit) const {
        for (int j = middle.j - 1; j <= middle.j + 1; ++j)
            for (int i = middle.i - 1; i <= middle.i + 1; ++i) visit(Place{i, j});
    }

    void find_steps() {
        for (int j = 0; j + 1 < rows_; ++j) {
            const float* const above = &elevations_[index({0, j})];
            const float* const below = above + columns_;
            for (int i = 0; i + 1 < columns_; ++i) {
                const float low =
                    std::min(std::min(above[i], above[i + 1]), std::min(below[i], below[i + 1]));
                const float high =
                    std::max(std::max(above[i], above[i + 1]), std::max(below[i], below[i + 1]));
                if (!(high - low > limit_px_) || !has_step({i, j})) continue;
                cuts_.cut[index({i, j})] = 1.0F;
                cuts_.cells.push_back(index({i, j}));
            }
        }
    }

    [[nodiscard]] bool has_step(Place cell) const {
        const int left = grid_.image_i(cell.i);
        const int right = grid_.image_i(cell.i + 1);
        const int top = grid_.image_j(cell.j);
        const int bottom = grid_.image_j(cell.j + 1);
        for (int y = top; y <= bottom; ++y)
            if (has_step_along(image_.index(0, y), 1, image_.columns, left, right)) return true;
        const auto stride = static_cast<std::size_t>(image_.columns);
        for (int x = left; x <= right; ++x)
            if (has_step_along(image_.index(x, 0), stride, image_.rows, top, bottom)) return true;
        return false;
    }

    /// Whether the row or column that begins at pixel `first`, of `count` pixels, has a step
    /// between its pixels `from` and `to`.
    [[nodiscard]] bool has_step_along(std::size_t first, std::size_t stride, int count, int from,
                                      int to) const {
        float before = elevation_(first + static_cast<std::size_t>(from) * stride);
        for (int k = from; k < to; ++k) {
            const float next = elevation_(first + static_cast<std::size_t>(k + 1) * stride);
            const bool steep = std::abs(next - before) > limit_px_;
            before = next;
            if (steep && StepSurroundings(elevation_, first, stride, count, k)
                             .has_step(kLeastStep * limit_px_))
                return true;
        }
        return false;
    }

    /// A corner that continues neither face's slope lies between the faces: no uncut cell may hang
    /// on it, so all cells around it are cut.
    void mark_between(std::size_t cell) {
        const Place first = place(cell);
        for (const Place corner : {first, Place{first.i + 1, first.j}, Place{first.i, first.j + 1},
                                   Place{first.i + 1, first.j + 1}}) {
            if (cuts_.between[index(corner)] || !lies_between(corner)) continue;
            cuts_.between[index(corner)] = true;
            for (const Place around :
                 {corner, Place{corner.i - 1, corner.j}, Place{corner.i, corner.j - 1},
                  Place{corner.i - 1, corner.j - 1}}) {
                if (!is_cell(around) || cuts_.cut[index(around)] > 0.0F) continue;
                cuts_.cut[index(around)] = 1.0F;
                cuts_.cells.push_back(index(around));
            }
        }
    }

    [[nodiscard]] bool lies_between(Place corner) const {
        Place up = corner;
        Place down = corner;
        each_around(corner, [&](Place p) {
            if (p.i < 0 || p.j < 0 || p.i >= columns_ || p.j >= rows_) return;
            if (at(p) > at(up)) up = p;
            if (at(p) < at(down)) down = p;
        });
        const float near = kOnSlope * (at(up) - at(down));
        return std::abs(at(corner) - extrapolated(corner, up)) > near &&
               std::abs(at(corner) - extrapolated(corner, down)) > near;
    }

    /// The elevation at `end`, extrapolated from the slope behind its neighbour `next`.
    [[nodiscard]] float extrapolated(Place end, Place next) const {
        const Place behind{2 * next.i - end.i, 2 * next.j - end.j};
        if (behind.i < 0 || behind.j < 0 || behind.i >= columns_ || behind.j >= rows_)
            return at(next);
        return 2.0F * at(next) - at(behind);
    }

    const DepthImage& image_;  // used for the size only
    PixelElevation elevation_;
    const ReliefGrid& grid_;
    int columns_;
    int rows_;
    float limit_px_;
    const std::vector<float>& elevations_;
    SilhouetteCuts& cuts_;
};

}  // namespace

void find_cuts(const BlendedDepth& depth, const ReliefGrid& grid,
               const std::vector<float>& elevations, double slope_limit, SilhouetteCuts& cuts) {
    CutFinder(depth, grid, elevations, slope_limit, cuts).run();
}

}  // namespace dibhr
