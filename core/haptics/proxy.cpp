// Start, surface following and resuming; free flight, leaving and resting of a walk.
#include "core/haptics/proxy.hpp"

#include <algorithm>
#include <cmath>

#include "core/haptics/collision.hpp"
#include "core/haptics/facet.hpp"
#include "core/haptics/neighbours.hpp"
#include "core/haptics/proxy_walk.hpp"

namespace dibhr {

namespace {

/// Far more primitives than any path of a hand's step visits; grows with the cells it may cross.
int most_moves(Vec3 proxy, Vec3 goal) noexcept {
    // The foot of a goal far below a slope lies as far to the side.
    const double way =
        std::abs(goal.x - proxy.x) + std::abs(goal.y - proxy.y) + std::abs(goal.z - proxy.z);
    return 256 + static_cast<int>(64.0 * std::min(way, 1e6));
}

/// Nearer to a grid line than this is on it [px]: even up a cliff of 255 px it is no step.
constexpr double kOnGrid_px = 1e-12;

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

ProxyWalk::Next ProxyWalk::visit_free() noexcept {
    const auto hit = first_hit(surface_, proxy_.position, goal_);
    if (!hit) {
        proxy_.position = goal_;
        return Next::rest;
    }
    proxy_.position = hit->position;
    proxy_.contact = true;
    proxy_.slipping = false;
    proxy_.active = hit->triangle;
    return Next::visit;
}

ProxyWalk::Next ProxyWalk::leave() noexcept {
    proxy_.contact = false;
    proxy_.slipping = false;
    proxy_.active = Primitive{};
    return visit_free();
}

ProxyWalk::Next ProxyWalk::rest_or_leave() noexcept {
    Primitive below = proxy_.active;
    if (below.kind == PrimitiveKind::edge) {
        below = triangle_towards(surface_, below, goal_.x, goal_.y);
    } else if (below.kind == PrimitiveKind::vertex) {
        below = triangle_around(surface_, below, goal_.x, goal_.y);
    }
    return is_above(below) ? leave() : Next::rest;
}

void ProxyWalk::stand_on_lowest() noexcept {
    const Primitive active = proxy_.active;
    if (active.kind != PrimitiveKind::triangle && active.kind != PrimitiveKind::edge) return;
    Vec3& p = proxy_.position;
    proxy_.active = lowest_under(active, p.x, p.y, kOnGrid_px);
    if (proxy_.active.kind == PrimitiveKind::vertex) {
        p = surface_.vertex_at(proxy_.active.i, proxy_.active.j);
    }
}

bool ProxyWalk::is_above(const Primitive& triangle) const noexcept {
    return goal_.z > Facet(surface_, triangle).elevation_at(goal_.x, goal_.y);
}

}  // namespace dibhr
