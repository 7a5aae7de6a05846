// The walk over the graph of VERTEXes.
#include "core/haptics/pga.hpp"

#include <cstddef>

#include "core/haptics/neighbours.hpp"
#include "core/haptics/proxy_walk.hpp"

namespace dibhr {

namespace {

/// To the six neighbours of a VERTEX, around it: each is a neighbour of the one before. The order
/// of `spokes_of`.
struct Step {
    int i, j;
};
constexpr Step kAround[6]{{1, 0}, {0, 1}, {-1, 1}, {-1, 0}, {0, -1}, {1, -1}};

/// A VERTEX of the walk.
struct Place {
    int i{-1};
    int j{-1};
    Vec3 position{0.0};
    double to_goal2{0.0};
};

class GraphWalk : private ProxyWalk {
  public:
    using ProxyWalk::ProxyWalk;

    void run() noexcept {
        visit_until_rest([this] {
            stand_on_lowest();
            switch (proxy_.active.kind) {
                case PrimitiveKind::triangle:
                    return visit_triangle();
                case PrimitiveKind::edge:
                    return visit_edge();
                case PrimitiveKind::vertex:
                    return visit_vertices();
                case PrimitiveKind::none:
                    break;
            }
            return visit_free();
        });
    }

  private:
    [[nodiscard]] Place place(int i, int j) const noexcept {
        const Vec3 position = surface_.vertex_at(i, j);
        return {i, j, position, squared_distance(position, goal_)};
    }

    /// `nearest` becomes the corner of the TRIANGLE that is nearest to the goal, if one is nearer
    /// and friction does not hold the proxy back from it.
    void look_at_corners(const Primitive& triangle, Place& nearest) const noexcept {
        const int far = triangle.side == TriangleSide::far_corner ? 1 : 0;
        const Place corners[3]{place(triangle.i + 1, triangle.j), place(triangle.i, triangle.j + 1),
                               place(triangle.i + far, triangle.j + far)};
        for (const Place& corner : corners) {
            if (corner.to_goal2 >= nearest.to_goal2) continue;
            if (!is_held(cone_view(corner.position))) nearest = corner;
        }
    }

    [[nodiscard]] Place here() const noexcept {
        return {-1, -1, proxy_.position, squared_distance(proxy_.position, goal_)};
    }

    Next visit_triangle() noexcept {
        Place nearest = here();
        look_at_corners(proxy_.active, nearest);
        return go_to(nearest, proxy_.active);
    }

    Next visit_edge() noexcept {
        const Primitive active = proxy_.active;
        const TrianglePair sides = triangles_of(surface_, active);
        Place nearest = here();
        if (sides.first) look_at_corners(*sides.first, nearest);
        const Place nearest_of_first = nearest;
        if (sides.second) look_at_corners(*sides.second, nearest);
        const EdgeEnds ends = ends_of(active);
        const bool is_end = (nearest.i == ends.begin_i && nearest.j == ends.begin_j) ||
                            (nearest.i == ends.end_i && nearest.j == ends.end_j);
        if (nearest.i < 0 || is_end) return go_to(nearest, active);
        const bool in_first = nearest.to_goal2 >= nearest_of_first.to_goal2;
        return go_to(nearest, in_first ? *sides.first : *sides.second);
    }

    /// From a place on an EDGE or in a TRIANGLE, `on`, to a VERTEX of it.
    Next go_to(const Place& corner, const Primitive& on) noexcept {
        if (corner.i < 0) return rest_or_leave();
        if (slide_to(corner.position, cone_view(corner.position))) {
            proxy_.active = vertex(corner.i, corner.j);
            return Next::visit;
        }
        proxy_.active = on;
        return rest_or_leave();
    }

    /// From VERTEX to VERTEX. Of the neighbours of the next one two were neighbours of the last one
    /// too and not nearer: only the three ahead are looked at, unless friction held it back from
    /// one of the two.
    Next visit_vertices() noexcept {
        Place at = place(proxy_.active.i, proxy_.active.j);
        Fan fan{0, 6};
        for (;; ++proxy_.moves) {
            unsigned held = 0;  // a bit for each way that friction holds the proxy back from
            Ahead ahead = nearest_in(fan, at, held);
            while (ahead.way >= 0 && is_held(cone_view(ahead.place.position))) {
                held |= 1U << ahead.way;
                ahead = nearest_in(fan, at, held);
            }
            if (ahead.way < 0) break;
            if (!slide_to(ahead.place.position, cone_view(ahead.place.position))) {
                const auto way = static_cast<std::size_t>(ahead.way);
                proxy_.active = spokes_of(vertex(at.i, at.j))[way].edge;
                return rest_or_leave();
            }
            at = ahead.place;
            if (proxy_.moves >= most_moves_) {
                proxy_.active = vertex(at.i, at.j);
                return Next::visit;  // which ends the walk
            }
            fan = held == 0 ? Fan{ahead.way == 0 ? 5 : ahead.way - 1, 3} : Fan{0, 6};
        }
        proxy_.active = vertex(at.i, at.j);
        return rest_or_leave();
    }

    /// Some of the six ways around a VERTEX, one after the other.
    struct Fan {
        int first;
        int count;
    };

    /// The neighbour to go to next.
    struct Ahead {
        Place place{};
        int way{-1};  ///< index in kAround; -1: there is none
    };

    /// The nearest to the goal, if one is nearer than `at`, but for the ways held back from.
    [[nodiscard]] Ahead nearest_in(Fan fan, const Place& at, unsigned held) const noexcept {
        Ahead ahead{at, -1};
        for (int k = fan.first; k < fan.first + fan.count; ++k) {
            const int way = k < 6 ? k : k - 6;
            const int i = at.i + kAround[way].i;
            const int j = at.j + kAround[way].j;
            if (((held >> way) & 1U) != 0 || !surface_.has_vertex(i, j)) continue;
            const Place candidate = place(i, j);
            if (candidate.to_goal2 < ahead.place.to_goal2) ahead = {candidate, way};
        }
        return ahead;
    }
};

}  // namespace

void Pga::walk(const DepthSurface& surface, Vec3 goal, const Friction& friction, int most_moves,
               Proxy& proxy) const noexcept {
    GraphWalk(surface, goal, friction, most_moves, proxy).run();
}

}  // namespace dibhr
