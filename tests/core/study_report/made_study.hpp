// Studies of simulated participants, without a file.
#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include "core/psychophysics/random.hpp"
#include "core/study/simulated_participant.hpp"
#include "core/study_report/study_findings.hpp"
#include "tests/core/study/pages.hpp"

namespace dibhr::test {

/// So many people of a kind; another `study` has other people and orders.
inline Study made_study(const std::string& page, const SimulatedParticipant& kind, int people,
                        std::uint64_t study) {
    Study made{.protocol = protocol(page)};
    // Studies of neighbouring seeds are not independent of each other.
    made.protocol.seed = draws_for(1, {study}).bits();
    for (int number = 1; number <= people; ++number) {
        StudyRecord record;
        record.identity.participant = "P" + std::to_string(number);
        record.identity.number = number;
        record.finished = true;
        record.answered = answers_of(kind, made.protocol, number);
        record.session_bytes.assign(record.answered.size(), 0);
        made.participants.push_back(std::move(record));
    }
    return made;
}

}  // namespace dibhr::test
