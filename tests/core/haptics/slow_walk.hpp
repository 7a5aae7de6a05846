// DIBHR's walk by its written rules (core/haptics/README.md), primitive by primitive, with corners,
// normals and distances as in a textbook: slow, and without any code of the walk that it checks.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include <glm/geometric.hpp>

#include "core/haptics/collision.hpp"
#include "core/haptics/neighbours.hpp"
#include "core/haptics/proxy.hpp"
#include "core/haptics/surface.hpp"

namespace dibhr::test {

class SlowWalk {
  public:
    /// `proxy`: the result of the last update, on a surface that stands still.
    SlowWalk(const DepthSurface& surface, Vec3 goal, const Friction& friction, const Proxy& proxy)
        : surface_(surface), goal_(goal), friction_(friction), proxy_(proxy) {}

    Proxy run() {
        while (visit()) {
        }
        if (!moved_) proxy_.slipping = false;
        return proxy_;
    }

  private:
    static constexpr double kArrived_px = 1e-11;

    struct Line {
        Vec3 begin, end;
        Primitive from, to;  // its VERTEXes
    };

    [[nodiscard]] bool visit() {
        switch (proxy_.active.kind) {
            case PrimitiveKind::triangle:
                return visit_triangle(proxy_.active);
            case PrimitiveKind::edge:
                return visit_edge(proxy_.active);
            case PrimitiveKind::vertex:
                return visit_vertex(proxy_.active);
            case PrimitiveKind::none:
                break;
        }
        return fly_to_goal();
    }

    bool fly_to_goal() {
        const auto hit = first_hit(surface_, proxy_.position, goal_);
        proxy_.position = hit ? hit->position : goal_;
        proxy_.contact = hit.has_value();
        proxy_.slipping = false;
        proxy_.active = hit ? hit->triangle : Primitive{};
        return proxy_.contact;
    }

    bool leave() {
        if (glm::length(proxy_.position - left_) <= kTouchDepth_px) return false;
        left_ = proxy_.position;
        return fly_to_goal();
    }

    bool visit_triangle(const Primitive& triangle) {
        if (is_above(triangle)) return leave();
        const Vec3 foot = foot_on(triangle);
        const double far = glm::length(foot - proxy_.position);
        if (is_held(far, glm::length(goal_ - foot))) return go_on();
        const auto here = shares(triangle, proxy_.position);
        const auto there = shares(triangle, foot);
        double exit = std::numeric_limits<double>::infinity();
        std::size_t across = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const double fall = here[k] - there[k];
            if (fall <= 0.0 || here[k] >= exit * fall) continue;
            exit = here[k] / fall;
            across = k;
        }
        if (exit > 1.0 + kArrived_px || (1.0 - exit) * far < cone_px(foot))
            return stop_at_cone(foot);
        const auto corners = corners_of(triangle);
        const Vec3 a = corners[(across + 1) % 3];
        const Vec3 b = corners[(across + 2) % 3];
        cross(edge_between(int(a.x), int(a.y), int(b.x), int(b.y)),
              proxy_.position + exit * (foot - proxy_.position));
        return true;
    }

    /// Onto the EDGE itself, or the VERTEX at its end.
    void cross(const Primitive& edge, Vec3 at) {
        const Line line = line_of(edge);
        const double along =
            edge.direction == EdgeDirection::along_row ? at.x - line.begin.x : at.y - line.begin.y;
        if (along <= 0.0) return stand_on(line.from, line.begin);
        if (along >= 1.0) return stand_on(line.to, line.end);
        stand_on(edge, line.begin + along * (line.end - line.begin));
    }

    bool visit_edge(const Primitive& edge) {
        const TrianglePair pair = triangles_of(surface_, edge);
        double steepest = 10.0 * kArrived_px;
        std::optional<Primitive> into;
        for (const auto& triangle : {pair.first, pair.second}) {
            const double gain = triangle ? gain_into(edge, *triangle) : 0.0;
            if (gain <= steepest) continue;
            steepest = gain;
            into = triangle;
        }
        if (into) {
            proxy_.active = *into;
            return true;
        }
        if (is_above(triangle_towards(surface_, edge, goal_.x, goal_.y))) return leave();
        return slide(edge);
    }

