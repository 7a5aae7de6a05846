// Pauses in-betweens and motion for a while on a machine that is too slow for them.
#pragma once

#include <algorithm>

#include "core/realtime/moving_mean.hpp"
#include "core/video/motion/motion_request.hpp"

namespace dibhr {

/// Pauses in-betweens first, then motion as well; each further pause is twice as long. For one
/// thread.
class MotionThrottle {
  public:
    /// `longest`: upper limit of a pause [frames].
    explicit MotionThrottle(int longest) : longest_(longest) {}

    /// The part of `wanted` to compute at the next frame. Call once a frame: it counts pauses down.
    [[nodiscard]] MotionRequest affordable(const MotionRequest& wanted) noexcept {
        const bool motion = is_over(motion_);
        const bool in_betweens = is_over(in_betweens_) && motion;
        return {wanted.motion && motion, wanted.in_betweens && in_betweens};
    }

    /// Begins a pause: there was no time for `done`.
    void pause_motion(const MotionRequest& done) noexcept {
        if (!done.any()) return;
        Pause& pause = done.in_betweens ? in_betweens_ : motion_;
        pause.left = pause.next;
        pause.next = std::min(2 * pause.next, longest_);
    }

    /// Adds the cost of a frame with `done`: it took `busy_s`, and frames come `interval_s` apart.
    /// Begins a pause unless frames are finished well before the next one comes.
    void add_cost(const MotionRequest& done, double busy_s, double interval_s) noexcept {
        constexpr double kMostShare = 0.7;
        constexpr double kOfNewest = 0.2;  // weight of the newest value in the moving mean
        if (!done.any()) return;
        share_ = moving_mean_from_first(share_, busy_s / interval_s, kOfNewest);
        if (share_ <= kMostShare) return;
        pause_motion(done);
        share_ = 0.0;
    }

    /// Back to the state at the beginning.
    void forget() noexcept { *this = MotionThrottle(longest_); }

    /// What is paused at present.
    [[nodiscard]] bool motion_paused() const noexcept { return motion_.left > 0; }
    [[nodiscard]] bool in_betweens_paused() const noexcept { return in_betweens_.left > 0; }

  private:
    static constexpr int kFirst = 60;  ///< frames
    struct Pause {
        int left{0};
        int next{kFirst};
    };
    static bool is_over(Pause& pause) noexcept {
        if (pause.left > 0) --pause.left;
        return pause.left == 0;
    }

    int longest_;
    Pause motion_{}, in_betweens_{};
    double share_{0.0};  ///< moving mean of busy_s / interval_s; 0: not known
};

}  // namespace dibhr
