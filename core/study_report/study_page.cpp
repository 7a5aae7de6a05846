// The report as one HTML page that needs nothing beside it.
#include <cstddef>
#include <string>
#include <vector>

#include "core/files/plain_text.hpp"
#include "core/report/page_parts.hpp"
#include "core/report/report_sentences.hpp"
#include "core/study_report/study_fields.hpp"
#include "core/study_report/study_report.hpp"
#include "core/study_report/study_sentences.hpp"

namespace dibhr {

namespace {

/// A row of a table.
constexpr auto kRow = [](const auto& one) { return fields_of(one); };

std::string figures_html(const StudyReport& report, const std::string& of) {
    std::string html;
    for (const Figure& figure : report.figures)
        if (figure.name.starts_with(of)) html += figure_html(figure);
    return html;
}

std::string block_section(const StudyReport& report, const BlockFindings& found) {
    const Block& block = report.study.protocol.blocks[found.block];
    std::string body = "<p class=\"quiet\">" + html_text(block.question.text) + " (" +
                       html_text(entry_of(kTrialForms, block.form).label) + ", " +
                       counted(found.trials, "trial") + ", answered after " +
                       number_cell(found.reaction_s.value, 2) + " s in the median)</p>\n";
    if (found.trials == 0)
        return section(html_text(block.name), "<p>Nobody has come so far.</p>\n");
    const std::string pictures = "block-" + std::to_string(found.block + 1) + "-";
    body += list_html(conclusions_of(report, found)) + figures_html(report, pictures) +
            table_of(found.shares, kRow) + table_of(found.values, kRow) +
            table_of(found.pairs,
                     [&found](const PairTest& pair) { return fields_of(pair, found.compared); });
    for (const ThresholdFinding& finding : found.thresholds) {
        if (finding.fits.empty()) continue;
        body += "<p>" + html_text(finding.name) + "</p>\n" +
                table_of(finding.fits, [&report](const ParticipantThreshold& one) {
                    return fields_of(report.study, one);
                });
    }
    return section(html_text(block.name), body);
}

std::string participants_table(const StudyReport& report) {
    std::size_t next = 0;
    return table_of(report.study.participants,
                    [&](const StudyRecord& one) { return fields_of(one, report.hands[next++]); });
}

std::string conditions_section(const Study& study) {
    std::vector<Cells> rows;
    for (const Condition& condition : study.protocol.conditions)
        rows.push_back({html_text(condition.name), html_text(in_words(condition.values))});
    return section("Conditions", table_of({"name", "values"}, rows));
}

std::string protocol_section(const Study& study) {
    return section("The protocol",
                   "<p class=\"quiet\">" +
                       html_text(study.participants.front().identity.protocol_name) +
                       ", SHA-256 <code>" + html_text(study.protocol.sha256) +
                       "</code></p>\n<pre class=\"text\"><code>" + html_text(study.protocol.text) +
                       "</code></pre>\n");
}

}  // namespace

std::string page_of(const StudyReport& report) {
    const Study& study = report.study;
    const std::string title = study.protocol.title.empty() ? "A study" : study.protocol.title;
    std::string page = page_head(title, report.program) + "<h1>" + html_text(title) +
                       "</h1>\n<p class=\"summary\">" + html_text(summary_of(report)) +
                       "</p>\n</header>\n<main>\n" +
                       section("What limits it", list_html(limits_of(report)));
    for (const BlockFindings& found : report.blocks) page += block_section(report, found);
    if (!report.motion.empty())
        page += section("What was done and felt",
                        figures_html(report, "motion") +
                            table_of(report.motion, [&report](const MotionFinding& found) {
                                return fields_of(found, report.forces_were_felt());
                            }));
    return page + conditions_section(study) + section("Participants", participants_table(report)) +
           section("How it was computed", definitions_html(methods_of(report))) +
           protocol_section(study) +
           page_foot(report.program,
                     "every trial in trials.csv, every interval that was recorded in "
                     "intervals.csv");
}

}  // namespace dibhr
