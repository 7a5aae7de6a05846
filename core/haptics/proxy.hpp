// What every proxy algorithm takes and gives, so that they can be run side by side.
#pragma once

#include "core/haptics/parameters.hpp"
#include "core/haptics/primitive.hpp"
#include "core/haptics/surface.hpp"
#include "core/haptics/vec.hpp"

namespace dibhr {

/// Where the proxy is after an update.
struct Proxy {
    Vec3 position{0.0};
    Primitive active{};  ///< kind none in free space
    int moves{0};        ///< primitives visited in this update
    bool contact{false};
    bool slipping{false};   ///< the dynamic coefficient holds
    bool bound_met{false};  ///< the walk was stopped by its bound: a fault, counted and reported
};

/// A proxy that follows goals over a surface. No allocation, lock, clock or exception in `update`.
class ProxyAlgorithm {
  public:
    virtual ~ProxyAlgorithm() = default;

    /// Moves the proxy towards `goal` over `surface`, which may have moved since the last update.
    /// The goal must be finite. The first update starts the proxy above the goal, in free space.
    virtual const Proxy& update(const DepthSurface& surface, Vec3 goal,
                                const Friction& friction) noexcept = 0;

    /// Forgets everything: the next update is a first one.
    virtual void restart() noexcept = 0;

    /// Goes on from where another algorithm left its proxy on this surface.
    virtual void resume(const DepthSurface& surface, const Proxy& proxy) noexcept = 0;
};

}  // namespace dibhr
