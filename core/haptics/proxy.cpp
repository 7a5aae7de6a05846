// Start, surface following and resuming.
#include "core/haptics/proxy.hpp"

#include <algorithm>
#include <cmath>

namespace dibhr {

namespace {

/// Far more primitives than any path of a hand's step visits; grows with the cells it may cross.
int most_moves(Vec3 proxy, Vec3 goal) noexcept {
    // The foot of a goal far below a slope lies as far to the side.
    const double way =
        std::abs(goal.x - proxy.x) + std::abs(goal.y - proxy.y) + std::abs(goal.z - proxy.z);
    return 256 + static_cast<int>(64.0 * std::min(way, 1e6));
}

}  // namespace

const Proxy& ProxyAlgorithm::update(const DepthSurface& surface, Vec3 goal,
                                    const Friction& friction) noexcept {
    const Vec3 goal_in_frame = surface.clamped_to_frame(goal);
    if (started_ && surface.columns() == columns_ && surface.rows() == rows_) {
        follow_surface(surface);
    } else {
        start_above(surface, goal_in_frame);
    }
    proxy_.moves = 0;
    proxy_.bound_met = false;
    walk(surface, goal_in_frame, friction, most_moves(proxy_.position, goal_in_frame), proxy_);
    return proxy_;
}

void ProxyAlgorithm::resume(const DepthSurface& surface, const Proxy& proxy) noexcept {
    proxy_ = proxy;
    proxy_.bound_met = false;
    columns_ = surface.columns();
    rows_ = surface.rows();
    started_ = true;
}

void ProxyAlgorithm::start_above(const DepthSurface& surface, Vec3 goal) noexcept {
    proxy_ = Proxy{};
    proxy_.position = {goal.x, goal.y, std::max(goal.z, surface.elevation_at(goal.x, goal.y))};
    columns_ = surface.columns();
    rows_ = surface.rows();
    started_ = true;
}

void ProxyAlgorithm::follow_surface(const DepthSurface& surface) noexcept {
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
