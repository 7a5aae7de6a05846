// The grip in a person's hand: a mass on a spring and damper that leads to a point which a script
// moves, pushed by the motors through the linkage.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <optional>

#include "core/haptics/vec.hpp"

namespace dibhr::test::falcon {

/// The mechanism, written independently of device/falcon: the numbers are libnifalcon's set
/// (device/falcon/README.md, Kinematics). `angles_at` solves Stamper's half-angle quadratic.
struct Linkage {
    double thigh_m{0.0600};
    double shin_m{0.1025};
    double shin_ends_m{0.0225};            ///< d + e
    double base_less_platform_m{0.02557};  ///< r - c
    double tangential_m{-0.00191};         ///< f - s
    double counts_per_rad{1280.0 * (0.110 / 0.01425) / 6.283185307179586};
    double angle_at_zero_rad{0.6108652381980153};  ///< 35 degrees

    /// Thigh angles [rad]; nothing when the grip cannot be there.
    [[nodiscard]] std::optional<Vec3> angles_at(Vec3 grip_m) const noexcept;
    /// Encoder counts from the mechanism's own zero; nothing when the grip cannot be there.
    [[nodiscard]] std::optional<Vec3> counts_at(Vec3 grip_m) const noexcept;
    /// Force on the grip [N] of torques at the thighs [N m], by virtual work with finite
    /// differences; zero where the grip cannot be.
    [[nodiscard]] Vec3 force_of(Vec3 torques_newton_metre, Vec3 grip_m) const noexcept;
};

struct HandOptions {
    double mass_kg{0.2};
    double stiffness_newton_per_m{300.0};
    double damping_newton_s_per_m{15.5};      ///< critical for the mass and stiffness above
    double counts_per_newton_metre{10000.0};  ///< S of the motors
    Vec3 start_m{0.0, 0.0, 0.115};
};

class HandModel {
  public:
    explicit HandModel(const HandOptions& options = {});

    /// Grip and hand are there, at rest; the rest of the way is forgotten.
    void place(Vec3 grip_m);
    /// After the earlier motions, the hand moves there in a straight line at constant speed.
    void move(Vec3 to_m, double seconds);

    /// Motor commands, as the firmware gets them; they last until the next ones.
    void drive(const std::array<std::int16_t, 3>& motor_counts) noexcept;
    void advance(double seconds);

    [[nodiscard]] Vec3 grip_m() const noexcept { return grip_; }
    [[nodiscard]] Vec3 velocity_m_per_s() const noexcept { return velocity_; }
    [[nodiscard]] Vec3 hand_m() const noexcept { return hand_; }  ///< where the spring leads
    [[nodiscard]] Vec3 motor_force_newton() const noexcept;
    /// Whether the hand has gone all its way.
    [[nodiscard]] bool arrived() const noexcept { return way_.empty(); }
    /// Encoder counts from the mechanism's own zero.
    [[nodiscard]] std::array<int, 3> counts() const noexcept;
    [[nodiscard]] const Linkage& linkage() const noexcept { return linkage_; }

  private:
    struct Leg {
        Vec3 to;
        double seconds;
    };

    void step(double seconds);
    void walk(double seconds);

    HandOptions options_;
    Linkage linkage_{};
    Vec3 grip_;
    Vec3 velocity_{0.0};
    Vec3 hand_;
    Vec3 torques_{0.0};
    std::deque<Leg> way_{};
};

}  // namespace dibhr::test::falcon
