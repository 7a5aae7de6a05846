// Where one has touched in the last seconds.
#pragma once

#include <deque>
#include <vector>

#include "core/haptics/surface.hpp"
#include "core/haptics/vec.hpp"
#include "render/scene_view.hpp"

namespace dibhr {

/// Dots a little apart, kept by their place in the picture: they stay on a surface that moves.
class TouchTrace {
  public:
    static constexpr double kLasts_s = 4.0;
    static constexpr double kApart_px = 5.0;  ///< in the grid

    /// A proxy in contact at `now_s`, which never goes back.
    void add(const Vec3& proxy, double now_s);

    /// What is left at `now_s`, on the surface of then.
    [[nodiscard]] std::vector<TracePoint> points(const DepthSurface& surface, double now_s);

    void clear() noexcept { dots_.clear(); }

  private:
    struct Dot {
        double x, y, at_s;
    };
    std::deque<Dot> dots_{};
};

}  // namespace dibhr
