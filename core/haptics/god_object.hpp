// The god-object: held by up to three planes, as near to the goal as they allow.
#pragma once

#include "core/haptics/proxy.hpp"

namespace dibhr {

/// Zilles and Salisbury, "A Constraint-Based God-Object Method for Haptic Display", IROS 1995.
///
/// The proxy goes straight to the point nearest to the goal on its active planes, at most three of
/// which bind. What it collides with on the way becomes active too; where it arrives the active
/// planes are found anew, by colliding from there to the goal. Where the publication is silent:
/// - All of this is repeated within an update until the proxy rests, so that it is not an update
///   late at every facet.
/// - A plane goes on beyond its facet, as published: over a ridge the proxy leaves the surface and
///   drops onto the next facet on its way to the goal. It rests on the surface only.
/// - The frame's walls are planes like others, without friction.
/// - Friction is that of the other algorithms, before each straight piece.
/// Guaranteed: the distance to the goal never grows; the proxy is never below the surface; on a
/// plane it goes as DIBHR does. Its active primitive is the TRIANGLE under it.
class GodObject final : public ProxyAlgorithm {
  public:
    /// Primitives visited in an update that flies nowhere, half of them over a bump map
    /// (README.md, "One update").
    static constexpr int kMostMoves = 500;

  private:
    void walk(const DepthSurface& surface, Vec3 goal, const Friction& friction,
              Proxy& proxy) const noexcept override;
};

}  // namespace dibhr
