// From torques at the thighs to motor commands that never wrap (README.md, Motors).
#pragma once

#include "core/haptics/vec.hpp"
#include "device/falcon/packet.hpp"

namespace dibhr::falcon {

/// Nobody has measured the scale: 10000 (libnifalcon), 6616 (Martin & Hillier), ~3600 (captures).
struct Motors {
    double counts_per_newton_metre{10000.0};
    double full_scale_counts{4095.0};  ///< where Novint's driver saturates; at most 4095

    bool operator==(const Motors&) const = default;
};

/// -S * torque; all three shortened by one common factor when one is beyond full scale, so that the
/// force keeps its direction. Zero when a torque is not finite.
[[nodiscard]] Counts motor_counts(Vec3 torques_newton_metre, const Motors& motors) noexcept;

}  // namespace dibhr::falcon
