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

/// The elevations along a row or a column of the image; the last one goes on beyond the border.
class PixelLine {
  public:
    PixelLine(const PixelElevation& elevation, std::size_t first, std::size_t stride, int count)
        : elevation_(elevation), first_(first), stride_(stride), last_(count - 1) {}

    [[nodiscard]] float operator[](int k) const {
        return elevation_(first_ + static_cast<std::size_t>(std::clamp(k, 0, last_)) * stride_);
    }

  private:
    const PixelElevation& elevation_;
    std::size_t first_, stride_;
    int last_;
};

/// The rise to the next pixel that the two rises before it lead to [px].
float continued(float rise, float rise_before) {
    const float curvature = std::clamp(rise - rise_before, 0.0F, std::max(rise, 0.0F));
    return std::max(rise + curvature, 0.0F);
}

/// The height of a step from pixel `from` to pixel `from + width`, less what its sides explain
/// [px].
float unexplained(const PixelLine& line, int from, int width) {
    const int to = from + width;
    const float rise = line[to] - line[from];
    const float sign = rise < 0.0F ? -1.0F : 1.0F;
    const auto rise_at = [&line, sign](int k) { return sign * (line[k + 1] - line[k]); };
    const float explained = std::max(continued(rise_at(from - 1), rise_at(from - 2)),
                                     continued(rise_at(to), rise_at(to + 1)));
    return sign * rise - static_cast<float>(width) * explained;
}

/// The highest step among those that contain the edge from pixel k to the next one [px].
float step_at(const PixelLine& line, int k) {
    float highest = 0.0F;
    for (int width = 1; width <= kWidestStep; ++width) {
        for (int from = k - width + 1; from <= k; ++from)
            highest = std::max(highest, unexplained(line, from, width));
    }
    return highest;
}

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
            for (int i = 0; i + 1 < columns_; ++i) {
                const auto [low, high] =
                    std::minmax({at({i, j}), at({i + 1, j}), at({i, j + 1}), at({i + 1, j + 1})});
                if (!(high - low > limit_px_)) continue;
                if (!has_step({i, j})) continue;
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
        for (int y = top; y <= bottom; ++y) {
            const PixelLine row(elevation_, image_.index(0, y), 1, image_.columns);
            for (int x = left; x < right; ++x)
                if (is_step(row, x)) return true;
        }
        const auto stride = static_cast<std::size_t>(image_.columns);
        for (int x = left; x <= right; ++x) {
            const PixelLine column(elevation_, image_.index(x, 0), stride, image_.rows);
            for (int y = top; y < bottom; ++y)
                if (is_step(column, y)) return true;
        }
        return false;
    }

    [[nodiscard]] bool is_step(const PixelLine& line, int k) const {
        return std::abs(line[k + 1] - line[k]) > limit_px_ &&
               step_at(line, k) > kLeastStep * limit_px_;
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
