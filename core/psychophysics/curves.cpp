// Logistic, normal and Gumbel.
#include "core/psychophysics/curves.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace dibhr {

CurvePoint standard_curve(Curve curve, double u) noexcept {
    if (curve == Curve::logistic) {
        const double share = 1.0 / (1.0 + std::exp(-u));
        return {share, share * (1.0 - share)};
    }
    if (curve == Curve::cumulative_gaussian) {
        constexpr double kNorm = 0.5 * std::numbers::inv_sqrtpi * std::numbers::sqrt2;
        return {normal_share(u), kNorm * std::exp(-0.5 * u * u)};
    }
    const double power = std::exp(std::fmin(u, 50.0));  // so that its exponential is plainly 0
    return {-std::expm1(-power), power * std::exp(-power)};
}

double standard_quantile(Curve curve, double share) {
    if (curve == Curve::logistic) return std::log(share / (1.0 - share));
    if (curve == Curve::cumulative_gaussian) return normal_quantile(share);
    return std::log(-std::log1p(-share));
}

double to_axis(Curve curve, double x) noexcept {
    if (curve != Curve::weibull) return x;
    return std::log(std::fmax(x, std::numeric_limits<double>::min()));
}

double from_axis(Curve curve, double place) noexcept {
    return curve == Curve::weibull ? std::exp(place) : place;
}

}  // namespace dibhr
