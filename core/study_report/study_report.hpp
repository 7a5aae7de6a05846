// A study as a report: one page that opens anywhere, its pictures, its numbers for scripts, and a
// table of its trials.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/plot/canvas.hpp"
#include "core/report/page_parts.hpp"
#include "core/study_report/study_findings.hpp"
#include "core/study_report/study_motion.hpp"

namespace dibhr {

/// The data of the page and the JSON.
struct StudyReport {
    Study study{};
    AnalysisSettings analysis{};
    std::vector<BlockFindings> blocks{};
    std::vector<IntervalRow> intervals{};  ///< empty: no session was recorded
    std::vector<MotionFinding> motion{};
    std::vector<ParticipantHand> hands{};  ///< in the order of the participants
    std::vector<Figure> figures{};
    std::string program{};  ///< that made the report, with its version

    /// No participant used the mouse, with which no force is felt.
    [[nodiscard]] bool forces_were_felt() const noexcept;
};

struct StudyReportRequest {
    std::filesystem::path folder{};
    std::string program{};
    AnalysisSettings analysis{};
    std::vector<PlotFormat> plot_formats{PlotFormat::png};
    /// Measures all intervals, in the order of participants and trials; empty: motion_of().
    std::function<std::vector<IntervalRow>(const Study&)> motion{};
};

/// Writes `report.html`, `report.json`, `trials.csv`, `intervals.csv` and the pictures into the
/// folder, all of them or none. Returns the warnings of the files that were not read whole, a line
/// each. Throws InputError: what, which file, what to do next.
std::vector<std::string> write_study_report(const std::vector<std::filesystem::path>& files,
                                            const StudyReportRequest& request);

/// A row is a trial, practice too: `participant,number,pilot,trial,block,position,practice,form,
/// reference,comparison,repetition,target,track,parameter,level,choice,chosen,answer,right,
/// reaction_s,utc_s,early`. Trials and positions count from 1, as intervals do in `target` and
/// `choice`; a missing value is empty. `chosen`: the condition that was chosen, or the answer's
/// name; `answer`: a rating, or the value an adjustment ended with; `early`: see StudyAnswer. Empty
/// without a trial.
[[nodiscard]] std::string trials_csv(const Study& study);

/// A row is an interval that was recorded: `participant,trial,interval,condition,practice,
/// duration_s,contact_s,updates,contact_updates,moves,sent_newton,sent_peak_newton,spring_newton,
/// spring_peak_newton,path_mm,speed_mm_per_s,turning_mean_deg,turning_sd_deg,turning_pairs,value`.
/// `value`: of the varied parameter, in an adjustment that of the start; empty: none varies.
[[nodiscard]] std::string intervals_csv(const Study& study, const std::vector<IntervalRow>& rows);

/// `{"report_version", "program", "protocol": {...}, "participants": [...], "blocks": [{"name",
///   "form", "trials", "unanswered", "reaction_s": ESTIMATE, "shares": [...], "thresholds": [...],
///   "values": [...], "overall": TEST, "pairs": [...], "remarks": [...]}], "motion": [...],
///   "conclusions": [...]}`
/// ESTIMATE is `{"value", "low", "high", "confidence", "count"}`, TEST `{"test", "count",
/// "statistic", "p", "effect"}` or null. A threshold's `participants_median` is null where it lies
/// beside the levels, of which `below_levels` and `above_levels` say more. What is not known, and
/// an end without bound, is null.
[[nodiscard]] std::string json_of(const StudyReport& report);

/// HTML5, pictures and style inside, no script.
[[nodiscard]] std::string page_of(const StudyReport& report);

}  // namespace dibhr
