// Start, surface following and resuming; free flight, leaving and resting of a walk.
#include "core/haptics/proxy.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <optional>

#include "core/haptics/collision.hpp"
#include "core/haptics/facet.hpp"
#include "core/haptics/neighbours.hpp"
#include "core/haptics/proxy_walk.hpp"

namespace dibhr {

namespace {

/// Flying over this many cells takes as long as all moves of an update, where no cell is in a cache
/// yet.
constexpr int kMostCells = 400;

/// A point nearer to a grid line than this is on it [px]: no step, even up a cliff of 255 px.
constexpr double kOnGrid_px = 1e-12;

/// A material point that goes up or down more steeply than this [px/px] has been mistaken for a
/// point of another object, in front of it or behind.
constexpr double kSteepestCarried = 8.0;
/// Sampling step on its way: half of the width of the narrowest cliff.
constexpr double kCarriedPiece_px = 0.5;

/// The elevation at `to`; nothing if there is a cliff between the two places, seen from above.
std::optional<double> elevation_beyond(const DepthSurface& surface, Vec2 from, Vec2 to) noexcept {
    constexpr double kRoundOff_px = 1e-9;
    const double length = glm::length(to - from);
    const double pieces = std::ceil(length / kCarriedPiece_px);
    const double most_px = kSteepestCarried * length / pieces + kRoundOff_px;
    double last = surface.elevation_at(from.x, from.y);
    for (double k = 1.0; k <= pieces; ++k) {
        const Vec2 at = k < pieces ? from + k / pieces * (to - from) : to;
        const double here = surface.elevation_at(at.x, at.y);
        if (std::abs(here - last) > most_px) return std::nullopt;
        last = here;
    }
    return last;
}

}  // namespace

const Proxy& ProxyAlgorithm::update(const DepthSurface& surface, Vec3 goal,
                                    const Friction& friction, const SurfaceMotion& given) noexcept {
    const Vec3 goal_in_frame = surface.clamped_to_frame(surface.clamped_to_reach(goal));
    const SurfaceMotion motion = given.over(surface.columns(), surface.rows());
    carried_px_ = Vec3(0.0);
    proxy_.flown = proxy_.motion_read = {};
    if (started_ && surface.columns() == columns_ && surface.rows() == rows_) {
        const Vec3 before = proxy_.position;
        const bool goes_along = proxy_.contact && motion.continues();
        if (!goes_along || !carry(surface, motion)) follow_surface(surface);
        if (goes_along) carried_px_ = proxy_.position - before;
    } else {
        start_above(surface, goal_in_frame);
    }
    proxy_.moves = proxy_.reads = 0;
    proxy_.bound_met = false;
    walk(surface, goal_in_frame, friction, proxy_);
    proxy_.position = surface.clamped_to_frame(proxy_.position);  // of round-off at the border
    if (proxy_.contact)
        material_.attach_at(Vec2(proxy_.position), motion, proxy_.motion_read);
    else
        material_.forget();
    return proxy_;
}

void ProxyAlgorithm::start_above(const DepthSurface& surface, Vec3 goal) noexcept {
    proxy_ = Proxy{};
    proxy_.position = {goal.x, goal.y, std::max(goal.z, surface.elevation_at(goal.x, goal.y))};
    material_.forget();
    columns_ = surface.columns();
    rows_ = surface.rows();
    started_ = true;
}

bool ProxyAlgorithm::carry(const DepthSurface& surface, const SurfaceMotion& motion) noexcept {
    Vec3& p = proxy_.position;
    const Vec2 here(p);
    const Vec2 step = material_.step_from(here, motion, proxy_.motion_read);
    if (step == Vec2(0.0) || !(glm::length(step) <= motion.farthest_px())) return false;
    const Vec2 there(surface.clamped_to_frame({here + step, p.z}));
    if (there == here) return false;
    proxy_.flown.add(here);
    proxy_.flown.add(there);
    const std::optional<double> elevation = elevation_beyond(surface, here, there);
    if (!elevation) return false;
    p = {there, *elevation};
    proxy_.active = surface.triangle_at(p.x, p.y);
    return true;
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
    const Flight flight = fly_to(goal_);
    proxy_.position = flight.end;
    if (flight.cut_short && touched_) stay_on_surface();
    if (!flight.ground) return Next::rest;
    proxy_.contact = touched_ = true;
    proxy_.slipping = false;
    proxy_.active = *flight.ground;
    return Next::visit;
}

bool ProxyWalk::stay_on_surface() noexcept {
    if (goal_.z >= surface_.elevation_at(goal_.x, goal_.y)) return false;
    Vec3& p = proxy_.position;
    p.z = surface_.elevation_at(p.x, p.y);
    proxy_.contact = true;
    proxy_.active = surface_.triangle_at(p.x, p.y);
    return true;
}

Flight ProxyWalk::fly_to(Vec3 end) noexcept {
    const int moves_left = std::max(most_moves_ - proxy_.moves, 0);
    const Flight flight = fly(surface_, proxy_.position, end, moves_left * kMostCells / all_moves_);
    most_moves_ -= (flight.cells * all_moves_ + kMostCells - 1) / kMostCells;
    proxy_.flown.add(Vec2(proxy_.position));
    proxy_.flown.add(Vec2(flight.end));
    if (flight.cut_short) proxy_.bound_met = true;
    return flight;
}

void ProxyWalk::end_or_look_ahead() noexcept {
    if (proxy_.reads >= most_reads_) {
        most_moves_ = std::min(most_moves_, proxy_.moves);
        return;
    }
    halt_reads_ = std::min(proxy_.reads + kReadsToNextLook, most_reads_);
    const auto i = static_cast<int>(proxy_.position.x);
    const auto j = static_cast<int>(proxy_.position.y);
    const int way_i = i - looked_i_;
    const int way_j = j - looked_j_;
    const bool is_first = looked_i_ < 0;
    looked_i_ = i;
    looked_j_ = j;
    const int length = std::max(std::abs(way_i), std::abs(way_j));
    if (is_first || length > kReadsToNextLook) return;  // or it flew
    constexpr int kBeside = 2;  // a move reads its neighbours, and ways are seldom quite straight
    for (int k = length + 1; k <= 2 * length; ++k) {
        const int to_i = i + k * way_i / length;
        const int to_j = j + k * way_j / length;
        surface_.fetch(to_i - kBeside, to_j);
        surface_.fetch(to_i + kBeside, to_j);
    }
}

ProxyWalk::Next ProxyWalk::leave() noexcept {
    // The last flight from here came down at once: on cliffs round-off can hide the way out.
    if (squared_distance(proxy_.position, left_surface_at_) <= square(kTouchDepth_px))
        return Next::rest;
    left_surface_at_ = proxy_.position;
    proxy_.contact = false;
    proxy_.slipping = false;
    proxy_.active = Primitive{};
    return visit_free();
}

ProxyWalk::Next ProxyWalk::rest_or_leave() noexcept {
    return goal_.z > ground_towards_goal().elevation_at(goal_.x, goal_.y) ? leave() : Next::rest;
}

Facet ProxyWalk::ground_towards_goal() const noexcept {
    // By reference: reading a value as a whole is slow just after its parts were written.
    const Primitive& active = proxy_.active;
    switch (active.kind) {
        case PrimitiveKind::edge:
            return {surface_, triangle_towards(surface_, active, goal_.x, goal_.y)};
        case PrimitiveKind::vertex:
            return {surface_, triangle_around(surface_, active, goal_.x, goal_.y)};
        case PrimitiveKind::triangle:
        case PrimitiveKind::none:
            break;
    }
    return {surface_, active};
}

Primitive ProxyWalk::smallest_primitive_under_proxy() const noexcept {
    const Vec3& p = proxy_.position;
    return smallest_primitive_under(proxy_.active, p.x, p.y, kOnGrid_px);
}

void ProxyWalk::activate_smallest_primitive() noexcept {
    const PrimitiveKind kind = proxy_.active.kind;
    if (kind != PrimitiveKind::triangle && kind != PrimitiveKind::edge) return;
    const Primitive lowest = smallest_primitive_under_proxy();
    if (lowest.kind == kind) return;
    proxy_.active = lowest;
    if (lowest.kind == PrimitiveKind::vertex) {
        proxy_.position = surface_.vertex_at(lowest.i, lowest.j);
    }
}

}  // namespace dibhr
