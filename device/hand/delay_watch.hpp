// How long a device takes to answer: a force that comes late drives the hand that it is to hold.
#pragma once

#include <chrono>
#include <optional>

namespace dibhr {

/// From one exchange with the device to the next.
class DelayWatch {
  public:
    using Time = std::chrono::steady_clock::time_point;

    /// An exchange from its message to its answer.
    void add(Time sent, Time answered) noexcept;
    /// A mean over a quarter of a second [ms].
    [[nodiscard]] double mean_ms() const noexcept { return 1e3 * mean_s_; }
    /// The whole milliseconds, 1 or more, that the mean is within: more at once, fewer after a
    /// second.
    [[nodiscard]] int within_ms() const noexcept { return within_ms_; }

  private:
    double mean_s_{0.0};
    std::optional<Time> last_{};
    std::optional<Time> better_since_{};
    int within_ms_{1};
};

}  // namespace dibhr
