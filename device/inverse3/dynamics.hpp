// Assumed dynamics of an Inverse3.
#pragma once

#include "core/haptics/stability.hpp"

namespace dibhr::inverse3 {

/// **Not measured.** Step: from a reseller's table. Mass and friction: guesses for so light an arm.
/// Delay: a tick of computation, an exchange, and a tick of the service.
inline constexpr DeviceDynamics kAssumedDynamics{
    .mass_kg = 0.15, .friction_newton_s_per_m = 0.2, .resolution_mm = 0.01, .delay_s = 0.003};

/// Delay from reading a pose until its force acts [s]: one and a half exchanges, half a tick, and
/// the service's own tick.
constexpr double delay_s_of(int exchange_ms) noexcept {
    return 1e-3 * (1.5 * exchange_ms + 1.5);
}

}  // namespace dibhr::inverse3
