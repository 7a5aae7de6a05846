// What of the time between frames is left out for a while, on a machine that is too slow for it.
#pragma once

#include <algorithm>

#include "core/realtime/moving_mean.hpp"
#include "core/video/motion/motion_wanted.hpp"

namespace dibhr {

/// In-betweens are left out first, then all of it, for longer each time that it was tried again in
/// vain. Plain numbers: belongs to one thread.
class MotionThrottle {
  public:
    /// For so many frames at most.
    explicit MotionThrottle(int longest) : longest_(longest) {}

    /// What is to be done at the next frame; to be asked once a frame.
    [[nodiscard]] MotionWanted affordable(const MotionWanted& wanted) noexcept {
        const bool motion = is_over(motion_);
        const bool in_betweens = is_over(in_betweens_) && motion;
        return {wanted.motion && motion, wanted.in_betweens && in_betweens};
    }

    /// There was no time for what was done.
    void begin_rest(const MotionWanted& done) noexcept {
        if (!done.any()) return;
        Rest& rest = done.in_betweens ? in_betweens_ : motion_;
        rest.left = rest.next;
        rest.next = std::min(2 * rest.next, longest_);
    }

    /// That much was done, of a frame that took `busy_s` in all, where they come `interval_s`
    /// apart: a rest begins unless frames are done well before the next one comes.
    void took(const MotionWanted& done, double busy_s, double interval_s) noexcept {
        constexpr double kMostShare = 0.7;
        constexpr double kOfNewest = 0.2;  // the weight of the newest of a moving mean
        if (!done.any()) return;
        share_ = moving_mean_from_first(share_, busy_s / interval_s, kOfNewest);
        if (share_ <= kMostShare) return;
        begin_rest(done);
        share_ = 0.0;
    }

    /// As at the beginning.
    void forget() noexcept { *this = MotionThrottle(longest_); }

    /// What is left out at present.
    [[nodiscard]] bool motion_rests() const noexcept { return motion_.left > 0; }
    [[nodiscard]] bool in_betweens_rest() const noexcept { return in_betweens_.left > 0; }

  private:
    static constexpr int kFirst = 60;  ///< frames
    struct Rest {
        int left{0};
        int next{kFirst};
    };
    static bool is_over(Rest& rest) noexcept {
        if (rest.left > 0) --rest.left;
        return rest.left == 0;
    }

    int longest_;
    Rest motion_{}, in_betweens_{};
    double share_{0.0};  ///< of the time from frame to frame, as of late; 0: nothing is known
};

}  // namespace dibhr
