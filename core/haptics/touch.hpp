// One haptic update: goal -> proxy -> spring force -> safe force.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "core/haptics/parameters.hpp"
#include "core/haptics/proxy.hpp"
#include "core/haptics/safety.hpp"
#include "core/haptics/stability.hpp"
#include "core/haptics/vec.hpp"

namespace dibhr {

/// One tick's result: the columns of the output rows, in grid space and newtons.
struct Touch {
    Vec3 goal{0.0};
    Proxy proxy{};
    Vec3 spring_force_newton{0.0};  ///< before the safety stage
    Vec3 sent_force_newton{0.0};    ///< after it
    SafetyCut cut{SafetyCut::none};
    EnergyFlow energy{};  ///< all zero while no device is watched
    /// How far the touched surface carried the proxy in this update, before the walk [px]; zero
    /// where nothing carries it.
    Vec3 carried{0.0};
};

/// Spring to the proxy and damping of the goal's velocity [N]; zero out of contact.
/// `goal_velocity` in px/s.
[[nodiscard]] Vec3 coupling_force(const Proxy& proxy, Vec3 goal, Vec3 goal_velocity,
                                  const Coupling& coupling) noexcept;

/// The friction of an update: from the friction map, at the proxy before the update, or under the
/// goal where that proxy is in the air; `everywhere` without a map.
[[nodiscard]] Friction local_friction(const DepthSurface& surface, const Proxy& proxy, Vec3 goal,
                                      Friction everywhere) noexcept;

/// The spring and damper with the stiffness map's stiffness at the proxy, no stiffer than the
/// device can stand, and with the damping that it needs there; `everywhere` without a map.
[[nodiscard]] Coupling local_coupling(const DepthSurface& surface, const Proxy& proxy,
                                      Coupling everywhere, const SafetyLimits& limits) noexcept;

/// The difference of two goals over time, through an adaptive window and a first-order low-pass. A
/// device's coarse steps make the plain difference jump: a step of 0.06 mm in a millisecond is 60
/// mm/s.
class GoalVelocity {
  public:
    /// Velocity [px/s] after a move of `step` [px] in `dt_s`. The filter's time constant is
    /// 1 / (2 pi cutoff_hz), whatever the ticks' lengths; `cutoff_hz` not above 0: the plain
    /// difference, which is 0 when no time has passed. A result that is not finite resets the
    /// filter. `resolution` [px]: a step of the device, noise for the window; 0: no window.
    [[nodiscard]] Vec3 after(Vec3 step, double dt_s, double cutoff_hz,
                             double resolution = 0.0) noexcept;

    /// The next step is no motion of the hand: the filter begins from zero, after that step.
    void forget() noexcept {
        continues_ = false;
        window_.forget();
    }

  private:
    [[nodiscard]] Vec3 difference(Vec3 step, double dt_s, double resolution) noexcept;

    AdaptiveWindow window_{};
    Vec3 filtered_px_per_s_{0.0};
    bool continues_{false};  ///< the next step is a motion of the same hand
};

/// The algorithm, with a proxy before its first update.
[[nodiscard]] std::unique_ptr<ProxyAlgorithm> make_algorithm(Algorithm algorithm);

/// Runs a proxy algorithm, the coupling and the safety stage on a stream of goals. At any update
/// another algorithm can go on from the proxy's place.
class TouchRenderer {
  public:
    TouchRenderer();

    /// One update. A non-finite goal is refused: the last state stands and the force is zero. One
    /// beyond all reach counts as at its limit.
    /// `input.goal_step_mm` is computed here; another algorithm than before makes the force ramp.
    /// `motion`: carries the proxy where `parameters.carry` is on; its time is that of `input`.
    /// No allocation.
    const Touch& update(const DepthSurface& surface, Vec3 goal, const TouchParameters& parameters,
                        SafetyInput input, const SafetyLimits& limits,
                        const SurfaceMotion& motion = {}) noexcept;

    /// The motion that the last update used; its field may be gone.
    [[nodiscard]] const SurfaceMotion& motion() const noexcept { return motion_; }
    /// The material point under the proxy after the last update.
    [[nodiscard]] const MaterialPoint& material() const noexcept {
        return algorithms_[static_cast<std::size_t>(running_)]->material();
    }

    /// The next update is as the first one. No allocation.
    void reset() noexcept;

    /// The proxy leaves the surface: the next update begins above its goal, in free space.
    void release_contact() noexcept;

    /// Zero force is sent until the next update, whose force begins from zero.
    void pause() noexcept;

  private:
    /// The motion that carries the proxy in this update, which may not go on from the last one.
    [[nodiscard]] SurfaceMotion motion_of_update(SurfaceMotion motion,
                                                 const TouchParameters& parameters,
                                                 const SafetyInput& input) noexcept;
    /// What moved in a tick [px].
    struct Steps {
        Vec3 goal{0.0};
        double rise{0.0};     ///< of the surface under the proxy
        bool carries{false};  ///< the surface carries the proxy
        Vec3 slid{0.0};       ///< of a carried proxy: afterwards, by itself
    };

    /// The spring and damper's force, with what keeps it stable.
    [[nodiscard]] Vec3 rendered_force(const Steps& steps, const Coupling& coupling,
                                      const SafetyInput& input,
                                      const SafetyLimits& limits) noexcept;
    /// The surface rises faster than 0.2 m/s into a hand that did not touch it, as when the video
    /// was cut: the force begins by the ramp.
    [[nodiscard]] bool is_video_cut(const Proxy& before, double rise_mm, double dt_s) noexcept;
    /// Fades the share of the force that is rendered to its value at the goal.
    void fade_unseen(const DepthSurface& surface, double unseen_share, double dt_s) noexcept;
    /// Makes the algorithm the running one; true: another one ran before.
    bool select_algorithm(Algorithm algorithm) noexcept;

    std::vector<std::unique_ptr<ProxyAlgorithm>> algorithms_{};  ///< by their enumeration
    Algorithm running_{Algorithm::dibhr};
    GoalVelocity goal_velocity_{};
    GoalVelocity surface_velocity_{};  ///< of the carrying surface, through the same low-pass
    VideoMotion video_motion_{};
    VideoMotion carried_motion_{};  ///< the part of it that carries the proxy
    PassivityControl passivity_{};
    SafetyStage safety_{};
    Touch last_{};
    SurfaceMotion motion_{};
    double rendered_share_{1.0};  ///< of the force: less where no surface was ever seen
    double contact_s_{0.0};       ///< time in contact
    bool continues_last_{false};  ///< the next update goes on from the last one, and may carry
    bool started_{false};
};

}  // namespace dibhr
