// The walk over TRIANGLEs, EDGEs and VERTEXes, with the friction cone before every straight piece.
#include "core/haptics/dibhr.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "core/haptics/crease.hpp"
#include "core/haptics/facet.hpp"
#include "core/haptics/glide.hpp"
#include "core/haptics/neighbours.hpp"
#include "core/haptics/proxy_walk.hpp"
#include "core/haptics/vertex_fan.hpp"

namespace dibhr {

namespace {

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
    /// A straight piece to the goal's foot on its line, the target of the proxy.
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
    Next glide(const Facet& start, const Facet::Projection& goal_on) noexcept {
        const double moving = square(friction_.dynamic_coefficient);
        const double sticking = square(friction_.static_coefficient);
        Glide glide({surface_, goal_, moving, last_move()}, proxy_.position, proxy_.moves,
                    proxy_.slipping ? moving : sticking, start, goal_on);
        const Glide::End end = glide.run();
        proxy_.moves = glide.moves();
        move_to(glide.position());
        switch (end) {
            case Glide::End::above:
                return leave();
            case Glide::End::held:
                proxy_.active = glide.facet().triangle();
                // On an EDGE it crossed: the TRIANGLE before it leads here, and a piece along the
                // EDGE is held where the TRIANGLE is, whose plane it lies in.
                return glide.crossed() ? Next::rest : rest_or_go_on();
            case Glide::End::cone:
                proxy_.active = glide.facet().triangle();
                return stop_at_cone(
                    {glide.goal_on().foot, glide.length2(), cone_at(glide.goal_on().distance2)});
            case Glide::End::crease: {
                const Primitive edge = glide.border();
                // The goal is not above the TRIANGLE it came over.
                const bool is_first = (glide.facet().sign() > 0);
                if (is_first == is_towards_first(edge, goal_.x, goal_.y) &&
                    glide.goal_on().rise > 0.0) {
                    return leave();
                }
                return slide_along(edge, glide.facet().elevations_along(edge.direction));
            }
            case Glide::End::stop:
            case Glide::End::none:
            case Glide::End::plane:
                break;
        }
        proxy_.active = glide.border();
        return Next::visit;
    }

    /// A TRIANGLE beside the active EDGE, relative to the goal.
    struct Side {
        const Facet& facet;
        Facet::Projection goal_on;
        double gradient2;  ///< of the distance to the goal, into it; 0: it leads no nearer
    };

    [[nodiscard]] Side side_of(const Facet& facet, EdgeDirection edge) const noexcept {
        const Facet::Projection goal_on = facet.project(goal_);
        const double inside = facet.barycentric(goal_on.foot.x, goal_on.foot.y).across(edge);
        // The foot's distance from the EDGE, in the plane: `inside` times the TRIANGLE's height
        // over it, which is |normal| / |EDGE|. The EDGE is the same for both.
        const double gradient2 =
            square(inside) * (1.0 + square(facet.slope_x()) + square(facet.slope_y()));
        return {facet, goal_on, inside <= kArrived_px ? 0.0 : gradient2};
    }

    /// Into the TRIANGLE beside the EDGE where the distance to the goal falls fastest, or along it.
    Next visit_edge() noexcept {
        const EdgeDirection direction = proxy_.active.direction;
        const TrianglePair pair = triangles_of(surface_, proxy_.active);
        const Facet first(surface_, pair.first ? *pair.first : *pair.second);
        const Side one = side_of(first, direction);
        if (!pair.first || !pair.second) return visit_sides(one, one);
        const Facet second(surface_, *pair.second);
        return visit_sides(one, side_of(second, direction));
    }

    /// Of the active EDGE; on the image's border there is one, twice.
    Next visit_sides(const Side& first, const Side& second) noexcept {
        const Side& steepest = second.gradient2 > first.gradient2 ? second : first;
        if (steepest.gradient2 > 0.0) {
            ++proxy_.moves;
            return glide(steepest.facet, steepest.goal_on);
        }
        const Side& under = is_towards_first(proxy_.active, goal_.x, goal_.y) ? first : second;
        if (under.goal_on.rise > 0.0) return leave();
        return slide_along(proxy_.active, first.facet.elevations_along(proxy_.active.direction));
    }

