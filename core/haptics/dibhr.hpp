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

    /// The proxy as the next update would have it after `moves` moves, 0 or more; no update is
    /// made. The surface's own motion and a flight come before the first move. `bound_met` is true
    /// while moves are left, else as `update` gives it. Of moves that are counted together all are
    /// made.
    [[nodiscard]] Proxy after_moves(const DepthSurface& surface, Vec3 goal,
                                    const Friction& friction, int moves) const noexcept;

  private:
    void walk(const DepthSurface& surface, Vec3 goal, const Friction& friction,
              Proxy& proxy) const noexcept override;

    int last_move_{kMostMoves};
};

}  // namespace dibhr
