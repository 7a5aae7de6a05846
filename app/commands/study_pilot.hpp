// A study without a person: run head-less and fast, by the same steps into the same file.
#pragma once

#include <string>

#include "core/study/simulated_participant.hpp"
#include "core/study/study_file.hpp"
#include "core/study/study_run.hpp"

namespace dibhr {

/// Throws InputError when the preferred condition is none of the protocol.
void require_preferred(const Protocol& protocol, const SimulatedParticipant& who);

struct Pilot {
    SimulatedParticipant answers{};
    /// Every interval is explored by the modelled hand of `dibhr experiment human` and recorded.
    bool has_hand{false};
};

/// What simulated_participant() takes; "hand", which then guesses; or "hand," and that. Throws
/// InputError.
[[nodiscard]] Pilot pilot_called(const std::string& text, const Protocol& protocol);

/// Runs what is left of the study. Throws InputError.
void run_pilot(StudyRun& run, StudyFile& file, const Pilot& pilot);

}  // namespace dibhr
