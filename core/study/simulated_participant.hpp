// Simulated participants, whose answers follow known rules: to try a protocol, and to test an
// analysis.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/psychophysics/psychometric.hpp"
#include "core/study/study_run.hpp"

namespace dibhr {

/// The rules of the answers. The guess rate is not among them: it follows from the form.
struct SimulatedParticipant {
    bool guesses{true};  ///< answers by chance alone
    /// A logistic function of the absolute level; `threshold`: half of what is not guessed.
    double threshold{0.1};
    double slope{10.0};       ///< of F at the threshold, per unit of the level
    double lapse{0.0};        ///< share of answers by chance, whatever is felt
    double false_alarm{0.0};  ///< share of yes at level 0, of yes/no
    /// Chosen where two conditions are compared, and rated best; empty: none.
    std::string prefers{};
    double share{1.0};  ///< of the comparisons in which that one is chosen, or found to be the odd
                        ///< one, in [1/3, 1]; lapses go on top
    /// How much higher it is rated than the others; nothing: a quarter of the scale.
    std::optional<double> difference{};
    double bias{0.0};   ///< of an adjustment: point of subjective equality minus reference
    double noise{0.0};  ///< standard deviation of adjustments and ratings, in their units
    /// How people differ: standard deviation of `share`, `bias` and `difference`, and of the
    /// threshold's natural logarithm. Each participant's number is another person.
    double spread{0.0};
    std::uint64_t seed{1};

    /// Share of hits at a level, guesses at `guess`.
    [[nodiscard]] PsychometricFunction function(double guess) const;
};

/// "threshold=0.1,slope=20,lapse=0.02,prefer=dibhr,share=0.8,spread=0.1,seed=1", any of them, each
/// once; or "guess", with a seed or without. Throws InputError that says what is allowed.
[[nodiscard]] SimulatedParticipant simulated_participant(const std::string& text);

/// The answer to the running trial, at its question or adjustment. The same protocol, number, trial
/// and participant give the same answer.
[[nodiscard]] StudyAnswer answer_of(const SimulatedParticipant& participant, const StudyRun& run);

/// A whole study's answers by that participant, as `number`.
[[nodiscard]] std::vector<AnsweredTrial> answers_of(const SimulatedParticipant& participant,
                                                    const Protocol& protocol, int number);

}  // namespace dibhr
