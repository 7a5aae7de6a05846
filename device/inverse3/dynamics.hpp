// How an Inverse3 moves, as far as it is known.
#pragma once

#include "core/haptics/stability.hpp"

namespace dibhr::inverse3 {

/// **Not measured.** Step: a reseller's table. Mass and friction: of an arm that light. Delay: a
/// tick of computation, an exchange, and a tick of the service's own.
inline constexpr DeviceDynamics kAssumedDynamics{
    .mass_kg = 0.15, .friction_newton_s_per_m = 0.2, .resolution_mm = 0.01, .delay_s = 0.003};

/// From reading a pose until its force acts, where exchanges take so long: one and a half of them,
/// half a tick of ours, and the service's own tick [s].
constexpr double delay_s_of(int exchange_ms) noexcept {
    return 1e-3 * (1.5 * exchange_ms + 1.5);
}
inline constexpr int kPromptExchange_ms = 2;   ///< a longer one makes springs softer to feel
inline constexpr int kLongestExchange_ms = 5;  ///< a longer one allows no force

}  // namespace dibhr::inverse3
