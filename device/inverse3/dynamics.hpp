// How an Inverse3 moves, as far as it is known.
#pragma once

#include "core/haptics/stability.hpp"

namespace dibhr::inverse3 {

/// **Not measured.** Step: a reseller's table. Mass and friction: of an arm that light. Delay: a
/// tick of computation, an exchange, and a tick of the service's own.
inline constexpr DeviceDynamics kAssumedDynamics{
    .mass_kg = 0.15, .friction_newton_s_per_m = 0.2, .resolution_mm = 0.01, .delay_s = 0.003};

}  // namespace dibhr::inverse3
