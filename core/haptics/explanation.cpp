// Steps of an update: Dibhr::after_moves gives the proxy after each move.
#include "core/haptics/explanation.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <optional>

#include "core/haptics/dibhr.hpp"
#include "core/haptics/facet.hpp"
#include "core/haptics/neighbours.hpp"
#include "core/haptics/touch.hpp"

namespace dibhr {

namespace {

constexpr double kSame_px = 1e-9;

/// The goal's foot on the plane of a TRIANGLE or the line of an EDGE; of a VERTEX itself.
Vec3 foot_on(const DepthSurface& surface, const Primitive& primitive, Vec3 goal) {
    switch (primitive.kind) {
        case PrimitiveKind::triangle:
            return Facet(surface, primitive).project(goal).foot;
        case PrimitiveKind::edge: {
            const EdgeEnds ends = ends_of(primitive);
            const Vec3 begin = surface.vertex_at(ends.begin_i, ends.begin_j);
            const Vec3 along = surface.vertex_at(ends.end_i, ends.end_j) - begin;
            return begin + glm::dot(goal - begin, along) / glm::dot(along, along) * along;
        }
        case PrimitiveKind::vertex:
            return surface.vertex_at(primitive.i, primitive.j);
        case PrimitiveKind::none:
            break;
    }
    return goal;
}

/// How far a point is inside a TRIANGLE, seen from above; below 0 outside.
double inside(const DepthSurface& surface, const Primitive& triangle, Vec3 p) {
    const Barycentric at = Facet(surface, triangle).barycentric(p.x, p.y);
    return std::min({at.row, at.column, at.diagonal});
}

/// Whether a point is on the line of an EDGE, seen from above.
bool is_on_line(const Primitive& edge, Vec3 p) {
    switch (edge.direction) {
        case EdgeDirection::along_row:
            return std::abs(p.y - edge.j) <= kSame_px;
        case EdgeDirection::along_column:
            return std::abs(p.x - edge.i) <= kSame_px;
        case EdgeDirection::diagonal:
            break;
    }
    return std::abs(p.x - edge.i + (p.y - edge.j) - 1.0) <= kSame_px;
}

/// The TRIANGLE beside an EDGE that the proxy went into; else the one that the walk judged, on the
/// side from which the proxy did not come.
std::optional<Primitive> triangle_beside(const DepthSurface& surface, const Primitive& edge,
                                         const Proxy& after, const Primitive& came_over) {
    const TrianglePair pair = triangles_of(surface, edge);
    if (!pair.first || !pair.second) return pair.first ? pair.first : pair.second;
    if (after.active == *pair.first || after.active == *pair.second) return after.active;
    const Vec3& end = after.position;
    if (is_on_line(edge, end)) return *pair.first == came_over ? pair.second : pair.first;
    const bool in_first = inside(surface, *pair.first, end) >= inside(surface, *pair.second, end);
    return in_first ? pair.first : pair.second;
}

/// Whether a surface of this size has the primitive.
bool has_primitive(const DepthSurface& surface, const Primitive& primitive) {
    const int i = primitive.i;
    const int j = primitive.j;
    switch (primitive.kind) {
        case PrimitiveKind::triangle:
            return surface.has_vertex(i, j) && surface.has_vertex(i + 1, j + 1);
        case PrimitiveKind::edge: {
            const EdgeEnds ends = ends_of(primitive);
            return surface.has_vertex(ends.begin_i, ends.begin_j) &&
                   surface.has_vertex(ends.end_i, ends.end_j);
        }
        case PrimitiveKind::vertex:
            return surface.has_vertex(i, j);
        case PrimitiveKind::none:
            break;
    }
    return false;
}

/// Whether an update over a surface of this size can give this proxy. A session that is replayed
/// over other files may hold proxies that do not fit.
bool fits(const DepthSurface& surface, const Proxy& proxy) {
    if (!is_finite(proxy.position)) return false;
    if (surface.clamped_to_frame(proxy.position) != proxy.position) return false;
    return !proxy.contact || has_primitive(surface, proxy.active);
}

/// The proxy with which an update begins that has no proxy to go on from.
Proxy above(const DepthSurface& surface, Vec3 goal) {
    Proxy proxy;
    proxy.position = {goal.x, goal.y, std::max(goal.z, surface.elevation_at(goal.x, goal.y))};
    return proxy;
}

class Explainer {
  public:
    Explainer(const DepthSurface& surface, const Proxy& last_proxy, Vec3 goal,
              const Friction& friction)
        : surface_(surface), requested_goal_(goal) {
        const Vec3 goal_in_frame = surface.clamped_to_frame(surface.clamped_to_reach(goal));
        const Proxy proxy = fits(surface, last_proxy) ? last_proxy : above(surface, goal_in_frame);
        friction_ = local_friction(surface, proxy, surface.clamped_to_reach(goal), friction);
        walk_.resume(proxy, surface.columns(), surface.rows());
        update_.goal = goal_in_frame;
        update_.result = after(Dibhr::kMostMoves);
        update_.start = proxy.contact ? after(0) : proxy;
        update_.start.moves = update_.start.reads = 0;
        update_.start.flown = update_.start.motion_read = {};
    }

