// Counts of answers: proportions with exact intervals and tests, and d' of the trial forms.
#pragma once

#include <limits>

namespace dibhr {

/// Closed. An infinite end: the data set no bound there.
struct Interval {
    double low{0.0};
    double high{0.0};

    [[nodiscard]] bool holds(double value) const noexcept { return low <= value && value <= high; }
};

inline constexpr double kConfidence = 0.95;
inline constexpr double kSignificance = 0.05;

/// The number of hits among trials.
struct Count {
    int hits{0};
    int trials{0};

    /// NaN for no trials.
    [[nodiscard]] double share() const noexcept {
        return trials > 0 ? static_cast<double>(hits) / trials
                          : std::numeric_limits<double>::quiet_NaN();
    }
};

/// The interval of the probability behind a count (Clopper & Pearson 1934): covers it at least as
/// often as `confidence`. [0, 1] for no trials.
[[nodiscard]] Interval exact_interval(Count count, double confidence = kConfidence);

/// Two-sided, against a known probability: of all counts no likelier than this one.
struct BinomialTest {
    double exact_p{1.0};  ///< finds an effect where there is none at most as often as its level
    /// With half of the counts just as likely: about as often as its level (Lancaster 1961).
    double mid_p{1.0};
};

/// `chance` in (0, 1). Both 1 for no trials.
[[nodiscard]] BinomialTest binomial_test(Count count, double chance);

/// The distance between two stimuli, in standard deviations of the sensation.
struct Sensitivity {
    double d_prime{0.0};
    Interval interval{};
};

/// "Which of two intervals had more of it?": d' = sqrt(2) z(share right). Its interval is the
/// exact one of the share, carried over; the value itself is of the log-linear share
/// (hits + 1/2) / (trials + 1), finite for all right as well.
[[nodiscard]] Sensitivity two_interval_sensitivity(Count right);

/// "Which of three intervals differed?", by comparing differences (Ennis 1993). At or below a
/// share of 1/3 d' is 0. Otherwise as above.
[[nodiscard]] Sensitivity oddity_sensitivity(Count right);

/// The share right in the oddity task at `d_prime` >= 0: 1/3 at 0.
[[nodiscard]] double oddity_share(double d_prime);

/// "Was it there?": d' = z(hits) - z(false alarms), both shares log-linear (Hautus 1995), with the
/// normal interval of Gourevitch & Galanter (1967).
struct YesNoSensitivity {
    Sensitivity sensitivity{};
    double criterion{0.0};  ///< above 0: a tendency to "no"
};

[[nodiscard]] YesNoSensitivity yes_no_sensitivity(Count hits, Count false_alarms);

/// The standard normal's quantile; infinite at 0 and 1.
[[nodiscard]] double normal_quantile(double share);
[[nodiscard]] double normal_share(double z) noexcept;

}  // namespace dibhr
