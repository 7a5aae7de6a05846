// The low-pass of the goal's velocity.
#include "core/haptics/goal_velocity.hpp"

#include <numbers>

namespace dibhr {

namespace {

/// How much of the newest difference gets through: backward Euler, stable for every tick. Without
/// exp(), so that the bits are the same on every machine.
double share_of_newest(double dt_s, double cutoff_hz) noexcept {
    if (!(dt_s > 0.0)) return 0.0;
    if (!(cutoff_hz > 0.0)) return 1.0;
    return dt_s / (dt_s + 1.0 / (2.0 * std::numbers::pi * cutoff_hz));
}

}  // namespace

Vec3 GoalVelocity::after(Vec3 step, double dt_s, double cutoff_hz) noexcept {
    const Vec3 difference = dt_s > 0.0 ? step / dt_s : Vec3(0.0);
    Vec3 filtered(0.0);
    if (continues_) {
        const Vec3 change = difference - filtered_px_per_s_;
        filtered = filtered_px_per_s_ + share_of_newest(dt_s, cutoff_hz) * change;
    }
    continues_ = is_finite(filtered);
    filtered_px_per_s_ = continues_ ? filtered : Vec3(0.0);
    return cutoff_hz > 0.0 ? filtered_px_per_s_ : difference;
}

}  // namespace dibhr
