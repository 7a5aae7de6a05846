// What every proxy algorithm keeps between updates, and what it does before its walk.
#pragma once

#include "core/haptics/proxy.hpp"

namespace dibhr {

/// A proxy over one surface: where it starts, how it follows a surface that moves, and where it
/// goes on from when another algorithm brought it there. The walk is the algorithm's own.
class SurfaceProxy : public ProxyAlgorithm {
  public:
    void restart() noexcept final { started_ = false; }
    void resume(const DepthSurface& surface, const Proxy& proxy) noexcept final;

  protected:
    /// Starts above the goal, or takes the proxy to where the surface has gone; no moves counted
    /// yet. Gives the goal clamped to the frame.
    Vec3 begin_update(const DepthSurface& surface, Vec3 goal) noexcept;

    /// Far more primitives than any path of a hand's step visits; grows with the cells it may
    /// cross.
    [[nodiscard]] int most_moves(Vec3 goal) const noexcept;

    Proxy proxy_{};

  private:
    void start_above(const DepthSurface& surface, Vec3 goal) noexcept;
    void follow_surface(const DepthSurface& surface) noexcept;

    int columns_{0};
    int rows_{0};
    bool started_{false};
};

}  // namespace dibhr
