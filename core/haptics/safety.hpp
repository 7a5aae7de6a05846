// The last stage of every tick: limits the force, whatever the algorithm computed.
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
    /// The highest stiffness of a stiffness map; held_limits() lowers it to the device's.
    double max_stiffness_newton_per_mm{10.0};
    /// Whether stability control takes out the energy that rendering creates.
    bool stability{false};
    DeviceDynamics watched{};  ///< the device that is controlled; held_limits() sets it

    bool operator==(const SafetyLimits&) const = default;
};

/// What a device can stand, in image millimetres, and how it moves. A value that is not finite, or
/// negative, counts as 0: the device can stand none of it.
struct DeviceLimits {
    double max_force_newton{8.0};
    double max_stiffness_newton_per_mm{1.0};
    double max_damping_newton_s_per_m{20.0};
    /// A faster goal is a jump, not a hand (10 m/s) [image mm].
    double max_goal_speed_mm_per_ms{10.0};
    DeviceDynamics dynamics{};

    bool operator==(const DeviceLimits&) const = default;
};

/// The same limits with 0 for every value that is not finite, or negative.
[[nodiscard]] DeviceLimits usable(const DeviceLimits& device) noexcept;

/// The limits in image millimetres where a millimetre of the hand is `scale` of them.
[[nodiscard]] DeviceLimits at_scale(const DeviceLimits& device, double scale) noexcept;

/// The limits of a device whose forces act `delay_s` after its pose was read, where that is later
/// than the device states. Such a force damps less and drives more. Where not every tick has a new
/// pose, its velocity jumps: only a quarter of the stiffness that a damper could hold is stable.
[[nodiscard]] DeviceLimits at_delay(DeviceLimits device, double delay_s) noexcept;

/// Spring and damper, lowered to what the device can stand. Lowering them again changes no bit; the
/// same is true of held_limits().
[[nodiscard]] Coupling held_coupling(Coupling coupling, const DeviceLimits& device) noexcept;

/// The user's limits, lowered to what the device can stand. The speed of a jump and the dynamics
/// are the device's.
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

/// The input of the safety stage in a tick, besides the force.
struct SafetyInput {
    double dt_s{0.001};
    double goal_step_mm{0.0};  ///< how far the goal moved since the last tick [image mm]
    bool force_enabled{true};  ///< the switch of the force
    bool device_ready{true};   ///< attached and homed
    /// What the device itself adds on the hand, such as its soft boundary [N]; limited with it.
    Vec3 device_force_newton{0.0};
    bool from_zero{false};  ///< start, engaging, seek, loop, new file, another hand or its scale
    /// The window, the video or the recorder stands still: the force goes down to zero and comes
    /// back by the ramp.
    bool standstill{false};
};

/// The goal moved farther than a hand can in that time, or there was no time to move in.
[[nodiscard]] bool goal_jumped(const SafetyInput& input, const SafetyLimits& limits) noexcept;

/// Finite? -> length <= limit -> ramp -> change per millisecond <= limit -> zero when no force may
/// act, at once or, at a standstill, within kFade_s. Limits per millisecond count at most 3 ms of a
/// late tick.
class SafetyStage {
  public:
    /// Time of the force from its last value to zero, whatever the slew limit [s].
    static constexpr double kFade_s = 0.040;

    /// The force to send [N]. |result| <= limits.max_force_newton, and always finite.
    [[nodiscard]] Vec3 limit(Vec3 force_newton, const SafetyInput& input,
                             const SafetyLimits& limits) noexcept;

    /// No force is sent until the next `limit`, which then begins from zero.
    void drop_to_zero() noexcept;

    [[nodiscard]] SafetyCut last_cut() const noexcept { return cut_; }
    /// The last force was cut, or was still on the ramp.
    [[nodiscard]] bool rising(const SafetyLimits& limits) const noexcept {
        return cut_ != SafetyCut::none || ramp_age_s_ < limits.ramp_s;
    }

  private:
    /// The next force of a standstill: linearly down from the force sent when it began.
    [[nodiscard]] Vec3 faded(const SafetyInput& input, const SafetyLimits& limits) noexcept;

    Vec3 sent_newton_{0.0};
    Vec3 fade_from_newton_{0.0};
    double fade_age_s_{0.0};  // of a standstill
    double ramp_age_s_{0.0};
    SafetyCut cut_{SafetyCut::none};
};

}  // namespace dibhr
