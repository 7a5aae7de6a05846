// Quantiles and histograms of measured values.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/files/json.hpp"

namespace dibhr {

/// A sample of values that are not negative. When it is full, every second value is dropped: the
/// values kept are spread evenly over the whole measurement, however long it lasts.
class Sample {
  public:
    void add(double value);
    /// The quantile `part`, 0 to 1; 0 when there are no values.
    [[nodiscard]] double quantile(double part) const;
    /// The largest of all added values; 0 when there are none.
    [[nodiscard]] double most() const noexcept { return most_; }
    /// Number of different values among the kept ones.
    [[nodiscard]] std::size_t different() const;
    /// Number of added values.
    [[nodiscard]] std::size_t count() const noexcept { return count_; }

  private:
    std::vector<double> values_{};
    double most_{0.0};
    std::size_t count_{0};
    std::size_t stride_{1};
};

/// Number of values per bin; bins in steps of 1, 2, 5 from 0.01 to 1000, and one for longer values.
class Histogram {
  public:
    void add(double value);
    /// [{"up_to_ms": 0.02, "count": 12}, ..]; the last may have no "up_to_ms". Empty bins are left
    /// out.
    [[nodiscard]] Json as_json() const;

  private:
    std::vector<std::size_t> counts_{};
};

/// "998 a second (half within 0.41 ms, 99 % within 0.93 ms)".
[[nodiscard]] std::string rate_in_words(double per_s, const Sample& took_ms);

}  // namespace dibhr
