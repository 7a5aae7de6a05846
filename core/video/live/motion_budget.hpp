// Whether there is time to find out how live frames move.
#pragma once

#include "core/video/motion/motion_rests.hpp"

namespace dibhr {

/// Motion is found before a frame is shown, and so delays it by as long: only where that and
/// cleaning are done well before the next one comes. Plain numbers: belongs to one thread.
class MotionBudget {
  public:
    /// What there is time for at the next frame.
    [[nodiscard]] MotionWanted affordable(const MotionWanted& wanted) noexcept {
        return rests_.affordable(wanted);
    }
    /// That much was done, of a frame that took `busy_s` in all, where they come `interval_s`
    /// apart.
    void took(const MotionWanted& done, double busy_s, double interval_s) noexcept;

    /// What of it is left out at present.
    [[nodiscard]] const MotionRests& rests() const noexcept { return rests_; }

  private:
    static constexpr int kLongestRest = 1920;  ///< frames: a minute

    MotionRests rests_{kLongestRest};
    double share_{0.0};  ///< of the time from frame to frame, as of late; 0: nothing is known
};

}  // namespace dibhr
