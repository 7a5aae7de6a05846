// Psychometric functions: the share of an answer over the strength of the stimulus.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "core/psychophysics/proportions.hpp"
#include "core/psychophysics/random.hpp"

namespace dibhr {

enum class Curve { logistic, cumulative_gaussian, weibull };

/// For people: "cumulative Gaussian".
[[nodiscard]] const char* name_of(Curve curve) noexcept;

/// share(x) = guess + (1 - guess - lapse) F(x), F rising from 0 to 1.
/// logistic: F = 1 / (1 + exp(-u)); cumulative Gaussian: F = Phi(u); both with
/// u = (x - threshold) / scale + F^-1(level). Weibull: F = 1 - exp(-exp(u)) over ln x, its shape
/// beta = 1 / scale; x > 0.
struct PsychometricFunction {
    Curve curve{Curve::logistic};
    double threshold{1.0};  ///< where F is `level`; in x's unit
    double scale{0.25};     ///< > 0; in x's unit, for Weibull of ln x
    double level{0.5};      ///< of F, without guesses and lapses: in (0, 1)
    double guess{0.0};      ///< share without a stimulus
    double lapse{0.0};      ///< share missed of the strongest stimulus

    [[nodiscard]] double share(double x) const;
    /// Slope of F at the threshold, per unit of x.
    [[nodiscard]] double slope() const;
};

/// F's level at which a task with this guess rate gives `share` right without lapses: 0.41 for the
/// 0.707 of a 1-up/2-down staircase of two intervals.
[[nodiscard]] constexpr double level_of(double share, double guess) noexcept {
    return (share - guess) / (1.0 - guess);
}

/// Answers at one level of x.
struct LevelCount {
    double x{0.0};
    Count count{};
};

using LevelCounts = std::vector<LevelCount>;

/// Adds an answer to the count of its level.
void add_answer(LevelCounts& counts, double x, bool hit);

/// The settings of a fit.
struct FitSettings {
    Curve curve{Curve::logistic};
    double level{0.5};
    double guess{0.0};
    double most_lapse{0.06};  ///< the lapse rate is fitted from 0 to here (Wichmann & Hill 2001);
                              ///< 0: none
    int bootstraps{399};
};

/// A psychometric function by maximum likelihood.
struct PsychometricFit {
    PsychometricFunction function{};
    Interval threshold{};  ///< 95 %
    Interval scale{};      ///< likewise
    double deviance{0.0};  ///< against a free share for every level
    /// How often data from this very function fit worse: below 0.05 the curve does not fit.
    double fit_p{1.0};
    int trials{0};
};

/// Simulates a study's answers again for a person with this function: at constant levels, or by a
/// staircase that runs anew each time.
using Simulate = std::function<LevelCounts(const PsychometricFunction&, Random&)>;

/// As many answers at the same levels.
[[nodiscard]] Simulate same_levels(LevelCounts counts);

/// The most likely function. The threshold is looked for from one range of the levels below them
/// to one above, the scale from a hundredth of the range to five times of it (for Weibull of ln x).
/// There must be two levels at least.
[[nodiscard]] PsychometricFunction most_likely(const LevelCounts& counts,
                                               const FitSettings& settings);

/// The fit without bootstraps, for many fits. The threshold's interval shows only whether it has
/// bounds: an end is that of the search, or infinite where chi squared does not reject the end.
[[nodiscard]] PsychometricFit fitted_roughly(const LevelCounts& counts,
                                             const FitSettings& settings);

/// With fewer trials the threshold's interval covers clearly less often than 95 % (README.md).
inline constexpr int kFewestTrialsOfThreshold = 60;

/// The fit with its intervals: profile likelihood, its critical value found by a parametric
/// bootstrap (the deviance of a known threshold among studies simulated with the fitted function),
/// but no lower than 3.5. An end is infinite where no value within the search is refused. The same
/// `seed` gives the same intervals; there must be a bootstrap.
[[nodiscard]] PsychometricFit fitted(const LevelCounts& counts, const FitSettings& settings,
                                     const Simulate& simulate, std::uint64_t seed);

}  // namespace dibhr
