// A depth video in memory, as a surface at any time: blended between its frames as the viewer does.
#pragma once

#include <cstdint>
#include <vector>

#include "core/haptics/depth_image.hpp"
#include "core/haptics/surface.hpp"

namespace dibhr {

/// One or more frames of one size, the first at 0 s; repeats. The surfaces it gives are views into
/// it.
class DepthClip {
  public:
    struct TimedDepth {
        DepthImage image{};
        double time_s{0.0};
    };

    /// Throws InputError for no frame, one below 2 x 2, or frames that differ in size or are not
    /// in order of time.
    DepthClip(std::vector<TimedDepth> frames, SurfaceShape shape);

    /// The surface `t_s` >= 0 after the first frame. After the last frame comes the first again,
    /// as long after it as the last is after the one before.
    [[nodiscard]] DepthSurface at(double t_s) const noexcept;

    /// The time of frame number `frame` (from 0, held at the last), `blend` in [0, 1] of the way to
    /// the next [s].
    [[nodiscard]] double time_of(std::int64_t frame, double blend) const noexcept;

    [[nodiscard]] int columns() const noexcept { return frames_.front().image.columns; }
    [[nodiscard]] int rows() const noexcept { return frames_.front().image.rows; }
    /// Of one round [s]; 0 for a still.
    [[nodiscard]] double duration_s() const noexcept { return duration_s_; }

  private:
    std::vector<TimedDepth> frames_;
    SurfaceShape shape_;
    double duration_s_{0.0};
};

}  // namespace dibhr
