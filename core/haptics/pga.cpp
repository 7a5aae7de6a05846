// The walk over the graph of VERTEXes.
#include "core/haptics/pga.hpp"

#include "core/haptics/neighbours.hpp"
#include "core/haptics/proxy_walk.hpp"

namespace dibhr {

namespace {

/// Steps to VERTEXes, in the order of the search.
struct Steps {
    const Step* first;
    int count;
};

/// Around a VERTEX, the first two again at the end, so that any three in a row are in one piece.
constexpr Step kAround[8]{kSpokes[0], kSpokes[1], kSpokes[2], kSpokes[3],
                          kSpokes[4], kSpokes[5], kSpokes[0], kSpokes[1]};

/// From (i, j) of a TRIANGLE to its corners, by its side.
constexpr Step kCorners[2][3]{{{1, 0}, {0, 1}, {0, 0}}, {{1, 0}, {0, 1}, {1, 1}}};

/// From (i, j) of an EDGE to the corners of the TRIANGLEs beside it, by its direction; and where
/// there is none towards +x, +y.
constexpr Step kBeside[3][4]{{{1, 0}, {0, 1}, {0, 0}, {1, -1}},
                             {{1, 0}, {0, 1}, {0, 0}, {-1, 1}},
                             {{1, 0}, {0, 1}, {0, 0}, {1, 1}}};
constexpr Step kBesideLast[2][3]{{{1, -1}, {0, 0}, {1, 0}}, {{0, 0}, {-1, 1}, {0, 1}}};

class GraphWalk : private ProxyWalk {
  public:
    using ProxyWalk::ProxyWalk;

    void run() noexcept {
        limit_reads(Pga::kMostReads);
        visit_until_rest([this] {
            activate_smallest_primitive();
            switch (proxy_.active.kind) {
                case PrimitiveKind::triangle:
                    return visit_corners(corners_of_triangle());
                case PrimitiveKind::edge:
                    return visit_corners(corners_beside_edge());
                case PrimitiveKind::vertex:
                    return visit_vertices();
                case PrimitiveKind::none:
                    break;
            }
            return visit_free();
        });
    }

  private:
    /// The VERTEX nearest to the goal among several.
    struct Nearest {
        int taken{-1};  ///< the index of the step to it; -1: none is nearer than here
        double z{0.0};
        double to_goal2{0.0};
    };

    /// By steps from VERTEX (i, j), except those with a bit in `held`. Plain numbers instead of
    /// places: reading a value as a whole is slow just after its parts were written.
    [[nodiscard]] Nearest nearest_of(int i, int j, Steps steps, unsigned held,
                                     double here_to_goal2) const noexcept {
        const Vec3 goal = goal_;
        int taken = -1;
        double nearest_z = 0.0;
        double nearest2 = here_to_goal2;
        for (int k = 0; k < steps.count; ++k) {
            const int to_i = i + steps.first[k].i;
            const int to_j = j + steps.first[k].j;
            if (((held >> k) & 1U) != 0 || !surface_.has_vertex(to_i, to_j)) continue;
            const double z = surface_.elevation(to_i, to_j);
            const double to_goal2 = squared_distance({to_i, to_j, z}, goal);
            if (to_goal2 >= nearest2) continue;
            taken = k;
            nearest_z = z;
            nearest2 = to_goal2;
        }
        return {taken, nearest_z, nearest2};
    }

    [[nodiscard]] Steps corners_of_triangle() const noexcept {
        return {kCorners[proxy_.active.side == TriangleSide::far_corner ? 1 : 0], 3};
    }

    [[nodiscard]] Steps corners_beside_edge() const noexcept {
        const EdgeDirection direction = proxy_.active.direction;
        if (direction == EdgeDirection::along_row && proxy_.active.j == surface_.rows() - 1)
            return {kBesideLast[0], 3};
        if (direction == EdgeDirection::along_column && proxy_.active.i == surface_.columns() - 1)
            return {kBesideLast[1], 3};
        return {kBeside[static_cast<int>(direction)], 4};
    }

    Next visit_corners(Steps steps) noexcept {
        const int i = proxy_.active.i;
        const int j = proxy_.active.j;
        const double here_to_goal2 = squared_distance(proxy_.position, goal_);
        for (unsigned held = 0;;) {
            const Nearest nearest = nearest_of(i, j, steps, held, here_to_goal2);
            count_reads(steps.count);
            if (nearest.taken < 0) return rest_or_leave();
            const Step step = steps.first[nearest.taken];
            const int to_i = i + step.i;
            const int to_j = j + step.j;
            const ConeView view = cone_view({to_i, to_j, nearest.z});
            if (is_held(view)) {
                held |= 1U << nearest.taken;
            } else if (slide_to({to_i, to_j, nearest.z}, view)) {
                proxy_.active = vertex(to_i, to_j);
                return Next::visit;
            } else {
                activate_triangle_towards(vertex(to_i, to_j));
                return rest_or_leave();
            }
        }
    }

    /// Makes the TRIANGLE active that the proxy crosses from an EDGE to the opposite corner.
    void activate_triangle_towards(const Primitive& corner) noexcept {
        const Primitive from = proxy_.active;
        if (from.kind != PrimitiveKind::edge) return;
        const TrianglePair sides = triangles_of(surface_, from);
        for (const auto& side : {sides.first, sides.second}) {
            if (side && corner_across(*side, from.direction) == corner) proxy_.active = *side;
        }
    }

    /// From VERTEX to VERTEX. Two neighbours of the next VERTEX were neighbours of the last one,
    /// too, and were not nearer. So only the three ahead are tried, unless friction held the proxy
    /// back from one of the two.
    Next visit_vertices() noexcept {
        int i = proxy_.active.i;
        int j = proxy_.active.j;
        Vec3 at = proxy_.position;
        double here_to_goal2 = squared_distance(surface_.vertex_at(i, j), goal_);
        int first = 0;
        int count = 6;
        unsigned held = 0;
        for (;;) {
            const Nearest nearest = nearest_of(i, j, {kAround + first, count}, held, here_to_goal2);
            count_reads(count);
            if (nearest.taken < 0) break;
            const int way = first + nearest.taken;
            const int to_i = i + kAround[way].i;
            const int to_j = j + kAround[way].j;
            const ConeView view = cone_view(at, {to_i, to_j, nearest.z});
            if (is_held(view)) {
                held |= 1U << nearest.taken;
                continue;
            }
            if (!slide_to({to_i, to_j, nearest.z}, view)) {
                proxy_.active = edge_between(i, j, to_i, to_j);
                return rest_or_leave();
            }
            at = {to_i, to_j, nearest.z};
            i = to_i;
            j = to_j;
            if (proxy_.moves >= most_moves_) {
                proxy_.active = vertex(i, j);
                return Next::visit;  // which ends the walk
            }
            ++proxy_.moves;
            here_to_goal2 = nearest.to_goal2;
            first = held == 0 ? (way + 5) % 6 : 0;
            count = held == 0 ? 3 : 6;
            held = 0;
        }
        proxy_.active = vertex(i, j);
        return rest_or_leave();
    }
};

}  // namespace

void Pga::walk(const DepthSurface& surface, Vec3 goal, const Friction& friction,
               Proxy& proxy) const noexcept {
    GraphWalk(surface, goal, friction, kMostMoves, proxy).run();
}

}  // namespace dibhr
