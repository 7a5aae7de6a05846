// Keeps the hand on a device from swinging: the damping that the loop's delay needs, a velocity
// that does not jump with the device's coarse steps, and a passivity observer and controller that
// takes out the energy which rendering itself creates. README.md, Stability.
#pragma once

#include <array>
#include <cstddef>

#include "core/haptics/parameters.hpp"
#include "core/haptics/vec.hpp"

namespace dibhr {

/// The weight of the newest value in a first-order low-pass after `dt_s`: backward Euler, stable
/// for every tick, and without exp(), so that the bits are the same on every machine. 1 for a time
/// constant of 0; 0 where no time has passed.
[[nodiscard]] double share_of_newest(double dt_s, double time_constant_s) noexcept;

/// The time constant [s] of a cutoff frequency; 0 for a frequency that is not above 0.
[[nodiscard]] double time_constant_of(double cutoff_hz) noexcept;

/// How a device moves under a force, in image millimetres. All zero: no force moves it, and nothing
/// has to be kept stable.
struct DeviceDynamics {
    double mass_kg{0.0};                  ///< the least that the force moves
    double friction_newton_s_per_m{0.0};  ///< the least viscous friction of the device itself
    double resolution_mm{0.0};            ///< a step of its position; 0: as fine as a number
    double delay_s{0.0};                  ///< from reading a pose until its force acts
    /// By how much the rendering and the device's friction must damp more than they drive.
    double margin_newton_s_per_m{3.0};

    /// A force moves it.
    [[nodiscard]] bool moves() const noexcept { return mass_kg > 0.0; }
    bool operator==(const DeviceDynamics&) const = default;
};

/// By how much [N s/m] coupling and device damp a pressed hand more than they drive it: held forces
/// act half a tick late on average, and so a spring drives the hand like a damper of
/// -stiffness * (tick / 2 + delay) (Colgate and Schenkel 1997; Diolaiti et al. 2006). Below 0 a
/// free hand swings.
[[nodiscard]] double stability_margin(const Coupling& coupling,
                                      const DeviceDynamics& device) noexcept;

/// The least damping [N s/m] that gives the device its margin; 0 for one that no force moves.
[[nodiscard]] double needed_damping(double stiffness_newton_per_mm,
                                    const DeviceDynamics& device) noexcept;

/// The stiffest spring [N/mm] whose needed damping is itself stable on the device; infinite for one
/// that no force moves, 0 where none is.
[[nodiscard]] double most_stiffness(const DeviceDynamics& device) noexcept;

/// The coupling with the damping that the device needs at `effective_stiffness` [N/mm], and the
/// low-pass on it; unchanged for a device that needs none.
[[nodiscard]] Coupling stable_coupling(Coupling coupling, double effective_stiffness,
                                       const DeviceDynamics& device) noexcept;

/// The velocity over the longest recent time in which every reading lies within a tolerance of the
/// straight line through the newest and the oldest: steps of a device's position look like noise of
/// that size while the hand is slow, and hardly delay it while it is fast (Janabi-Sharifi, Hayward
/// and Chen 2000, end-fit; each axis by itself).
class AdaptiveWindow {
  public:
    /// `tolerance` in steps of the device.
    explicit AdaptiveWindow(double tolerance = 1.0) : tolerance_(tolerance) {}

    /// Velocity [1/s] after a `way` that took `dt_s`, which is above 0. `resolution`: a step of the
    /// device.
    [[nodiscard]] Vec3 after(Vec3 way, double dt_s, double resolution) noexcept;
    void forget() noexcept { length_ = 0; }

  private:
    static constexpr std::size_t kLongest = 8;

    [[nodiscard]] double slope(int axis, double tolerance) const noexcept;

    double tolerance_;
    /// From each earlier reading to the newest, latest first.
    std::array<Vec3, kLongest> way_{};
    std::array<double, kLongest> age_s_{};
    std::size_t length_{0};
};

/// Whether a hand rests: it has not gone farther than a step of the device for a tenth of a second.
class RestWatch {
  public:
    [[nodiscard]] bool rests_after(Vec3 way, double dt_s, double resolution) noexcept;

