// The report as one HTML page.
#include "core/report/report_page.hpp"

#include <string_view>

#include "core/files/plain_text.hpp"
#include "core/report/page_tables.hpp"
#include "core/report/report_words.hpp"

namespace dibhr {

namespace {

// Pictures keep their white paper in the dark: their inks are made for it.
constexpr std::string_view kStyle = R"(
:root { color-scheme: light dark; --ground: #fff; --ink: #222; --quiet: #666; --line: #ddd; --stripe: #f6f6f4; }
@media (prefers-color-scheme: dark) {
  :root { --ground: #16181b; --ink: #e6e6e4; --quiet: #a2a6ab; --line: #3a3e44; --stripe: #1e2125; }
}
* { box-sizing: border-box; }
body { margin: 0 auto; padding: 2rem 1.25rem 4rem; max-width: 76rem; background: var(--ground); color: var(--ink);
  font: 1rem/1.5 system-ui, "Segoe UI", "Liberation Sans", Arial, sans-serif; }
h1 { font-size: 1.7rem; line-height: 1.2; margin: 0 0 .25rem; overflow-wrap: anywhere; }
h2 { font-size: 1.2rem; margin: 2.5rem 0 .6rem; }
.quiet, figcaption { color: var(--quiet); }
.summary { font-size: 1.15rem; max-width: 60rem; }
.text { white-space: pre-wrap; overflow-wrap: anywhere; }
.note { border-left: 4px solid var(--line); padding-left: 1rem; }
figure { margin: 1.5rem 0 0; }
figure img { display: block; width: 100%; height: auto; background: #fff; border: 1px solid var(--line); border-radius: 6px; }
figure.map img { width: auto; max-width: 100%; max-height: 92vh; }
figcaption { margin-top: .4rem; max-width: 60rem; }
.pair { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 24rem), 1fr)); gap: 0 1.5rem; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; font-size: .9rem; font-variant-numeric: tabular-nums; }
th, td { text-align: left; vertical-align: top; padding: .3rem .7rem; border-bottom: 1px solid var(--line); }
th { color: var(--quiet); font-weight: 600; }
tbody tr:nth-child(even) { background: var(--stripe); }
code { font-size: .85em; overflow-wrap: anywhere; }
dt { font-weight: 600; margin-top: .6rem; }
dd { margin: 0; max-width: 60rem; }
@media print {
  :root { color-scheme: light; --ground: #fff; --ink: #000; --quiet: #444; --line: #bbb; --stripe: #fff; }
  body { max-width: none; padding: 0; font-size: 10pt; }
  figure, tr { break-inside: avoid; }
  h2 { break-after: avoid; }
  .wide { overflow: visible; }
  table { font-size: 7.5pt; }
  th, td { padding: .15rem .3rem; }
  figure.map img { max-height: 20cm; }
}
)";

std::string figure_html(const Figure& figure) {
    const bool is_map = figure.name.starts_with("heat-map");
    return std::string("<figure") + (is_map ? " class=\"map\"" : "") + ">\n<img alt=\"" +
           html_text(figure.title) + "\" width=\"" + std::to_string(figure.columns) +
           "\" height=\"" + std::to_string(figure.rows) + "\" src=\"data:image/png;base64," +
           base64_text(figure.png) + "\">\n<figcaption>" + html_text(figure.caption) +
           " <span class=\"quiet\">(" + html_text(figure.files) + ")</span></figcaption>\n" +
           "</figure>\n";
}

/// The figures, histograms side by side where there is room.
std::string figures_html(const SessionReport& report) {
    std::string whole;
    std::string pair;
    for (const Figure& figure : report.figures) {
        (figure.name.ends_with("-histogram") ? pair : whole) += figure_html(figure);
    }
    return pair.empty() ? whole : whole + "<div class=\"pair\">\n" + pair + "</div>\n";
}

std::string head_html(const SessionReport& report) {
    const std::string name = html_text(report.session.file().filename().string());
    return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
           "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
           "<meta name=\"generator\" content=\"" +
           html_text(report.program) + "\">\n<title>What was touched: " + name +
           "</title>\n<style>" + std::string(kStyle) + "</style>\n</head>\n";
}

std::string remarks_html(const SessionReport& report) {
    std::string items;
    for (const std::string& remark : remarks_of(report)) {
        items += "<li class=\"text\">" + html_text(remark) + "</li>\n";
    }
    if (items.empty()) return {};
    return "<section>\n<h2>To mind</h2>\n<ul>\n" + items + "</ul>\n</section>\n";
}

std::string opening_html(const SessionReport& report) {
    const Session& session = report.session;
    std::string text =
        "<h1>What was touched: " + html_text(session.file().filename().string()) + "</h1>\n";
    std::string when = wall_time_text(report.numbers.begin_utc_s);
    if (!when.empty()) when = "Recorded from " + when;
    if (const std::string who = session.fact("participant"); !who.empty()) {
        when += (when.empty() ? "Participant " : ", participant ") + who;
    }
    text += "<p class=\"quiet\">" + html_text(when) + "</p>\n<p class=\"summary\">" +
            html_text(summary_of(report)) + "</p>\n";
    if (const std::string note = session.fact("note"); !note.empty()) {
        text += "<p class=\"note text\">" + html_text(note) + "</p>\n";
    }
    return text;
}

}  // namespace

std::string page_of(const SessionReport& report) {
    return head_html(report) + "<body>\n<header>\n" + opening_html(report) + "</header>\n<main>\n" +
           remarks_html(report) + figures_html(report) + episodes_section(report) +
           marks_section(report) + parameters_section(report) + files_section(report) +
           facts_section(report) + definitions_section() +
           "</main>\n<footer class=\"quiet\">\n<p>Made by " + html_text(report.program) +
           ". The numbers are in report.json beside this page, the pictures in the files named "
           "under them.</p>\n</footer>\n</body>\n</html>\n";
}

}  // namespace dibhr
