// A proxy that follows goals over a surface: what every algorithm takes and gives.
#pragma once

#include "core/haptics/parameters.hpp"
#include "core/haptics/surface.hpp"
#include "core/haptics/surface_motion.hpp"
#include "core/haptics/vec.hpp"

namespace dibhr {

/// Where the proxy is after an update.
struct Proxy {
    Vec3 position{0.0};
    Primitive active{};  ///< kind none in free space
    int moves{0};        ///< primitives visited in this update
    int reads{0};        ///< looked at in it, where the algorithm has a bound of them; else 0
    bool contact{false};
    bool slipping{false};  ///< the dynamic coefficient holds
    /// Around all ends of its flights in this update, and of the way on which it was to be carried.
    /// What it reads on the surface is within `moves` of these, or of its begin and end.
    PlaceBox flown{};
    /// Around all places at which the motion was looked up, between four pixels each.
    PlaceBox motion_read{};
    /// The walk came to its last move, or a flight to its last cell, before its end: it goes on
    /// from here in the next update.
    bool bound_met{false};

    bool operator==(const Proxy&) const = default;
};

/// The proxy of one of several algorithms that run side by side.
struct AlgorithmProxy {
    Algorithm algorithm{Algorithm::dibhr};
    Proxy proxy{};
};

/// Where the proxy starts, how it follows a surface that moves, and where it goes on from when
/// another algorithm brought it there. The walk is the algorithm's own, so that all can be run side
/// by side. No allocation, lock, clock or exception in `update`.
class ProxyAlgorithm {
  public:
    virtual ~ProxyAlgorithm() = default;

    /// Moves the proxy towards `goal` over `surface`, which may have moved since the last update.
    /// The goal must be finite; one beyond all reach counts as at its limit. The first update
    /// starts the proxy above the goal, in free space. A proxy in contact is first carried along by
    /// the material point that it was on after the last update.
    const Proxy& update(const DepthSurface& surface, Vec3 goal, const Friction& friction,
                        const SurfaceMotion& motion = {}) noexcept;

    /// How far the last update carried a proxy in contact before the walk [px]: in the picture
    /// plane, and by the rise of the surface.
    [[nodiscard]] Vec3 carried_px() const noexcept { return carried_px_; }

    /// The next update is a first one.
    void reset() noexcept { started_ = false; }

    /// Goes on from the proxy of another algorithm, on the same surface.
    void resume(const ProxyAlgorithm& other) noexcept { *this = other; }

    /// The material point under the proxy.
    [[nodiscard]] const MaterialPoint& material() const noexcept { return material_; }

    /// Goes on from `proxy`, the result of an update on a surface of this size, at `material`.
    void resume(const Proxy& proxy, int columns, int rows,
                const MaterialPoint& material = {}) noexcept {
        proxy_ = proxy;
        columns_ = columns;
        rows_ = rows;
        started_ = true;
        material_ = material;
    }

  protected:
    /// Moves the proxy until it rests, or until the algorithm's most moves are made: then sets
    /// `bound_met`. `goal` lies inside the image rectangle.
    virtual void walk(const DepthSurface& surface, Vec3 goal, const Friction& friction,
                      Proxy& proxy) const noexcept = 0;

  private:
    void start_above(const DepthSurface& surface, Vec3 goal) noexcept;
    /// False: the proxy keeps its (x, y).
    bool carry(const DepthSurface& surface, const SurfaceMotion& motion) noexcept;
    void follow_surface(const DepthSurface& surface) noexcept;

    Proxy proxy_{};
    MaterialPoint material_{};  // under it, while it is in contact
    Vec3 carried_px_{0.0};
    int columns_{0};
    int rows_{0};
    bool started_{false};
};

}  // namespace dibhr
