// The trace of touch: where the proxy was in contact in the last seconds.
#pragma once

#include <deque>
#include <vector>

#include "core/haptics/surface.hpp"
#include "core/haptics/vec.hpp"
#include "render/scene_view.hpp"

namespace dibhr {

/// Dots a little apart, stored by column and row, so that they stay on a surface that moves.
class TouchTrace {
  public:
    static constexpr double kLasts_s = 4.0;
    static constexpr double kApart_px = 5.0;  ///< in the grid

    /// Adds a proxy in contact. `now_s` must not decrease.
    void add(const Vec3& proxy, double now_s);

    /// The dots that remain at `now_s`, on `surface`.
    [[nodiscard]] std::vector<TracePoint> points(const DepthSurface& surface, double now_s);

    /// Adds the proxy of the markers where it is in contact, and gives them the dots.
    void mark(const DepthSurface& surface, double now_s, TouchMarkers& markers);

    void clear() noexcept { dots_.clear(); }

  private:
    struct Dot {
        double x, y, at_s;
    };
    std::deque<Dot> dots_{};
};

}  // namespace dibhr