  private:
    Vec3 off_{0.0};  // from a reference place, which follows the hand at a step's distance
    double rested_s_{0.0};
};

/// The surface's own motion under a resting proxy, low-passed for the force: motion as slow as that
/// of a chest or a waving hand lifts the finger, flicker of the depth does not.
class VideoMotion {
  public:
    /// How far the rendered surface rises in `dt_s` [px], at most by `most_px`, where the recorded
    /// one rose by `rise_px` under the proxy.
    double filtered_rise(double rise_px, double dt_s, double most_px) noexcept;
    /// How far the rendered surface lies below the recorded one [px].
    [[nodiscard]] double lag_px() const noexcept { return lag_px_; }
    /// The rendered surface begins `lag_px` below the recorded one.
    void begin(double lag_px) noexcept { lag_px_ = lag_px; }

  private:
    double lag_px_{0.0};
};

/// What the controller measured and did, for the panel: mean powers of the last second.
struct EnergyFlow {
    double from_video_mw{0.0};           ///< what the video's own motion put into the spring
    double created_mw{0.0};              ///< what rendering put in: delay, held forces, steps
    double taken_out_mw{0.0};            ///< by the controller
    double damping_newton_s_per_m{0.0};  ///< of the controller, now
};

/// Time-domain passivity observer and controller (Hannaford and Ryu 2002) around the coupling's
/// spring, whose stored energy is known: in each tick the work of the force that acted, and what
/// the spring then holds more, less what the video put in, is energy that rendering created. It is
/// taken out along the spring by a damper no stronger than the device can stand.
class PassivityControl {
  public:
    /// The input of a tick.
    struct Tick {
        double dt_s{0.001};
        Vec3 goal_step_mm{0.0};
        Vec3 lag_mm{0.0};  ///< from the goal to where the spring pulls it
        double stiffness_newton_per_mm{0.0};
        double max_force_newton{0.0};  ///< the spring pulls no harder
        Vec3 video_step_mm{0.0};       ///< of the felt surface under the proxy
        /// How far a proxy that was carried in the picture plane then slid by itself. Friction
        /// takes that energy from the video; it must not hide energy that rendering creates.
        Vec3 slid_mm{0.0};
    };

    /// What the controller adds to the force [N].
    [[nodiscard]] Vec3 force_after(const Tick& tick, const DeviceDynamics& device) noexcept;

    /// Records the force that was sent in the tick [N], without the device's own force.
    void record_sent_force(Vec3 force_newton) noexcept;

    /// How far the rendered surface may rise in the next tick [mm]: the video puts at most 20 mJ at
    /// once and 20 mW for long into a hand (an energy tank: Franken et al. 2011). Energy that the
    /// video takes back fills the tank again.
    [[nodiscard]] double most_rise_mm(double stiffness_newton_per_mm) const noexcept;

    /// A tick out of contact, or with a force that is not the spring's: no energy is stored, and
    /// none is left to be taken out.
    void skip_tick(double dt_s) noexcept;
    /// A tick in contact while the force rises from zero: only the video's energy is counted.
    void skip_tick(const Tick& tick) noexcept;

    [[nodiscard]] const EnergyFlow& flow() const noexcept { return flow_; }

  private:
    static constexpr std::size_t kMostDelay = 16;  // ticks
    static constexpr double kVideoAtOnce_mj = 20.0;

    [[nodiscard]] Vec3 acting_force(double dt_s, double delay_s) const noexcept;

    /// Energy that rendering created in the tick, and what the video put in [mJ].
    struct Energy {
        double created{0.0};
        double from_video{0.0};
    };
    [[nodiscard]] Energy account_for(const Tick& tick, Vec3 along,
                                     const DeviceDynamics& device) noexcept;
    void fill_video_tank(double dt_s, double from_video_mj) noexcept;
    [[nodiscard]] double update_spring_pull(const Tick& tick, Vec3 along) noexcept;
    void smooth_flow(const EnergyFlow& now, double dt_s) noexcept;
    /// The damping that takes the created energy out within 3 ms [N s/m].
    [[nodiscard]] double damping_for(double speed_mm_per_s,
                                     const DeviceDynamics& device) const noexcept;

    std::array<Vec3, kMostDelay> sent_newton_{};  // latest first
    AdaptiveWindow quick_velocity_{0.5};          // hardly late, but in steps: for the damper
    AdaptiveWindow steady_velocity_{};
    RestWatch rest_{};
    Vec3 pull_newton_{0.0};             // of the spring on the hand, in the tick before
    double length_mm_{0.0};             // of the spring, in the tick before
    double excess_mj_{0.0};             // created by rendering and not taken out yet
    double video_mj_{kVideoAtOnce_mj};  ///< that the video may put in now
    EnergyFlow flow_{};
};

}  // namespace dibhr
