// What the walks of all algorithms share: flights, moves, and friction before a straight piece.
#pragma once

#include <cmath>

#include "core/haptics/parameters.hpp"
#include "core/haptics/proxy.hpp"
#include "core/haptics/surface.hpp"
#include "core/haptics/vec.hpp"

namespace dibhr {

/// The proxy of one update on its way to `goal`, which lies inside the image rectangle. A class
/// derived from it gives the visits.
class ProxyWalk {
  protected:
    ProxyWalk(const DepthSurface& surface, Vec3 goal, const Friction& friction,
              Proxy& proxy) noexcept
        : surface_(surface), goal_(goal), friction_(friction), proxy_(proxy) {}

    enum class Next { visit, rest };

    /// A proxy that stopped on the cone is inside it at the next update whatever the last bit says.
    static constexpr double kConeRounding = 1.0 + 1e-12;

    /// Nearer than this is there [px]: round-off of an 8K image's coordinates is never walked
    /// after.
    static constexpr double kThere_px = 1e-11;

    [[nodiscard]] static double square(double x) noexcept { return x * x; }
    [[nodiscard]] static double dot(Vec3 a, Vec3 b) noexcept {
        return a.x * b.x + a.y * b.y + a.z * b.z;
    }
    [[nodiscard]] static double squared_distance(Vec3 a, Vec3 b) noexcept {
        return dot(a - b, a - b);
    }

    /// Calls `visit()` until the proxy rests; after `most_moves` of them `bound_met` is set.
    template <typename Visit>
    void visit_until_rest(int most_moves, Visit&& visit) noexcept {
        most_moves_ = most_moves;
        Next next = proxy_.contact ? Next::visit : visit_free();
        while (next == Next::visit) {
            if (proxy_.moves >= most_moves) {
                proxy_.bound_met = true;
                break;
            }
            ++proxy_.moves;
            next = visit();
        }
        if (!moved_) proxy_.slipping = false;
    }

    /// Free flight to the goal, or to where it meets the surface: then there is a TRIANGLE to
    /// visit.
    Next visit_free() noexcept;

    /// Off the surface, and free flight.
    Next leave() noexcept;

    /// The walk has come to its end on the surface: the proxy rests, or leaves if the goal is above
    /// the active primitive.
    Next rest_or_leave() noexcept;

    /// A proxy stopped at a VERTEX or EDGE of the active primitive makes that active: only then
    /// does it see all that surrounds it.
    void stand_on_lowest() noexcept;

    [[nodiscard]] bool is_above(const Primitive& triangle) const noexcept;

    /// The coefficient a proxy must overcome now.
    [[nodiscard]] double holding_coefficient() const noexcept {
        return proxy_.slipping ? friction_.dynamic_coefficient : friction_.static_coefficient;
    }

    void move_to(Vec3 position) noexcept {
        if (position == proxy_.position) return;
        proxy_.position = position;
        proxy_.slipping = true;
        moved_ = true;
    }

    /// How far friction lets the proxy go along a straight piece.
    struct Reach {
        enum class End { held, cone, all };
        End end{End::all};
        Vec3 to{0.0};  ///< the proxy's place, the place on the cone, or the piece's end
    };

    /// A straight piece as the friction rule sees it: F is the goal's foot on the piece's line, and
    /// the cone around it has the radius mu |goal - F|. All but `along` are squares, and all are
    /// times the piece's length, so that comparing them costs no root and no division.
    struct ConeView {
        Vec3 piece{0.0};
        double length2{0.0};
        double along{0.0};  ///< from the proxy to F
        double away2{0.0};  ///< from F to the goal
    };

    [[nodiscard]] ConeView cone_view(Vec3 end) const noexcept {
        const Vec3 w = goal_ - proxy_.position;
        const Vec3 a = end - proxy_.position;
        const Vec3 off{w.y * a.z - w.z * a.y, w.z * a.x - w.x * a.z, w.x * a.y - w.y * a.x};
        return {a, dot(a, a), dot(w, a), dot(off, off)};
    }

    /// The proxy is inside the cone already, or at F.
    [[nodiscard]] bool is_held(const ConeView& view) const noexcept {
        const double cone2 = square(holding_coefficient()) * view.away2 * kConeRounding;
        return square(view.along) <= cone2 + square(kThere_px) * view.length2;
    }

    /// The piece enters the cone before its end.
    [[nodiscard]] bool enters_cone(const ConeView& view) const noexcept {
        const double cone2 = square(friction_.dynamic_coefficient) * view.away2;
        const double beyond = view.along - view.length2;  // from the end to F
        return cone2 > 0.0 && (beyond < 0.0 || square(beyond) < cone2);
    }

    /// Goes along a piece that does not hold the proxy, up to the cone (README.md,
    /// "Friction"); false if that is before its end. Without friction there is no cone.
    bool slide_to(Vec3 end, const ConeView& view) noexcept {
        if (!enters_cone(view)) {
            move_to(end);
            return true;
        }
        move_to(place_on_cone(view));
        return false;
    }

    [[nodiscard]] Vec3 place_on_cone(const ConeView& view) const noexcept {
        const double cone2 = square(friction_.dynamic_coefficient) * view.away2;
        return proxy_.position + ((view.along - std::sqrt(cone2)) / view.length2) * view.piece;
    }

    const DepthSurface& surface_;
    const Vec3 goal_;
    const Friction friction_;
    Proxy& proxy_;
    int most_moves_{0};
    bool moved_{false};
};

}  // namespace dibhr
