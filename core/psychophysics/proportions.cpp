// Exact intervals and tests of proportions, and d'.
#include "core/psychophysics/proportions.hpp"

#include <cmath>

#include <boost/math/distributions/beta.hpp>
#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/normal.hpp>

namespace dibhr {

namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

double beta_quantile(double a, double b, double share) {
    return boost::math::quantile(boost::math::beta_distribution<>(a, b), share);
}

double log_linear_share(Count count) noexcept {
    return (count.hits + 0.5) / (count.trials + 1.0);
}

double two_interval_d_prime(double share) {
    return std::sqrt(2.0) * normal_quantile(share);
}

/// The inverse of oddity_share, by halving.
double oddity_d_prime(double share) {
    if (share <= 1.0 / 3.0) return 0.0;
    if (share >= 1.0) return kInfinite;
    constexpr double kMost = 40.0;  // where oddity_share is 1 to the last bit
    double low = 0.0;
    double high = kMost;
    while (high - low > 1e-9) {
        const double middle = (low + high) / 2.0;
        (oddity_share(middle) < share ? low : high) = middle;
    }
    return (low + high) / 2.0;
}

template <typename Inverse>
Sensitivity sensitivity_of(Count right, Inverse inverse) {
    const Interval shares = exact_interval(right);
    return {inverse(log_linear_share(right)), {inverse(shares.low), inverse(shares.high)}};
}

/// Of z(share), to first order.
double variance_of_z(Count count) {
    const double share = log_linear_share(count);
    const double density = boost::math::pdf(boost::math::normal(), normal_quantile(share));
    return share * (1.0 - share) / (count.trials * density * density);
}

}  // namespace

double normal_quantile(double share) {
    if (share <= 0.0) return -kInfinite;
    if (share >= 1.0) return kInfinite;
    return boost::math::quantile(boost::math::normal(), share);
}

double normal_share(double z) noexcept {
    return 0.5 * std::erfc(-z / std::sqrt(2.0));
}

Interval exact_interval(Count count, double confidence) {
    if (count.trials <= 0) return {0.0, 1.0};
    const double tail = (1.0 - confidence) / 2.0;
    const double hits = count.hits;
    const double misses = count.trials - count.hits;
    return {count.hits == 0 ? 0.0 : beta_quantile(hits, misses + 1.0, tail),
            count.hits == count.trials ? 1.0 : beta_quantile(hits + 1.0, misses, 1.0 - tail)};
}

BinomialTest binomial_test(Count count, double chance) {
    if (count.trials <= 0) return {};
    const boost::math::binomial_distribution<> distribution(count.trials, chance);
    const double seen = boost::math::pdf(distribution, count.hits);
    const double rounding = 1e-9 * seen;  // counts on the other side, just as likely but for it
    double rarer = 0.0;
    double as_rare = 0.0;
    for (int hits = 0; hits <= count.trials; ++hits) {
        const double probability = boost::math::pdf(distribution, hits);
        if (probability < seen - rounding) {
            rarer += probability;
        } else if (probability <= seen + rounding) {
            as_rare += probability;
        }
    }
    return {std::fmin(1.0, rarer + as_rare), std::fmin(1.0, rarer + as_rare / 2.0)};
}

double oddity_share(double d_prime) {
    // Ennis (1993), by Simpson's rule: the integrand is even, smooth, and gone beyond 9.
    constexpr int kPieces = 240;
    constexpr double kEnd = 9.0;
    constexpr double kStep = kEnd / kPieces;
    const double root3 = std::sqrt(3.0);
    const double shift = d_prime * std::sqrt(2.0 / 3.0);
    const boost::math::normal normal;
    double sum = 0.0;
    for (int i = 0; i <= kPieces; ++i) {
        const double u = i * kStep;
        const double both = normal_share(-u * root3 + shift) + normal_share(-u * root3 - shift);
        const double weight = i == 0 || i == kPieces ? 1.0 : i % 2 == 1 ? 4.0 : 2.0;
        sum += weight * both * boost::math::pdf(normal, u);
    }
    return std::fmin(1.0, 2.0 * sum * kStep / 3.0);
}

Sensitivity two_interval_sensitivity(Count right) {
    return sensitivity_of(right, two_interval_d_prime);
}

Sensitivity oddity_sensitivity(Count right) {
    return sensitivity_of(right, oddity_d_prime);
}

YesNoSensitivity yes_no_sensitivity(Count hits, Count false_alarms) {
    const double z_hits = normal_quantile(log_linear_share(hits));
    const double z_alarms = normal_quantile(log_linear_share(false_alarms));
    YesNoSensitivity found;
    found.criterion = -(z_hits + z_alarms) / 2.0;
    const double d_prime = z_hits - z_alarms;
    const bool known = hits.trials > 0 && false_alarms.trials > 0;
    const double half = known ? normal_quantile((1.0 + kConfidence) / 2.0) *
                                    std::sqrt(variance_of_z(hits) + variance_of_z(false_alarms))
                              : kInfinite;
    found.sensitivity = {d_prime, {d_prime - half, d_prime + half}};
    return found;
}

}  // namespace dibhr
