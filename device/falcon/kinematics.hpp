// The grip's position from three thigh angles, and back; motor commands from torques, without
// integer overflow (README.md: Kinematics, Motors).
// Frame: x right, y up, z out of the base towards the person, metres, origin on the base plane.
#pragma once

#include <array>
#include <optional>

#include "core/haptics/vec.hpp"
#include "device/falcon/packet.hpp"

namespace dibhr::falcon {

/// The constants of the mechanism, on which sources disagree; the defaults are libnifalcon's.
struct Geometry {
    double thigh_m{0.0600};             ///< a
    double shin_m{0.1025};              ///< b, of the shin parallelogram
    double shin_end_d_m{0.01125};       ///< d, joint at one end of the shin
    double shin_end_e_m{0.01125};       ///< e, at the other
    double platform_radius_m{0.01443};  ///< c
    double base_radius_m{0.0400};       ///< r
    double platform_shift_m{-0.0250};   ///< f, tangential
    double base_shift_m{-0.02309};      ///< s, tangential; only f - s counts
    double gear{0.110 / 0.01425};       ///< motor turns per thigh turn
    double angle_at_zero_deg{35.0};     ///< thigh angle at encoder count 0

    bool operator==(const Geometry&) const = default;
};

/// d theta / d position: a row per leg [rad/m].
using Jacobian = std::array<Vec3, 3>;

/// Thigh angles [rad] of encoder counts; the counts need not be whole.
[[nodiscard]] Vec3 angles_of_counts(Vec3 counts, const Geometry& geometry) noexcept;
[[nodiscard]] Vec3 angles_of_counts(const Counts& counts, const Geometry& geometry) noexcept;

/// Inverse kinematics [rad]; nothing where the grip cannot be.
[[nodiscard]] std::optional<Vec3> angles_at(Vec3 position_m, const Geometry& geometry) noexcept;

/// Exact; nothing where the grip cannot be or the mechanism is singular.
[[nodiscard]] std::optional<Jacobian> jacobian_at(Vec3 position_m,
                                                  const Geometry& geometry) noexcept;

/// Forward kinematics by Newton's method, converged to 1e-9 rad. Starts at `near_m` (the last
/// pose); if that fails, at several heights. Of two poses with these angles, the one that a hand
/// can reach from the centre. Nothing when no pose has them.
[[nodiscard]] std::optional<Vec3> position_with(Vec3 angles_rad, Vec3 near_m,
                                                const Geometry& geometry) noexcept;

/// Torques at the thighs [N m] that push the grip with `force_newton` (device frame):
/// (dp/dtheta)^T F. Nothing when the mechanism is singular.
[[nodiscard]] std::optional<Vec3> torques_of(Vec3 force_newton, const Jacobian& jacobian) noexcept;

/// The scale is not measured: 10000 (libnifalcon), 6616 (Martin & Hillier), ~3600 (captures).
struct Motors {
    double counts_per_newton_metre{10000.0};
    double full_scale_counts{4095.0};  ///< where Novint's driver saturates; at most 4095

    bool operator==(const Motors&) const = default;
};

/// -S * torque. When one motor is beyond full scale, all three are scaled down by one factor, so
/// that the force keeps its direction. Zero when a torque is not finite.
[[nodiscard]] Counts motor_counts(Vec3 torques_newton_metre, const Motors& motors) noexcept;

}  // namespace dibhr::falcon
