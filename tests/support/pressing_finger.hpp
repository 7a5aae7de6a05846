// A finger that presses into a surface and follows it slowly, as a hand does.
#pragma once

namespace dibhr::test {

inline constexpr double kFingerTick_s = 0.001;
inline constexpr double kPressed_px = 12.0;           ///< below the surface that it follows
inline constexpr double kRestTimeConstant_s = 0.25;   ///< a hand that lies still
inline constexpr double kSlideTimeConstant_s = 0.01;  ///< one that slides and explores

/// kPressed_px below the surface under it, smoothed in time by a first-order low-pass.
class PressingFinger {
  public:
    PressingFinger(double surface_px, double time_constant_s)
        : smooth_px_(surface_px), share_(kFingerTick_s / time_constant_s) {}

    /// The finger's elevation a millisecond later, over the surface at `surface_px` [px].
    double follow(double surface_px) {
        smooth_px_ += share_ * (surface_px - smooth_px_);
        return smooth_px_ - kPressed_px;
    }

  private:
    double smooth_px_;
    double share_;
};

}  // namespace dibhr::test
