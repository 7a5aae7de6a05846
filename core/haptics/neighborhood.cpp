// The search over the neighbours of the active primitive.
#include "core/haptics/neighborhood.hpp"

#include <array>

#include "core/haptics/facet.hpp"
#include "core/haptics/neighbours.hpp"
#include "core/haptics/proxy_walk.hpp"

namespace dibhr {

namespace {

/// From (i, j) of a primitive to a TRIANGLE that touches it.
struct Neighbour {
    TriangleSide side;
    int i, j;
};

/// The TRIANGLEs that touch a primitive, in the order of the search; some are missing on the
/// border.
struct Neighbours {
    const Neighbour* first;
    int count;
};

constexpr auto kNear = TriangleSide::near_origin;
constexpr auto kFar = TriangleSide::far_corner;
constexpr Neighbour kOfTriangle[2][1]{{{kNear, 0, 0}}, {{kFar, 0, 0}}};
constexpr Neighbour kOfEdge[3][2]{
    {{kNear, 0, 0}, {kFar, 0, -1}}, {{kNear, 0, 0}, {kFar, -1, 0}}, {{kNear, 0, 0}, {kFar, 0, 0}}};
constexpr Neighbour kOfVertex[6]{{kNear, 0, 0},  {kFar, -1, -1}, {kNear, -1, 0},
                                 {kNear, 0, -1}, {kFar, -1, 0},  {kFar, 0, -1}};

[[nodiscard]] Neighbours neighbours_of(const Primitive& active) noexcept {
    switch (active.kind) {
        case PrimitiveKind::triangle:
            return {kOfTriangle[static_cast<int>(active.side)], 1};
        case PrimitiveKind::edge:
            return {kOfEdge[static_cast<int>(active.direction)], 2};
        default:
            return {kOfVertex, 6};
    }
}

/// Where on a TRIANGLE a point is: on its face, or on an EDGE, or at an end of that.
enum class Part { face, edge, begin, end };

[[nodiscard]] Primitive primitive_at(Part part, const Primitive& triangle,
                                     EdgeDirection direction) noexcept {
    const Primitive edge = edge_of(triangle, direction);
    const EdgeEnds ends = ends_of(edge);
    switch (part) {
        case Part::edge:
            return edge;
        case Part::begin:
            return vertex(ends.begin_i, ends.begin_j);
        case Part::end:
            return vertex(ends.end_i, ends.end_j);
        case Part::face:
            break;
    }
    return triangle;
}

class NeighborhoodWalk : private ProxyWalk {
  public:
    using ProxyWalk::ProxyWalk;

    void run() noexcept {
        limit_reads(half_over_bump(surface_, Neighborhood::kMostLooks));
        visit_until_rest([this] {
            if (proxy_.active.kind == PrimitiveKind::none) return visit_free();
            activate_smallest_primitive();
            const bool arrived = judged_ && proxy_.position == nearest_.position();
            const unsigned judged = arrived ? judged_before() : 0;
            judged_ = found_ = held_ = false;
            nearest_.to_goal2 = squared_distance(proxy_.position, goal_);
            search(judged);
            return found_ ? go_to_nearest() : rest_or_leave();
        });
    }

  private:
    /// Plain numbers instead of places and primitives: reading a value as a whole is slow just
    /// after its parts were written.
    struct Nearest {
        double x{0.0}, y{0.0}, z{0.0};
        double to_goal2{0.0};
        Part part{Part::face};
        EdgeDirection direction{EdgeDirection::along_row};  ///< of the EDGE it is on
        TriangleSide side{TriangleSide::near_origin};       ///< of the TRIANGLE it is in
        int i{0}, j{0};

        [[nodiscard]] Vec3 position() const noexcept { return {x, y, z}; }
    };

    /// Of a TRIANGLE or an EDGE, nearest to the goal.
    struct Point {
        Vec3 position;
        double to_goal2;
        Part part;
    };

    /// Calls `look_at` for the TRIANGLEs that touch the active primitive, but for those that have a
    /// bit in `judged`.
    template <typename Look>
    void each_neighbour(unsigned judged, Look&& look_at) const noexcept {
        const Neighbours neighbours = neighbours_of(proxy_.active);
        for (int k = 0; k < neighbours.count; ++k) {
            if (((judged >> k) & 1U) != 0) continue;
            const int i = proxy_.active.i + neighbours.first[k].i;
            const int j = proxy_.active.j + neighbours.first[k].j;
            if (!surface_.has_vertex(i, j) || !surface_.has_vertex(i + 1, j + 1)) continue;
            look_at(triangle(neighbours.first[k].side, i, j));
        }
    }

    /// A bit for each neighbour that also touches the primitive from which the proxy came. The
    /// proxy is at the nearest point of them all: none of them has a nearer one.
    [[nodiscard]] unsigned judged_before() const noexcept {
        const Neighbours neighbours = neighbours_of(proxy_.active);
        unsigned judged = 0;
        for (int k = 0; k < neighbours.count; ++k) {
            const Neighbour& to = neighbours.first[k];
            const int i = from_.i - proxy_.active.i - to.i;
            const int j = from_.j - proxy_.active.j - to.j;
            if (is_touched(to.side, from_, i, j)) judged |= 1U << k;
        }
        return judged;
    }

    /// A TRIANGLE by a primitive that is (i, j) away from it.
    [[nodiscard]] static bool is_touched(TriangleSide side, const Primitive& what, int i,
                                         int j) noexcept {
        const int far = side == kFar ? 1 : 0;
        switch (what.kind) {
            case PrimitiveKind::triangle:
                return what.side == side && i == 0 && j == 0;
            case PrimitiveKind::edge:
                return i == (what.direction == EdgeDirection::along_column ? far : 0) &&
                       j == (what.direction == EdgeDirection::along_row ? far : 0);
            case PrimitiveKind::vertex:
                return (i == 1 && j == 0) || (i == 0 && j == 1) || (i == far && j == far);
            case PrimitiveKind::none:
                break;
        }
        return false;
    }

