// Nominal numbers of a Touch.
#pragma once

#include "core/haptics/safety.hpp"

namespace dibhr::openhaptics {

/// Of the Touch, **nominal, not measured**: README.md, Numbers. The greatest force is the one that
/// its motors stand for ever. Two thirds of the nominal mass, and half of the usual margin: so
/// light an arm is shaken by a damper that is made for more mass than there is.
[[nodiscard]] inline DeviceLimits nominal_limits() noexcept {
    DeviceLimits limits;
    limits.max_force_newton = 0.88;
    limits.max_stiffness_newton_per_mm = 0.4;
    limits.dynamics = {.mass_kg = 0.03,
                       .friction_newton_s_per_m = 0.2,
                       .resolution_mm = 0.055,
                       .delay_s = 0.003,
                       .margin_newton_s_per_m = 1.5};
    return limits;
}

}  // namespace dibhr::openhaptics
