// Reads participants' files, and trusts none of them.
#include "core/study_report/studies.hpp"

#include <algorithm>
#include <utility>

#include "core/error.hpp"
#include "core/files/plain_text.hpp"

namespace dibhr {

namespace {

/// A file that somebody made by hand is told, not read out of bounds. (Whether the order is the
/// protocol's does not matter here.)
void require_trials_of(const Protocol& protocol, const StudyRecord& record) {
    const auto fits = [&protocol](const AnsweredTrial& one) {
        const Trial& trial = one.trial;
        if (trial.block < 0 || trial.block >= static_cast<int>(protocol.blocks.size()))
            return false;
        const Block& block = protocol.blocks[static_cast<std::size_t>(trial.block)];
        const int intervals = block.intervals();
        const bool leveled = block.variation.staircase || !block.variation.levels.empty();
        const bool of_numbers = block.form == TrialForm::adjust || block.form == TrialForm::rating;
        const int choices = block.form == TrialForm::explore
                                ? static_cast<int>(block.question.answers.size())
                                : intervals;
        const bool answered = one.answer.choice >= 0 || one.answer.number;
        return trial.form == block.form && trial.practice == block.practice && trial.item >= 0 &&
               trial.item < static_cast<int>(block.items.size()) &&
               static_cast<int>(trial.intervals.size()) == intervals &&
               trial.level.has_value() == leveled && trial.target < intervals &&
               one.answer.choice < choices && (!answered || of_numbers == !!one.answer.number);
    };
    for (const AnsweredTrial& one : record.answered) {
        if (!fits(one))
            throw InputError(record.file.string() + ": trial " +
                             std::to_string(one.trial.number + 1) +
                             " is none of the protocol in it: the file is damaged, or was made by "
                             "another program");
    }
}

}  // namespace

bool Study::has_pilots() const noexcept {
    return std::any_of(participants.begin(), participants.end(),
                       [](const StudyRecord& one) { return !one.identity.pilot.empty(); });
}

Study read_studies(const std::vector<std::filesystem::path>& files) {
    Study study;
    for (const std::filesystem::path& file : files) {
        StudyRecord record = read_study(file);
        if (study.participants.empty())
            study.protocol = protocol_of(record.identity.protocol_text, file, {});
        const StudyIdentity& who = record.identity;
        require_trials_of(study.protocol, record);
        if (who.protocol_sha256 != study.protocol.sha256)
            throw InputError(file.string() + ": is of another protocol (" +
                             in_quotes(who.protocol_name) + ") than " + files.front().string() +
                             ": report on each protocol by itself");
        for (const StudyRecord& other : study.participants) {
            if (other.identity.participant == who.participant)
                throw InputError(file.string() + ": participant " + who.participant + " is in " +
                                 other.file.string() + ", too: give one of the two");
        }
        study.participants.push_back(std::move(record));
    }
    std::sort(study.participants.begin(), study.participants.end(),
              [](const StudyRecord& a, const StudyRecord& b) {
                  return std::pair(a.identity.number, a.identity.participant) <
                         std::pair(b.identity.number, b.identity.participant);
              });
    return study;
}

}  // namespace dibhr
