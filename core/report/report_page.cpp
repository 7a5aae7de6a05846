// The report as one HTML page that needs nothing beside it.
#include "core/report/session_report.hpp"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <numeric>
#include <set>
#include <string_view>
#include <vector>

#include "core/files/plain_text.hpp"
#include "core/plot/axes.hpp"
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
th, td { text-align: left; vertical-align: top; padding: .3rem .45rem; border-bottom: 1px solid var(--line); }
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
    return "<section>\n<h2>Worth knowing</h2>\n<ul>\n" + items + "</ul>\n</section>\n";
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

// A browser is slow with more, and nobody reads them: the JSON has them all.
constexpr std::size_t kMostRows = 300;

/// Cells of a row as HTML.
using Cells = std::vector<std::string>;

std::string row_of(const Cells& cells, const std::string& begin, const std::string& end) {
    std::string row = "<tr>";
    for (const std::string& text : cells) row.append(begin).append(text).append(end);
    return row + "</tr>\n";
}

std::string table_of(const Cells& heads, const std::vector<Cells>& rows) {
    std::string table = "<div class=\"wide\"><table>\n<thead>" +
                        row_of(heads, "<th scope=\"col\">", "</th>") + "</thead>\n<tbody>\n";
    for (const Cells& row : rows) table += row_of(row, "<td>", "</td>");
    return table + "</tbody></table></div>\n";
}

std::string section(const std::string& heading, const std::string& body) {
    return "<section>\n<h2>" + heading + "</h2>\n" + body + "</section>\n";
}

/// Which episodes are shown, in order: all, or the longest.
std::vector<std::size_t> shown_episodes(const std::vector<Episode>& episodes) {
    std::vector<std::size_t> shown(episodes.size());
    std::iota(shown.begin(), shown.end(), std::size_t{0});
    if (shown.size() <= kMostRows) return shown;
    std::stable_sort(shown.begin(), shown.end(), [&](std::size_t a, std::size_t b) {
        return episodes[a].contact_s > episodes[b].contact_s;
    });
    shown.resize(kMostRows);
    std::sort(shown.begin(), shown.end());
    return shown;
}

std::string shares_text(const PrimitiveShares& shares) {
    const auto percent = [](double share) { return number_text(100.0 * share, 0); };
    return percent(shares.triangle) + " / " + percent(shares.edge) + " / " + percent(shares.vertex);
}

Cells episode_row(const SessionReport& report, std::size_t k) {
    const Episode& e = report.numbers.episodes[k];
    return {std::to_string(k + 1),
            number_text(e.begin_s - report.session.begin_s(), 3),
            number_text(e.video_begin_s, 3),
            number_text(e.length_s(), 3),
            number_text(e.sent.mean_newton, 3),
            number_text(e.sent.peak_newton, 3),
            number_text(e.spring.mean_newton, 3),
            number_text(e.spring.peak_newton, 3),
            number_text(e.path_mm, 1),
            number_text(e.mean_speed_mm_per_s(), 1),
            number_text(e.centre_px.x, 0) + ",&nbsp;" + number_text(e.centre_px.y, 0),
            shares_text(e.shares)};
}

/// A file's name; the whole path where a pointer rests on it.
std::string file_cell(const SessionMedia& media) {
    if (media.file.empty()) return "none";
    return "<span title=\"" + html_text(media.file.string()) + "\">" +
           html_text(media.file.filename().string()) + "</span>";
}

/// "damping [N s/m]"
std::string head_of(const TouchNumber& number) {
    std::string head(number.label);
    head[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(head[0])));
    return number.unit.empty() ? head : head + " [" + std::string(number.unit) + "]";
}

Cells parameters_heads() {
    Cells heads{"from [s]", "algorithm"};
    for (const TouchNumber& number : touch_numbers()) heads.push_back(head_of(number));
    heads.insert(heads.end(), {"bump map", "carried along", "force limit [N]", "force"});
    return heads;
}

Cells parameters_row(const SessionReport& report, const SessionParameters& parameters) {
    const auto from = report.numbers.settings_from_s.find(parameters.version);
    Cells row{from == report.numbers.settings_from_s.end()
                  ? "not used"
                  : number_text(from->second - report.session.begin_s(), 3),
              html_text(name_of(parameters.touch.algorithm))};
    for (const TouchNumber& number : touch_numbers()) {
        const double value = number.of(parameters.touch);
        const bool named = number.zero != nullptr && !(value > 0.0);
        row.push_back(named ? number.zero : tick_text(value));
    }
    row.insert(row.end(), {file_cell(parameters.bump), parameters.touch.carry ? "yes" : "no",
                           tick_text(parameters.limits.max_force_newton),
                           parameters.force_enabled ? "on" : "off"});
    return row;
}

