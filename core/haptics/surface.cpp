// A surface from two images, and elevations between the vertices.
#include "core/haptics/surface.hpp"

#include <algorithm>
#include <cassert>

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

}  // namespace dibhr
