// Maximum likelihood by damped Fisher scoring, and profile intervals.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "core/psychophysics/curves.hpp"
#include "core/psychophysics/psychometric.hpp"

namespace dibhr {

namespace {

constexpr std::size_t kParameters = 3;

/// Chi squared's 95 % with one degree of freedom: what a deviance reaches by chance of many trials.
constexpr double kUsualCritical = 3.841459;
/// Lower bound of the critical value, measured: README.md, Intervals of thresholds.
constexpr double kLeastCritical = 3.5;

constexpr double kNoEnd = std::numeric_limits<double>::infinity();

enum Parameter : std::size_t { kThreshold, kLogScale, kLapse };

/// Threshold and scale on the curve's axis.
using Values = std::array<double, kParameters>;
using Matrix = std::array<Values, kParameters>;

struct Bounds {
    Values low{}, high{};
};

/// The input of a fit; parameters in `held` keep their start values.
struct Problem {
    const FitSettings& settings;
    LevelCounts counts{};  ///< x on the curve's axis
    Bounds bounds{};
    double shift{0.0};  ///< F^-1(level)
    std::optional<Parameter> held{};
};

struct Point {
    Values values{};
    double log_likelihood{-std::numeric_limits<double>::infinity()};
};

Problem problem_of(const LevelCounts& counts, const FitSettings& settings) {
    Problem problem{settings, counts, {}, standard_quantile(settings.curve, settings.level), {}};
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (LevelCount& level : problem.counts) {
        level.x = to_axis(settings.curve, level.x);
        low = std::fmin(low, level.x);
        high = std::fmax(high, level.x);
    }
    const double range = std::fmax(high - low, 1e-9);
    problem.bounds.low = {low - range, std::log(range / 100.0), 0.0};
    problem.bounds.high = {high + range, std::log(range * 5.0), settings.most_lapse};
    return problem;
}

/// A share that no answer makes impossible.
double possible(double share) noexcept {
    return std::clamp(share, 1e-9, 1.0 - 1e-9);
}

double log_likelihood(const Problem& problem, const Values& values) {
    const double per_scale = std::exp(-values[kLogScale]);
    const double span = 1.0 - problem.settings.guess - values[kLapse];
    double sum = 0.0;
    for (const LevelCount& level : problem.counts) {
        const double u = (level.x - values[kThreshold]) * per_scale + problem.shift;
        const double share = possible(problem.settings.guess +
                                      span * standard_curve(problem.settings.curve, u).share);
        const int misses = level.count.trials - level.count.hits;
        if (level.count.hits > 0) sum += level.count.hits * std::log(share);
        if (misses > 0) sum += misses * std::log1p(-share);
    }
    return sum;
}

Point point_at(const Problem& problem, const Values& values) {
    return {values, log_likelihood(problem, values)};
}

struct Score {
    Values gradient{};
    Matrix information{};
};

Score score_at(const Problem& problem, const Values& values) {
    const double per_scale = std::exp(-values[kLogScale]);
    const double span = 1.0 - problem.settings.guess - values[kLapse];
    Score score;
    for (const LevelCount& level : problem.counts) {
        const double off = (level.x - values[kThreshold]) * per_scale;
        const CurvePoint curve = standard_curve(problem.settings.curve, off + problem.shift);
        const double share = possible(problem.settings.guess + span * curve.share);
        const double weight = 1.0 / (share * (1.0 - share));
        const Values slope{-span * curve.density * per_scale, -span * curve.density * off,
                           -curve.share};
        const double residual = (level.count.hits - level.count.trials * share) * weight;
        for (std::size_t i = 0; i < kParameters; ++i) {
            score.gradient[i] += residual * slope[i];
            for (std::size_t j = 0; j < kParameters; ++j) {
                score.information[i][j] += level.count.trials * weight * slope[i] * slope[j];
            }
        }
    }
    return score;
}

/// Whether the parameter is held, or pushed against its bound.
bool is_fixed(const Problem& problem, const Values& values, const Score& score, std::size_t i) {
    return (problem.held && *problem.held == i) ||
           (values[i] <= problem.bounds.low[i] && score.gradient[i] < 0.0) ||
           (values[i] >= problem.bounds.high[i] && score.gradient[i] > 0.0);
}

/// Gauss's way without pivots: the matrix is positive, for it is damped.
Values solved(Matrix a, Values b) {
    for (std::size_t k = 0; k < kParameters; ++k) {
        for (std::size_t i = k + 1; i < kParameters; ++i) {
            const double factor = a[i][k] / a[k][k];
            for (std::size_t j = k; j < kParameters; ++j) a[i][j] -= factor * a[k][j];
            b[i] -= factor * b[k];
        }
    }
    for (std::size_t k = kParameters; k-- > 0;) {
        for (std::size_t j = k + 1; j < kParameters; ++j) b[k] -= a[k][j] * b[j];
        b[k] /= a[k][k];
    }
    return b;
}

Values damped_step(const Problem& problem, const Values& values, const Score& score,
                   double damping) {
    Matrix a = score.information;
    Values b = score.gradient;
    for (std::size_t i = 0; i < kParameters; ++i) {
        a[i][i] = a[i][i] * (1.0 + damping) + 1e-12;
        if (!is_fixed(problem, values, score, i)) continue;
        for (std::size_t j = 0; j < kParameters; ++j) a[i][j] = a[j][i] = i == j ? 1.0 : 0.0;
        b[i] = 0.0;
    }
    Values next = solved(a, b);
    for (std::size_t i = 0; i < kParameters; ++i) {
        next[i] = std::clamp(values[i] + next[i], problem.bounds.low[i], problem.bounds.high[i]);
    }
    return next;
}

Point climbed(const Problem& problem, Point best) {
    double damping = 1e-3;
    for (int i = 0; i < 60 && damping < 1e8; ++i) {
        const Score score = score_at(problem, best.values);
        const Point next = point_at(problem, damped_step(problem, best.values, score, damping));
        const double gain = next.log_likelihood - best.log_likelihood;
        if (gain > 0.0) {
            best = next;
            damping /= 10.0;
            if (gain < 1e-7) break;
        } else {
            if (gain > -1e-9) break;
            damping *= 10.0;
        }
    }
    return best;
}

/// The best of a coarse grid over what is not held.
Point best_of_grid(const Problem& problem, const Values& held_at) {
    constexpr int kSteps = 7;
    Point best;
    for (int t = 0; t < kSteps; ++t) {
        for (int s = 0; s < kSteps; ++s) {
            const auto at = [&problem](Parameter parameter, int step) {
                const double low = problem.bounds.low[parameter];
                return low + (problem.bounds.high[parameter] - low) * (step + 0.5) / kSteps;
            };
            Values values{at(kThreshold, t), at(kLogScale, s), problem.bounds.high[kLapse] / 4.0};
            if (problem.held) values[*problem.held] = held_at[*problem.held];
            const Point point = point_at(problem, values);
            if (point.log_likelihood > best.log_likelihood) best = point;
        }
    }
    return best;
}

Point best_point(const Problem& problem) {
    return climbed(problem, best_of_grid(problem, {}));
}

/// The best with one parameter held: from the grid, or from beside another best.
Point best_with(Problem problem, Parameter held, double value, const Point& near) {
    problem.held = held;
    Values values = near.values;
    values[held] = value;
    return climbed(problem, point_at(problem, values));
}

PsychometricFunction function_of(const Problem& problem, const Point& point) {
    const FitSettings& settings = problem.settings;
    return {settings.curve,
            from_axis(settings.curve, point.values[kThreshold]),
            std::exp(point.values[kLogScale]),
            settings.level,
            settings.guess,
            point.values[kLapse]};
}

Values values_of(const PsychometricFunction& function) {
    return {to_axis(function.curve, function.threshold), std::log(function.scale), function.lapse};
}

double likelihood_of_own_shares(const LevelCounts& counts) {
    double sum = 0.0;
    for (const LevelCount& level : counts) {
        const int misses = level.count.trials - level.count.hits;
        if (level.count.hits > 0) sum += level.count.hits * std::log(level.count.share());
        if (misses > 0) sum += misses * std::log1p(-level.count.share());
    }
    return sum;
}

double deviance_of(const LevelCounts& counts, const Point& best) {
    return std::fmax(0.0, 2.0 * (likelihood_of_own_shares(counts) - best.log_likelihood));
}

/// What studies simulated with the fitted function show.
struct Bootstrap {
    std::array<std::vector<double>, 2> refusals{};  ///< deviances of the true threshold and scale
    std::vector<double> deviances{};                ///< of the whole fit
};

Bootstrap bootstrapped(const PsychometricFunction& person, const FitSettings& settings,
                       const Simulate& simulate, std::uint64_t seed) {
    Bootstrap found;
    const Values truth = values_of(person);
    Random random(seed);
    for (int i = 0; i < settings.bootstraps; ++i) {
        const LevelCounts drawn = simulate(person, random);
        const Problem problem = problem_of(drawn, settings);
        const Point best = best_point(problem);
        for (const Parameter held : {kThreshold, kLogScale}) {
            const Point there = best_with(problem, held, truth[held], best);
            found.refusals[held].push_back(
                std::fmax(0.0, 2.0 * (best.log_likelihood - there.log_likelihood)));
        }
        found.deviances.push_back(deviance_of(drawn, best));
    }
    return found;
}

/// Nearest rank: with 399 values, 95 % is the 380th.
double quantile_of(std::vector<double> values, double share) {
    const auto rank =
        static_cast<std::size_t>(std::ceil(share * (static_cast<double>(values.size()) + 1.0)));
    const std::size_t k = std::clamp<std::size_t>(rank, 1, values.size()) - 1;
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(k), values.end());
    return values[k];
}

/// Where the deviance of `held` passes `critical`, going from the best towards `bound`.
double end_of(const Problem& problem, Parameter held, const Point& best, double bound,
              double critical) {
    constexpr int kSteps = 24;
    double inside = best.values[held];
    const double step = (bound - inside) / kSteps;
    Point at = best;
    const auto refused = [&](double value) {
        const Point there = best_with(problem, held, value, at);
        if (2.0 * (best.log_likelihood - there.log_likelihood) > critical) return true;
        at = there;
        return false;
    };
    double outside = inside;
    for (int i = 1; i <= kSteps; ++i) {
        outside = i == kSteps ? bound : best.values[held] + i * step;
        if (refused(outside)) break;
        inside = outside;
    }
    if (inside == outside) {
        return bound == problem.bounds.low[held] ? -kNoEnd : kNoEnd;
    }
    for (int i = 0; i < 12; ++i) {
        const double middle = (inside + outside) / 2.0;
        (refused(middle) ? outside : inside) = middle;
    }
    return (inside + outside) / 2.0;
}

Interval profile_of(const Problem& problem, Parameter held, const Point& best, double critical) {
    return {end_of(problem, held, best, problem.bounds.low[held], critical),
            end_of(problem, held, best, problem.bounds.high[held], critical)};
}

PsychometricFit fit_at(const Problem& problem, const Point& best, const LevelCounts& counts) {
    const auto add = [](int sum, const LevelCount& level) { return sum + level.count.trials; };
    return {.function = function_of(problem, best),
            .deviance = deviance_of(counts, best),
            .trials = std::accumulate(counts.begin(), counts.end(), 0, add)};
}

}  // namespace

