// Many measured values in few numbers.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/files/json.hpp"

namespace dibhr {

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

/// "998 a second (half within 0.41 ms, 99 % within 0.93 ms)".
[[nodiscard]] std::string rate_in_words(double per_s, const Sample& took_ms);

}  // namespace dibhr
