// Intervals of means and medians, and paired tests.
#include "core/psychophysics/ranks.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>

#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/students_t.hpp>

#include "core/psychophysics/random.hpp"

namespace dibhr {

namespace {

constexpr double kNoBound = std::numeric_limits<double>::infinity();
constexpr double kNotKnown = std::numeric_limits<double>::quiet_NaN();

struct Moments {
    double mean{0.0};
    double sd{0.0};  ///< of the population, n - 1; 0: all alike
};

Moments moments_of(std::span<const double> values) {
    const auto n = static_cast<double>(values.size());
    const double mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
    double squares = 0.0;
    double largest = 0.0;
    for (const double value : values) {
        squares += (value - mean) * (value - mean);
        largest = std::fmax(largest, std::fabs(value));
    }
    const double sd = values.size() > 1 ? std::sqrt(squares / (n - 1.0)) : 0.0;
    constexpr double kRounding = 1e-12;  // the mean of three tenths is no tenth to the last bit
    return {mean, sd > kRounding * largest ? sd : 0.0};
}

/// Twice each value's rank, so that shared ranks are whole, too.
std::vector<int> doubled_ranks(const std::vector<double>& values) {
    std::vector<int> ranks;
    for (const double value : values) {
        int below = 0;
        int equal = 0;
        for (const double other : values) {
            below += other < value ? 1 : 0;
            equal += other == value ? 1 : 0;
        }
        ranks.push_back(2 * below + equal + 1);
    }
    return ranks;
}

/// In steps of a billionth of the largest, and without those of 0: 7/12 - 1/2 and 1/2 - 5/12 are
/// as large as each other, whatever their last bits. Ranks that depended on these would follow the
/// sign.
std::vector<double> without_zeros(std::span<const double> differences) {
    constexpr double kSteps = 1e9;
    double largest = 0.0;
    for (const double each : differences) largest = std::fmax(largest, std::fabs(each));
    std::vector<double> kept;
    for (const double each : differences) {
        const double steps = largest > 0.0 ? std::round(each / largest * kSteps) : 0.0;
        if (steps != 0.0) kept.push_back(steps);
    }
    return kept;
}

/// Two-sided: of all 2^n ways to give signs to the ranks, those no nearer to the middle.
double exact_signed_rank_p(const std::vector<int>& ranks, int positive) {
    const int total = std::accumulate(ranks.begin(), ranks.end(), 0);
    std::vector<double> ways(static_cast<std::size_t>(total) + 1, 0.0);
    ways[0] = 1.0;
    for (const int rank : ranks) {
        for (int sum = total; sum >= rank; --sum) {
            ways[static_cast<std::size_t>(sum)] += ways[static_cast<std::size_t>(sum - rank)];
        }
    }
    double extreme = 0.0;
    for (int sum = 0; sum <= total; ++sum) {
        const bool as_far = std::abs(2 * sum - total) >= std::abs(2 * positive - total);
        extreme += as_far ? ways[static_cast<std::size_t>(sum)] : 0.0;
    }
    return std::ldexp(extreme, -static_cast<int>(ranks.size()));
}

double normal_signed_rank_p(const std::vector<int>& ranks, int positive) {
    double squares = 0.0;
    for (const int rank : ranks) squares += static_cast<double>(rank) * rank;
    const int total = std::accumulate(ranks.begin(), ranks.end(), 0);
    const double off = std::fmax(0.0, std::fabs(positive - total / 2.0) - 1.0);
    return std::fmin(1.0, 2.0 * normal_share(-off / std::sqrt(squares / 4.0)));
}

constexpr std::size_t kMostExact = 40;

/// Sums over the conditions of ranks, doubled; their squares are all that orders change.
double friedman_squares(const std::vector<std::vector<int>>& ranks) {
    double squares = 0.0;
    for (std::size_t k = 0; k < ranks.front().size(); ++k) {
        double sum = 0.0;
        for (const auto& row : ranks) sum += row[k];
        squares += sum * sum;
    }
    return squares;
}

double friedman_p(std::vector<std::vector<int>> ranks) {
    constexpr int kOrders = 9999;
    const double seen = friedman_squares(ranks);
    Random random(1937);
    int as_far = 1;
    for (int i = 0; i < kOrders; ++i) {
        for (auto& row : ranks) random.shuffle(std::span<int>(row));
        as_far += friedman_squares(ranks) >= seen ? 1 : 0;
    }
    return as_far / (kOrders + 1.0);
}

}  // namespace

Estimate mean_of(std::span<const double> values) {
    Estimate found{kNotKnown, {-kNoBound, kNoBound}, kConfidence, static_cast<int>(values.size())};
    if (values.empty()) return found;
    const Moments moments = moments_of(values);
    found.value = moments.mean;
    if (!(moments.sd > 0.0)) return found;
    const boost::math::students_t_distribution<> t(static_cast<double>(values.size()) - 1.0);
    const double half = boost::math::quantile(t, (1.0 + kConfidence) / 2.0) * moments.sd /
                        std::sqrt(static_cast<double>(values.size()));
    found.interval = {moments.mean - half, moments.mean + half};
    return found;
}

Estimate median_of(std::span<const double> values) {
    Estimate found{kNotKnown, {-kNoBound, kNoBound}, 1.0, static_cast<int>(values.size())};
    if (values.empty()) return found;
    std::vector<double> sorted(values.begin(), values.end());
    std::sort(sorted.begin(), sorted.end());
    const std::size_t n = sorted.size();
    found.value = (sorted[(n - 1) / 2] + sorted[n / 2]) / 2.0;
    const boost::math::binomial_distribution<> below(static_cast<double>(n), 0.5);
    // From the k-th lowest to the k-th highest, k as large as the confidence allows.
    for (std::size_t k = 0; k < n / 2; ++k) {
        const double tails = 2.0 * boost::math::cdf(below, static_cast<double>(k));
        if (1.0 - tails < kConfidence) break;
        found.interval = {sorted[k], sorted[n - 1 - k]};
        found.confidence = 1.0 - tails;
    }
    return found;
}

TestResult signed_rank_test(std::span<const double> differences) {
    const std::vector<double> kept = without_zeros(differences);
    TestResult result{"Wilcoxon signed-rank, exact", static_cast<int>(kept.size())};
    if (kept.empty()) return result;
    std::vector<double> sizes;
    sizes.reserve(kept.size());
    for (const double each : kept) sizes.push_back(std::fabs(each));
    const std::vector<int> ranks = doubled_ranks(sizes);
    int positive = 0;
    for (std::size_t i = 0; i < kept.size(); ++i) positive += kept[i] > 0.0 ? ranks[i] : 0;
    const int total = std::accumulate(ranks.begin(), ranks.end(), 0);
    result.statistic = positive / 2.0;
    result.effect = (2.0 * positive - total) / total;
    if (kept.size() > kMostExact) result.test = "Wilcoxon signed-rank, normal approximation";
    result.p = kept.size() > kMostExact ? normal_signed_rank_p(ranks, positive)
                                        : exact_signed_rank_p(ranks, positive);
    return result;
}

TestResult sign_test(std::span<const double> differences) {
    const std::vector<double> kept = without_zeros(differences);
    Count above{0, static_cast<int>(kept.size())};
    for (const double each : kept) above.hits += each > 0.0 ? 1 : 0;
    TestResult result{"sign test, exact", above.trials};
    if (kept.empty()) return result;
    result.statistic = above.hits;
    result.p = binomial_test(above, 0.5).exact_p;
    result.effect = 2.0 * above.share() - 1.0;
    return result;
}

TestResult one_sample_t_test(std::span<const double> differences) {
    TestResult result{"one-sample t", static_cast<int>(differences.size())};
    const Moments moments = moments_of(differences);
    assert(moments.sd > 0.0);
    const auto n = static_cast<double>(differences.size());
    result.effect = moments.mean / moments.sd;
    result.statistic = result.effect * std::sqrt(n);
    const boost::math::students_t_distribution<> t(n - 1.0);
    result.p = 2.0 * boost::math::cdf(t, -std::fabs(result.statistic));
    return result;
}

TestResult friedman_test(const std::vector<std::vector<double>>& rows) {
    TestResult result{"Friedman, 9,999 random orders", static_cast<int>(rows.size())};
    if (rows.empty() || rows.front().size() < 2) return result;
    std::vector<std::vector<int>> ranks;
    ranks.reserve(rows.size());
    for (const auto& row : rows) ranks.push_back(doubled_ranks(row));
    const auto n = static_cast<double>(rows.size());
    const auto k = static_cast<double>(rows.front().size());
    double squares_of_ranks = 0.0;  // of doubled ranks about their mean, k + 1
    for (const auto& row : ranks) {
        for (const int rank : row) squares_of_ranks += (rank - k - 1.0) * (rank - k - 1.0);
    }
    const double between = friedman_squares(ranks) - k * n * n * (k + 1.0) * (k + 1.0);
    if (squares_of_ranks > 0.0) {
        result.statistic = (k - 1.0) * between / squares_of_ranks;
        result.effect = result.statistic / (n * (k - 1.0));
        result.p = friedman_p(ranks);
    }
    return result;
}

std::vector<double> holm_adjusted(const std::vector<double>& p) {
    std::vector<std::size_t> order(p.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return p[a] < p[b]; });
    std::vector<double> adjusted(p.size());
    double highest = 0.0;
    for (std::size_t i = 0; i < order.size(); ++i) {
        highest = std::fmax(highest, p[order[i]] * static_cast<double>(p.size() - i));
        adjusted[order[i]] = std::fmin(1.0, highest);
    }
    return adjusted;
}

}  // namespace dibhr
