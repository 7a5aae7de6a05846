// How fast the hand and the point on the surface move: way over a short time, not over one tick.
#pragma once

#include <cstddef>
#include <deque>
#include <optional>

#include "core/haptics/vec.hpp"
#include "core/session/tick_record.hpp"

namespace dibhr {

/// Between two readings 1 ms apart a device's steps are larger than the way: over this time they
/// are not.
inline constexpr double kSpeedWindow_s = 0.020;

struct Speeds {
    double goal_mm_per_s{0.0};
    double proxy_mm_per_s{0.0};
};

/// Distance between now and kSpeedWindow_s ago, over the time between.
class SpeedWindow {
  public:
    /// Nothing while the window is not filled, or when ticks are missing in it. `pitch_mm`: size
    /// of a pixel.
    [[nodiscard]] std::optional<Speeds> add(const TickRecord& tick, double pitch_mm);

  private:
    struct Place {
        double t_s{0.0};
        Vec3 goal_px{0.0};
        Vec3 proxy_px{0.0};
    };
    std::deque<Place> places_{};  ///< the oldest first; all within the window but the first
};

}  // namespace dibhr
