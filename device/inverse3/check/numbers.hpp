// Many measured values in few numbers.
#pragma once

#include <cstddef>
#include <vector>

#include "core/files/json.hpp"
#include "core/haptics/vec.hpp"

namespace dibhr::inverse3 {

inline constexpr double kMetre_mm = 1000.0;

/// {"x": .., "y": .., "z": ..}: along the axes of the service's frame.
[[nodiscard]] Json along_axes(Vec3 values);

/// Values that are not negative, of which every second is left out whenever they become too many:
/// however long it lasts, those that stay are spread over all of it.
class Sample {
  public:
    void add(double value);
    /// With this part of the values below it, 0 to 1; 0 when there are none.
    [[nodiscard]] double quantile(double part) const;
    /// The largest of all; 0 when there are none.
    [[nodiscard]] double most() const noexcept { return most_; }
    /// How many different ones, of those that are kept.
    [[nodiscard]] std::size_t different() const;
    /// How many were added.
    [[nodiscard]] std::size_t count() const noexcept { return count_; }

  private:
    std::vector<double> values_{};
    double most_{0.0};
    std::size_t count_{0};
    std::size_t stride_{1};
};

/// How many values came in each range, in steps of 1, 2, 5: 0.01 to 1000, and what is longer.
class Histogram {
  public:
    void add(double value);
    /// [{"up_to_ms": 0.02, "count": 12}, ..]; the last may have no "up_to_ms". Empty ranges are
    /// left out.
    [[nodiscard]] Json as_json() const;

  private:
    std::vector<std::size_t> counts_{};
};

}  // namespace dibhr::inverse3
