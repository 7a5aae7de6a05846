// A surface from two images, and elevations between the vertices.
#include "core/haptics/surface.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <new>
#include <utility>
#include <vector>

#include "core/haptics/facet.hpp"

namespace dibhr {

namespace {

/// The two columns (or rows) of a bump map around a VERTEX, and the share of the second. The pixel
/// centres of both images have the same normalised coordinates.
struct Between {
    int first{0};
    int second{0};
    double share{0.0};
};

/// Around VERTEX k of `count` that the map is stretched over: held at its border.
Between stretched_between(int k, int count, int bumps) noexcept {
    const double at = (k + 0.5) / count * bumps - 0.5;  // >= -0.5
    const int below = at < 0.0 ? -1 : static_cast<int>(at);
    return {std::max(below, 0), std::min(below + 1, bumps - 1), at - below};
}

/// Around VERTEX k, where the map begins anew every `period_px`.
Between repeated_between(int k, double period_px, int bumps) noexcept {
    const double at = std::fmod((k + 0.5) / period_px, 1.0) * bumps - 0.5;  // >= -0.5, < bumps
    const int below = at < 0.0 ? -1 : static_cast<int>(at);
    return {(below + bumps) % bumps, (below + 1) % bumps, at - below};
}

/// A bump map as it lies over columns x rows VERTEXes.
class LaidBump {
  public:
    LaidBump(const BumpMap& bump, int columns, int rows, double size_px) noexcept
        : bump_(bump), columns_(columns), rows_(rows), size_px_(size_px) {}

    [[nodiscard]] Between across(int i) const noexcept {
        if (!repeats()) return stretched_between(i, columns_, bump_.columns);
        return repeated_between(i, width_px(), bump_.columns);
    }

    [[nodiscard]] Between down(int j) const noexcept {
        if (!repeats()) return stretched_between(j, rows_, bump_.rows);
        return repeated_between(j, width_px() / bump_.columns * bump_.rows, bump_.rows);
    }

  private:
    [[nodiscard]] bool repeats() const noexcept { return size_px_ > 0.0; }
    /// A copy is a pixel at least.
    [[nodiscard]] double width_px() const noexcept { return std::max(size_px_, 1.0); }

