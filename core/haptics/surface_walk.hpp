// The walk of one DIBHR update: from primitive to primitive until the proxy rests.
#pragma once

#include "core/haptics/facet.hpp"
#include "core/haptics/parameters.hpp"
#include "core/haptics/proxy.hpp"
#include "core/haptics/proxy_walk.hpp"
#include "core/haptics/surface.hpp"

namespace dibhr {

/// Moves `proxy` over `surface` towards `goal`, which lies inside the image rectangle. Every move
/// is along one straight piece, on the surface or in free space, and ends nearer to the goal than
/// it began.
class SurfaceWalk : private ProxyWalk {
  public:
    SurfaceWalk(const DepthSurface& surface, Vec3 goal, const Friction& friction,
                Proxy& proxy) noexcept
        : ProxyWalk(surface, goal, friction, proxy) {}

    /// Walks until the proxy rests or `most_moves` primitives were visited (then `bound_met` is
    /// set).
    void run(int most_moves) noexcept;

  private:
    /// The goal as the plane of one TRIANGLE sees it.
    struct Projection {
        Vec3 foot{0.0};         ///< the nearest point of the plane: where the proxy wants to go
        double rise{0.0};       ///< of the goal above the plane, along z [px]
        double distance2{0.0};  ///< from the goal to the plane, squared
    };

    /// A straight piece of the path, and the friction cone around its foot.
    struct Piece {
        Vec3 foot{0.0};       ///< the goal's foot on the piece's line: the proxy wants to go there
        double length2{0.0};  ///< from the proxy to the foot, squared
        double cone2{0.0};    ///< radius of the cone at the foot for a proxy that moves, squared
        double stick2{0.0};   ///< of the cone in which the proxy, as it is now, stays; squared
        bool sticks{false};   ///< the proxy is inside the cone already
    };

    /// How the way over one plane ended.
    struct PlaneExit {
        enum class Reason { none, other_plane, border, rest };
        Reason reason{Reason::none};
        EdgeDirection through{EdgeDirection::diagonal};
        double t{0.0};  ///< of the piece, where it crosses
    };

    Next visit_triangle() noexcept;
    Next visit_edge() noexcept;
    Next visit_vertex() noexcept;

    Next glide(Facet facet, Projection goal_on) noexcept;
    PlaneExit cross_plane(Facet& facet, const Piece& piece) noexcept;
    Next slide_along_edge() noexcept;

    [[nodiscard]] Projection project_on(const Facet& facet) const noexcept;
    [[nodiscard]] Piece piece_to(Vec3 foot, double distance2) const noexcept;
    Next stop_at_cone(const Piece& piece) noexcept;
    void move_to_crossing(const Facet& beside, const PlaneExit& exit, Vec3 foot) noexcept;
};

}  // namespace dibhr
