// Linear interpolation of the parameters in time.
#include "core/haptics/parameter_glide.hpp"

#include <algorithm>

namespace dibhr {

auto ParameterGlide::towards(const Values& target, double dt_s, bool at_once) noexcept
    -> const Values& {
    if (at_once || !started_) {
        age_s_ = kDuration_s;
    } else if (target != to_) {
        from_ = now_;
        age_s_ = 0.0;
    }
    started_ = true;
    to_ = now_ = target;
    if (under_way()) age_s_ += std::max(dt_s, 0.0);
    if (!under_way()) return now_;
    const double share = age_s_ / kDuration_s;
    const auto between = [share](double from, double to) { return from + share * (to - from); };
    for (const TouchNumber& number : touch_numbers()) {
        double& value = number.in(now_.parameters);
        value = between(number.in(from_.parameters), value);
    }
    now_.parameters.shape.bump_size_px = target.parameters.shape.bump_size_px;
    Coupling& coupling = now_.parameters.coupling;
    coupling.pixel_pitch_mm = target.parameters.coupling.pixel_pitch_mm;
    // Between none and one there is no low-pass, but a slower one.
    coupling.damping_cutoff_hz = target.parameters.coupling.damping_cutoff_hz;
    now_.limits.max_force_newton =
        std::min(between(from_.limits.max_force_newton, target.limits.max_force_newton),
                 target.limits.max_force_newton);
    return now_;
}

}  // namespace dibhr
