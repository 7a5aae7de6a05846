// How promptly the service answers: a force that comes late drives the hand that it is to hold.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

namespace dibhr::inverse3 {

enum class Pace : std::uint8_t {
    prompt,   ///< as the assumed dynamics have it
    slow,     ///< a softer spring is still stable
    too_slow  ///< no force is
};

/// From one exchange to the next.
class PaceWatch {
  public:
    using Time = std::chrono::steady_clock::time_point;

    /// An exchange from its message to its answer.
    void add(Time sent, Time answered) noexcept;
    [[nodiscard]] Pace pace() const noexcept { return pace_; }
    /// How long they take lately, a mean over a quarter of a second [ms].
    [[nodiscard]] double exchange_ms() const noexcept { return 1e3 * mean_s_; }

  private:
    double mean_s_{0.0};
    std::optional<Time> last_{};
    std::optional<Time> better_since_{};
    Pace pace_{Pace::prompt};
};

}  // namespace dibhr::inverse3
