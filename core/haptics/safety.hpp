// The last stage of every tick, whatever the algorithm gave: a force the hand can be trusted to.
#pragma once

#include <cstdint>

#include "core/haptics/parameters.hpp"
#include "core/haptics/stability.hpp"
#include "core/haptics/vec.hpp"

namespace dibhr {

/// The defaults suit a Falcon, the weakest device that dibhr drives.
struct SafetyLimits {
    double max_force_newton{4.0};          ///< the smaller of the device's limit and the user's
    double max_change_newton_per_ms{0.5};  ///< slew limit
    double ramp_s{0.5};                    ///< the rise from zero to full force
    double max_tick_s{0.020};              ///< a longer tick is late: no force
    /// A faster goal is a jump, not a hand (10 m/s) [image mm].
    double max_goal_speed_mm_per_ms{10.0};
    /// Of a stiffness map; held_limits() makes it the device's.
    double max_stiffness_newton_per_mm{10.0};
    /// The energy that rendering creates is to be taken out of a device that moves.
    bool stability{false};
    DeviceDynamics watched{};  ///< that device; held_limits() sets it

    bool operator==(const SafetyLimits&) const = default;
};

/// What a device can stand, as it is felt in the image, and how it moves. A value that is no
/// number, infinite or negative means that it can stand none of it.
struct DeviceLimits {
    double max_force_newton{8.0};
    double max_stiffness_newton_per_mm{1.0};
    double max_damping_newton_s_per_m{20.0};
    /// A faster goal is a jump, not a hand (10 m/s) [image mm].
    double max_goal_speed_mm_per_ms{10.0};
    DeviceDynamics dynamics{};

    bool operator==(const DeviceLimits&) const = default;
};

/// The same limits with 0 for every value that is no limit.
[[nodiscard]] DeviceLimits usable(const DeviceLimits& device) noexcept;

/// The limits of a hand of which a millimetre is `scale` image millimetres.
[[nodiscard]] DeviceLimits at_scale(const DeviceLimits& device, double scale) noexcept;

/// The limits of a device whose forces act `delay_s` after its pose was read, where that is later
/// than it states: it damps less and drives more, and a pose that is new in one tick of some shows
/// a velocity that jumps, so that no more than a quarter of the stiffness that a damper could hold
/// is stable.
[[nodiscard]] DeviceLimits at_delay(DeviceLimits device, double delay_s) noexcept;

/// Spring and damper, no stiffer than the device can stand. A coupling that was held before stays
/// as it is, bit by bit; so do limits.
[[nodiscard]] Coupling held_coupling(Coupling coupling, const DeviceLimits& device) noexcept;

/// The user's limits, with the device's where it can stand less; what a jump is, and how a force
/// moves it, the device knows.
[[nodiscard]] SafetyLimits held_limits(SafetyLimits limits, const DeviceLimits& device) noexcept;

/// Why the last force was cut, or `none`.
enum class SafetyCut : std::uint8_t {
    none,
    not_finite,
    off,
    device_not_ready,
    late_tick,
    goal_jump,
    standstill
};
inline constexpr auto kLastSafetyCut = SafetyCut::standstill;

/// "", "not finite", "force off", ...: for the panel.
[[nodiscard]] const char* name_of(SafetyCut cut) noexcept;

/// What one tick knows besides the force.
struct SafetyInput {
    double dt_s{0.001};
    double goal_step_mm{0.0};  ///< how far the goal moved since the last tick [image mm]
    bool force_enabled{true};  ///< the switch of the force
    bool device_ready{true};   ///< attached and homed
    /// What the device itself adds on the hand, such as its soft boundary [N]; limited with it.
    Vec3 device_force_newton{0.0};
    bool from_zero{false};  ///< start, engaging, seek, loop, new file, another hand or its scale
    /// What people could take the force off with, or what they touch, does not go on: the force
    /// goes down to zero and comes back by the ramp.
    bool standstill{false};
};

/// The goal moved farther than a hand can in that time, or there was no time to move in.
[[nodiscard]] bool goal_jumped(const SafetyInput& input, const SafetyLimits& limits) noexcept;

/// Finite? -> length <= limit -> ramp -> change per millisecond <= limit -> zero when it must not
/// act, at once or, at a standstill, within kFade_s. Limits per millisecond count at most 3 ms of a
/// late tick.
class SafetyStage {
  public:
    /// So long the force takes to zero, from what it was and whatever limits its change [s].
    static constexpr double kFade_s = 0.040;

    /// The force to send [N]. |result| <= limits.max_force_newton, and always finite.
    [[nodiscard]] Vec3 limit(Vec3 force_newton, const SafetyInput& input,
                             const SafetyLimits& limits) noexcept;

    /// No force is sent until the next `limit`, which then begins from zero.
    void drop_to_zero() noexcept;

    [[nodiscard]] SafetyCut last_cut() const noexcept { return cut_; }
    /// The last force was cut, or was one on the way from zero to its full length.
    [[nodiscard]] bool rising(const SafetyLimits& limits) const noexcept {
        return cut_ != SafetyCut::none || ramp_age_s_ < limits.ramp_s;
    }

  private:
    /// The next force of a standstill: straight down from what was sent when it began.
    [[nodiscard]] Vec3 faded(const SafetyInput& input, const SafetyLimits& limits) noexcept;

    Vec3 sent_newton_{0.0};
    Vec3 fade_from_newton_{0.0};
    double fade_age_s_{0.0};  // of a standstill
    double ramp_age_s_{0.0};
    SafetyCut cut_{SafetyCut::none};
};

}  // namespace dibhr
