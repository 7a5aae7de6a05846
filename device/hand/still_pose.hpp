// Detects a frozen position: it does not change although the device reports a velocity.
#pragma once

#include <chrono>
#include <optional>

#include "core/haptics/vec.hpp"

namespace dibhr {

/// A frozen position is an old one, even in a new message: it must give no force. For devices that
/// report a velocity; without it, a frozen position cannot be told from a hand at rest.
class StillPose {
  public:
    using Time = std::chrono::steady_clock::time_point;
    static constexpr double kMoves_m_per_s = 0.01;  ///< 20 steps of 0.01 mm in that time
    static constexpr std::chrono::milliseconds kLongest{20};

    /// True: the position received at `at` is frozen.
    [[nodiscard]] bool add(Vec3 position_m, double reported_m_per_s, Time at) noexcept {
        const bool still = position_m == last_m_ && reported_m_per_s >= kMoves_m_per_s;
        if (!still || !since_) since_ = at;
        last_m_ = position_m;
        return at - *since_ >= kLongest;
    }

  private:
    std::optional<Vec3> last_m_{};
    std::optional<Time> since_{};
};

}  // namespace dibhr
