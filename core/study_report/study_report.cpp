// Measures a study, draws it, and writes the report.
#include "core/study_report/study_report.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "core/error.hpp"
#include "core/files/output_file.hpp"
#include "core/files/plain_text.hpp"
#include "core/report/report_sentences.hpp"
#include "core/study_report/study_plots.hpp"

namespace dibhr {

namespace {

constexpr std::size_t kMostBlocks = 50;  // whose pictures of an earlier report are removed
constexpr std::size_t kMostItems = 12;   // of a block that have pictures of their own

std::string block_picture(std::size_t block, const std::string& what) {
    return "block-" + std::to_string(block + 1) + "-" + what;
}

std::string item_picture(std::size_t block, const std::string& what, std::size_t item) {
    const std::string name = block_picture(block, what);
    return item == 0 ? name : name + "-" + std::to_string(item + 1);
}

std::vector<std::string> all_files() {
    std::vector<std::string> pictures{"motion-force", "motion-turning"};
    for (std::size_t block = 0; block < kMostBlocks; ++block) {
        pictures.push_back(block_picture(block, "shares"));
        pictures.push_back(block_picture(block, "values"));
        for (std::size_t item = 0; item < kMostItems; ++item) {
            pictures.push_back(item_picture(block, "threshold", item));
            pictures.push_back(item_picture(block, "staircases", item));
        }
    }
    return report_files({"report.html", "report.json", "trials.csv", "intervals.csv"}, pictures);
}

/// The report, and its pictures.
struct Drawing {
    const StudyReport& report;
    FigureMaker figures;

