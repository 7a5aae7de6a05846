// One DIBHR update: the surface moved, free flight, and the walk over the primitives.
#include "core/haptics/dibhr.hpp"

#include <algorithm>
#include <cmath>

#include "core/haptics/collision.hpp"
#include "core/haptics/surface_walk.hpp"

namespace dibhr {

namespace {

/// Far more primitives than any path of a hand's step visits; grows with the cells it may cross.
/// The foot of a goal far below a slope lies as far to the side.
int most_moves(Vec3 proxy, Vec3 goal) noexcept {
    const Vec3 way = goal - proxy;
    return 256 + static_cast<int>(
                     64.0 * std::min(std::abs(way.x) + std::abs(way.y) + std::abs(way.z), 1e6));
}

}  // namespace

const Proxy& Dibhr::update(const DepthSurface& surface, Vec3 goal,
                           const Friction& friction) noexcept {
    const Vec3 goal_in_frame = surface.clamped_to_frame(goal);
    const bool fits = surface.columns() == columns_ && surface.rows() == rows_;
    if (started_ && fits) {
        follow_surface(surface);
    } else {
        start_above(surface, goal_in_frame);
    }

    proxy_.moves = 0;
    proxy_.bound_met = false;
    SurfaceWalk walk(surface, goal_in_frame, friction, proxy_);
    walk.run(most_moves(proxy_.position, goal_in_frame));
    return proxy_;
}

void Dibhr::start_above(const DepthSurface& surface, Vec3 goal) noexcept {
    proxy_ = Proxy{};
    proxy_.position = {goal.x, goal.y, std::max(goal.z, surface.elevation_at(goal.x, goal.y))};
    columns_ = surface.columns();
    rows_ = surface.rows();
    started_ = true;
}

void Dibhr::follow_surface(const DepthSurface& surface) noexcept {
    Vec3& p = proxy_.position;
    const double elevation = surface.elevation_at(p.x, p.y);
    if (proxy_.contact) {
        p.z = elevation;
    } else if (p.z < elevation) {  // the surface passed the free proxy: it is lifted
        p.z = elevation;
        proxy_.contact = true;
        proxy_.active = surface.triangle_at(p.x, p.y);
        proxy_.slipping = false;
    }
}

}  // namespace dibhr