    ExplainedUpdate run() {
        Proxy at = after(0);
        add_flight(at);
        for (int moves = 1; at.moves < update_.result.moves; ++moves) {
            const Proxy next = moves < update_.result.moves ? after(moves) : update_.result;
            if (next.moves == at.moves) continue;
            add_step(at, next);
            at = next;
        }
        return std::move(update_);
    }

  private:
    [[nodiscard]] Proxy after(int moves) const {
        return walk_.after_moves(surface_, requested_goal_, friction_, moves);
    }

    /// A flight counts as no move.
    void add_flight(const Proxy& landed) {
        const Proxy& start = update_.start;
        if (start.contact) return;
        WalkStep step;
        step.before = start;
        step.after = landed;
        step.foot = update_.goal;
        step.end = landed.contact ? StepEnd::meets_surface : StepEnd::reaches_goal;
        update_.steps.push_back(step);
    }

    void add_step(const Proxy& before, const Proxy& after) {
        WalkStep step;
        step.before = before;
        step.after = after;
        step.visited[0] = before.active;
        step.visits = 1;
        add_second_visit(step);
        step.piece = piece_of(step);
        step.foot = foot_on(surface_, step.piece, update_.goal);
        step.end = end_of(step);
        const bool sticks = step.end == StepEnd::stays_in_cone && !before.slipping;
        const double mu = sticks ? friction_.static_coefficient : friction_.dynamic_coefficient;
        if (step.piece.kind != PrimitiveKind::vertex)
            step.cone_px = mu * glm::length(update_.goal - step.foot);
        update_.steps.push_back(step);
    }

    /// An EDGE and the TRIANGLE beside it are judged in one step.
    void add_second_visit(WalkStep& step) const {
        const Primitive& first = step.visited[0];
        if (first.kind != PrimitiveKind::edge || step.after.moves < step.before.moves + 2) return;
        const Primitive came_over =
            update_.steps.empty() ? Primitive{} : update_.steps.back().piece;
        const auto beside = triangle_beside(surface_, first, step.after, came_over);
        if (!beside) return;
        step.visited[1] = *beside;
        step.visits = 2;
    }

    /// The piece along which the proxy moved, or would have.
    [[nodiscard]] Primitive piece_of(const WalkStep& step) const {
        const Primitive& first = step.visited[0];
        const Primitive& then = step.after.active;
        const bool along = has_moved(step) && is_on_line(first, step.after.position);
        if (first.kind == PrimitiveKind::edge && (along || then == first)) return first;
        if (has_moved(step) && first.kind == PrimitiveKind::vertex) {
            const bool beside =
                std::max(std::abs(then.i - first.i), std::abs(then.j - first.j)) <= 1;
            if (then.kind == PrimitiveKind::edge) return then;
            if (then.kind == PrimitiveKind::vertex && beside)
                return edge_between(first.i, first.j, then.i, then.j);
        }
        return step.visited[step.visits - 1];
    }

    [[nodiscard]] StepEnd end_of(const WalkStep& step) const {
        if (!step.after.contact || has_left(step)) return StepEnd::leaves;
        const bool last = step.after.moves == update_.result.moves;
        if (last && update_.result.bound_met) return StepEnd::out_of_moves;
        const bool on_foot = glm::length(step.after.position - step.foot) <= kSame_px;
        if (!has_moved(step)) {
            if (!last) return StepEnd::becomes_active;
            if (step.piece.kind == PrimitiveKind::vertex) return StepEnd::rests_at_minimum;
            return on_foot ? StepEnd::rests_at_foot : StepEnd::stays_in_cone;
        }
        if (step.after.active == step.piece)
            return on_foot ? StepEnd::rests_at_foot : StepEnd::stops_on_cone;
        return step.piece.kind == PrimitiveKind::edge ? StepEnd::goes_to_end : StepEnd::crosses;
    }

    /// The proxy left the surface, flew, and came down.
    [[nodiscard]] bool has_left(const WalkStep& step) const {
        switch (step.piece.kind) {
            case PrimitiveKind::triangle:
                return Facet(surface_, step.piece).project(update_.goal).rise > 0.0;
            case PrimitiveKind::edge:
                return has_moved(step) && !is_on_line(step.piece, step.after.position);
            case PrimitiveKind::vertex:
            case PrimitiveKind::none:
                break;
        }
        return has_moved(step);
    }

