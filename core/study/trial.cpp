// What an answer makes of a trial.
#include "core/study/trial.hpp"

#include <cstddef>

namespace dibhr {

std::optional<bool> is_right(const Trial& trial, const StudyAnswer& answer) {
    switch (trial.form) {
        case TrialForm::explore:
            if (!trial.level) return std::nullopt;
            if (answer.choice < 0) return false;
            return (answer.choice == 0) == (*trial.level > 0.0);
        case TrialForm::two_interval:
            if (!trial.level || *trial.level == 0.0) return std::nullopt;
            if (answer.choice < 0) return false;
            return (answer.choice == trial.target) == (*trial.level > 0.0);
        case TrialForm::three_interval:
            if (trial.level && *trial.level == 0.0) return std::nullopt;
            return answer.choice == trial.target;
        case TrialForm::adjust:
        case TrialForm::rating:
            break;
    }
    return std::nullopt;
}

std::string chosen_condition(const AnsweredTrial& answered) {
    const auto choice = static_cast<std::size_t>(answered.answer.choice);
    const auto& intervals = answered.trial.intervals;
    const bool of_intervals = answered.trial.form == TrialForm::two_interval ||
                              answered.trial.form == TrialForm::three_interval;
    if (!of_intervals || answered.answer.choice < 0 || choice >= intervals.size()) return {};
    return intervals[choice].condition;
}

}  // namespace dibhr
