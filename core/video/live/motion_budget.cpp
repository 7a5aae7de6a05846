// How much of the time between frames is taken, as of late.
#include "core/video/live/motion_budget.hpp"

namespace dibhr {

namespace {

constexpr double kMostShare = 0.7;
constexpr double kOfNewest = 0.2;  ///< the weight of the newest of a moving mean

}  // namespace

void MotionBudget::took(const MotionWanted& done, double busy_s, double interval_s) noexcept {
    if (!done.any()) return;
    const double share = busy_s / interval_s;
    share_ += (share_ > 0.0 ? kOfNewest : 1.0) * (share - share_);
    if (share_ <= kMostShare) return;
    rests_.begin(done);
    share_ = 0.0;
}

}  // namespace dibhr