    const BumpMap& bump_;
    int columns_;
    int rows_;
    double size_px_;
};

/// Bilinear height of a bump map.
double height_between(const BumpMap& bump, const Between& x, const Between& y) noexcept {
    const auto height = [&bump](int column, int row) {
        return static_cast<double>(
            bump.heights[static_cast<std::size_t>(row) * static_cast<std::size_t>(bump.columns) +
                         static_cast<std::size_t>(column)]);
    };
    return (1.0 - y.share) *
               ((1.0 - x.share) * height(x.first, y.first) + x.share * height(x.second, y.first)) +
           y.share *
               ((1.0 - x.share) * height(x.first, y.second) + x.share * height(x.second, y.second));
}

}  // namespace

DepthSurface::DepthSurface(const DepthImage& from, const DepthImage& to, double blend,
                           SurfaceShape shape, const BumpMap* bump,
                           const std::vector<std::uint8_t>* unseen, const TouchMaps* maps) noexcept
    : from_(from.levels.data()),
      to_(to.levels.data()),
      columns_(from.columns),
      rows_(from.rows),
      blend_(std::clamp(blend, 0.0, 1.0)),
      relief_px_(shape.relief_px),
      highest_level_(from.highest_level),
      roughness_px_(shape.roughness_px),
      bump_size_px_(shape.bump_size_px),
      bump_(shape.roughness_px == 0.0 ? nullptr : bump),
      unseen_(unseen == nullptr ? nullptr : unseen->data()),
      maps_(maps) {
    assert(unseen == nullptr || unseen->size() == from.levels.size());
    if (bump_ != nullptr && is_stretched(*bump_, columns_, rows_, bump_size_px_)) {
        stretched_ = bump_->at_vertices.heights.data();
        assert(bump_->at_vertices.heights.size() == from.levels.size());
    }
    if (maps_ != nullptr && maps_->at_vertices.columns == columns_ &&
        maps_->at_vertices.rows == rows_) {
        heights_ = maps_->at_vertices.heights_px.data();
        assert(maps_->at_vertices.heights_px.size() == from.levels.size());
    }
    is_bare_ = bump_ == nullptr && heights_ == nullptr;
    assert(columns_ >= 2 && rows_ >= 2);
    assert(to.columns == columns_ && to.rows == rows_ && to.highest_level == highest_level_);
}

double DepthSurface::elevation_at(double x, double y) const noexcept {
    const Vec3 p = clamped_to_frame({x, y, 0.0});
    return Facet(*this, triangle_at(p.x, p.y)).elevation_at(p.x, p.y);
}

bool DepthSurface::seen_at(double x, double y) const noexcept {
    if (unseen_ == nullptr) return true;
    const Vec3 p = clamped_to_frame({x, y, 0.0});
    const auto i = static_cast<std::size_t>(std::lround(p.x));
    const auto j = static_cast<std::size_t>(std::lround(p.y));
    return unseen_[j * static_cast<std::size_t>(columns_) + i] == 0;
}

double DepthSurface::map_value_at(const TouchMap& map, double x, double y,
                                  double otherwise) const noexcept {
    if (map.empty()) return otherwise;
    const Vec3 p = clamped_to_frame({x, y, 0.0});
    return map_value(map, p.x, p.y, columns_, rows_, otherwise);
}

Friction DepthSurface::friction_at(double x, double y, Friction everywhere) const noexcept {
    if (maps_ == nullptr || maps_->friction.empty()) return everywhere;
    const double as_static = everywhere.static_coefficient;
    const double ratio = as_static > 0.0 ? everywhere.dynamic_coefficient / as_static : 1.0;
    const double here = map_value_at(maps_->friction, x, y, as_static);
    if (here == as_static) return everywhere;
    return {here, ratio * here};
}

double DepthSurface::stiffness_at(double x, double y, double everywhere) const noexcept {
    return maps_ == nullptr ? everywhere : map_value_at(maps_->stiffness, x, y, everywhere);
}

double DepthSurface::bump_height(int i, int j) const noexcept {
    const LaidBump laid(*bump_, columns_, rows_, bump_size_px_);
    return height_between(*bump_, laid.across(i), laid.down(j));
}

void stretch(BumpMap& bump, int columns, int rows, double bump_size_px) {
    bump.at_vertices = {};  // stays so if memory runs out
    const LaidBump laid(bump, columns, rows, bump_size_px);
    std::vector<double> heights;
    heights.reserve(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
    for (int j = 0; j < rows; ++j) {
        const Between y = laid.down(j);
        for (int i = 0; i < columns; ++i)
            heights.push_back(height_between(bump, laid.across(i), y));
    }
    bump.at_vertices = {columns, rows, bump_size_px, std::move(heights)};
}

void stretch(std::shared_ptr<const BumpMap>& bump, int columns, int rows, double bump_size_px) try {
    if (!bump || columns < 1 || rows < 1 || is_stretched(*bump, columns, rows, bump_size_px))
        return;
    auto stretched = std::make_shared<BumpMap>(BumpMap{bump->columns, bump->rows, bump->heights});
    stretch(*stretched, columns, rows, bump_size_px);
    bump = std::move(stretched);
} catch (const std::bad_alloc&) {  // an update works without, and takes longer
}

bool is_stretched(const BumpMap& bump, int columns, int rows, double bump_size_px) noexcept {
    const BumpMap::AtVertices& at = bump.at_vertices;
    return at.columns == columns && at.rows == rows && at.size_px == bump_size_px;
}

}  // namespace dibhr