    [[nodiscard]] const Block& block(const BlockFindings& found) const {
        return report.study.protocol.blocks[found.block];
    }
    [[nodiscard]] std::string subtitle(const BlockFindings& found) const {
        return one_line(report.study.protocol.title, 40) + ", " +
               counted(static_cast<std::int64_t>(report.study.participants.size()), "participant") +
               ", " + counted(found.trials, "trial");
    }
    /// Rows by the block's question.
    [[nodiscard]] RowsPlot rows(const BlockFindings& found) const {
        const std::string& question = block(found).question.text;
        return {.title = question.empty() ? block(found).name : question,
                .subtitle = subtitle(found)};
    }
};

void draw_shares(const Drawing& drawing, const BlockFindings& found) {
    if (found.shares.empty()) return;
    RowsPlot plot = drawing.rows(found);
    plot.axis = "share of answers [%]";
    plot.span = Interval{0.0, 100.0};
    if (found.shares.front().chance) {
        plot.line = 100.0 * *found.shares.front().chance;
        plot.line_name = "chance";
    }
    for (const ShareFinding& share : found.shares) {
        PlotRow row{.name = share.name,
                    .value = 100.0 * share.all.share(),
                    .interval = {100.0 * share.interval.low, 100.0 * share.interval.high}};
        if (share.by_participant.size() > 1)
            for (const Count& one : share.by_participant) row.each.push_back(100.0 * one.share());
        plot.rows.push_back(std::move(row));
    }
    drawing.figures.add(
        block_picture(found.block, "shares"), plot.title,
        "Shares of all answers with their exact 95 % intervals; pale: each participant.",
        plot_rows(plot));
}

void draw_values(const Drawing& drawing, const BlockFindings& found) {
    if (found.values.empty()) return;
    const Block& block = drawing.block(found);
    RowsPlot plot = drawing.rows(found);
    if (block.form == TrialForm::rating) {
        plot.axis = "rating";
        plot.span = Interval{static_cast<double>(block.question.lowest),
                             static_cast<double>(block.question.highest)};
    } else {
        plot.axis = "set equal, less the reference (" + block.variation.parameter + ")";
        plot.line = 0.0;
        plot.line_name = "equal";
    }
    for (const ValueFinding& value : found.values) {
        PlotRow row{.name = value.name, .value = value.mean.value, .interval = value.mean.interval};
        if (value.by_participant.size() > 1) row.each = value.by_participant;
        plot.rows.push_back(std::move(row));
    }
    drawing.figures.add(block_picture(found.block, "values"), plot.title,
                        "Means with their 95 % intervals; pale: each participant's mean.",
                        plot_rows(plot));
}

void draw_thresholds(const Drawing& drawing, const BlockFindings& found) {
    for (const ThresholdFinding& finding : found.thresholds) {
        if (finding.item >= kMostItems) break;
        const std::string subtitle = drawing.subtitle(found);
        if (!finding.fits.empty()) {
            const std::string title = "Psychometric function: " + finding.name;
            drawing.figures.add(
                item_picture(found.block, "threshold", finding.item), title,
                "Share of right answers (of yes) over the difference: circles are answers at "
                "levels near to each other, the larger the more, with exact 95 % intervals; the "
                "bar is the threshold's interval.",
                plot_threshold(finding, title, subtitle));
        }
        if (!drawing.block(found).variation.staircase || finding.all.empty()) continue;
        const std::string title = "Staircases: " + finding.name;
        drawing.figures.add(
            item_picture(found.block, "staircases", finding.item), title,
            "Each line is a staircase of one participant.",
            plot_tracks(drawing.report.study, found.block, finding.item, title, subtitle));
    }
}

void draw_motion(const Drawing& drawing) {
    const StudyReport& report = drawing.report;
    if (report.motion.empty()) return;
    const std::string subtitle =
        one_line(report.study.protocol.title, 40) + ", " +
        counted(static_cast<std::int64_t>(report.intervals.size()), "interval") + " recorded";
    const auto draw = [&](const char* name, const char* title, const char* what, const char* axis,
                          Estimate MotionFinding::*quantity) {
        RowsPlot plot{
            .title = title, .subtitle = subtitle, .axis = axis, .no_value = "not touched"};
        for (const MotionFinding& found : report.motion) {
            const Estimate& of = found.*quantity;
            PlotRow row{.name = found.condition, .value = of.value, .interval = of.interval};
            if (!std::isfinite(of.interval.low)) row.interval = {of.value, of.value};
            plot.rows.push_back(std::move(row));
        }
        drawing.figures.add(
            name, title,
            std::string(what) + ", by condition; 95 % intervals over participants who touched it.",
            plot_rows(plot));
    };
    const bool felt = report.forces_were_felt();
    draw("motion-force", "Force while touching",
         felt ? "Mean force sent while in contact"
              : "Mean force computed while in contact (with the mouse no force is felt)",
         felt ? "mean force sent [N]" : "mean force computed [N]", &MotionFinding::sent_newton);
    draw("motion-turning", "How the force turned",
         "Mean turning of the force from update to update", "turning of the force [deg per update]",
         &MotionFinding::turning_deg);
}

}  // namespace

bool StudyReport::forces_were_felt() const noexcept {
    return std::ranges::none_of(hands, &ParticipantHand::used_mouse);
}

std::vector<std::string> write_study_report(const std::vector<std::filesystem::path>& files,
                                            const StudyReportRequest& request) {
    StudyReport report{
        .study = read_studies(files), .analysis = request.analysis, .program = request.program};
    const auto& all = report.study.participants;
    if (std::all_of(all.begin(), all.end(),
                    [](const StudyRecord& one) { return one.answered.empty(); }))
        throw InputError(files.front().string() +
                         ": holds no answer yet, so there is nothing to report; run the study");
    OutputFolder folder(request.folder, all_files());
    const auto& progress = request.analysis.progress;
    AnalysisSettings analysis = request.analysis;
    if (progress) analysis.progress = [&progress](double share) { progress(0.5 * share); };
    report.blocks = findings_of(report.study, analysis);
    report.intervals = request.motion ? request.motion(report.study)
                                      : motion_of(report.study, [&progress](double share) {
                                            if (progress) progress(0.5 + 0.5 * share);
                                        });
    report.motion = motion_findings(report.study.protocol, report.intervals);
    report.hands = hands_in(report.intervals, report.study.participants.size());
    const Drawing drawing{report, {folder, request.plot_formats, report.figures}};
    for (const BlockFindings& found : report.blocks) {
        draw_shares(drawing, found);
        draw_values(drawing, found);
        draw_thresholds(drawing, found);
    }
    draw_motion(drawing);
    folder.add("trials.csv", trials_csv(report.study));
    folder.add("intervals.csv", intervals_csv(report.study, report.intervals));
    folder.add("report.json", json_of(report));
    folder.add("report.html", page_of(report));
    folder.commit();
    std::vector<std::string> warnings;
    for (const StudyRecord& one : all)
        if (!one.warning.empty()) warnings.push_back(one.warning);
    return warnings;
}

}  // namespace dibhr
