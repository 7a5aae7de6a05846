// Elevations between the vertices, the bump map, and the frame.
#include "core/haptics/surface.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/haptics/facet.hpp"

namespace dibhr {

DepthSurface::DepthSurface(const DepthImage& from, const DepthImage& to, double blend,
                           SurfaceShape shape, const BumpMap* bump) noexcept
    : from_(from.levels.data()),
      to_(to.levels.data()),
      columns_(from.columns),
      rows_(from.rows),
      blend_(std::clamp(blend, 0.0, 1.0)),
      relief_px_(shape.relief_px),
      highest_level_(from.highest_level),
      roughness_px_(shape.roughness_px),
      bump_(shape.roughness_px == 0.0 ? nullptr : bump) {
    assert(columns_ >= 2 && rows_ >= 2);
    assert(to.columns == columns_ && to.rows == rows_ && to.highest_level == highest_level_);
}

double DepthSurface::elevation_at(double x, double y) const noexcept {
    const Vec3 p = clamped_to_frame({x, y, 0.0});
    return Facet(*this, triangle_at(p.x, p.y)).elevation_at(p.x, p.y);
}

Primitive DepthSurface::triangle_at(double x, double y) const noexcept {
    const int i = std::clamp(static_cast<int>(std::floor(x)), 0, columns_ - 2);
    const int j = std::clamp(static_cast<int>(std::floor(y)), 0, rows_ - 2);
    return triangle(x - i + (y - j) <= 1.0 ? TriangleSide::near_origin : TriangleSide::far_corner,
                    i, j);
}

double DepthSurface::ceiling() const noexcept {
    const double roughness = bump_ == nullptr ? 0.0 : std::max(roughness_px_, 0.0);
    return std::max(relief_px_, 0.0) + roughness;
}

Vec3 DepthSurface::clamped_to_frame(Vec3 p) const noexcept {
    return {std::clamp(p.x, 0.0, columns_ - 1.0), std::clamp(p.y, 0.0, rows_ - 1.0), p.z};
}

double DepthSurface::bump_height(int i, int j) const noexcept {
    // Pixel centres of both images in the same normalised coordinates.
    const double x = (i + 0.5) / columns_ * bump_->columns - 0.5;
    const double y = (j + 0.5) / rows_ * bump_->rows - 0.5;
    const auto sample = [this](double column, double row) {
        const int c = std::clamp(static_cast<int>(column), 0, bump_->columns - 1);
        const int r = std::clamp(static_cast<int>(row), 0, bump_->rows - 1);
        return static_cast<double>(
            bump_->heights[static_cast<std::size_t>(r) * static_cast<std::size_t>(bump_->columns) +
                           static_cast<std::size_t>(c)]);
    };
    const double x0 = std::floor(x);
    const double y0 = std::floor(y);
    const double u = x - x0;
    const double v = y - y0;
    return (1.0 - v) * ((1.0 - u) * sample(x0, y0) + u * sample(x0 + 1.0, y0)) +
           v * ((1.0 - u) * sample(x0, y0 + 1.0) + u * sample(x0 + 1.0, y0 + 1.0));
}

}  // namespace dibhr
