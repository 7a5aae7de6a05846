// One trial: which conditions its intervals have, and what was answered. Plain data, of which the
// study file keeps a row each.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/study/protocol.hpp"

namespace dibhr {

/// What is felt in one interval.
struct StudyInterval {
    std::string condition{};  ///< its name
    TouchValues values{};     ///< all of them: base, condition and varied parameter
    /// The varied parameter's own value; nothing: none varies. In an adjustment that of the start.
    std::optional<double> value{};

    bool operator==(const StudyInterval&) const = default;
};

struct Trial {
    int number{0};    ///< in the participant's study, from 0
    int block{0};     ///< in Protocol::blocks
    int position{0};  ///< in its block, from 0
    bool practice{false};
    TrialForm form{TrialForm::explore};
    int item{0};  ///< in Block::items
    int repetition{0};
    std::vector<StudyInterval> intervals{};
    /// The interval that has the comparison, or is the odd one; -1: there is none to find.
    int target{-1};
    int track{-1};  ///< of interleaved staircases; -1: none
    /// Comparison minus reference in the varied parameter; nothing: none varies.
    std::optional<double> level{};

    bool operator==(const Trial&) const = default;
};

/// What a person answered.
struct StudyAnswer {
    /// The interval (forced choice) or the answer (`explore`), from 0; -1: none, the time was over
    /// or it is a number.
    int choice{-1};
    /// A rating, or the value to which the parameter was turned.
    std::optional<double> number{};
    /// From when the question was on the screen, or an adjustment was first felt, until the key or
    /// button went down.
    double reaction_s{0.0};
    /// The number of answers that were pressed before that, and ignored; nothing: they were not
    /// counted.
    std::optional<int> early{};

    bool operator==(const StudyAnswer&) const = default;
};

/// A trial that is over.
struct AnsweredTrial {
    Trial trial{};
    StudyAnswer answer{};
    /// Nothing where nothing is right or wrong: preferences, ratings, adjustments, equal intervals.
    std::optional<bool> right{};
    double utc_s{0.0};  ///< wall time of the answer since 1970

    bool operator==(const AnsweredTrial&) const = default;
};

/// Whether that answer is right. Forced choice: the target was chosen (of a level below 0: the
/// other interval). `explore` with a varied parameter: the first answer ("yes"). No answer in time
/// is wrong where another one is right.
[[nodiscard]] std::optional<bool> is_right(const Trial& trial, const StudyAnswer& answer);

/// The condition's name of the chosen interval; empty: none was chosen, or it is a number.
[[nodiscard]] std::string chosen_condition(const AnsweredTrial& answered);

}  // namespace dibhr
