// The answers of a study as a table: a row for every trial.
#pragma once

#include <map>
#include <string>

#include "core/archive/dictionary.hpp"
#include "core/study/study_file.hpp"

namespace dibhr {

struct TrialTable {
    std::string rows{};  ///< CSV
    Json dictionary = Json::object();
};

/// `study`: a study file in an archive. `protocol`: its page there. `runs`: the run of each trial
/// whose session was recorded. Throws InputError.
[[nodiscard]] TrialTable trial_table(const StudyRecord& study, const TableSource& source,
                                     const std::string& protocol,
                                     const std::map<int, std::string>& runs);

}  // namespace dibhr