    /// Along an EDGE, which becomes active, with these elevations of its ends.
    Next slide_along(const Primitive& edge, const EdgeElevations& z) noexcept {
        const EdgeEnds ends = ends_of(edge);
        const Vec3 begin(ends.begin_i, ends.begin_j, z.begin);
        const Vec3 end(ends.end_i, ends.end_j, z.end);
        const Vec3 along = end - begin;
        const double foot_along = glm::dot(goal_ - begin, along) / glm::dot(along, along);
        const Vec3 foot = begin + foot_along * along;
        const Piece piece = piece_to(foot, squared_distance(goal_, foot));
        const bool past_begin = foot_along <= 0.0;
        const bool past_an_end = past_begin || foot_along >= 1.0;
        proxy_.active = edge;
        // Without friction a foot at the very end is the VERTEX's to judge.
        if (is_held(piece.cone, piece.length2) && (piece.cone.holding2 > 0.0 || !past_an_end)) {
            return rest_on_edge();
        }
        const Vec3 corner = past_begin ? begin : end;
        if (past_an_end && squared_distance(foot, corner) >= piece.cone.moving2) {
            const std::size_t spoke = spoke_along(edge.direction, past_begin);
            const Primitive end_vertex =
                past_begin ? vertex(ends.begin_i, ends.begin_j) : vertex(ends.end_i, ends.end_j);
            go_to_vertex(end_vertex, spoke, piece, corner, along);
            return Next::visit;
        }
        return stop_at_cone(piece);
    }

    /// To the end of an EDGE, and on over those that follow it in a straight crease.
    void go_to_vertex(const Primitive& end, std::size_t spoke, const Piece& piece, Vec3 corner,
                      Vec3 along) noexcept {
        const double to_cone =
            std::sqrt(squared_distance(piece.foot, corner)) - std::sqrt(piece.cone.moving2);
        const double edges = to_cone / std::sqrt(glm::dot(along, along)) - 1.0;
        const int moves_left = last_move() - proxy_.moves;
        const int most = std::min(static_cast<int>(std::max(edges, 0.0)), moves_left / 2 - 1);
        const int more = CreaseAhead(surface_, end, spoke, goal_).count(most);
        proxy_.moves += 2 * more;  // a VERTEX and an EDGE each
        proxy_.active = vertex(end.i + more * kSpokes[spoke].i, end.j + more * kSpokes[spoke].j);
        move_to(more == 0 ? corner : surface_.vertex_at(proxy_.active.i, proxy_.active.j));
    }

    /// The EDGE along which the distance to the goal falls fastest becomes active and is visited,
    /// if there is one.
    Next visit_vertex() noexcept {
        const VertexFan fan(surface_, proxy_.active);
        const std::size_t steepest = steepest_spoke(fan, kArrived_px, [](Vec3) { return true; });
        if (steepest == kSpokes.size()) return rest_or_leave();
        proxy_.active = edge_at(proxy_.active, steepest);
        if (proxy_.moves >= last_move()) return Next::visit;  // which ends the walk
        ++proxy_.moves;
        return visit_fan_edge(fan, steepest);
    }

    /// The spoke along which the distance falls fastest, by more than `least`, of those for which
    /// `is_free(along)` is true; kSpokes.size() if there is none.
    template <typename IsFree>
    [[nodiscard]] std::size_t steepest_spoke(const VertexFan& fan, double least,
                                             IsFree&& is_free) const noexcept {
        const Vec3 to_goal = goal_ - proxy_.position;
        std::size_t steepest = kSpokes.size();
        double steepest_gain = least;
        for (std::size_t k = 0; k < kSpokes.size(); ++k) {
            if (!fan.has(k)) continue;
            const Vec3 along = fan.along(k);
            const double nearer = glm::dot(to_goal, along);
            if (nearer <= 0.0 || !is_free(along)) continue;
            const double gain = nearer / std::sqrt(glm::dot(along, along));
            if (gain <= steepest_gain) continue;
            steepest_gain = gain;
            steepest = k;
        }
        return steepest;
    }

    /// Friction holds the proxy on the active piece. On an EDGE or a VERTEX that is not all that
    /// surrounds it: it goes on by the piece along which the distance falls fastest of those on
    /// which friction does not hold it, and rests where there is none.
    Next rest_or_go_on() noexcept {
        if (proxy_.position == judged_) return Next::rest;
        judged_ = proxy_.position;
        const Primitive under = smallest_primitive_under_proxy();
        if (under.kind == PrimitiveKind::vertex) return go_on_from_vertex(under);
        if (under.kind == PrimitiveKind::edge) return go_on_from_edge(under);
        return Next::rest;
    }

