// Measures participants in processes of their own, and reports on all.
#include "app/commands/study/study_report.hpp"

#include <algorithm>
#include <iostream>
#include <string>
#include <utility>

#include "app/commands/batch/kept_work.hpp"
#include "app/commands/output.hpp"
#include "core/error.hpp"
#include "core/files/plain_text.hpp"
#include "core/study/study_file.hpp"

namespace dibhr {

namespace {

namespace fs = std::filesystem;

/// Counts changes of the kept rows' fields: rows of an earlier dibhr are measured again.
constexpr const char* kKeptRows = "rows 2";

/// Calls `visit` with each field's name and the field, of a row or of a const one.
template <typename Row, typename Visit>
void visit_fields(Row& row, const Visit& visit) {
    visit("trial", row.trial);
    visit("interval", row.interval);
    visit("condition", row.condition);
    visit("practice", row.practice);
    visit("device", row.device);
    auto& motion = row.motion;
    visit("updates", motion.updates);
    visit("contact_updates", motion.contact_updates);
    visit("moves", motion.moves);
    visit("hand_updates", motion.hand.all);
    visit("mouse_updates", motion.hand.mouse_fallback);
    visit("duration_s", motion.duration_s);
    visit("contact_s", motion.contact_s);
    visit("sent_newton", motion.sent_newton);
    visit("sent_peak_newton", motion.sent_peak_newton);
    visit("spring_newton", motion.spring_newton);
    visit("spring_peak_newton", motion.spring_peak_newton);
    visit("path_mm", motion.path_mm);
    auto& turning = motion.turning;
    visit("turning_mean_deg", turning.mean_deg);
    visit("turning_sd_deg", turning.sd_deg);
    visit("turning_pairs", turning.pairs);
    visit("turning_mean_without_reversals_deg", turning.mean_without_reversals_deg);
    visit("turning_sd_without_reversals_deg", turning.sd_without_reversals_deg);
    visit("turning_pairs_without_reversals", turning.pairs_without_reversals);
}

Json json_of(const IntervalRow& row) {
    Json json;
    visit_fields(row, [&json](const char* name, const auto& field) { json[name] = field; });
    json["value"] = row.value ? Json(*row.value) : Json();
    return json;
}

IntervalRow row_of(const Json& json) {
    IntervalRow row;
    visit_fields(row, [&json](const char* name, auto& field) { json.at(name).get_to(field); });
    row.value = finite_number_in(json, "value");
    return row;
}

/// In a process of its own.
WorkResult measured(const GivenFile& file, const WorkProgress& progress) {
    const std::vector<IntervalRow> rows = motion_of(read_studies({file.file}), progress);
    return {
        .value = {{"intervals", json_list(rows, [](const auto& row) { return json_of(row); })}}};
}

bool has_sessions(const StudyRecord& record) {
    return std::ranges::any_of(record.session_bytes, [](auto bytes) { return bytes > 0; });
}

/// Files that can be read; a line for each of the others.
struct ReadFiles {
    std::vector<GivenFile> files{};
    std::vector<std::string> failures{};

    void check(const GivenFile& file) {
        try {
            static_cast<void>(read_studies({file.file}));
            files.push_back(file);
        } catch (const InputError& error) {
            failures.emplace_back(error.what());
        }
    }
};

/// The rows of all participants; a line for each whose motion cannot be measured.
std::vector<IntervalRow> measure_all(const Study& study, const fs::path& folder, ReadFiles& read) {
    std::vector<GivenFile> wanted;
    std::vector<std::size_t> participants;
    for (std::size_t k = 0; k < study.participants.size(); ++k) {
        if (!has_sessions(study.participants[k])) continue;
        const auto is_it = [&](const GivenFile& file) {
            return file.file == study.participants[k].file;
        };
        wanted.push_back(*std::ranges::find_if(read.files, is_it));
        participants.push_back(k);
    }
    if (wanted.empty()) return {};
    const std::vector<WorkResult> results = work_through({.command = "study",
                                                          .options = kKeptRows,
                                                          .title = "Measuring the study",
                                                          .folder = folder,
                                                          .work = measured},
                                                         wanted);
    std::vector<IntervalRow> rows;
    for (std::size_t k = 0; k < results.size(); ++k) {
        read.failures.insert(read.failures.end(), results[k].failures.begin(),
                             results[k].failures.end());
        for (const Json& one : results[k].value.value("intervals", Json::array())) {
            rows.push_back(row_of(one));
            rows.back().participant = participants[k];
        }
    }
    return rows;
}

}  // namespace

int report_studies(const std::vector<fs::path>& given, StudyReportRequest request) {
    ReadFiles read;
    for (const GivenFile& file : given_files(
             given,
             {.ending = kStudyEnding, .application_id = kStudyApplicationId, .called = "study"}))
        read.check(file);
    if (read.files.empty()) throw InputError(read.failures.front());
    std::vector<fs::path> files;
    for (const GivenFile& file : read.files) files.push_back(file.file);
    std::vector<std::string> warnings;
    {
        request.motion = [&](const Study& study) {
            return measure_all(study, request.folder, read);
        };
        ProgressBar bar("measuring the study");
        request.analysis.progress = [&bar](double share) { bar.show(share); };
        warnings = write_study_report(files, request);
    }
    for (const std::string& warning : warnings) print_warning(warning);
    for (const std::string& failure : read.failures) print_error_line(failure);
    std::cout << (request.folder / "report.html").string() << '\n';
    return read.failures.empty() ? 0 : 1;
}

}  // namespace dibhr
