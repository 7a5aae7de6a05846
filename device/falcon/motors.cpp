// From torques at the thighs to motor commands that never wrap.
#include "device/falcon/motors.hpp"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>

namespace dibhr::falcon {

namespace {

/// Beyond it Novint's driver saturates.
constexpr double kMostCounts = 4095.0;

std::int16_t rounded(double counts) noexcept {
    return static_cast<std::int16_t>(std::lround(counts));
}

}  // namespace

Counts motor_counts(Vec3 torques_newton_metre, const Motors& motors) noexcept {
    const double scale = motors.counts_per_newton_metre;
    // Whole, so that rounding does not lead beyond it.
    const double full = std::floor(std::min(motors.full_scale_counts, kMostCounts));
    if (!is_finite(torques_newton_metre) || !std::isfinite(scale)) return {};
    if (!(scale > 0.0) || !(full > 0.0)) return {};

    const Vec3 size = glm::abs(torques_newton_metre);
    const double largest = std::max({size.x, size.y, size.z});
    const bool saturated = scale * largest > full;
    const auto command = [&](double torque) {
        return rounded(saturated ? -full * (torque / largest) : -scale * torque);
    };
    return {command(torques_newton_metre.x), command(torques_newton_metre.y),
            command(torques_newton_metre.z)};
}

}  // namespace dibhr::falcon
