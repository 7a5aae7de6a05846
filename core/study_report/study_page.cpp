// The report as one HTML page that needs nothing beside it.
#include <cmath>
#include <string>
#include <vector>

#include "core/files/plain_text.hpp"
#include "core/report/page_parts.hpp"
#include "core/report/report_words.hpp"
#include "core/study_report/study_report.hpp"
#include "core/study_report/study_words.hpp"

namespace dibhr {

namespace {

std::string list_html(const std::vector<std::string>& sentences) {
    std::string items;
    for (const std::string& sentence : sentences)
        items += "<li class=\"text\">" + html_text(sentence) + "</li>\n";
    return "<ul>\n" + items + "</ul>\n";
}

std::string number_cell(double value, int digits = 3) {
    return std::isfinite(value) ? short_text(value, digits) : "&ndash;";
}

/// On one line.
std::string unbroken(const std::string& text) {
    std::string html;
    for (const char each : html_text(text)) {
        if (each == ' ')
            html += "&nbsp;";
        else
            html += each;
    }
    return html;
}

std::string interval_cell(const Interval& interval) {
    const auto end = [](double value) {
        return std::isfinite(value) ? short_text(value, 3) : std::string("not bounded");
    };
    if (std::isinf(interval.low) && std::isinf(interval.high)) return "none";
    return unbroken(end(interval.low) + " to " + end(interval.high));
}

std::string share_cell(const Interval& interval) {
    return unbroken(percent_text(interval.low) + " to " + percent_text(interval.high));
}

std::string p_cell(double p) {
    return unbroken(p_text(p));
}

std::string test_cells(const TestResult& test) {
    return html_text(test.test) + ", n = " + std::to_string(test.count);
}

std::string shares_table(const BlockFindings& found) {
    if (found.shares.empty()) return {};
    std::vector<Cells> rows;
    for (const ShareFinding& share : found.shares) {
        Cells row{html_text(share.name),
                  std::to_string(share.all.hits) + " of " + std::to_string(share.all.trials),
                  unbroken(percent_text(share.all.share())), share_cell(share.interval)};
        const bool several = share.across.count > 1;
        row.push_back(several ? percent_text(share.across.value) : "&ndash;");
        row.push_back(several ? share_cell(share.across.interval) : "&ndash;");
        if (share.d_prime) {
            row.push_back(number_cell(share.d_prime->d_prime));
            row.push_back(interval_cell(share.d_prime->interval));
        } else {
            row.insert(row.end(), {"&ndash;", "&ndash;"});
        }
        row.push_back(share.test ? test_cells(*share.test) : "&ndash;");
        row.push_back(share.test ? p_cell(share.test->p) : "&ndash;");
        row.push_back(share.test ? p_cell(share.adjusted_p) : "&ndash;");
        rows.push_back(std::move(row));
    }
    return table_of({"share", "answers", "of all", "95 % interval", "mean over participants",
                     "95 % interval", "d'", "95 % interval", "test against chance", "p", "p, Holm"},
                    rows);
}

std::string thresholds_table(const Study& study, const ThresholdFinding& finding) {
    std::vector<Cells> rows;
    for (const ParticipantThreshold& one : finding.fits) {
        const PsychometricFit& fit = one.fit;
        rows.push_back({html_text(study.participants[one.participant].identity.participant),
                        number_cell(fit.function.threshold), interval_cell(fit.threshold),
                        number_cell(fit.function.slope()), number_cell(fit.function.guess, 2),
                        number_cell(fit.function.lapse, 2), number_cell(fit.fit_p, 2),
                        std::to_string(fit.trials), number_cell(one.reversal_mean)});
    }
    if (rows.empty()) return {};
    return "<p>" + html_text(finding.name) + "</p>\n" +
           table_of({"participant", "threshold", "95 % interval", "slope", "guess rate",
                     "lapse rate", "p of the fit", "trials", "mean of reversals"},
                    rows);
}

std::string values_table(const BlockFindings& found) {
    if (found.values.empty()) return {};
    std::vector<Cells> rows;
    for (const ValueFinding& value : found.values) {
        rows.push_back({html_text(value.name), std::to_string(value.trials),
                        number_cell(value.mean.value), interval_cell(value.mean.interval),
                        number_cell(value.median.value), interval_cell(value.median.interval),
                        value.test ? test_cells(*value.test) : "&ndash;",
                        value.test ? p_cell(value.test->p) : "&ndash;"});
    }
    return table_of(
        {"of", "trials", "mean", "95 % interval", "median", "interval of the median", "test", "p"},
        rows);
}

std::string pairs_table(const BlockFindings& found) {
    if (found.pairs.empty()) return {};
    std::vector<Cells> rows;
    for (const PairTest& pair : found.pairs) {
        rows.push_back({html_text(pair.first), html_text(pair.second),
                        number_cell(pair.difference.value), interval_cell(pair.difference.interval),
                        test_cells(pair.test), number_cell(pair.test.effect, 2),
                        p_cell(pair.test.p), p_cell(pair.adjusted_p)});
    }
    const std::string of = found.compared.empty() ? "" : " of the " + html_text(found.compared);
    return table_of({"first", "second", "mean difference" + of, "95 % interval", "test",
                     "rank-biserial correlation", "p", "p, Holm"},
                    rows);
}

std::string figures_html(const StudyReport& report, const std::string& of) {
    std::string html;
    for (const Figure& figure : report.figures)
        if (figure.name.starts_with(of)) html += figure_html(figure);
    return html;
}

/// "block-2-": how its pictures' names begin.
std::string pictures_of(const BlockFindings& found) {
    return "block-" + std::to_string(found.block + 1) + "-";
}

std::string block_section(const StudyReport& report, const BlockFindings& found) {
    const Block& block = report.study.protocol.blocks[found.block];
    std::string body = "<p class=\"quiet\">" + html_text(block.question.text) + " (" +
                       html_text(entry_of(kTrialForms, block.form).label) + ", " +
                       counted(found.trials, "trial") + ", answered after " +
                       number_cell(found.reaction_s.value, 2) + " s in the median)</p>\n";
    if (found.trials == 0)
        return section(html_text(block.name), "<p>Nobody has come so far.</p>\n");
    body += list_html(conclusions_of(report, found)) + figures_html(report, pictures_of(found)) +
            shares_table(found) + values_table(found) + pairs_table(found);
    for (const ThresholdFinding& finding : found.thresholds)
        body += thresholds_table(report.study, finding);
    return section(html_text(block.name), body);
}

std::string motion_section(const StudyReport& report) {
    if (report.motion.empty()) return {};
    std::vector<Cells> rows;
    for (const MotionFinding& found : report.motion) {
        const IntervalMotion& all = found.all;
        rows.push_back({html_text(found.condition), std::to_string(found.intervals),
                        number_text(all.duration_s, 1), percent_text(all.contact_share()),
                        number_cell(all.sent_newton), number_cell(all.sent_peak_newton),
                        number_cell(all.speed_mm_per_s()), number_cell(all.turning.mean_deg, 4),
                        number_cell(all.turning.sd_deg, 4)});
    }
    return section(
        "What was done and felt",
        figures_html(report, "motion") +
            table_of({"condition", "intervals", "time [s]", "in contact", "force sent, mean [N]",
                      "peak [N]", "speed [mm/s]", "turning of the force [deg]", "sd [deg]"},
                     rows));
}

std::string conditions_section(const Study& study) {
    std::vector<Cells> rows;
    for (const Condition& condition : study.protocol.conditions) {
        std::string values;
        const auto add = [&values](const std::string& name, const std::string& value) {
            values.append(values.empty() ? "" : ", ").append(name).append(" ").append(value);
        };
        for (const auto& [name, word] : condition.values.words) add(name, word);
        for (const auto& [name, number] : condition.values.numbers) add(name, number_text(number));
        rows.push_back({html_text(condition.name),
                        values.empty() ? "as the program has it" : html_text(values)});
    }
    return section("Conditions", table_of({"name", "values"}, rows));
}

std::string participants_section(const Study& study) {
    std::vector<Cells> rows;
    for (const StudyRecord& record : study.participants) {
        const StudyIdentity& who = record.identity;
        rows.push_back({html_text(who.participant), std::to_string(who.number),
                        std::to_string(record.answered.size()), record.finished ? "yes" : "no",
                        who.pilot.empty() ? "a person" : "simulated: " + html_text(who.pilot),
                        html_text(wall_time_text(who.created_s)), html_text(who.program)});
    }
    return section(
        "Participants",
        table_of({"label", "number", "trials", "finished", "who", "begun", "program"}, rows));
}

std::string methods_section(const StudyReport& report) {
    std::string list;
    for (const StudyMethod& method : methods_of(report))
        list +=
            "<dt>" + html_text(method.name) + "</dt><dd>" + html_text(method.meaning) + "</dd>\n";
    return section("How it was computed", "<dl>\n" + list + "</dl>\n");
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
    std::string page = page_head(title, report.program) + "<body>\n<header>\n<h1>" +
                       html_text(title) + "</h1>\n<p class=\"summary\">" +
                       html_text(summary_of(report)) + "</p>\n</header>\n<main>\n" +
                       section("What limits it", list_html(limits_of(report)));
    for (const BlockFindings& found : report.blocks) page += block_section(report, found);
    return page + motion_section(report) + conditions_section(study) + participants_section(study) +
           methods_section(report) + protocol_section(study) +
           "</main>\n<footer class=\"quiet\">\n<p>Made by " + html_text(report.program) +
           ". The numbers are in report.json beside this page, every trial in trials.csv, every "
           "interval that was recorded in intervals.csv.</p>\n</footer>\n</body>\n</html>\n";
}

}  // namespace dibhr
