// Motion first, then what it makes of the time between.
#include "core/video/motion/frame_motion.hpp"

namespace dibhr {

void FrameMotion::connect(Frame& from, const Frame& to, const MotionWanted& wanted) {
    from.motion.reset();
    from.between.reset();
    if (!wanted.any() || !DepthBlend{&from, &to}.makes_surface()) return;
    from.motion = estimator_.between(from, to);
    if (wanted.in_betweens) from.between = maker_.between(from, to);
}

}  // namespace dibhr
