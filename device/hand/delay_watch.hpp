// Mean delay of a device's answers: a late force drives the hand instead of holding it.
#pragma once

#include <chrono>
#include <optional>

namespace dibhr {

/// Updated after each exchange with the device.
class DelayWatch {
  public:
    using Time = std::chrono::steady_clock::time_point;

    /// One exchange: when the message was sent, and when its answer came.
    void add(Time sent, Time answered) noexcept;
    /// Mean over a quarter of a second [ms].
    [[nodiscard]] double mean_ms() const noexcept { return 1e3 * mean_s_; }
    /// The mean, rounded up to whole milliseconds, at least 1. Rises at once, falls only after the
    /// mean has been lower for a second.
    [[nodiscard]] int within_ms() const noexcept { return within_ms_; }

  private:
    double mean_s_{0.0};
    std::optional<Time> last_{};
    std::optional<Time> better_since_{};
    int within_ms_{1};
};

}  // namespace dibhr
