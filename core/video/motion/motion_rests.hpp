// What of the time between frames is left out for a while, on a machine that is too slow for it.
#pragma once

#include <algorithm>

#include "core/video/motion/motion_wanted.hpp"

namespace dibhr {

/// In-betweens are left out first, then all of it, for longer each time that it was tried again in
/// vain. Plain numbers: belongs to one thread.
class MotionRests {
  public:
    /// For so many frames at most.
    explicit MotionRests(int longest) : longest_(longest) {}

    /// What is to be done at the next frame; to be asked once a frame.
    [[nodiscard]] MotionWanted affordable(const MotionWanted& wanted) noexcept {
        const bool motion = is_over(motion_);
        const bool in_betweens = is_over(in_betweens_) && motion;
        return {wanted.motion && motion, wanted.in_betweens && in_betweens};
    }

    /// There was no time for what was done.
    void begin(const MotionWanted& done) noexcept {
        if (!done.any()) return;
        Rest& rest = done.in_betweens ? in_betweens_ : motion_;
        rest.left = rest.next;
        rest.next = std::min(2 * rest.next, longest_);
    }

    /// What is left out at present.
    [[nodiscard]] bool motion() const noexcept { return motion_.left > 0; }
    [[nodiscard]] bool in_betweens() const noexcept { return in_betweens_.left > 0; }

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
};

}  // namespace dibhr
