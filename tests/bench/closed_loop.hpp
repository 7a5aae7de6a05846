// A simulated hand and device on the real haptic tick: whether the hand oscillates or buzzes, and
// how much energy it gets.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/haptics/parameters.hpp"
#include "core/haptics/safety.hpp"
#include "core/loop/haptic_tick.hpp"

namespace dibhr::bench {

/// The hand that holds the device: a spring to its rest position and a damper, or a constant push.
struct Grip {
    const char* name;
    double spring_newton_per_m;  ///< 0: none, the device is pushed
    double damper_newton_s_per_m;
};
inline constexpr std::array kGrips{Grip{"grip", 300.0, 3.0}, Grip{"light", 100.0, 1.0},
                                   Grip{"free", 0.0, 0.0}};
inline constexpr std::array kMasses_kg{0.1, 0.2, 0.3};                 ///< device and hand
inline constexpr std::array kFrictions_newton_s_per_m{0.5, 1.0, 2.0};  ///< of the device

/// Elevation of the surface [mm] at a time [s].
using SurfaceElevation = std::function<double(double)>;

/// One run.
struct ClosedLoop {
    Grip grip{kGrips[0]};
    double mass_kg{0.2};
    double friction_newton_s_per_m{1.0};
    double resolution_mm{0.05};            ///< steps of the measured position
    int delay_ticks{2};                    ///< between reading a pose and its force acting
    int stated_ticks{-1};                  ///< the delay that the device states; -1: as it is
    std::optional<DeviceLimits> stated{};  ///< all that it states; nothing: of an unknown mass
    bool measures_delay{true};             ///< its limits follow a delay longer than stated
    double press_newton{1.0};              ///< at rest
    double tap_newton_s{0.03};             ///< into the surface, after two seconds; 0: none
    double seconds{4.0};
    TouchParameters parameters{};
    bool stability{false};  ///< as in `view`: damping as the device needs it, energy observer on
    bool damping{true};     ///< with stability; false: observer only, damping as in `parameters`
    SurfaceElevation surface_mm{};  ///< none: it is still
    double slide_mm_per_s{0.0};     ///< of the surface in the picture plane, which carries
    std::function<void(double, HapticSettings&)> change{};  ///< settings by the time [s]
};

/// The result of a run, of its last second unless stated otherwise.
struct ClosedLoopResult {
    double swing_mm{0.0};     ///< peak to peak
    double buzz_newton{0.0};  ///< RMS of the force about its mean
    double work_mw{0.0};      ///< of the force on hand and device, mean from 2 s on
    double travel_mm{0.0};    ///< peak to peak from 2 s on
    double aside_mm{0.0};     ///< where the hand is in the picture plane at the end, off its rest
    double aside_swing_mm{0.0};  ///< and peak to peak
    double controller_mw{0.0};
    bool limits_held{true};  ///< no force above the limit, no change faster than the slew limit
    std::vector<double> depth_mm{};  ///< of every tick
    std::vector<double> force_newton{};
};

[[nodiscard]] ClosedLoopResult run(const ClosedLoop& loop);

/// A hand on a device that is as its driver states it, with stability control: `times_mass` and
/// `times_friction` its nominal ones. It presses with at most half of the device's force.
[[nodiscard]] ClosedLoop on_device(const DeviceLimits& stated, double stiffness_newton_per_mm,
                                   const Grip& grip, double times_mass, double times_friction);

/// Mass and friction of those hands, beside kGrips: 27 in all.
inline constexpr std::array kTimesMass{1.0, 2.0, 3.0};
inline constexpr std::array kTimesFriction{1.0, 2.0, 4.0};

/// More than 0.2 mm peak to peak in the last second.
[[nodiscard]] bool oscillates(const ClosedLoopResult& result);

/// The lowest stiffness [N/mm] that oscillates, in steps of 12 %; `most` when none does.
[[nodiscard]] double lowest_oscillating(ClosedLoop loop, double most = 12.0);

}  // namespace dibhr::bench
