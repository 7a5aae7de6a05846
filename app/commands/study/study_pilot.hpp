// A study with a simulated participant: no window, the same steps and the same file.
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

/// Parses what simulated_participant() takes; "hand", which then guesses; or "hand," and such text.
/// Throws InputError.
[[nodiscard]] Pilot parse_pilot(const std::string& text, const Protocol& protocol);

/// Runs the remaining trials. Throws InputError.
void run_pilot(StudyRun& run, StudyFile& file, const Pilot& pilot);

}  // namespace dibhr