    bool slide(const Primitive& edge) {
        proxy_.active = edge;
        const Line line = line_of(edge);
        const Vec3 way = line.end - line.begin;
        const double along = glm::dot(goal_ - line.begin, way) / glm::dot(way, way);
        const Vec3 foot = line.begin + along * way;
        const bool past_end = along <= 0.0 || along >= 1.0;
        const bool held = is_held(glm::length(foot - proxy_.position), glm::length(goal_ - foot));
        if (held && (mu() > 0.0 || !past_end)) {
            return lowest().kind == PrimitiveKind::vertex && go_on();
        }
        const Vec3 corner = along <= 0.0 ? line.begin : line.end;
        if (!past_end || glm::length(foot - corner) < cone_px(foot)) return stop_at_cone(foot);
        stand_on(along <= 0.0 ? line.from : line.to, corner);
        return true;
    }

    bool visit_vertex(const Primitive& vertex) {
        const auto spoke = steepest_spoke(vertex, kArrived_px, [](double, double) { return true; });
        if (spoke) {
            proxy_.active = *spoke;
            return true;
        }
        return is_above(triangle_around(surface_, vertex, goal_.x, goal_.y)) && leave();
    }

    /// On an EDGE or a VERTEX other pieces than the one that holds the proxy may be free.
    bool go_on() {
        if (proxy_.position == judged_) return false;
        judged_ = proxy_.position;
        const Primitive under = lowest();
        double farthest = 0.0;
        for (const Primitive& triangle : triangles_around(under)) {
            const Vec3 foot = foot_on(triangle);
            const double far = glm::length(foot - proxy_.position);
            const bool is_free = is_above(triangle) || !is_held(far, glm::length(goal_ - foot));
            if (!is_free || far <= farthest || !leads_inside(triangle, foot)) continue;
            farthest = far;
            proxy_.active = triangle;
        }
        if (farthest > 0.0) return true;
        if (under.kind != PrimitiveKind::vertex) return false;
        const auto spoke = steepest_spoke(
            under, 0.0, [this](double gain, double aside) { return !is_held(gain, aside); });
        return spoke && slide(*spoke);
    }

    /// The EDGE along which the distance falls fastest, of those that `is_free` of how far the
    /// goal's foot on it is, and how far the goal beside it.
    template <typename IsFree>
    [[nodiscard]] std::optional<Primitive> steepest_spoke(const Primitive& vertex, double least,
                                                          IsFree is_free) const {
        std::optional<Primitive> steepest;
        const Vec3 to_goal = goal_ - proxy_.position;
        for (const Step& step : kSpokes) {
            if (!surface_.has_vertex(vertex.i + step.i, vertex.j + step.j)) continue;
            const Vec3 end = surface_.vertex_at(vertex.i + step.i, vertex.j + step.j);
            const Vec3 along = glm::normalize(end - surface_.vertex_at(vertex.i, vertex.j));
            const double gain = glm::dot(to_goal, along);
            if (gain <= least || !is_free(gain, glm::length(to_goal - gain * along))) continue;
            least = gain;
            steepest = edge_between(vertex.i, vertex.j, vertex.i + step.i, vertex.j + step.j);
        }
        return steepest;
    }

    [[nodiscard]] std::vector<Primitive> triangles_around(const Primitive& under) const {
        std::vector<Primitive> around;
        if (under.kind == PrimitiveKind::edge) {
            const TrianglePair pair = triangles_of(surface_, under);
            for (const auto& one : {pair.first, pair.second})
                if (one) around.push_back(*one);
        }
        if (under.kind != PrimitiveKind::vertex) return around;
        for (const auto side : {TriangleSide::near_origin, TriangleSide::far_corner})
            for (int j = under.j - 1; j <= under.j; ++j)
                for (int i = under.i - 1; i <= under.i; ++i)
                    if (surface_.has_vertex(i, j) && surface_.has_vertex(i + 1, j + 1))
                        add_if_at(triangle(side, i, j), under, around);
        return around;
    }

    void add_if_at(const Primitive& one, const Primitive& vertex,
                   std::vector<Primitive>& around) const {
        for (const Vec3& corner : corners_of(one))
            if (int(corner.x) == vertex.i && int(corner.y) == vertex.j) around.push_back(one);
    }

    /// Not out of the TRIANGLE at once.
    [[nodiscard]] bool leads_inside(const Primitive& triangle, Vec3 foot) const {
        constexpr double kOn = 1e-9;
        const auto here = shares(triangle, proxy_.position);
        const auto there = shares(triangle, foot);
        for (std::size_t k = 0; k < 3; ++k)
            if (here[k] < kOn && there[k] <= kArrived_px) return false;
        return true;
    }

