// Measures a study, draws it, and writes the report.
#include "core/study_report/study_report.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "core/error.hpp"
#include "core/files/output_file.hpp"
#include "core/files/plain_text.hpp"
#include "core/report/report_words.hpp"
#include "core/study_report/study_plots.hpp"

namespace dibhr {

namespace {

constexpr std::size_t kMostBlocks = 50;  // whose pictures of an earlier report are taken away
constexpr std::size_t kMostItems = 12;   // of a block that have pictures of their own

std::string block_picture(std::size_t block, const std::string& what) {
    return "block-" + std::to_string(block + 1) + "-" + what;
}

std::string item_picture(std::size_t block, const std::string& what, std::size_t item) {
    const std::string name = block_picture(block, what);
    return item == 0 ? name : name + "-" + std::to_string(item + 1);
}

std::vector<std::string> all_pictures() {
    std::vector<std::string> names{"motion-force", "motion-turning"};
    for (std::size_t block = 0; block < kMostBlocks; ++block) {
        names.push_back(block_picture(block, "shares"));
        names.push_back(block_picture(block, "values"));
        for (std::size_t item = 0; item < kMostItems; ++item) {
            names.push_back(item_picture(block, "threshold", item));
            names.push_back(item_picture(block, "staircases", item));
        }
    }
    return names;
}

std::vector<std::string> all_files() {
    std::vector<std::string> names{"report.html", "report.json", "trials.csv", "intervals.csv"};
    for (const std::string& picture : all_pictures())
        for (const PlotFormat format : kPlotFormats) names.push_back(picture_file(picture, format));
    return names;
}

/// The report, and where its pictures go.
struct Drawing {
    StudyReport& report;
    OutputFolder& files;
    const StudyReportRequest& request;

    void add(const std::string& name, const std::string& title, const std::string& caption,
             const Canvas& plot) const {
        report.figures.push_back(
            add_figure(files, request.plot_formats, name, title, caption, plot));
    }
    [[nodiscard]] std::string subtitle(const BlockFindings& found) const {
        return one_line(report.study.protocol.title, 40) + ", " +
               counted(static_cast<std::int64_t>(report.study.participants.size()), "participant") +
               ", " + counted(found.trials, "trial");
    }
};

void draw_shares(const Drawing& drawing, const BlockFindings& found) {
    if (found.shares.empty()) return;
    const Block& block = drawing.report.study.protocol.blocks[found.block];
    RowsPlot plot{.title = block.question.text.empty() ? block.name : block.question.text,
                  .subtitle = drawing.subtitle(found),
                  .axis = "share of answers [%]",
                  .span = Interval{0.0, 100.0}};
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
    drawing.add(block_picture(found.block, "shares"), plot.title,
                "Shares of all answers with their exact 95 % intervals; pale: each participant.",
                plot_rows(plot));
}

void draw_values(const Drawing& drawing, const BlockFindings& found) {
    if (found.values.empty()) return;
    const Block& block = drawing.report.study.protocol.blocks[found.block];
    const bool rated = block.form == TrialForm::rating;
    RowsPlot plot{
        .title = block.question.text.empty() ? block.name : block.question.text,
        .subtitle = drawing.subtitle(found),
        .axis =
            rated ? "rating" : "set equal, less the reference (" + block.variation.parameter + ")"};
    if (rated) {
        plot.span = Interval{static_cast<double>(block.question.lowest),
                             static_cast<double>(block.question.highest)};
    } else {
        plot.line = 0.0;
        plot.line_name = "equal";
    }
    for (const ValueFinding& value : found.values) {
        PlotRow row{.name = value.name, .value = value.mean.value, .interval = value.mean.interval};
        if (value.by_participant.size() > 1) row.each = value.by_participant;
        plot.rows.push_back(std::move(row));
    }
    drawing.add(block_picture(found.block, "values"), plot.title,
                "Means with their 95 % intervals; pale: each participant's mean.", plot_rows(plot));
}

void draw_thresholds(const Drawing& drawing, const BlockFindings& found) {
    const Study& study = drawing.report.study;
    for (const ThresholdFinding& finding : found.thresholds) {
        if (finding.item >= kMostItems) break;
        const std::string subtitle = drawing.subtitle(found);
        if (!finding.fits.empty()) {
            const std::string title = "Psychometric function: " + finding.name;
            drawing.add(item_picture(found.block, "threshold", finding.item), title,
                        "Share of right answers (of yes) over the difference: circles are answers "
                        "at levels near to each other, the larger the more, with exact 95 % "
                        "intervals; the bar is the threshold's 95 % interval.",
                        plot_threshold(finding, title, subtitle));
        }
        if (!study.protocol.blocks[found.block].variation.staircase || finding.all.empty())
            continue;
        const std::string title = "Staircases: " + finding.name;
        drawing.add(item_picture(found.block, "staircases", finding.item), title,
                    "Each line is a staircase of one participant.",
                    plot_tracks(study, found.block, finding.item, title, subtitle));
    }
}

void draw_motion(const Drawing& drawing) {
    const StudyReport& report = drawing.report;
    if (report.motion.empty()) return;
    const auto rows_of = [&report](Estimate MotionFinding::*quantity) {
        std::vector<PlotRow> rows;
        for (const MotionFinding& found : report.motion) {
            const Estimate& of = found.*quantity;
            PlotRow row{.name = found.condition, .value = of.value, .interval = of.interval};
            if (!std::isfinite(of.interval.low)) row.interval = {of.value, of.value};
            rows.push_back(std::move(row));
        }
        return rows;
    };
    const std::string subtitle =
        one_line(report.study.protocol.title, 40) + ", " +
        counted(static_cast<std::int64_t>(report.intervals.size()), "interval") + " recorded";
    drawing.add("motion-force", "Force while touching",
                "Mean force sent while in contact, by condition; 95 % intervals over participants.",
                plot_rows({.title = "Force while touching",
                           .subtitle = subtitle,
                           .axis = "mean force sent [N]",
                           .rows = rows_of(&MotionFinding::sent_newton)}));
    drawing.add("motion-turning", "How the force turned",
                "Mean turning of the force from update to update, by condition; 95 % intervals "
                "over participants.",
                plot_rows({.title = "How the force turned",
                           .subtitle = subtitle,
                           .axis = "turning of the force [deg an update]",
                           .rows = rows_of(&MotionFinding::turning_deg)}));
}

}  // namespace

void write_study_report(const std::vector<std::filesystem::path>& files,
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
    report.intervals = motion_of(report.study, [&progress](double share) {
        if (progress) progress(0.5 + 0.5 * share);
    });
    report.motion = motion_findings(report.intervals);
    const Drawing drawing{report, folder, request};
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
}

}  // namespace dibhr
