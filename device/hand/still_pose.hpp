// A position that stands still while the device reports that it moves.
#pragma once

#include <chrono>
#include <optional>

#include "core/haptics/vec.hpp"

namespace dibhr {

/// Such a position is an old one, however fresh its message: there is to be no force. For every
/// device that reports a velocity; without one a frozen position and a hand that rests look alike.
class StillPose {
  public:
    using Time = std::chrono::steady_clock::time_point;
    static constexpr double kMoves_m_per_s = 0.01;  ///< 20 steps of 0.01 mm in that time
    static constexpr std::chrono::milliseconds kLongest{20};

    /// True: the position that came at `at` is an old one.
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
