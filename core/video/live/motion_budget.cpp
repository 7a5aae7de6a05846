// Rests as long as it takes.
#include "core/video/live/motion_budget.hpp"

#include <algorithm>

namespace dibhr {

namespace {

constexpr double kMostShare = 0.7;
constexpr double kOfNewest = 0.2;  ///< the weight of the newest of a moving mean
constexpr int kMostFrames = 1920;  ///< frames: a minute

}  // namespace

void MotionBudget::Rest::begin() noexcept {
    left = next;
    next = std::min(2 * next, kMostFrames);
}

bool MotionBudget::Rest::is_over() noexcept {
    if (left > 0) --left;
    return left == 0;
}

MotionWanted MotionBudget::affordable(const MotionWanted& wanted) noexcept {
    const bool motion = motion_.is_over();
    const bool in_betweens = in_betweens_.is_over() && motion;
    return {wanted.motion && motion, wanted.in_betweens && in_betweens};
}

void MotionBudget::took(const MotionWanted& done, double busy_s, double interval_s) noexcept {
    if (!done.any()) return;
    const double share = busy_s / interval_s;
    share_ += (share_ > 0.0 ? kOfNewest : 1.0) * (share - share_);
    if (share_ <= kMostShare) return;
    (done.in_betweens ? in_betweens_ : motion_).begin();
    share_ = 0.0;
}

}  // namespace dibhr
