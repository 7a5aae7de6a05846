// Staircases: the next level follows from the answers so far (Levitt 1971; Kaernbach 1991).
#pragma once

#include <cstdint>
#include <vector>

#include "core/psychophysics/psychometric.hpp"

namespace dibhr {

struct StaircaseRule {
    int down_after{2};      ///< right answers in a row: one step down, to less
    double start{1.0};      ///< the first level
    double low{0.0};        ///< no level is below
    double high{1.0};       ///< nor above
    double step_down{0.1};  ///< > 0
    double step_up{0.1};    ///< after a wrong answer; > 0
    bool factors{false};    ///< a step of 0.1 divides or multiplies the level by 1.1
    /// Until so many reversals, steps are `first_steps` times as long.
    int first_reversals{0};
    double first_steps{2.0};
    int stop_reversals{0};  ///< ends after so many reversals; 0: does not depend on them
    int most_trials{60};    ///< ends after so many trials at the latest
};

/// The share right at which steps down and up are in balance: 0.5^(1/n) for equal
/// steps, (up / (up + down))^(1/n) for weighted ones.
[[nodiscard]] double convergence_share(const StaircaseRule& rule);

/// One run of a rule.
class Staircase {
  public:
    explicit Staircase(const StaircaseRule& rule) : rule_(rule), level_(rule.start) {}

    /// The level of the next trial.
    [[nodiscard]] double level() const noexcept { return level_; }
    [[nodiscard]] bool finished() const noexcept;
    void answer(bool right);

    struct Trial {
        double level{0.0};
        bool right{false};
        bool reversal{false};  ///< the direction changed after this trial
    };
    [[nodiscard]] const std::vector<Trial>& trials() const noexcept { return trials_; }
    [[nodiscard]] int reversals() const noexcept { return reversals_; }

  private:
    void step(int direction, Trial& trial);

    StaircaseRule rule_;
    double level_;
    int right_in_a_row_{0};
    int direction_{0};  ///< of the last step: -1 down, 1 up, 0 none yet
    int reversals_{0};
    std::vector<Trial> trials_{};
};

/// Mean level of the last `count` reversals, an even number so that turns above and below weigh the
/// same; of all after the first one when there are fewer. NaN for less than two. A summary of the
/// track, at `convergence_share`: for inference fit a psychometric function to the answers.
[[nodiscard]] double reversal_mean(const std::vector<Staircase::Trial>& trials, int count);

[[nodiscard]] LevelCounts counts_of(const std::vector<Staircase::Trial>& trials);

/// `runs` independent runs of the rule a study.
[[nodiscard]] Simulate same_staircases(const StaircaseRule& rule, int runs = 1);

}  // namespace dibhr
