// Statistics of a study's answers: shares, thresholds, adjustments and ratings of its participants,
// with intervals and tests.
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/psychophysics/proportions.hpp"
#include "core/psychophysics/psychometric.hpp"
#include "core/psychophysics/ranks.hpp"
#include "core/study/protocol.hpp"
#include "core/study_report/studies.hpp"

namespace dibhr {

inline constexpr double kNotKnown = std::numeric_limits<double>::quiet_NaN();

/// How often an answer was given, of the trials in which it was possible.
struct ShareFinding {
    std::string name{};  ///< "dibhr rather than pga", "right: friction 0.3 + 0.1", "yes: smooth"
    std::vector<Count> by_participant{};  ///< as Study::participants; no trials: had none
    Count all{};
    Interval interval{};                   ///< exact, of all trials together
    Estimate participants_mean{};          ///< mean of the participants' shares
    std::optional<double> chance{};        ///< share by guessing; nothing: not defined
    std::optional<TestResult> test{};      ///< against chance
    double adjusted_p{1.0};                ///< of the tests of one block (Holm)
    std::optional<Sensitivity> d_prime{};  ///< of all trials together
    std::optional<double> level{};         ///< a constant level; nothing: none, or a staircase
};

/// One participant's psychometric function.
struct ParticipantThreshold {
    std::size_t participant{0};  ///< in Study::participants
    LevelCounts counts{};
    PsychometricFit fit{};
    /// Mean level of the last reversals over the tracks; NaN: of no staircase.
    double reversal_mean{kNotKnown};

    /// Whether the answers bound the threshold on both sides.
    [[nodiscard]] bool bounded() const noexcept;
    /// The threshold. Infinite where it is not bounded and its most likely value lies below or
    /// above all tested levels: then only the side is known.
    [[nodiscard]] double threshold_or_infinite() const noexcept;
};

/// The threshold of one item of a block.
struct ThresholdFinding {
    std::string name{};  ///< "friction, plain"
    std::size_t item{0};
    std::string parameter{};
    double reference{0.0};  ///< levels are differences from it
    FitSettings
        settings{};  ///< the participants' guess rates, where not the same, are in their fits
    std::vector<ParticipantThreshold> fits{};
    LevelCounts all{};  ///< of all participants
    /// Mean of the participants' thresholds; NaN where one of them is not bounded. Bounded ones are
    /// no random selection, so a mean of them alone would be biased.
    Estimate participants_mean{};
    /// Of all fits; one outside the levels counts as below or above them: may be infinite.
    Estimate median{};
    int below{0}, above{0};            ///< of the fits, outside the levels
    int unbounded{0};                  ///< of the fits, inside the levels or outside
    double lowest{0.0}, highest{0.0};  ///< levels that were tested
};

/// Numbers that were given to one condition, or one pair: ratings, or how far from the reference an
/// adjustment ended.
struct ValueFinding {
    std::string name{};
    std::vector<double> by_participant{};  ///< each one's mean; NaN: gave none
    int trials{0};
    Estimate mean{};                   ///< over participants; of one participant over the trials
    Estimate median{};                 ///< likewise
    std::optional<TestResult> test{};  ///< of an adjustment: against the reference
};

/// The comparison of two conditions of a block.
struct PairTest {
    std::string first{}, second{};
    Estimate difference{};  ///< mean of first - second over the participants that have both
    TestResult test{};
    double adjusted_p{1.0};  ///< among the pairs of the block (Holm)
};

/// The findings of one block; practice has none.
struct BlockFindings {
    std::size_t block{0};  ///< in Protocol::blocks
    int trials{0};
    int unanswered{0};   ///< trials without an answer in time
    int not_counted{0};  ///< trials without a right answer: in no share or threshold
    std::vector<ShareFinding> shares{};
    std::vector<ThresholdFinding> thresholds{};
    std::vector<ValueFinding> values{};
    std::string compared{};               ///< the quantity compared in `pairs`; empty: the values
    std::optional<TestResult> overall{};  ///< of three conditions or more that have values
    std::vector<PairTest> pairs{};
    Estimate reaction_s{};               ///< median over participants of their medians
    std::vector<std::string> remarks{};  ///< what could not be computed, and why
};

struct AnalysisSettings {
    Curve curve{Curve::logistic};
    int bootstraps{399};                     ///< 0: thresholds without intervals
    std::function<void(double)> progress{};  ///< called with the share done; may be empty
};

/// The same files give the same numbers.
[[nodiscard]] std::vector<BlockFindings> findings_of(const Study& study,
                                                     const AnalysisSettings& settings);

/// Against chance: by signed ranks of the participants' shares, or by the binomial distribution of
/// all their trials, which is valid for these people only.
[[nodiscard]] TestResult chance_test(const std::vector<Count>& by_participant, double chance,
                                     bool by_ranks);

/// How many of them have trials.
[[nodiscard]] int with_trials(const std::vector<Count>& by_participant);

/// "a against b" or "a".
[[nodiscard]] std::string item_name(const Protocol& protocol, const Block& block, std::size_t item);

}  // namespace dibhr