Cells media_row(const std::string& what, const SessionMedia& media) {
    return {what, "<span class=\"text\">" + html_text(media.file.string()) + "</span>",
            std::to_string(media.bytes),
            media.sha256.empty() ? "not known: the recording ended before"
                                 : "<code>" + html_text(media.sha256) + "</code>"};
}

std::string cleaning_text(const FrameSource& source) {
    std::string text;
    const auto add = [&text](bool on, const char* name) {
        if (on) text += (text.empty() ? "" : ", ") + std::string(name);
    };
    add(source.remove_spikes, "spikes removed");
    add(source.fill_holes, "holes filled");
    add(source.sharpen_silhouettes, "silhouettes sharpened");
    add(source.sharpen_silhouettes && source.colour_edges, "at the colour's edges");
    add(source.steady, "steadied in time");
    add(source.smooth_steps, "steps smoothed");
    add(source.smooth_noise, "noise smoothed");
    add(source.in_betweens, "moved between frames");
    add(source.finger_px > 0.0, "touched with a fingertip");
    return text.empty() ? "as it is in the file" : text;
}

/// Empty for a session without contact.
std::string episodes_section(const SessionReport& report) {
    const std::vector<Episode>& episodes = report.numbers.episodes;
    if (episodes.empty()) return {};
    std::vector<Cells> rows;
    for (const std::size_t k : shown_episodes(episodes)) rows.push_back(episode_row(report, k));
    std::string body;
    if (rows.size() < episodes.size()) {
        body = "<p>The " + std::to_string(rows.size()) + " longest of " +
               std::to_string(episodes.size()) + "; all are in report.json.</p>\n";
    }
    return section(
        "Contacts",
        body + table_of({"No.", "start [s]", "video [s]", "length [s]", "sent, mean [N]",
                         "sent, peak [N]", "spring, mean [N]", "spring, peak [N]", "path [mm]",
                         "speed [mm/s]", "place [px]", "triangle / edge / vertex [%]"},
                        rows));
}

/// Empty for a session without marks.
std::string marks_section(const SessionReport& report) {
    if (report.session.marks().empty()) return {};
    std::vector<Cells> rows;
    for (const SessionMark& mark : report.session.marks()) {
        if (rows.size() == kMostRows) break;
        rows.push_back({number_text(mark.t_s - report.session.begin_s(), 3),
                        "<span class=\"text\">" + html_text(mark.tag) + "</span>",
                        "<span class=\"text\">" + html_text(mark.text) + "</span>"});
    }
    return section("Marks", table_of({"time [s]", "tag", "text"}, rows));
}

std::string parameters_section(const SessionReport& report) {
    std::vector<Cells> rows;
    for (const SessionParameters& parameters : report.session.parameters()) {
        if (rows.size() == kMostRows) break;
        rows.push_back(parameters_row(report, parameters));
    }
    return section("Parameters", rows.empty() ? "<p>None were recorded.</p>\n"
                                              : table_of(parameters_heads(), rows));
}

std::string files_section(const SessionReport& report) {
    std::vector<Cells> rows;
    std::set<std::string> cleanings;
    std::set<std::filesystem::path> told;
    const auto add = [&](const char* what, const SessionMedia& media) {
        if (!media.file.empty() && told.insert(media.file).second) {
            rows.push_back(media_row(what, media));
        }
    };
    for (const SessionSource& source : report.session.sources()) {
        add("colour", source.colour);
        add("depth", source.depth);
        cleanings.insert(cleaning_text(source.source));
    }
    for (const SessionParameters& parameters : report.session.parameters()) {
        add("bump map", parameters.bump);
    }
    if (rows.empty()) return section("Files", "<p>No file was touched.</p>\n");
    std::string body = table_of({"what", "file", "bytes", "SHA-256"}, rows);
    for (const std::string& cleaning : cleanings) body += "<p>Depth: " + cleaning + ".</p>\n";
    return section("Files", body);
}

std::string facts_section(const SessionReport& report) {
    std::vector<Cells> rows{{"file", html_text(report.session.file().filename().string())},
                            {"ticks", std::to_string(report.session.rows())}};
    const HandTicks hand = hand_of(report.numbers.ticks);
    for (const auto& [key, value] : facts_of_hand(report.session.facts(), hand)) {
        if (key == "note" || key == "participant") continue;
        const std::string text = key == "device" ? device_text(value, hand) : value;
        rows.push_back({html_text(key), "<span class=\"text\">" + html_text(text) + "</span>"});
    }
    return section("Session", table_of({"fact", "value"}, rows));
}

std::string definitions_section() {
    std::string list = "<dl>\n";
    for (const Definition& each : definitions()) {
        list += "<dt>" + html_text(each.name) + "</dt><dd>" + html_text(each.meaning) + "</dd>\n";
    }
    return section("What the numbers mean", list + "</dl>\n");
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
