// The values of a tick that the strip charts show.
#pragma once

#include <glm/geometric.hpp>

#include "core/haptics/touch.hpp"
#include "core/realtime/spsc_ring.hpp"

namespace dibhr {

struct TickStrip {
    float force_newton{0.0F};     ///< length of the force sent
    float penetration_mm{0.0F};   ///< of the goal, from the proxy; 0 out of contact
    float speed_mm_per_s{0.0F};   ///< of the goal
    float work_millijoule{0.0F};  ///< work of the last tick's force on the hand's motion since
    float lateness_us{0.0F};      ///< after the tick's deadline
};

/// One value a tick, for the strip charts.
using StripRing = SpscRing<TickStrip, 4096>;

/// `before` is the tick before `now`, `dt_s` earlier; 0: there was none to move from.
[[nodiscard]] inline TickStrip strip_of(const Touch& before, const Touch& now, double dt_s,
                                        double lateness_us, double pitch_mm) noexcept {
    TickStrip strip;
    strip.force_newton = static_cast<float>(glm::length(now.sent_force_newton));
    if (now.proxy.contact)
        strip.penetration_mm =
            static_cast<float>(pitch_mm * glm::length(now.proxy.position - now.goal));
    strip.lateness_us = static_cast<float>(lateness_us);
    if (!(dt_s > 0.0)) return strip;
    const Vec3 way_mm = pitch_mm * (now.goal - before.goal);
    strip.speed_mm_per_s = static_cast<float>(glm::length(way_mm) / dt_s);
    strip.work_millijoule = static_cast<float>(glm::dot(before.sent_force_newton, way_mm));
    return strip;
}

}  // namespace dibhr
