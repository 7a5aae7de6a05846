// The modelled hand of `dibhr experiment human` in place of a participant: explores each interval
// of a trial on the built-in sample, and is recorded as the trial's session.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "app/commands/experiment_human.hpp"
#include "core/study/trial.hpp"

namespace dibhr {

class StudyHand {
  public:
    /// `updates`: of each interval, a millisecond each.
    explicit StudyHand(int updates = kExperimentUpdates) : updates_(updates) {}

    /// Explores all intervals and records them. Throws InputError, also for a media that is not the
    /// sample.
    void explore(const Trial& trial, const std::filesystem::path& session);

  private:
    /// The surface of an interval, and the hand's path on it.
    struct Ground {
        SampleClip sample;
        PathRun path{};
    };
    const Ground& ground_of(const StudyInterval& interval);

    int updates_;
    std::map<std::string, Ground> grounds_{};  ///< by cleaning and relief
};

}  // namespace dibhr