    [[nodiscard]] std::array<Vec3, 3> corners_of(const Primitive& one) const {
        const int i = one.i;
        const int j = one.j;
        if (one.side == TriangleSide::near_origin)
            return {surface_.vertex_at(i, j), surface_.vertex_at(i + 1, j),
                    surface_.vertex_at(i, j + 1)};
        return {surface_.vertex_at(i + 1, j + 1), surface_.vertex_at(i, j + 1),
                surface_.vertex_at(i + 1, j)};
    }

    [[nodiscard]] Line line_of(const Primitive& edge) const {
        const EdgeEnds ends = ends_of(edge);
        return {surface_.vertex_at(ends.begin_i, ends.begin_j),
                surface_.vertex_at(ends.end_i, ends.end_j), vertex(ends.begin_i, ends.begin_j),
                vertex(ends.end_i, ends.end_j)};
    }

    [[nodiscard]] Vec3 normal_of(const Primitive& triangle) const {
        const auto corners = corners_of(triangle);
        const Vec3 n = glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
        return n.z < 0.0 ? -n : n;
    }

    [[nodiscard]] double height_over(const Primitive& triangle) const {
        return glm::dot(goal_ - corners_of(triangle)[0], normal_of(triangle));
    }
    [[nodiscard]] bool is_above(const Primitive& triangle) const {
        return height_over(triangle) > 0.0;
    }
    [[nodiscard]] Vec3 foot_on(const Primitive& triangle) const {
        return goal_ - height_over(triangle) * normal_of(triangle);
    }

    /// The barycentric coordinates of a point.
    [[nodiscard]] std::array<double, 3> shares(const Primitive& triangle, Vec3 point) const {
        const Vec3 corner = corners_of(triangle)[0];
        const double sign = triangle.side == TriangleSide::near_origin ? 1.0 : -1.0;
        const double x = sign * (point.x - corner.x);
        const double y = sign * (point.y - corner.y);
        return {1.0 - x - y, x, y};
    }

    /// How fast the distance falls into the TRIANGLE, across its EDGE.
    [[nodiscard]] double gain_into(const Primitive& edge, const Primitive& triangle) const {
        const Line line = line_of(edge);
        const auto corners = corners_of(triangle);
        Vec3 inwards = glm::normalize(glm::cross(normal_of(triangle), line.end - line.begin));
        const Vec3 middle = (corners[0] + corners[1] + corners[2]) / 3.0;
        if (glm::dot(inwards, middle - line.begin) < 0.0) inwards = -inwards;
        return glm::dot(inwards, goal_ - proxy_.position);
    }

    [[nodiscard]] Primitive lowest() const {
        constexpr double kOnGrid_px = 1e-12;
        return smallest_primitive_under(proxy_.active, proxy_.position.x, proxy_.position.y,
                                        kOnGrid_px);
    }

    [[nodiscard]] double mu() const {
        return proxy_.slipping ? friction_.dynamic_coefficient : friction_.static_coefficient;
    }
    [[nodiscard]] double cone_px(Vec3 foot) const {
        return friction_.dynamic_coefficient * glm::length(goal_ - foot);
    }
    [[nodiscard]] bool is_held(double far, double aside) const {
        return far <= mu() * aside * (1.0 + 1e-12) + kArrived_px;
    }

    bool stop_at_cone(Vec3 foot) {
        const double far = glm::length(proxy_.position - foot);
        move_to(foot + cone_px(foot) / far * (proxy_.position - foot));
        return false;
    }

    void stand_on(const Primitive& primitive, Vec3 at) {
        proxy_.active = primitive;
        move_to(at);
    }

    void move_to(Vec3 at) {
        const bool moves = glm::length(at - proxy_.position) > kArrived_px;
        proxy_.position = at;
        if (moves) moved_ = proxy_.slipping = true;
    }

    const DepthSurface& surface_;
    const Vec3 goal_;
    const Friction friction_;
    Proxy proxy_;
    bool moved_{false};
    Vec3 left_{std::numeric_limits<double>::infinity()};
    Vec3 judged_{std::numeric_limits<double>::infinity()};
};

}  // namespace dibhr::test
