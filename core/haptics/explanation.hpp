// One update of DIBHR, step by step and in words: for people who want to see how it walks.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "core/haptics/parameters.hpp"
#include "core/haptics/proxy.hpp"
#include "core/haptics/surface.hpp"
#include "core/haptics/vec.hpp"

namespace dibhr {

/// What a step came to.
enum class StepEnd {
    reaches_goal,     ///< through the air: nothing is in the way
    meets_surface,    ///< through the air: contact begins
    leaves,           ///< the goal is above the piece: off the surface
    crosses,          ///< the foot is outside the TRIANGLE: to the EDGE or VERTEX on the way
    goes_to_end,      ///< the foot is beyond the EDGE: to the VERTEX on the way
    rests_at_foot,    ///< no point of the piece is nearer to the goal
    stops_on_cone,    ///< friction lets it go no nearer
    stays_in_cone,    ///< friction holds it where it is
    becomes_active,   ///< another primitive does, of those that meet where the proxy is
    rests_on_lowest,  ///< on a VERTEX or an EDGE: no way from it leads nearer
    out_of_moves,     ///< it goes on from here in the next update
};

/// From one place of the proxy to the next, along one straight piece, or from one active primitive
/// to the next without a motion.
struct WalkStep {
    /// In order: what it counts as moves, but for a straight run along EDGEs and for a way off the
    /// surface and back to where it was. None in the air.
    std::array<Primitive, 2> visited{};
    std::size_t visits{0};
    Primitive piece{};  ///< the last of them, or where it moves: along an EDGE beside a crease
    Proxy before{}, after{};
    Vec3 foot{0.0};       ///< the goal's nearest point on the piece's plane or line, inside or not
    double cone_px{0.0};  ///< radius of the friction cone around the foot; 0 on a VERTEX
    StepEnd end{StepEnd::reaches_goal};
};

/// The next update of a proxy, which is not made.
struct ExplainedUpdate {
    Vec3 goal{0.0};  ///< as the walk takes it: held to the image rectangle
    Proxy start{};   ///< what the surface's own motion made of it
    std::vector<WalkStep> steps{};
    Proxy result{};  ///< as `update` gives it
};

/// Around all places of the proxy.
struct PathBox {
    Vec3 low{0.0}, high{0.0};
};
[[nodiscard]] PathBox box_of(const ExplainedUpdate& update);

/// What DIBHR would do with `proxy`, as an update left it on a surface of this size; one that
/// cannot be on it begins anew above the goal, and a goal that is not finite is refused: no steps.
/// Takes an update's time for each of its moves, and memory: not for the haptic thread.
[[nodiscard]] ExplainedUpdate explain(const DepthSurface& surface, const Proxy& proxy, Vec3 goal,
                                      const Friction& friction);

/// "EDGE (12, 30), along the row".
[[nodiscard]] std::string text_of(const Primitive& primitive);

/// A sentence or two in plain words.
[[nodiscard]] std::string text_of(const WalkStep& step);

}  // namespace dibhr
