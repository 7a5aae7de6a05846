// Neighborhood search: the proxy goes to the nearest point of the nearest neighbouring primitive.
#pragma once

#include "core/haptics/proxy.hpp"

namespace dibhr {

/// Ho, Basdogan and Srinivasan, "Efficient Point-Based Rendering Techniques for Haptic Display of
/// Virtual Objects", Presence 8(5), 1999.
///
/// Among the active primitive and its neighbours the one whose nearest point to the goal is nearest
/// becomes active and the proxy goes there, again and again while the distance falls. Neighbours:
/// of a TRIANGLE its EDGEs and VERTEXes; of an EDGE or VERTEX the TRIANGLEs around it. (The nearest
/// point of a TRIANGLE covers its EDGEs and VERTEXes, so those need no look of their own.) Where
/// the publication is silent:
/// - The path is the straight line from nearest point to nearest point. It always lies in the
///   TRIANGLE of the next point, so the proxy is never off the surface.
/// - A proxy that friction stops on its way goes on from there: in the TRIANGLE, or on the EDGE if
///   its way ran along one.
/// - A nearest point that friction holds the proxy back from is passed over: it goes to the next
///   nearest it is free to go to. (Held by the nearest one it would stick more often and for
///   longer.)
/// - It leaves as DIBHR does: where it would rest, if the goal is above the plane there.
/// Guaranteed: the distance to the goal never grows; without friction the resting place is a local
/// minimum of the distance over the surface. Cost: a visit looks at the one TRIANGLE, two or six it
/// touches, but for those it looked at before the move; each takes three elevations, a projection
/// and up to two EDGEs, and held back from all of them once more with its three EDGEs.
class Neighborhood final : public ProxyAlgorithm {
  public:
    /// Primitives visited in an update that flies nowhere, half of them over a bump map
    /// (README.md, "One update"): more than the stick and slip of the paper's paths needs, 453.
    static constexpr int kMostMoves = 460;
    /// TRIANGLEs looked at in such an update, half of them over a bump map: up to 12 a move where
    /// friction holds the proxy back. The stick and slip of the paper's paths needs 1675.
    static constexpr int kMostLooks = 2000;

  private:
    void walk(const DepthSurface& surface, Vec3 goal, const Friction& friction,
              Proxy& proxy) const noexcept override;
};

}  // namespace dibhr
