// Connects a frame to the next one: its motion, and the in-betweens.
#pragma once

#include "core/video/frames/frame_window.hpp"
#include "core/video/motion/in_betweens.hpp"
#include "core/video/motion/motion_estimator.hpp"
#include "core/video/motion/motion_request.hpp"

namespace dibhr {

/// The same two frames give the same bits. One thread at a time.
class FrameMotion {
  public:
    /// Sets the motion of `from` and its in-betweens before `to`, the next frame. Null where they
    /// are not wanted, or where the two frames make no surface.
    void connect(Frame& from, const Frame& to, const MotionRequest& wanted) {
        from.motion.reset();
        from.in_betweens.reset();
        if (!wanted.any() || !DepthBlend{&from, &to}.makes_surface()) return;
        from.motion = estimator_.estimate(from, to);
        if (wanted.in_betweens) from.in_betweens = maker_.make(from, to);
    }

  private:
    MotionEstimator estimator_{};
    InBetweenMaker maker_{};
};

}  // namespace dibhr