    static bool has_moved(const WalkStep& step) {
        return step.before.position != step.after.position;
    }

    const DepthSurface& surface_;
    Vec3 requested_goal_;
    Friction friction_;
    Dibhr walk_{};
    ExplainedUpdate update_{};
};

std::string place(int i, int j) {
    return " (" + std::to_string(i) + ", " + std::to_string(j) + ")";
}

std::string pixels(double px) {
    std::array<char, 400> text{};  // of any number
    const auto end =
        std::to_chars(text.data(), text.data() + text.size(), px, std::chars_format::fixed, 2).ptr;
    return std::string(text.data(), end) + " px";
}

/// A sentence on the EDGE judged before the piece; empty: none was.
std::string judged_text(const WalkStep& step) {
    if (step.visits < 2) return {};
    const std::string edge = text_of(step.visited[0]);
    const std::string beside = text_of(step.visited[1]);
    if (step.piece == step.visited[0])
        return edge + ": " + beside + " behind it leads back to it, so this is a crease. ";
    return edge + ": the fastest way towards the goal leads over " + beside +
           ", which becomes active. ";
}

std::string end_text(const WalkStep& step) {
    const std::string piece = text_of(step.piece);
    const std::string cone =
        "the friction cone, " + pixels(step.cone_px) + " around the goal's foot";
    switch (step.end) {
        case StepEnd::reaches_goal:
            return "Nothing is between the proxy and the goal: it goes there, free.";
        case StepEnd::meets_surface:
            return "On its way to the goal the proxy meets the surface on " +
                   text_of(step.after.active) + ": contact begins.";
        case StepEnd::leaves:
            return piece + ": the goal is above the surface, so the proxy leaves it" +
                   (step.after.contact ? " and comes down on " + text_of(step.after.active) + "."
                                       : " and goes on through the air.");
        case StepEnd::crosses:
            return piece + ": the goal's foot is outside, so the proxy goes as far as " +
                   text_of(step.after.active) + ".";
        case StepEnd::goes_to_end:
            return piece + ": the goal's foot is beyond its end, so the proxy goes as far as " +
                   text_of(step.after.active) + ".";
        case StepEnd::rests_at_foot:
            return piece +
                   ": the proxy rests at the goal's foot; no place beside it is nearer to the "
                   "goal.";
        case StepEnd::stops_on_cone:
            return piece + ": the proxy stops on " + cone + ".";
        case StepEnd::stays_in_cone:
            return piece + ": the proxy stays, within " + cone + ".";
        case StepEnd::becomes_active:
            return piece + ": the fastest way towards the goal leads over " +
                   text_of(step.after.active) + ", which becomes active.";
        case StepEnd::rests_at_minimum:
            return piece + ": no way from here leads nearer to the goal, so the proxy rests.";
        case StepEnd::out_of_moves:
            break;
    }
    return piece + ": this update has no moves left, so the next one goes on from here.";
}

}  // namespace

ExplainedUpdate explain(const DepthSurface& surface, const Proxy& proxy, Vec3 goal,
                        const Friction& friction) {
    if (!is_finite(goal)) return {.goal = goal, .start = proxy, .steps = {}, .result = proxy};
    return Explainer(surface, proxy, goal, friction).run();
}

PathBox box_of(const ExplainedUpdate& update) {
    PathBox box{update.start.position, update.start.position};
    for (const WalkStep& step : update.steps) {
        box.low = glm::min(box.low, step.after.position);
        box.high = glm::max(box.high, step.after.position);
    }
    return box;
}

std::string text_of(const Primitive& primitive) {
    switch (primitive.kind) {
        case PrimitiveKind::triangle:
            return "TRIANGLE" + place(primitive.i, primitive.j) +
                   (primitive.side == TriangleSide::near_origin ? ", upper left" : ", lower right");
        case PrimitiveKind::edge: {
            const char* way = primitive.direction == EdgeDirection::along_row ? ", along the row"
                              : primitive.direction == EdgeDirection::along_column
                                  ? ", along the column"
                                  : ", diagonal";
            return "EDGE" + place(primitive.i, primitive.j) + way;
        }
        case PrimitiveKind::vertex:
            return "VERTEX" + place(primitive.i, primitive.j);
        case PrimitiveKind::none:
            break;
    }
    return "Free space";
}

std::string text_of(const WalkStep& step) {
    return judged_text(step) + end_text(step);
}

}  // namespace dibhr