    /// Searches a nearer point. Where friction holds the proxy back from the nearest points of all
    /// TRIANGLEs, searches their EDGEs, which are neighbours as well.
    void search(unsigned judged) noexcept {
        each_neighbour(judged, [this](const Primitive& which) { look_into(which); });
        if (found_ || !held_) return;
        each_neighbour(0, [this](const Primitive& which) { look_along_edges(which); });
    }

    /// At the point of a TRIANGLE that is nearest to the goal: its foot, or one of an EDGE that the
    /// foot is beyond.
    void look_into(const Primitive& which) noexcept {
        count_reads(1);
        const Facet facet(surface_, which);
        const Vec3 foot = facet.project(goal_).foot;
        const Barycentric share = facet.barycentric(foot.x, foot.y);
        if (share.row >= 0.0 && share.column >= 0.0 && share.diagonal >= 0.0) {
            take_if_nearer({foot, squared_distance(foot, goal_), Part::face},
                           EdgeDirection::along_row, which);
            return;
        }
        Point nearest{Vec3(0.0), kFarther, Part::face};
        EdgeDirection on = EdgeDirection::along_row;
        const auto look_along = [&](EdgeDirection direction) {
            if (share.across(direction) >= 0.0) return;
            const Point point = nearest_on(facet, which, direction);
            if (point.to_goal2 >= nearest.to_goal2) return;
            nearest = point;
            on = direction;
        };
        look_along(EdgeDirection::along_row);
        look_along(EdgeDirection::along_column);
        look_along(EdgeDirection::diagonal);
        take_if_nearer(nearest, on, which);
    }

    void look_along_edges(const Primitive& which) noexcept {
        count_reads(1);
        const Facet facet(surface_, which);
        for (const EdgeDirection direction : kDirections) {
            take_if_nearer(nearest_on(facet, which, direction), direction, which);
        }
    }

    /// The point nearest to the goal on an EDGE of TRIANGLE `which`.
    [[nodiscard]] Point nearest_on(const Facet& facet, const Primitive& which,
                                   EdgeDirection direction) const noexcept {
        const EdgeEnds ends = ends_of(edge_of(which, direction));
        const EdgeElevations z = facet.elevations_along(direction);
        const Vec3 begin{ends.begin_i, ends.begin_j, z.begin};
        const Vec3 end{ends.end_i, ends.end_j, z.end};
        const Vec3 along = end - begin;
        const double t = glm::dot(goal_ - begin, along) / glm::dot(along, along);
        const Part part = t <= 0.0 ? Part::begin : t >= 1.0 ? Part::end : Part::edge;
        const Vec3 position = t <= 0.0 ? begin : t >= 1.0 ? end : begin + t * along;
        return {position, squared_distance(position, goal_), part};
    }

    void take_if_nearer(const Point& point, EdgeDirection direction,
                        const Primitive& through) noexcept {
        if (point.to_goal2 >= nearest_.to_goal2) return;
        if (is_held(cone_view(point.position))) {
            held_ = true;
            return;
        }
        found_ = true;
        nearest_.x = point.position.x;
        nearest_.y = point.position.y;
        nearest_.z = point.position.z;
        nearest_.to_goal2 = point.to_goal2;
        nearest_.part = point.part;
        nearest_.direction = direction;
        nearest_.side = through.side;
        nearest_.i = through.i;
        nearest_.j = through.j;
    }

    Next go_to_nearest() noexcept {
        const Primitive through = triangle(nearest_.side, nearest_.i, nearest_.j);
        const Primitive on = primitive_at(nearest_.part, through, nearest_.direction);
        const Vec3 position = nearest_.position();
        if (!slide_to(position, cone_view(position))) {
            proxy_.active = way_to(on, through);
            return rest_or_leave();
        }
        judged_ = !held_;
        from_ = proxy_.active;
        proxy_.active = on;
        return Next::visit;
    }

    /// The EDGE of the TRIANGLE along which the way to a primitive of it runs, or that TRIANGLE.
    [[nodiscard]] Primitive way_to(const Primitive& on, const Primitive& through) const noexcept {
        for (const EdgeDirection direction : kDirections) {
            const Primitive edge = edge_of(through, direction);
            if (lies_on(proxy_.active, edge) && lies_on(on, edge)) return edge;
        }
        return through;
    }

    [[nodiscard]] static bool lies_on(const Primitive& what, const Primitive& edge) noexcept {
        if (what.kind != PrimitiveKind::vertex) return what == edge;
        const EdgeEnds ends = ends_of(edge);
        return (what.i == ends.begin_i && what.j == ends.begin_j) ||
               (what.i == ends.end_i && what.j == ends.end_j);
    }

    static constexpr double kFarther = 1e300;
    static constexpr std::array kDirections{EdgeDirection::along_row, EdgeDirection::along_column,
                                            EdgeDirection::diagonal};

    Nearest nearest_{};   ///< the nearest point to which the proxy is free to go
    bool found_{false};   ///< a point is nearer than the proxy
    bool held_{false};    ///< a point is nearer, but friction holds the proxy back
    bool judged_{false};  ///< the last visit judged what touches `from_`, and none was held
    Primitive from_{};    ///< of the last visit
};

}  // namespace

void Neighborhood::walk(const DepthSurface& surface, Vec3 goal, const Friction& friction,
                        Proxy& proxy) const noexcept {
    const int most_moves = half_over_bump(surface, kMostMoves);
    NeighborhoodWalk(surface, goal, friction, most_moves, proxy).run();
}

}  // namespace dibhr
