// How fast the goal moves, for the damper of the coupling.
#pragma once

#include "core/haptics/vec.hpp"

namespace dibhr {

/// The difference of two goals over time, through a first-order low-pass. A device's coarse steps
/// make the plain difference jump: a step of 0.06 mm in a millisecond is 60 mm/s.
class GoalVelocity {
  public:
    /// Velocity [px/s] after a move of `step` [px] in `dt_s`. The filter's time constant is
    /// 1 / (2 pi cutoff_hz), whatever the ticks' lengths; `cutoff_hz` not above 0: the plain
    /// difference, which is 0 when no time has passed. What would not be finite is forgotten.
    [[nodiscard]] Vec3 after(Vec3 step, double dt_s, double cutoff_hz) noexcept;

    /// The next step is no motion of the hand: the filter begins from rest, after that step.
    void forget() noexcept { continues_ = false; }

  private:
    Vec3 filtered_px_per_s_{0.0};
    bool continues_{false};  ///< the next step is a motion of the same hand
};

}  // namespace dibhr
