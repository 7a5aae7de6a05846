// The walk over TRIANGLEs, EDGEs and VERTEXes, with the friction cone before every straight piece.
#include "core/haptics/surface_walk.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/haptics/neighbours.hpp"
#include "core/haptics/straight_way.hpp"

namespace dibhr {

namespace {

/// An EDGE crossed at the foot itself is crossed: the TRIANGLE behind it may lead on.
constexpr double kPastFoot = 1.0 + 1e-11;

Vec3 vertex_position(const DepthSurface& surface, int i, int j) noexcept {
    return {i, j, surface.elevation(i, j)};
}

/// The point of an EDGE at `along` in [0, 1]: on the grid line itself, so that round-off never
/// leaves a point beside the EDGE it is on.
Vec3 point_on(const EdgeEnds& ends, const EdgeElevations& z, double along) noexcept {
    return {ends.begin_i + along * (ends.end_i - ends.begin_i),
            ends.begin_j + along * (ends.end_j - ends.begin_j),
            z.begin + along * (z.end - z.begin)};
}

}  // namespace

void SurfaceWalk::run(int most_moves) noexcept {
    visit_until_rest(most_moves, [this] {
        switch (proxy_.active.kind) {
            case PrimitiveKind::triangle:
                return visit_triangle();
            case PrimitiveKind::edge:
                return visit_edge();
            case PrimitiveKind::vertex:
                return visit_vertex();
            case PrimitiveKind::none:
                break;
        }
        return visit_free();
    });
}

SurfaceWalk::Projection SurfaceWalk::project_on(const Facet& facet) const noexcept {
    const double rise = goal_.z - facet.elevation_at(goal_.x, goal_.y);
    const double fall = rise / (1.0 + square(facet.slope_x()) + square(facet.slope_y()));
    const double x = goal_.x + facet.slope_x() * fall;
    const double y = goal_.y + facet.slope_y() * fall;
    return {{x, y, facet.elevation_at(x, y)}, rise, rise * fall};
}

ProxyWalk::Next SurfaceWalk::visit_triangle() noexcept {
    const Facet facet(surface_, proxy_.active);
    return glide(facet, project_on(facet));
}

/// Over the active TRIANGLE and on across EDGEs, for as long as the next TRIANGLE leads nearer to
/// the goal.
ProxyWalk::Next SurfaceWalk::glide(Facet facet, Projection goal_on) noexcept {
    for (;;) {
        if (goal_on.rise > 0.0) return leave();
        const Piece piece = piece_to(goal_on.foot, goal_on.distance2);
        if (piece.sticks) {
            proxy_.active = facet.triangle();
            return Next::rest;
        }
        const PlaneExit exit = cross_plane(facet, piece);
        if (exit.reason == PlaneExit::Reason::rest) {
            proxy_.active = facet.triangle();
            return stop_at_cone(piece);
        }
        move_to_crossing(facet, exit, piece.foot);
        if (exit.reason == PlaneExit::Reason::border) return Next::visit;
        if (proxy_.active.kind == PrimitiveKind::vertex) return Next::visit;
        goal_on = project_on(facet);
        const Barycentric at_foot = facet.barycentric(goal_on.foot.x, goal_on.foot.y);
        if (at_foot.across(exit.through) <= kThere_px) return slide_along_edge();  // a crease
    }
}

/// Follows the piece over TRIANGLEs of one plane, on which it stays straight. `facet` becomes the
/// first TRIANGLE that is not of the plane, or the last one before the border or the cone.
SurfaceWalk::PlaneExit SurfaceWalk::cross_plane(Facet& facet, const Piece& piece) noexcept {
    using Reason = PlaneExit::Reason;
    Facet here = facet;  // a local value stays in registers
    int moves = proxy_.moves;
    PlaneExit exit;
    const auto cross = [&](auto direction, double t) {
        exit.through = direction;
        exit.t = t;
        if (t > kPastFoot) return Reason::rest;
        if (square(1.0 - t) * piece.length2 < piece.cone2) return Reason::rest;
        const Facet::Across across = here.step_across(surface_, direction);
        if (across == Facet::Across::border || moves >= most_moves_) return Reason::border;
        moves += 2;  // the EDGE, and the TRIANGLE behind it
        return across == Facet::Across::same_plane ? Reason::none : Reason::other_plane;
    };
    const FirstExit first = first_exit(facet, proxy_.position, piece.foot);
    exit.reason = cross(first.through, first.t);
    if (exit.reason == Reason::none) {
        StraightWay way(proxy_.position, piece.foot, here);
        while (exit.reason == Reason::none) exit.reason = way.over_next_edge(here.sign(), cross);
    }
    proxy_.moves = moves;
    facet = here;
    return exit;
}

/// To where the piece leaves the plane: on an EDGE, or the VERTEX it hits exactly; makes that
/// active. The crossing is snapped to the grid line, so that round-off never leaves a point beside
/// the EDGE it is on.
void SurfaceWalk::move_to_crossing(const Facet& beside, const PlaneExit& exit, Vec3 foot) noexcept {
    const Primitive border = edge_of(beside.triangle(), exit.through);
    const EdgeEnds ends = ends_of(border);
    const Vec3& p = proxy_.position;
    const double x = p.x + exit.t * (foot.x - p.x);
    const double y = p.y + exit.t * (foot.y - p.y);
    const double along = exit.through == EdgeDirection::along_row      ? x - ends.begin_i
                         : exit.through == EdgeDirection::along_column ? y - ends.begin_j
                                                                       : ends.begin_i - x;
    move_to(point_on(ends, beside.elevations_along(exit.through), std::clamp(along, 0.0, 1.0)));
    if (along <= 0.0) {
        proxy_.active = vertex(ends.begin_i, ends.begin_j);
    } else if (along >= 1.0) {
        proxy_.active = vertex(ends.end_i, ends.end_j);
    } else {
        proxy_.active = border;
    }
}

ProxyWalk::Next SurfaceWalk::visit_edge() noexcept {
    const EdgeDirection direction = proxy_.active.direction;
    const TrianglePair sides = triangles_of(surface_, proxy_.active);
    std::optional<Facet> steepest;
    Projection goal_on_steepest;
    double steepest2 = 0.0;
    for (const auto& side : {sides.first, sides.second}) {
        if (!side) continue;
        const Facet facet(surface_, *side);
        const Projection goal_on = project_on(facet);
        const double inside = facet.barycentric(goal_on.foot.x, goal_on.foot.y).across(direction);
        if (inside <= kThere_px) continue;
        // The foot's distance from the EDGE, in the plane: `inside` times the TRIANGLE's height
        // over it, which is |normal| / |EDGE|. The EDGE is the same for both.
        const double gradient2 =
            square(inside) * (1.0 + square(facet.slope_x()) + square(facet.slope_y()));
        if (gradient2 <= steepest2) continue;
        steepest = facet;
        goal_on_steepest = goal_on;
        steepest2 = gradient2;
    }
    if (!steepest) return slide_along_edge();
    ++proxy_.moves;
    return glide(*steepest, goal_on_steepest);
}

ProxyWalk::Next SurfaceWalk::slide_along_edge() noexcept {
    const Primitive active = proxy_.active;
    const EdgeEnds ends = ends_of(active);
    if (is_above(triangle_towards(surface_, active, goal_.x, goal_.y))) {
        return leave();
    }

    const Vec3 begin = vertex_position(surface_, ends.begin_i, ends.begin_j);
    const Vec3 end = vertex_position(surface_, ends.end_i, ends.end_j);
    const Vec3 along = end - begin;
    const double foot_along = dot(goal_ - begin, along) / dot(along, along);
    const Vec3 foot = begin + foot_along * along;
    const Vec3 away = goal_ - foot;
    const Piece piece = piece_to(foot, dot(away, away));
    const bool past_begin = foot_along <= 0.0;
    const bool past_an_end = past_begin || foot_along >= 1.0;
    // Without friction a foot at the very end is the VERTEX's to judge.
    if (piece.sticks && (piece.stick2 > 0.0 || !past_an_end)) return Next::rest;
    if (past_an_end) {
        const Vec3 corner = past_begin ? begin : end;
        const Vec3 beyond = foot - corner;
        if (dot(beyond, beyond) >= piece.cone2) {
            move_to(corner);
            proxy_.active =
                past_begin ? vertex(ends.begin_i, ends.begin_j) : vertex(ends.end_i, ends.end_j);
            return Next::visit;
        }
    }
    return stop_at_cone(piece);
}

ProxyWalk::Next SurfaceWalk::visit_vertex() noexcept {
    const Primitive active = proxy_.active;
    const Vec3 to_goal = goal_ - proxy_.position;
    std::optional<Primitive> steepest;
    double steepest_gain = kThere_px;
    for (const VertexSpoke& spoke : spokes_of(active)) {
        if (spoke.far_i < 0 || spoke.far_i >= surface_.columns()) continue;
        if (spoke.far_j < 0 || spoke.far_j >= surface_.rows()) continue;
        const Vec3 along = vertex_position(surface_, spoke.far_i, spoke.far_j) - proxy_.position;
        const double gain = dot(to_goal, along) / std::sqrt(dot(along, along));
        if (gain > steepest_gain) {
            steepest_gain = gain;
            steepest = spoke.edge;
        }
    }
    if (steepest) {
        proxy_.active = *steepest;
        return Next::visit;
    }
    return rest_or_leave();
}

SurfaceWalk::Piece SurfaceWalk::piece_to(Vec3 foot, double distance2) const noexcept {
    const Vec3 way = foot - proxy_.position;
    const double length2 = dot(way, way);
    const double mu_d = friction_.dynamic_coefficient;
    const double stick2 = square(holding_coefficient()) * distance2;
    const bool sticks = length2 <= stick2 * kConeRounding + square(kThere_px);
    return {foot, length2, square(mu_d) * distance2, stick2, sticks};
}

ProxyWalk::Next SurfaceWalk::stop_at_cone(const Piece& piece) noexcept {
    const double back = std::sqrt(piece.cone2 / piece.length2);
    move_to(piece.foot + back * (proxy_.position - piece.foot));
    return Next::rest;
}

}  // namespace dibhr
