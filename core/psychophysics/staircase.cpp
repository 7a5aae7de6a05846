// The levels of a staircase.
#include "core/psychophysics/staircase.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace dibhr {

double convergence_share(const StaircaseRule& rule) {
    return std::pow(rule.step_up / (rule.step_up + rule.step_down), 1.0 / rule.down_after);
}

bool Staircase::finished() const noexcept {
    return static_cast<int>(trials_.size()) >= rule_.most_trials ||
           (rule_.stop_reversals > 0 && reversals_ >= rule_.stop_reversals);
}

void Staircase::answer(bool right) {
    Trial trial{level_, right, false};
    if (!right) {
        right_in_a_row_ = 0;
        step(1, trial);
    } else if (++right_in_a_row_ >= rule_.down_after) {
        right_in_a_row_ = 0;
        step(-1, trial);
    }
    trials_.push_back(trial);
}

void Staircase::step(int direction, Trial& trial) {
    trial.reversal = direction_ == -direction;
    reversals_ += trial.reversal ? 1 : 0;
    direction_ = direction;
    const double length = (direction > 0 ? rule_.step_up : rule_.step_down) *
                          (reversals_ < rule_.first_reversals ? rule_.first_steps : 1.0);
    const double next =
        rule_.factors ? level_ * std::pow(1.0 + length, direction) : level_ + direction * length;
    level_ = std::clamp(next, rule_.low, rule_.high);
}

double reversal_mean(const std::vector<Staircase::Trial>& trials, int count) {
    std::vector<double> levels;
    for (const Staircase::Trial& trial : trials) {
        if (trial.reversal) levels.push_back(trial.level);
    }
    const std::size_t known = levels.empty() ? 0 : levels.size() - 1;
    const std::size_t used = std::min(static_cast<std::size_t>(count), known) / 2 * 2;
    if (used == 0) return std::numeric_limits<double>::quiet_NaN();
    double sum = 0.0;
    for (std::size_t k = levels.size() - used; k < levels.size(); ++k) sum += levels[k];
    return sum / static_cast<double>(used);
}

LevelCounts counts_of(const std::vector<Staircase::Trial>& trials) {
    LevelCounts counts;
    for (const Staircase::Trial& trial : trials) add_answer(counts, trial.level, trial.right);
    return counts;
}

Simulate same_staircases(const StaircaseRule& rule, int runs) {
    return [rule, runs](const PsychometricFunction& person, Random& random) {
        LevelCounts counts;
        for (int run = 0; run < runs; ++run) {
            Staircase staircase(rule);
            while (!staircase.finished()) {
                const double level = staircase.level();
                const bool right = random.chance(person.share(level));
                staircase.answer(right);
                add_answer(counts, level, right);
            }
        }
        return counts;
    };
}

}  // namespace dibhr
