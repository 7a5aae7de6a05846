// Depth Image-Based Haptic Rendering: the proxy follows the correct path over the depth image
// itself.
#pragma once

#include "core/haptics/proxy.hpp"

namespace dibhr {

/// Cha, Eid and El Saddik, "DIBHR: Depth Image-Based Haptic Rendering", EuroHaptics 2008,
/// section 3.
///
/// The walk ends where the distance to the goal has a local minimum over the surface (no friction),
/// or on or in the friction cone of the piece it was on. Cost: a fraction of a microsecond for a
/// hand's step; proportional to the cells crossed.
class Dibhr final : public ProxyAlgorithm {
  public:
    /// Primitives visited in an update that flies nowhere (README.md, "One update").
    static constexpr int kMostMoves = 1000;

    /// Where the proxy is within the next update, which is not made: after so many of its moves,
    /// 0 or more. What the surface did to it comes before the first, and so does a flight. Once
    /// there are none left, `bound_met` is as `update` would say; before, it is set. Some moves
    /// are counted together: then it is after the last of them.
    [[nodiscard]] Proxy after_moves(const DepthSurface& surface, Vec3 goal,
                                    const Friction& friction, int moves) const noexcept;

  private:
    void walk(const DepthSurface& surface, Vec3 goal, const Friction& friction,
              Proxy& proxy) const noexcept override;

    int last_move_{kMostMoves};
};

}  // namespace dibhr
