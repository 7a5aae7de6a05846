// Nominal numbers of a Touch.
#pragma once

#include "core/haptics/safety.hpp"

namespace dibhr::openhaptics {

/// Of the Touch, **nominal, not measured**: README.md, Numbers. The greatest force is the one that
/// its motors stand for ever.
[[nodiscard]] inline DeviceLimits nominal_limits() noexcept {
    DeviceLimits limits;
    limits.max_force_newton = 0.88;
    limits.max_stiffness_newton_per_mm = 0.4;
    limits.dynamics = {
        .mass_kg = 0.045, .friction_newton_s_per_m = 0.2, .resolution_mm = 0.055, .delay_s = 0.003};
    return limits;
}

}  // namespace dibhr::openhaptics
