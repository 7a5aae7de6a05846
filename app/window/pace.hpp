// How often a picture is drawn, so that the haptic thread and the decoder keep their share of the
// processor.
#pragma once

#include <chrono>

namespace dibhr {

/// Waits between pictures, and counts them.
class PicturePace {
  public:
    /// `shortest`: least time from picture to picture; zero: do not wait.
    explicit PicturePace(std::chrono::nanoseconds shortest) : shortest_(shortest) {}

    /// After a picture was shown: waits until the next one may be drawn.
    void wait();

    [[nodiscard]] double pictures_per_s() const { return pictures_per_s_; }

  private:
    using Clock = std::chrono::steady_clock;

    std::chrono::nanoseconds shortest_;
    Clock::time_point next_{};
    Clock::time_point second_begin_{};
    int pictures_{0};
    double pictures_per_s_{0.0};
};

}  // namespace dibhr
