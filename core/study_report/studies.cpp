// Reads and validates participants' files.
#include "core/study_report/studies.hpp"

#include <algorithm>
#include <cstddef>
#include <fstream>
#include <map>
#include <string>
#include <utility>

#include "core/error.hpp"
#include "core/files/plain_text.hpp"
#include "core/sqlite/database.hpp"

namespace dibhr {

namespace {

/// Refuses trials that do not fit the protocol, which would be read out of bounds. (Their order is
/// not checked.)
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

/// Distinguishes another kind of file from a damaged study.
void require_study_file(const std::filesystem::path& file) {
    const bool holds_something = std::ifstream(file).get() != std::ifstream::traits_type::eof();
    if (holds_something && !is_database(file))  // else read_study says what is wrong
        throw InputError(file.string() +
                         ": is not a study file: name one that dibhr study run made "
                         "(*.dibhr-study), or a folder of them");
}

/// The error names the files of each protocol, a few of many.
void require_one_protocol(const std::vector<StudyRecord>& records) {
    constexpr std::size_t kMostNamed = 4;
    struct Group {
        std::string protocol{};
        std::vector<std::string> files{};
        std::size_t others{0};
    };
    std::map<std::string, Group> groups;
    for (const StudyRecord& record : records) {
        Group& group = groups[record.identity.protocol_sha256];
        group.protocol = record.identity.protocol_name;
        if (group.files.size() < kMostNamed)
            group.files.push_back(record.file.string());
        else
            ++group.others;
    }
    if (groups.size() == 1) return;
    std::string text =
        "some of these files are of another protocol than others, or of a page that was changed: "
        "report on each protocol by itself";
    for (const auto& [sha256, group] : groups)
        text += "; of " + in_quotes(group.protocol) + " (SHA-256 " + sha256.substr(0, 8) +
                "..): " + listed(group.files) +
                (group.others > 0 ? " and " + std::to_string(group.others) + " more" : "");
    throw InputError(text);
}

void require_distinct_labels(const std::vector<StudyRecord>& records) {
    std::map<std::string, std::string> files;
    for (const StudyRecord& record : records) {
        const auto [known, is_new] =
            files.emplace(record.identity.participant, record.file.string());
        if (!is_new)
            throw InputError(record.file.string() + ": participant " + record.identity.participant +
                             " is in " + known->second + ", too: give one of the two");
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
        require_study_file(file);
        study.participants.push_back(read_study(file));
    }
    if (study.participants.empty()) return study;
    require_one_protocol(study.participants);
    require_distinct_labels(study.participants);
    const StudyRecord& first = study.participants.front();
    study.protocol = protocol_of(first.identity.protocol_text, first.file, {});
    for (const StudyRecord& record : study.participants) require_trials_of(study.protocol, record);
    std::ranges::sort(study.participants, {}, [](const StudyRecord& one) {
        return std::pair(one.identity.number, one.identity.participant);
    });
    return study;
}

}  // namespace dibhr
