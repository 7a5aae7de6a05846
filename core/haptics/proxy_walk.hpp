// What the walks of all algorithms share: flights, moves, and friction before a straight piece.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

#include "core/haptics/collision.hpp"
#include "core/haptics/facet.hpp"
#include "core/haptics/parameters.hpp"
#include "core/haptics/proxy.hpp"
#include "core/haptics/surface.hpp"
#include "core/haptics/vec.hpp"

namespace dibhr {

/// Tolerance: a proxy that stopped on the cone counts as inside it at the next update.
inline constexpr double kConeRounding = 1.0 + 1e-12;

/// A proxy nearer than this has arrived [px]: more than round-off of an 8K image's coordinates.
inline constexpr double kArrived_px = 1e-11;

[[nodiscard]] constexpr double square(double x) noexcept {
    return x * x;
}

/// The most moves of a walk that reads whole TRIANGLEs: over a bump map that is not stretched
/// beforehand they take up to four times as long. Halved over a stretched one, too: the same bits.
[[nodiscard]] inline int half_over_bump(const DepthSurface& surface, int most_moves) noexcept {
    return surface.has_bump() ? most_moves / 2 : most_moves;
}

/// The proxy of one update on its way to `goal`, which lies inside the image rectangle. A class
/// derived from it gives the visits.
class ProxyWalk {
  public:
    /// `last_move`: ends after that move at the latest, with the proxy of the whole walk there.
    ProxyWalk(const DepthSurface& surface, Vec3 goal, const Friction& friction, int most_moves,
              Proxy& proxy, int last_move = std::numeric_limits<int>::max()) noexcept
        : surface_(surface),
          goal_(goal),
          friction_(friction),
          all_moves_(most_moves),
          last_move_(last_move),
          proxy_(proxy) {}

  protected:
    enum class Next { visit, rest };

    [[nodiscard]] static double squared_distance(Vec3 a, Vec3 b) noexcept {
        return glm::dot(a - b, a - b);
    }

    /// Calls `visit()` until the proxy rests; after too many of them `bound_met` is set.
    template <typename Visit>
    void visit_until_rest(Visit&& visit) noexcept {
        Next next = proxy_.contact ? Next::visit : visit_free();
        while (next == Next::visit) {
            if (proxy_.moves >= last_move()) {
                proxy_.bound_met = true;
                break;
            }
            ++proxy_.moves;
            next = visit();
        }
        if (!moved_) proxy_.slipping = false;
    }

    /// The number of moves after which no further one is made.
    [[nodiscard]] int last_move() const noexcept { return std::min(most_moves_, last_move_); }

    /// From now on reads are counted.
    void limit_reads(int most) noexcept {
        most_reads_ = most;
        halt_reads_ = kReadsToFirstLook;
    }

    /// Counts what a visit reads: after so many there is no further visit.
    void count_reads(int reads) noexcept {
        proxy_.reads += reads;
        if (proxy_.reads >= halt_reads_) [[unlikely]]
            end_or_look_ahead();
    }

    /// Free flight to the goal, or to where it meets the surface: then there is a TRIANGLE to
    /// visit.
    Next visit_free() noexcept;

    /// Keeps a pressing hand in contact while its proxy catches up: puts a proxy that is in the air
    /// down on the surface below it. False: the goal is not below the surface.
    bool stay_on_surface() noexcept;

    /// The flight from the proxy's place, without moving the proxy. Uses up its share of the moves.
    Flight fly_to(Vec3 end) noexcept;

    /// The proxy leaves the surface and flies on.
    Next leave() noexcept;

    /// The walk has come to its end on the surface: the proxy rests, or leaves if the goal is above
    /// the active primitive.
    Next rest_or_leave() noexcept;

    /// The VERTEX or EDGE of the active primitive that the proxy is on, else the active primitive.
    [[nodiscard]] Primitive smallest_primitive_under_proxy() const noexcept;

    /// Makes that primitive active, so that the walk considers all TRIANGLEs around it.
    void activate_smallest_primitive() noexcept;

    /// The TRIANGLE of the active primitive, or around it, on whose side the goal is.
    [[nodiscard]] Facet ground_towards_goal() const noexcept;

    /// A change within round-off is no move: it would make a sticking proxy slip.
    void move_to(Vec3 position) noexcept {
        const bool moves = squared_distance(proxy_.position, position) > square(kArrived_px);
        proxy_.position = position;
        if (!moves) return;
        proxy_.slipping = true;
        moved_ = true;
    }

