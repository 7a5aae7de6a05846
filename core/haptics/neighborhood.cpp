// The search over the neighbours of the active primitive.
#include "core/haptics/neighborhood.hpp"

#include <array>

#include "core/haptics/facet.hpp"
#include "core/haptics/neighbours.hpp"
#include "core/haptics/proxy_walk.hpp"

namespace dibhr {

namespace {

/// The point of a TRIANGLE nearest to the goal, and the primitive of that TRIANGLE it lies on.
struct NearestPoint {
    Vec3 position{0.0};
    Primitive on{};
    double to_goal2{0.0};
};

class NeighborhoodWalk : private ProxyWalk {
  public:
    using ProxyWalk::ProxyWalk;

    void run() noexcept {
        visit_until_rest([this] {
            if (proxy_.active.kind == PrimitiveKind::none) return visit_free();
            stand_on_lowest();
            nearest_ = {proxy_.position, proxy_.active, squared_distance(proxy_.position, goal_)};
            found_ = held_ = false;
            each_neighbour([this](const Primitive& triangle) {
                take_if_nearer(nearest_in(triangle), triangle);
            });
            if (!found_ && held_) look_at_edges();
            return found_ ? go_to_nearest() : rest_or_leave();
        });
    }

  private:
    /// Held back from the nearest points of all TRIANGLEs: their EDGEs are neighbours as well.
    void look_at_edges() noexcept {
        each_neighbour([this](const Primitive& triangle) {
            for (const EdgeDirection direction : kDirections) {
                take_if_nearer(nearest_on(edge_of(triangle, direction)), triangle);
            }
        });
    }

    template <typename Look>
    void each_neighbour(Look&& look_at) const noexcept {
        const Primitive active = proxy_.active;
        if (active.kind == PrimitiveKind::triangle) {
            look_at(active);
        } else if (active.kind == PrimitiveKind::edge) {
            const TrianglePair sides = triangles_of(surface_, active);
            if (sides.first) look_at(*sides.first);
            if (sides.second) look_at(*sides.second);
        } else {
            each_around(active.i, active.j, look_at);
        }
    }

    /// The six TRIANGLEs around a VERTEX, fewer on the border.
    template <typename Look>
    void each_around(int i, int j, Look&& look_at) const noexcept {
        const bool left = i > 0;
        const bool right = i < surface_.columns() - 1;
        const bool above = j > 0;
        const bool below = j < surface_.rows() - 1;
        if (right && below) look_at(triangle(TriangleSide::near_origin, i, j));
        if (left && above) look_at(triangle(TriangleSide::far_corner, i - 1, j - 1));
        for (const TriangleSide side : {TriangleSide::near_origin, TriangleSide::far_corner}) {
            if (left && below) look_at(triangle(side, i - 1, j));
            if (right && above) look_at(triangle(side, i, j - 1));
        }
    }

    void take_if_nearer(const NearestPoint& point, const Primitive& through) noexcept {
        if (point.to_goal2 >= nearest_.to_goal2) return;
        const ConeView view = cone_view(point.position);
        if (is_held(view)) {
            held_ = true;
            return;
        }
        nearest_ = point;
        view_ = view;
        through_ = through;
        found_ = true;
    }

    [[nodiscard]] NearestPoint nearest_in(const Primitive& which) const noexcept {
        const Facet facet(surface_, which);
        const Vec3 foot = facet.project(goal_).foot;
        const Barycentric share = facet.barycentric(foot.x, foot.y);
        if (share.row >= 0.0 && share.column >= 0.0 && share.diagonal >= 0.0) {
            return {foot, which, squared_distance(foot, goal_)};
        }
        NearestPoint nearest;
        nearest.to_goal2 = kFarther;
        for (const EdgeDirection direction : kDirections) {
            if (share.across(direction) >= 0.0) continue;  // the goal's foot is not beyond this one
            const NearestPoint point = nearest_on(edge_of(which, direction));
            if (point.to_goal2 < nearest.to_goal2) nearest = point;
        }
        return nearest;
    }

    [[nodiscard]] NearestPoint nearest_on(const Primitive& edge) const noexcept {
        const EdgeEnds ends = ends_of(edge);
        const Vec3 begin = surface_.vertex_at(ends.begin_i, ends.begin_j);
        const Vec3 end = surface_.vertex_at(ends.end_i, ends.end_j);
        const Vec3 along = end - begin;
        const double t = glm::dot(goal_ - begin, along) / glm::dot(along, along);
        if (t <= 0.0) {
            return {begin, vertex(ends.begin_i, ends.begin_j), squared_distance(begin, goal_)};
        }
        if (t >= 1.0) return {end, vertex(ends.end_i, ends.end_j), squared_distance(end, goal_)};
        const Vec3 foot = begin + t * along;
        return {foot, edge, squared_distance(foot, goal_)};
    }

    /// The EDGE of the TRIANGLE `through_` along which the way to the nearest point runs, or that
    /// TRIANGLE.
    [[nodiscard]] Primitive way_to_nearest() const noexcept {
        for (const EdgeDirection direction : kDirections) {
            const Primitive edge = edge_of(through_, direction);
            if (lies_on(proxy_.active, edge) && lies_on(nearest_.on, edge)) return edge;
        }
        return through_;
    }

    [[nodiscard]] static bool lies_on(const Primitive& what, const Primitive& edge) noexcept {
        if (what.kind != PrimitiveKind::vertex) return what == edge;
        const EdgeEnds ends = ends_of(edge);
        return (what.i == ends.begin_i && what.j == ends.begin_j) ||
               (what.i == ends.end_i && what.j == ends.end_j);
    }

    Next go_to_nearest() noexcept {
        const Primitive way = way_to_nearest();
        const bool all_the_way = slide_to(nearest_.position, view_);
        proxy_.active = all_the_way ? nearest_.on : way;
        return all_the_way ? Next::visit : rest_or_leave();
    }

    static constexpr double kFarther = 1e300;
    static constexpr std::array kDirections{EdgeDirection::along_row, EdgeDirection::along_column,
                                            EdgeDirection::diagonal};

    NearestPoint nearest_{};  ///< of those looked at, that the proxy is free to go to
    ConeView view_{};         ///< of the way there
    Primitive through_{};     ///< the TRIANGLE it is in
    bool found_{false};       ///< there is one nearer than the proxy
    bool held_{false};        ///< there is one nearer that friction holds the proxy back from
};

}  // namespace

void Neighborhood::walk(const DepthSurface& surface, Vec3 goal, const Friction& friction,
                        int most_moves, Proxy& proxy) const noexcept {
    NeighborhoodWalk(surface, goal, friction, most_moves, proxy).run();
}

}  // namespace dibhr
