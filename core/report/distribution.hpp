// For how long a quantity had which value: mean, peak, quantiles and bars of a histogram.
#pragma once

#include <vector>

namespace dibhr {

/// Equal bars from 0 on.
struct Bars {
    double width{1.0};
    std::vector<double> seconds{};
    double beyond_s{0.0};  ///< time beyond the last bar
};

/// Values from 0 on, each for some seconds. Memory is bounded: values are sorted into narrow bins,
/// and what is beyond the last of them counts as in it.
class Distribution {
  public:
    /// `resolution`: width of a narrow bin, in the quantity's unit.
    explicit Distribution(double resolution) : resolution_(resolution) {}

    /// What is not finite or below 0 is left out.
    void add(double value, double seconds);

    [[nodiscard]] double total_s() const noexcept { return total_s_; }
    [[nodiscard]] double mean() const noexcept;  ///< over time; 0 for nothing
    [[nodiscard]] double peak() const noexcept { return peak_; }
    /// The value below which the quantity was for this share of the time, to half the resolution.
    [[nodiscard]] double quantile(double share) const;
    /// At most `most` bars of a round width that reach to `upto` at least.
    [[nodiscard]] Bars bars(double upto, int most) const;

  private:
    double resolution_;
    std::vector<double> bin_s_{};
    double total_s_{0.0};
    double sum_{0.0};
    double peak_{0.0};
};

}  // namespace dibhr