    /// The friction cone around F, the goal's foot on the line of a straight piece: radii of
    /// mu |goal - F|, squared, so that comparing them costs no root (README.md, "Friction").
    struct Cone {
        double moving2{0.0};   ///< for a proxy that moves: it goes no nearer to F
        double holding2{0.0};  ///< for the proxy as it is, sticking or slipping: inside, it stays
    };

    [[nodiscard]] Cone cone_at(double foot_to_goal2) const noexcept {
        const double holding =
            proxy_.slipping ? friction_.dynamic_coefficient : friction_.static_coefficient;
        return {square(friction_.dynamic_coefficient) * foot_to_goal2,
                square(holding) * foot_to_goal2};
    }

    /// The proxy, this far from F, is inside the cone already, or at F. Both squares may be times
    /// the same `scale2`.
    [[nodiscard]] static bool is_held(const Cone& cone, double to_foot2,
                                      double scale2 = 1.0) noexcept {
        return to_foot2 <= cone.holding2 * kConeRounding + square(kArrived_px) * scale2;
    }

    /// Where the cone around a known F stops the proxy.
    [[nodiscard]] Vec3 place_on_cone(Vec3 foot, double to_foot2, const Cone& cone) const noexcept {
        return foot + std::sqrt(cone.moving2 / to_foot2) * (proxy_.position - foot);
    }

    /// A straight piece to an end that need not be F, nor lie on this side of it. All but `piece`
    /// and `length2` are times the piece's length (squares: its square): no root and no division.
    struct ConeView {
        Vec3 piece{0.0};
        double length2{0.0};
        double along{0.0};  ///< from the proxy to F
        Cone cone{};
    };

    [[nodiscard]] ConeView cone_view(Vec3 end) const noexcept {
        return cone_view(proxy_.position, end);
    }

    /// The same, of a proxy at `begin`.
    [[nodiscard]] ConeView cone_view(Vec3 begin, Vec3 end) const noexcept {
        const Vec3 to_goal = goal_ - begin;
        ConeView view{end - begin};  // in its place: a copy would have to wait for its parts
        const Vec3 off = glm::cross(to_goal, view.piece);
        view.length2 = glm::dot(view.piece, view.piece);
        view.along = glm::dot(to_goal, view.piece);
        view.cone = cone_at(glm::dot(off, off));
        return view;
    }

    [[nodiscard]] static bool is_held(const ConeView& view) noexcept {
        return is_held(view.cone, square(view.along), view.length2);
    }

    /// The piece enters the cone before its end. Without friction there is no cone.
    [[nodiscard]] static bool enters_cone(const ConeView& view) noexcept {
        const double beyond = view.along - view.length2;  // from the end to F
        return view.cone.moving2 > 0.0 && (beyond < 0.0 || square(beyond) < view.cone.moving2);
    }

    [[nodiscard]] Vec3 place_on_cone(const ConeView& view) const noexcept {
        // Round-off may make a very short piece lead away from F.
        const double gone = std::max(view.along - std::sqrt(view.cone.moving2), 0.0);
        return proxy_.position + gone / view.length2 * view.piece;
    }

    /// Goes along a piece that does not hold the proxy, up to the cone; false if that is before its
    /// end.
    bool slide_to(Vec3 end, const ConeView& view) noexcept {
        const bool stops = enters_cone(view);
        move_to(stops ? place_on_cone(view) : end);
        return !stops;
    }

    /// A usual update reads less, and never looks ahead.
    static constexpr int kReadsToFirstLook = 64;
    static constexpr int kReadsToNextLook = 32;  ///< about eight moves

    /// Ends the walk after its last read. Before that, every so many reads, asks the memory for the
    /// vertices around the way ahead, if the walk goes on as it went last: where an image is in no
    /// cache, each of its rows is a wait of some moves' length. Nothing but the time depends on it.
    [[gnu::cold, gnu::noinline]] void end_or_look_ahead() noexcept;

    const DepthSurface& surface_;
    const Vec3 goal_;
    const Friction friction_;
    const int all_moves_;
    const int last_move_;
    int most_moves_{all_moves_};  ///< less those that flights and reads have used up
    int most_reads_{std::numeric_limits<int>::max()};
    int halt_reads_{std::numeric_limits<int>::max()};  ///< the reads after which to look or end
    int looked_i_{-1}, looked_j_{-1};                  ///< where it looked ahead last; -1: not yet
    Proxy& proxy_;
    bool moved_{false};
    bool touched_{proxy_.contact};  ///< in contact at the begin of this update or since
    Vec3 left_surface_at_{
        std::numeric_limits<double>::infinity()};  ///< where the proxy left the surface last
};

}  // namespace dibhr
