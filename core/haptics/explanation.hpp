// One update of DIBHR, step by step and in sentences: shows people how the proxy walks.
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

/// How a step ended.
enum class StepEnd {
    reaches_goal,      ///< through the air: nothing is in the way
    meets_surface,     ///< through the air: contact begins
    leaves,            ///< the goal is above the piece: off the surface
    crosses,           ///< the foot is outside the TRIANGLE: to the EDGE or VERTEX on the way
    goes_to_end,       ///< the foot is beyond the EDGE: to the VERTEX on the way
    rests_at_foot,     ///< no point of the piece is nearer to the goal
    stops_on_cone,     ///< friction stops the proxy on the cone
    stays_in_cone,     ///< friction holds the proxy where it is
    becomes_active,    ///< another primitive that meets here becomes active
    rests_at_minimum,  ///< no way from this VERTEX or EDGE leads nearer to the goal
    out_of_moves,      ///< the next update goes on from here
};

/// From one place of the proxy to the next, along one straight piece, or from one active primitive
/// to the next without a motion.
struct WalkStep {
    /// The primitives that the step visits, in order, each a move. (A straight run along EDGEs, and
    /// a way off the surface and back to the same place, count more moves.) None in the air.
    std::array<Primitive, 2> visited{};
    std::size_t visits{0};
    Primitive piece{};  ///< the last one visited, or the EDGE along which the proxy moves
    Proxy before{}, after{};
    Vec3 foot{0.0};       ///< the goal's nearest point on the piece's plane or line, inside or not
    double cone_px{0.0};  ///< radius of the friction cone around the foot; 0 on a VERTEX
    StepEnd end{StepEnd::reaches_goal};
};

/// The next update of a proxy, explained without making it.
struct ExplainedUpdate {
    Vec3 goal{0.0};  ///< as the walk takes it: held to the image rectangle
    Proxy start{};   ///< the proxy after the surface's own motion
    std::vector<WalkStep> steps{};
    Proxy result{};  ///< as `update` gives it
};

/// The box around all places of the proxy.
struct PathBox {
    Vec3 low{0.0}, high{0.0};
};
[[nodiscard]] PathBox box_of(const ExplainedUpdate& update);

/// The update that DIBHR would make next with `proxy`, the result of an update on a surface of this
/// size. A proxy that cannot be on the surface begins above the goal. A goal that is not finite
/// gives no steps. Computes an update for each move, and allocates: not for the haptic thread.
[[nodiscard]] ExplainedUpdate explain(const DepthSurface& surface, const Proxy& proxy, Vec3 goal,
                                      const Friction& friction);

/// "EDGE (12, 30), along the row".
[[nodiscard]] std::string text_of(const Primitive& primitive);

/// The step in one or two sentences.
[[nodiscard]] std::string text_of(const WalkStep& step);

}  // namespace dibhr