PsychometricFunction most_likely(const LevelCounts& counts, const FitSettings& settings) {
    const Problem problem = problem_of(counts, settings);
    return function_of(problem, best_point(problem));
}

PsychometricFit fitted_roughly(const LevelCounts& counts, const FitSettings& settings) {
    const Problem problem = problem_of(counts, settings);
    const Point best = best_point(problem);
    PsychometricFit fit = fit_at(problem, best, counts);
    const auto end = [&](double bound) {
        const Point there = best_with(problem, kThreshold, bound, best);
        const bool refused = 2.0 * (best.log_likelihood - there.log_likelihood) > kUsualCritical;
        const bool low = bound == problem.bounds.low[kThreshold];
        return from_axis(settings.curve, refused ? bound : low ? -kNoEnd : kNoEnd);
    };
    fit.threshold = {end(problem.bounds.low[kThreshold]), end(problem.bounds.high[kThreshold])};
    return fit;
}

PsychometricFit fitted(const LevelCounts& counts, const FitSettings& settings,
                       const Simulate& simulate, std::uint64_t seed) {
    const Problem problem = problem_of(counts, settings);
    const Point best = best_point(problem);
    PsychometricFit fit = fit_at(problem, best, counts);
    const Bootstrap bootstrap = bootstrapped(fit.function, settings, simulate, seed);
    const auto interval = [&](Parameter held) {
        // With few trials the fitted function is often one that every simulated study finds again
        // (all right, or a step between two levels). Their critical value would then reject every
        // other value.
        const double critical =
            std::fmax(kLeastCritical, quantile_of(bootstrap.refusals[held], kConfidence));
        return profile_of(problem, held, best, critical);
    };
    const Interval threshold = interval(kThreshold);
    const Interval log_scale = interval(kLogScale);
    fit.threshold = {from_axis(settings.curve, threshold.low),
                     from_axis(settings.curve, threshold.high)};
    fit.scale = {std::exp(log_scale.low), std::exp(log_scale.high)};
    const auto worse = std::count_if(bootstrap.deviances.begin(), bootstrap.deviances.end(),
                                     [&](double deviance) { return deviance >= fit.deviance; });
    fit.fit_p = (1.0 + static_cast<double>(worse)) / (settings.bootstraps + 1.0);
    return fit;
}

}  // namespace dibhr
