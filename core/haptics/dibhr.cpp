// The walk over TRIANGLEs, EDGEs and VERTEXes, with the friction cone before every straight piece.
#include "core/haptics/dibhr.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/haptics/facet.hpp"
#include "core/haptics/neighbours.hpp"
#include "core/haptics/proxy_walk.hpp"

namespace dibhr {

namespace {

/// An EDGE crossed at the foot itself is crossed: the TRIANGLE behind it may lead on.
constexpr double kPastFoot = 1.0 + 1e-11;

/// The point of an EDGE at `along` in [0, 1]: on the grid line itself, so that round-off never
/// leaves a point beside the EDGE it is on.
Vec3 point_on(const EdgeEnds& ends, const EdgeElevations& z, double along) noexcept {
    return {ends.begin_i + along * (ends.end_i - ends.begin_i),
            ends.begin_j + along * (ends.end_j - ends.begin_j),
            z.begin + along * (z.end - z.begin)};
}

/// Every move is along one straight piece, on the surface or in free space, and ends nearer to the
/// goal than it began.
class SurfaceWalk : private ProxyWalk {
  public:
    using ProxyWalk::ProxyWalk;

    void run() noexcept {
        visit_until_rest([this] {
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

  private:
    /// A straight piece to the goal's foot on its line, where the proxy wants to go.
    struct Piece {
        Vec3 foot{0.0};
        double length2{0.0};
        Cone cone{};
    };

    [[nodiscard]] Piece piece_to(Vec3 foot, double foot_to_goal2) const noexcept {
        return {foot, squared_distance(foot, proxy_.position), cone_at(foot_to_goal2)};
    }

    Next stop_at_cone(const Piece& piece) noexcept {
        move_to(place_on_cone(piece.foot, piece.length2, piece.cone));
        return Next::rest;
    }

    Next visit_triangle() noexcept {
        const Facet facet(surface_, proxy_.active);
        return glide(facet, facet.project(goal_));
    }

    /// Over the active TRIANGLE and on across EDGEs, for as long as the next TRIANGLE leads nearer
    /// to the goal.
    Next glide(Facet facet, Facet::Projection goal_on) noexcept {
        for (;;) {
            if (goal_on.rise > 0.0) return leave();
            const Piece piece = piece_to(goal_on.foot, goal_on.distance2);
            if (is_held(piece.cone, piece.length2)) {
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
            goal_on = facet.project(goal_);
            const Barycentric at_foot = facet.barycentric(goal_on.foot.x, goal_on.foot.y);
            if (at_foot.across(exit.through) <= kThere_px) return slide_along_edge();  // a crease
        }
    }

    /// How the way over one plane ended.
    struct PlaneExit {
        enum class Reason { none, other_plane, border, rest };
        Reason reason{Reason::none};
        EdgeDirection through{EdgeDirection::diagonal};
        double t{0.0};  ///< of the piece, where it crosses
    };

    /// Follows the piece over TRIANGLEs of one plane, on which it stays straight. `facet` becomes
    /// the first TRIANGLE that is not of the plane, or the last one before the border or the cone.
    PlaneExit cross_plane(Facet& facet, const Piece& piece) noexcept {
        using Reason = PlaneExit::Reason;
        Facet here = facet;  // a local value stays in registers
        int moves = proxy_.moves;
        PlaneExit exit;
        const auto cross = [&](auto direction, double t) {
            exit.through = direction;
            exit.t = t;
            if (t > kPastFoot) return Reason::rest;
            if (square(1.0 - t) * piece.length2 < piece.cone.moving2) return Reason::rest;
            const Facet::Across across = here.step_across(surface_, direction);
            if (across == Facet::Across::border || moves >= most_moves_) return Reason::border;
            moves += 2;  // the EDGE, and the TRIANGLE behind it
            return across == Facet::Across::same_plane ? Reason::none : Reason::other_plane;
        };
        const FirstExit first = first_exit(facet, proxy_.position, piece.foot);
        exit.reason = cross(first.through, first.t);
        if (exit.reason == Reason::none) {
            StraightWay way(proxy_.position, piece.foot, here);
            while (exit.reason == Reason::none) {
                exit.reason = way.over_next_edge(here.sign(), cross);
            }
        }
        proxy_.moves = moves;
        facet = here;
        return exit;
    }

    /// To where the piece leaves the plane: on an EDGE, or the VERTEX it hits exactly; makes that
    /// active.
    void move_to_crossing(const Facet& beside, const PlaneExit& exit, Vec3 foot) noexcept {
        const Primitive border = edge_of(beside.triangle(), exit.through);
        const EdgeEnds ends = ends_of(border);
        const Vec3& p = proxy_.position;
        const double x = p.x + exit.t * (foot.x - p.x);
        const double y = p.y + exit.t * (foot.y - p.y);
        const double along = exit.through == EdgeDirection::along_row      ? x - ends.begin_i
                             : exit.through == EdgeDirection::along_column ? y - ends.begin_j
                                                                           : ends.begin_i - x;
        move_to(point_on(ends, beside.elevations_along(exit.through), std::clamp(along, 0.0, 1.0)));
        proxy_.active = along <= 0.0   ? vertex(ends.begin_i, ends.begin_j)
                        : along >= 1.0 ? vertex(ends.end_i, ends.end_j)
                                       : border;
    }

    /// The TRIANGLE beside it into which the distance to the goal falls fastest, or along it.
    Next visit_edge() noexcept {
        const EdgeDirection direction = proxy_.active.direction;
        const TrianglePair sides = triangles_of(surface_, proxy_.active);
        std::optional<Facet> steepest;
        Facet::Projection goal_on_steepest;
        double steepest2 = 0.0;
        for (const auto& side : {sides.first, sides.second}) {
            if (!side) continue;
            const Facet facet(surface_, *side);
            const Facet::Projection goal_on = facet.project(goal_);
            const double inside =
                facet.barycentric(goal_on.foot.x, goal_on.foot.y).across(direction);
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

    Next slide_along_edge() noexcept {
        if (is_above(triangle_towards(surface_, proxy_.active, goal_.x, goal_.y))) return leave();

        const EdgeEnds ends = ends_of(proxy_.active);
        const Vec3 begin = surface_.vertex_at(ends.begin_i, ends.begin_j);
        const Vec3 end = surface_.vertex_at(ends.end_i, ends.end_j);
        const Vec3 along = end - begin;
        const double foot_along = glm::dot(goal_ - begin, along) / glm::dot(along, along);
        const Vec3 foot = begin + foot_along * along;
        const Piece piece = piece_to(foot, squared_distance(goal_, foot));
        const bool past_begin = foot_along <= 0.0;
        const bool past_an_end = past_begin || foot_along >= 1.0;
        // Without friction a foot at the very end is the VERTEX's to judge.
        if (is_held(piece.cone, piece.length2) && (piece.cone.holding2 > 0.0 || !past_an_end)) {
            return Next::rest;
        }
        const Vec3 corner = past_begin ? begin : end;
        if (past_an_end && squared_distance(foot, corner) >= piece.cone.moving2) {
            move_to(corner);
            proxy_.active =
                past_begin ? vertex(ends.begin_i, ends.begin_j) : vertex(ends.end_i, ends.end_j);
            return Next::visit;
        }
        return stop_at_cone(piece);
    }

    /// The EDGE along which the distance to the goal falls fastest becomes active, if there is one.
    Next visit_vertex() noexcept {
        const Vec3 to_goal = goal_ - proxy_.position;
        std::optional<Primitive> steepest;
        double steepest_gain = kThere_px;
        for (const VertexSpoke& spoke : spokes_of(proxy_.active)) {
            if (!surface_.has_vertex(spoke.far_i, spoke.far_j)) continue;
            const Vec3 along = surface_.vertex_at(spoke.far_i, spoke.far_j) - proxy_.position;
            const double gain = glm::dot(to_goal, along) / std::sqrt(glm::dot(along, along));
            if (gain <= steepest_gain) continue;
            steepest_gain = gain;
            steepest = spoke.edge;
        }
        if (!steepest) return rest_or_leave();
        proxy_.active = *steepest;
        return Next::visit;
    }
};

}  // namespace

void Dibhr::walk(const DepthSurface& surface, Vec3 goal, const Friction& friction, int most_moves,
                 Proxy& proxy) const noexcept {
    SurfaceWalk(surface, goal, friction, most_moves, proxy).run();
}

}  // namespace dibhr
