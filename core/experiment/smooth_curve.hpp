// A smooth curve through samples that never overshoots them.
#pragma once

#include <vector>

namespace dibhr {

/// Monotone piecewise cubic through (t, value): continuous in value and slope, between two samples
/// never outside their values (Fritsch and Butland 1984). Held at both ends.
class SmoothCurve {
  public:
    /// `times` rise strictly; as many values, at least one.
    SmoothCurve(std::vector<double> times, std::vector<double> values);

    [[nodiscard]] double at(double t) const noexcept;

  private:
    std::vector<double> times_;
    std::vector<double> values_;
    std::vector<double> slopes_{};
};

}  // namespace dibhr