    /// The same where neither TRIANGLE beside the active EDGE leads nearer.
    Next rest_on_edge() noexcept {
        const bool on_vertex = smallest_primitive_under_proxy().kind == PrimitiveKind::vertex;
        return on_vertex ? rest_or_go_on() : Next::rest;
    }

    /// How far a TRIANGLE's piece leads, squared; 0 where friction holds the proxy. Nothing holds
    /// it from a goal above.
    [[nodiscard]] double free_length2(const Facet::Projection& goal_on) const noexcept {
        const Piece piece = piece_to(goal_on.foot, goal_on.distance2);
        const bool is_free = goal_on.rise > 0.0 || !is_held(piece.cone, piece.length2);
        return is_free ? piece.length2 : 0.0;
    }

    Next go_on_from_edge(const Primitive& edge) noexcept {
        const TrianglePair pair = triangles_of(surface_, edge);
        double farthest2 = 0.0;
        for (const auto& triangle : {pair.first, pair.second}) {
            if (!triangle) continue;
            const Facet facet(surface_, *triangle);
            const Side side = side_of(facet, edge.direction);
            const double length2 = side.gradient2 > 0.0 ? free_length2(side.goal_on) : 0.0;
            if (length2 <= farthest2) continue;
            farthest2 = length2;
            proxy_.active = *triangle;
        }
        return farthest2 > 0.0 ? Next::visit : Next::rest;
    }

    [[nodiscard]] bool is_held_along(Vec3 along) const noexcept {
        const Vec3 to_goal = goal_ - proxy_.position;
        const double length2 = square(glm::dot(to_goal, along)) / glm::dot(along, along);
        return is_held(cone_at(glm::dot(to_goal, to_goal) - length2), length2);
    }

    Next go_on_from_vertex(const Primitive& vertex) noexcept {
        const VertexFan fan(surface_, vertex);
        double farthest2 = 0.0;
        for (std::size_t k = 0; k < kSpokes.size(); ++k) {
            if (!fan.has_facet(k)) continue;
            const Facet facet = fan.facet(k);
            const Facet::Projection goal_on = facet.project(goal_);
            const Barycentric at_foot = facet.barycentric(goal_on.foot.x, goal_on.foot.y);
            if (at_foot.across(direction_of_spoke(k)) <= kArrived_px) continue;
            if (at_foot.across(direction_of_spoke((k + 1) % kSpokes.size())) <= kArrived_px)
                continue;
            const double length2 = free_length2(goal_on);
            if (length2 <= farthest2) continue;
            farthest2 = length2;
            proxy_.active = facet.triangle();
        }
        if (farthest2 > 0.0) return Next::visit;
        return go_on_by_spoke(vertex, fan);
    }

    /// No TRIANGLE around the VERTEX leads on: an EDGE may.
    Next go_on_by_spoke(const Primitive& vertex, const VertexFan& fan) noexcept {
        const std::size_t steepest =
            steepest_spoke(fan, 0.0, [this](Vec3 along) { return !is_held_along(along); });
        if (steepest == kSpokes.size()) return Next::rest;
        return slide_along(edge_at(vertex, steepest), fan.elevations_along(steepest));
    }

    /// Visits the EDGE along a spoke, whose TRIANGLEs the fan holds.
    Next visit_fan_edge(const VertexFan& fan, std::size_t spoke) noexcept {
        // As `triangles_of` orders them: the even one is towards +x and +y.
        const std::size_t before = (spoke + 5) % kSpokes.size();
        const std::size_t first = spoke % 2 == 0 ? spoke : before;
        const std::size_t second = spoke % 2 == 0 ? before : spoke;
        const EdgeDirection direction = proxy_.active.direction;
        const Facet facet = fan.facet(fan.has_facet(first) ? first : second);
        const Side one = side_of(facet, direction);
        if (!fan.has_facet(first) || !fan.has_facet(second)) return visit_sides(one, one);
        const Facet other = fan.facet(second);
        return visit_sides(one, side_of(other, direction));
    }

    Vec3 judged_{std::numeric_limits<double>::infinity()};  ///< where all around it was judged
};

}  // namespace

void Dibhr::walk(const DepthSurface& surface, Vec3 goal, const Friction& friction,
                 Proxy& proxy) const noexcept {
    SurfaceWalk(surface, goal, friction, kMostMoves, proxy, last_move_).run();
}

Proxy Dibhr::after_moves(const DepthSurface& surface, Vec3 goal, const Friction& friction,
                         int moves) const noexcept {
    Dibhr some = *this;
    some.last_move_ = moves;
    return some.update(surface, goal, friction);
}

}  // namespace dibhr
