// How many participants and trials a stated effect needs, by simulating the study over and over.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/study/protocol.hpp"
#include "core/study/simulated_participant.hpp"

namespace dibhr {

struct PlanSettings {
    SimulatedParticipant effect{};  ///< what is to be found; `spread`: how people differ in it
    double power{0.8};              ///< share of studies that must find it
    int studies{400};               ///< simulated for each line; 2 at least
    int most_participants{48};
    std::uint64_t seed{1};
    std::function<void(double)> progress{};  ///< called with the share done; may be empty
};

/// The result of one number of participants.
struct PlannedStudies {
    int participants{0};
    /// Share of the studies whose test finds the effect (p < 0.05, Holm's correction included).
    double power{0.0};
    /// Of a threshold, which has no test: 95 % of the estimates lie at most so far from the truth,
    /// as a share of it. Infinite: more than 5 % of the studies do not bound it. NaN: there is a
    /// test.
    double precision{0.0};
    double unbounded{0.0};  ///< share of the studies that give the threshold no bound

    [[nodiscard]] bool of_threshold() const noexcept { return !std::isnan(precision); }
};

/// One finding of a block at so many repetitions.
struct PlanLine {
    std::string block{};
    std::string finding{};  ///< "dibhr rather than pga"
    int repetitions{1};     ///< of the block; of staircases: tracks
    int trials{0};          ///< of one participant in the block, on average
    bool as_in_protocol{false};
    std::vector<PlannedStudies> studies{};  ///< by rising number of participants
    /// The fewest participants with that power in a test that is valid for people in general; of a
    /// threshold with a precision of 10 %; 0: none.
    int needed_participants{0};
};

/// Half, all and twice the repetitions of each block that counts. The same arguments give the same
/// numbers. Throws InputError for an effect that changes nothing in this protocol.
[[nodiscard]] std::vector<PlanLine> plan_of(const Protocol& protocol, const PlanSettings& settings);

/// As a table of plain text, and what it means.
[[nodiscard]] std::string plan_text(const std::vector<PlanLine>& lines,
                                    const PlanSettings& settings);

}  // namespace dibhr
