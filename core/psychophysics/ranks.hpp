// Inference from participants to all people: intervals and paired tests, one value a participant
// and condition.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/psychophysics/proportions.hpp"

namespace dibhr {

/// A value with its 95 % interval; NaN for no values.
struct Estimate {
    double value{0.0};
    Interval interval{};
    double confidence{kConfidence};  ///< of the interval: higher for order statistics
    int count{0};
};

/// By Student's t; no bound for a single value, or for equal values: they do not show how others
/// vary.
[[nodiscard]] Estimate mean_of(std::span<const double> values);

/// The interval lies between two of the values, so that it covers at least as often as its
/// confidence; no bound for fewer than 6 values.
[[nodiscard]] Estimate median_of(std::span<const double> values);

/// A test's outcome.
struct TestResult {
    std::string test{};  ///< its name, with how it was computed
    int count{0};        ///< of participants in the test
    double statistic{0.0};
    double p{1.0};
    double effect{0.0};  ///< rank-biserial correlation in [-1, 1]; Cohen's d_z for t; Kendall's W
                         ///< for Friedman
};

/// Of paired differences against 0, by signs and ranks (Wilcoxon 1945). Differences of 0 are left
/// out; equal ones share their mean rank; the distribution is exact for just these ranks up to 40
/// differences, normal with its continuity correction beyond. Exact tests may find an effect where
/// there is none less often than in 5 %.
[[nodiscard]] TestResult signed_rank_test(std::span<const double> differences);

/// By signs alone, exact.
[[nodiscard]] TestResult sign_test(std::span<const double> differences);

/// By their mean: for values that are means themselves. There must be two that differ.
[[nodiscard]] TestResult one_sample_t_test(std::span<const double> differences);

/// One row a participant, one value a condition, three conditions or more (Friedman 1937, with
/// ties). Its p is of 9,999 random orders within the rows, always the same ones.
[[nodiscard]] TestResult friedman_test(const std::vector<std::vector<double>>& rows);

/// For tests made together: corrected so that in at most 5 % of such families a p is below 0.05 by
/// chance (Holm 1979). In the order given.
[[nodiscard]] std::vector<double> holm_adjusted(const std::vector<double>& p);

/// Fewer participants cannot reach p < 0.05 in a two-sided signed-rank test.
inline constexpr int kFewestForRanks = 6;

}  // namespace dibhr
