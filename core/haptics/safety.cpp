// The safety stage.
#include "core/haptics/safety.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace dibhr {

namespace {

/// The time a limit per millisecond may count on: a loop that stumbles earns no larger step [ms].
double bounded_ms(double dt_s) noexcept {
    constexpr double kLongest_ms = 3.0;
    return std::min(dt_s * 1e3, kLongest_ms);
}

/// The vector shortened to `longest`, same direction. Safe for any finite length.
Vec3 shortened(Vec3 v, double longest) noexcept {
    const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    if (largest == 0.0) return v;
    const Vec3 scaled = v / largest;  // its length is in [1, sqrt 3]: nothing overflows
    const double length = glm::length(scaled);
    return largest * length <= longest ? v : scaled * (longest / length);
}

SafetyCut reason_to_cut(Vec3 force_newton, const SafetyInput& input,
                        const SafetyLimits& limits) noexcept {
    if (!is_finite(force_newton)) return SafetyCut::not_finite;
    if (!input.force_enabled) return SafetyCut::off;
    if (!input.device_ready) return SafetyCut::device_not_ready;
    if (!(input.dt_s > 0.0 && input.dt_s <= limits.max_tick_s)) return SafetyCut::late_tick;
    return goal_jumped(input, limits) ? SafetyCut::goal_jump : SafetyCut::none;
}

}  // namespace

bool goal_jumped(const SafetyInput& input, const SafetyLimits& limits) noexcept {
    return !(input.goal_step_mm <= limits.max_goal_speed_mm_per_ms * bounded_ms(input.dt_s));
}

const char* name_of(SafetyCut cut) noexcept {
    switch (cut) {
        case SafetyCut::not_finite:
            return "not finite";
        case SafetyCut::off:
            return "force off";
        case SafetyCut::device_not_ready:
            return "device not ready";
        case SafetyCut::late_tick:
            return "late tick";
        case SafetyCut::goal_jump:
            return "goal jumped";
        case SafetyCut::none:
            break;
    }
    return "";
}

void SafetyStage::rest() noexcept {
    ramp_age_s_ = 0.0;
    sent_newton_ = Vec3(0.0);
}

Vec3 SafetyStage::limit(Vec3 force_newton, const SafetyInput& input,
                        const SafetyLimits& limits) noexcept {
    cut_ = reason_to_cut(force_newton, input, limits);
    if (cut_ != SafetyCut::none) {
        rest();
        return sent_newton_;
    }
    if (input.restart) rest();  // what was sent was another hand's, or another scale's
    ramp_age_s_ = input.restart ? 0.0 : ramp_age_s_ + input.dt_s;
    const double ramp = limits.ramp_s > 0.0 ? std::min(1.0, ramp_age_s_ / limits.ramp_s) : 1.0;
    const Vec3 wanted = shortened(force_newton, limits.max_force_newton) * ramp;
    const double most_change = limits.max_change_newton_per_ms * bounded_ms(input.dt_s);
    const Vec3 changed = sent_newton_ + shortened(wanted - sent_newton_, most_change);
    sent_newton_ = shortened(changed, limits.max_force_newton);
    return sent_newton_;
}

}  // namespace dibhr
