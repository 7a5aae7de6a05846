// Free flight, leaving and resting.
#include "core/haptics/proxy_walk.hpp"

#include "core/haptics/collision.hpp"
#include "core/haptics/facet.hpp"
#include "core/haptics/neighbours.hpp"

namespace dibhr {

namespace {

/// Nearer to a grid line than this is on it [px]: even up a cliff of 255 px it is no step.
constexpr double kOnGrid_px = 1e-12;

}  // namespace

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
