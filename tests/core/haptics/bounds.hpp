// The invariants of every update, whatever its goal, ground and algorithm.
#pragma once

#include <utility>

#include "core/haptics/dibhr.hpp"
#include "core/haptics/god_object.hpp"
#include "core/haptics/neighborhood.hpp"
#include "core/haptics/pga.hpp"

namespace dibhr::test {

/// Algorithms that read whole TRIANGLEs make half as many moves over a bump map.
inline int most_moves_of(Algorithm algorithm, const DepthSurface& surface) {
    const int half = surface.has_bump() ? 2 : 1;
    switch (algorithm) {
        case Algorithm::dibhr:
            return Dibhr::kMostMoves;
        case Algorithm::pga:
            return Pga::kMostMoves;
        case Algorithm::neighborhood:
            return Neighborhood::kMostMoves / half;
        case Algorithm::god_object:
            break;
    }
    return GodObject::kMostMoves / half;
}

/// What an update looks at: VERTICES of the proxy graph, TRIANGLEs of the neighbourhood search. The
/// last move goes on to its end, past all neighbours. Zero: bounded by its moves alone.
inline int most_reads_of(Algorithm algorithm, const DepthSurface& surface) {
    if (algorithm == Algorithm::pga) return Pga::kMostReads;
    if (algorithm == Algorithm::neighborhood)
        return Neighborhood::kMostLooks / (surface.has_bump() ? 2 : 1);
    return 0;
}
inline constexpr int kReadsOfOneMove = 36;

/// Follows one proxy from update to update.
class BoundsWatch {
  public:
    /// The invariant that the update to `goal` violated; null: none.
    [[nodiscard]] const char* broken_by(const DepthSurface& surface, Algorithm algorithm, Vec3 goal,
                                        const Proxy& proxy) {
        constexpr double kUnder_px = 1e-6;  // round-off at the greatest relief is less
        constexpr int kRestOfPiece = 3;
        const Vec3 at = proxy.position;
        const bool pressed = std::exchange(pressed_, proxy.contact);
        if (!is_finite(at)) return "the proxy is not finite";
        if (surface.clamped_to_frame(at) != at) return "the proxy is beside the image";
        const double height_px = at.z - surface.elevation_at(at.x, at.y);
        if (height_px < -1e-8) return "the proxy is below the surface";
        if (proxy.contact && height_px > 1e-7) return "a proxy in contact is above the surface";
        if (proxy.moves > most_moves_of(algorithm, surface) + kRestOfPiece) return "too many moves";
        const int most_reads = most_reads_of(algorithm, surface);
        if (proxy.reads > (most_reads > 0 ? most_reads + kReadsOfOneMove : 0))
            return "too many reads";
        goal = surface.clamped_to_frame(surface.clamped_to_reach(goal));
        // A hand that comes from the air may be on its way through it for some updates more.
        const bool may_fly = proxy.bound_met && !pressed;
        if (!proxy.contact && !may_fly &&
            goal.z < surface.elevation_at(goal.x, goal.y) - kUnder_px) {
            return "the contact is lost although the goal is below the surface";
        }
        return nullptr;
    }

    /// The next update begins in the air.
    void release_contact() { pressed_ = false; }

  private:
    bool pressed_{false};
};

}  // namespace dibhr::test
