// Whether there is time to find out how live frames move.
#pragma once

#include "core/video/motion/motion_wanted.hpp"

namespace dibhr {

/// Motion is found before a frame is shown, and so delays it by as long: only where that and
/// cleaning are done well before the next one comes. In-betweens are left out first, then all of
/// it, for longer each time that it was tried again in vain. Plain numbers: belongs to one thread.
class MotionBudget {
  public:
    /// What there is time for at the next frame.
    [[nodiscard]] MotionWanted affordable(const MotionWanted& wanted) noexcept;
    /// That much was done, of a frame that took `busy_s` in all, where they come `interval_s`
    /// apart.
    void took(const MotionWanted& done, double busy_s, double interval_s) noexcept;

    /// What of it is left out at present.
    [[nodiscard]] bool motion_rests() const noexcept { return motion_.left > 0; }
    [[nodiscard]] bool in_betweens_rest() const noexcept { return in_betweens_.left > 0; }

  private:
    static constexpr int kFirstRest = 60;  ///< frames
    struct Rest {
        int left{0};
        int next{kFirstRest};

        void begin() noexcept;
        [[nodiscard]] bool is_over() noexcept;  ///< to be asked once a frame
    };

    Rest motion_{}, in_betweens_{};
    double share_{0.0};  ///< of the time from frame to frame, as of late; 0: nothing is known
};

}  // namespace dibhr
