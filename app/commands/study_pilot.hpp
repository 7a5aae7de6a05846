// A study without a person: run head-less and fast, by the same steps into the same file.
#pragma once

#include <string>

#include "core/study/study_file.hpp"
#include "core/study/study_run.hpp"

namespace dibhr {

/// Runs what is left of the study. `pilot`: "hand", where every interval is explored by the
/// modelled hand of `dibhr experiment human` and recorded, and answered by guessing; or what
/// simulated_participant() takes, of which nothing is recorded. Throws InputError.
void run_pilot(StudyRun& run, StudyFile& file, const std::string& pilot);

}  // namespace dibhr
