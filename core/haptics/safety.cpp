// The safety stage.
#include "core/haptics/safety.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace dibhr {

namespace {

/// The time by which a limit per millisecond is multiplied [ms]: a late tick gets no larger step.
double bounded_ms(double dt_s) noexcept {
    constexpr double kLongest_ms = 3.0;
    return std::min(dt_s * 1e3, kLongest_ms);
}

/// The vector shortened to `longest`, same direction. Safe for any finite length; zero where
/// `longest` is negative or no number.
Vec3 shortened(Vec3 v, double longest) noexcept {
    const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    if (largest == 0.0) return v;
    if (!(longest >= 0.0)) return Vec3(0.0);
    const Vec3 scaled = v / largest;  // its length is in [1, sqrt 3]: nothing overflows
    const double length = glm::length(scaled);
    return largest * length <= longest ? v : scaled * (longest / length);
}

double limit_or_zero(double value) noexcept {
    return std::isfinite(value) && value > 0.0 ? value : 0.0;
}

SafetyCut reason_to_cut(Vec3 force_newton, const SafetyInput& input,
                        const SafetyLimits& limits) noexcept {
    if (!is_finite(force_newton)) return SafetyCut::not_finite;
    if (!input.force_enabled) return SafetyCut::off;
    if (!input.device_ready) return SafetyCut::device_not_ready;
    if (!(input.dt_s > 0.0 && input.dt_s <= limits.max_tick_s)) return SafetyCut::late_tick;
    if (goal_jumped(input, limits)) return SafetyCut::goal_jump;
    return input.standstill ? SafetyCut::standstill : SafetyCut::none;
}

}  // namespace

DeviceLimits usable(const DeviceLimits& device) noexcept {
    return {limit_or_zero(device.max_force_newton),
            limit_or_zero(device.max_stiffness_newton_per_mm),
            limit_or_zero(device.max_damping_newton_s_per_m),
            limit_or_zero(device.max_goal_speed_mm_per_ms),
            {limit_or_zero(device.dynamics.mass_kg),
             limit_or_zero(device.dynamics.friction_newton_s_per_m),
             limit_or_zero(device.dynamics.resolution_mm), limit_or_zero(device.dynamics.delay_s),
             limit_or_zero(device.dynamics.margin_newton_s_per_m)}};
}

DeviceLimits at_scale(const DeviceLimits& device, double scale) noexcept {
    return usable(
        {device.max_force_newton,
         device.max_stiffness_newton_per_mm / scale,
         device.max_damping_newton_s_per_m / scale,
         device.max_goal_speed_mm_per_ms * scale,
         {device.dynamics.mass_kg / scale, device.dynamics.friction_newton_s_per_m / scale,
          device.dynamics.resolution_mm * scale, device.dynamics.delay_s,
          device.dynamics.margin_newton_s_per_m / scale}});
}

DeviceLimits at_delay(DeviceLimits device, double delay_s) noexcept {
    constexpr double kStableShare = 0.25;
    if (!(delay_s > device.dynamics.delay_s)) return device;
    device.dynamics.delay_s = delay_s;
    device.max_stiffness_newton_per_mm = std::min(device.max_stiffness_newton_per_mm,
                                                  kStableShare * most_stiffness(device.dynamics));
    return device;
}

Coupling held_coupling(Coupling coupling, const DeviceLimits& device) noexcept {
    const DeviceLimits most = usable(device);
    coupling.stiffness_newton_per_mm =
        std::clamp(coupling.stiffness_newton_per_mm, 0.0, most.max_stiffness_newton_per_mm);
    coupling.damping_newton_s_per_m =
        std::clamp(coupling.damping_newton_s_per_m, 0.0, most.max_damping_newton_s_per_m);
    return coupling;
}

SafetyLimits held_limits(SafetyLimits limits, const DeviceLimits& device) noexcept {
    const DeviceLimits most = usable(device);
    const double asked = limits.max_force_newton;
    limits.max_force_newton = asked > 0.0 ? std::min(asked, most.max_force_newton) : 0.0;
    limits.max_goal_speed_mm_per_ms = most.max_goal_speed_mm_per_ms;
    limits.max_stiffness_newton_per_mm =
        std::min(limits.max_stiffness_newton_per_mm, most.max_stiffness_newton_per_mm);
    limits.watched = limits.stability ? most.dynamics : DeviceDynamics{};
    return limits;
}

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
        case SafetyCut::standstill:
            return "window or disk stopped";
        case SafetyCut::none:
            break;
    }
    return "";
}

void SafetyStage::drop_to_zero() noexcept {
    ramp_age_s_ = 0.0;
    sent_newton_ = fade_from_newton_ = Vec3(0.0);
}

Vec3 SafetyStage::limit(Vec3 force_newton, const SafetyInput& input,
                        const SafetyLimits& limits) noexcept {
    const bool fading = cut_ == SafetyCut::standstill;
    cut_ = reason_to_cut(force_newton, input, limits);
    if (cut_ != SafetyCut::none && cut_ != SafetyCut::standstill) {
        drop_to_zero();
        return sent_newton_;
    }
    if (input.from_zero) drop_to_zero();  // the last force was of another hand or scale
    if (cut_ == SafetyCut::standstill) {
        if (!fading) {
            fade_from_newton_ = sent_newton_;
            fade_age_s_ = 0.0;
        }
        sent_newton_ = faded(input, limits);
        return sent_newton_;
    }
    ramp_age_s_ = input.from_zero ? 0.0 : ramp_age_s_ + input.dt_s;
    const double ramp = limits.ramp_s > 0.0 ? std::min(1.0, ramp_age_s_ / limits.ramp_s) : 1.0;
    const Vec3 wanted = shortened(force_newton, limits.max_force_newton) * ramp;
    const double most_change = limits.max_change_newton_per_ms * bounded_ms(input.dt_s);
    const Vec3 changed = sent_newton_ + shortened(wanted - sent_newton_, most_change);
    sent_newton_ = shortened(changed, limits.max_force_newton);
    return sent_newton_;
}

Vec3 SafetyStage::faded(const SafetyInput& input, const SafetyLimits& limits) noexcept {
    ramp_age_s_ = 0.0;  // the force returns by the ramp
    fade_age_s_ += input.dt_s;
    const double left = std::max(0.0, 1.0 - fade_age_s_ / kFade_s);
    return shortened(fade_from_newton_ * left, limits.max_force_newton);
}

}  // namespace dibhr
