// The proxy graph algorithm: the proxy goes from VERTEX to VERTEX.
#pragma once

#include "core/haptics/proxy.hpp"

namespace dibhr {

/// Walker and Salisbury, "Large Haptic Topographic Maps: MarsView and the Proxy Graph Algorithm",
/// Symposium on Interactive 3D Graphics 2003.
///
/// The proxy lives on the VERTEXes: it goes to the neighbour nearest to the goal while that is
/// nearer than here. Where the publication is silent:
/// - A proxy that friction stops on its way is on an EDGE; one that has just touched the surface is
///   in a TRIANGLE. Its candidates are then the corners of the TRIANGLEs it touches, one or two,
///   so that it goes on straight ahead instead of turning back to an end of its EDGE, and every
///   piece of its path lies on the surface.
/// - A neighbour that friction holds the proxy back from is no candidate: it goes to the nearest it
///   is free to go to. (Held by the nearest one it would stick more often and for longer.)
/// - It leaves as DIBHR does: where it would rest, if the goal is above the plane there.
/// Guaranteed: the distance to the goal never grows; the proxy is always on the surface or in free
/// space; without friction a proxy on a VERTEX of a plane rests within half a cell's diagonal of
/// the goal's foot. Cost: three or four elevations for the corners where it was stopped, six at the
/// first VERTEX, three at every next one, again where friction holds it back from a neighbour.
class Pga final : public ProxyAlgorithm {
  public:
    /// Primitives visited in an update that flies nowhere (README.md, "One update").
    static constexpr int kMostMoves = 500;
    /// Elevations read in such an update: twice what its moves take where friction holds the proxy
    /// back from no neighbour, up to 36 a move where it does.
    static constexpr int kMostReads = 3000;

  private:
    void walk(const DepthSurface& surface, Vec3 goal, const Friction& friction,
              Proxy& proxy) const noexcept override;
};

}  // namespace dibhr
