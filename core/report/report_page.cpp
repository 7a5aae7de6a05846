// The report as one HTML page that needs nothing beside it.
#include "core/report/session_report.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "core/files/plain_text.hpp"
#include "core/report/fields.hpp"
#include "core/report/page_parts.hpp"
#include "core/report/report_sentences.hpp"

namespace dibhr {

namespace {

/// The figures, histograms side by side where there is room.
std::string figures_html(const SessionReport& report) {
    std::string whole;
    std::string pair;
    for (const Figure& figure : report.figures)
        (figure.name.ends_with("-histogram") ? pair : whole) += figure_html(figure);
    return pair.empty() ? whole : whole + "<div class=\"pair\">\n" + pair + "</div>\n";
}

std::string remarks_section(const SessionReport& report) {
    const std::vector<std::string> remarks = remarks_of(report);
    return remarks.empty() ? "" : section("Worth knowing", list_html(remarks));
}

std::string opening_html(const SessionReport& report, const std::string& title) {
    const Session& session = report.session;
    std::string text = "<h1>" + html_text(title) + "</h1>\n";
    std::string when = wall_time_text(report.numbers.begin_utc_s);
    if (!when.empty()) when = "Recorded from " + when;
    if (const std::string who = session.fact("participant"); !who.empty())
        when += (when.empty() ? "Participant " : ", participant ") + who;
    text += "<p class=\"quiet\">" + html_text(when) + "</p>\n<p class=\"summary\">" +
            html_text(summary_of(report)) + "</p>\n";
    if (const std::string note = session.fact("note"); !note.empty())
        text += "<p class=\"note text\">" + html_text(note) + "</p>\n";
    return text;
}

// A browser is slow with more, and nobody reads them: the JSON has them all.
constexpr std::size_t kMostRows = 300;

/// Which episodes are shown, in order: all, or the longest.
std::vector<std::size_t> shown_episodes(const std::vector<Episode>& episodes) {
    std::vector<std::size_t> shown = longest_first(episodes);
    shown.resize(std::min(shown.size(), kMostRows));
    std::sort(shown.begin(), shown.end());
    return shown;
}

Cells media_row(const std::string& what, const SessionMedia& media) {
    return {what, text_cell(media.file.string()), std::to_string(media.bytes),
            media.sha256.empty() ? "not known: the recording ended before"
                                 : "<code>" + html_text(media.sha256) + "</code>"};
}

std::string cleaning_text(const FrameSource& source) {
    std::string text;
    const auto add = [&text](bool on, const char* name) {
        if (on) text += (text.empty() ? "" : ", ") + std::string(name);
    };
    add(source.densify, "sparse depth interpolated");
    add(source.remove_spikes, "spikes removed");
    add(source.fill_holes, "holes filled");
    add(source.sharpen_silhouettes, "silhouettes sharpened");
    add(source.sharpen_silhouettes && source.colour_edges, "at the colour's edges");
    add(source.steady, "steadied in time");
    add(source.smooth_steps, "steps smoothed");
    add(source.smooth_noise, "noise smoothed");
    add(source.smooth_outlines, "outlines smoothed");
    add(source.in_betweens, "moved between frames");
    add(source.finger_px > 0.0, "touched with a fingertip");
    return text.empty() ? "as it is in the file" : text;
}

/// The first items, as many as are shown.
template <typename Item>
std::span<const Item> first_of(const std::vector<Item>& items) {
    return std::span(items).first(std::min(items.size(), kMostRows));
}

/// Empty for a session without contact.
std::string episodes_section(const SessionReport& report) {
    const std::vector<Episode>& episodes = report.numbers.episodes;
    if (episodes.empty()) return {};
    const std::vector<std::size_t> shown = shown_episodes(episodes);
    std::string body;
    if (shown.size() < episodes.size()) {
        body = "<p>The " + std::to_string(shown.size()) + " longest of " +
               std::to_string(episodes.size()) + "; all are in report.json.</p>\n";
    }
    return section("Contacts", body + table_of(shown, [&](std::size_t k) {
                                   return episode_fields(report, k);
                               }));
}

/// Empty for a session without marks.
std::string marks_section(const SessionReport& report) {
    const auto marks = first_of(report.session.marks());
    if (marks.empty()) return {};
    return section("Marks", table_of(marks, [&](const SessionMark& mark) {
                       return mark_fields(report, mark);
                   }));
}

/// Of rows that begin with their time: bold where a cell is not that of the row before.
void mark_changes(std::vector<Cells>& rows) {
    for (std::size_t row = rows.size(); row-- > 1;)
        for (std::size_t k = 1; k < rows[row].size(); ++k)
            if (rows[row][k] != rows[row - 1][k])
                rows[row][k] = "<strong>" + rows[row][k] + "</strong>";
}

/// Versions that differ in nothing that is shown are one row; those that no tick used are left out.
std::string parameters_section(const SessionReport& report) {
    const auto& used_from_s = report.numbers.settings_from_s;
    Cells heads;
    std::vector<Cells> rows;
    for (const SessionParameters& parameters : report.session.parameters()) {
        if (!used_from_s.empty() && !used_from_s.contains(parameters.version)) continue;
        Fields row = parameters_fields(report, parameters);
        heads = std::move(row.heads);
        if (rows.empty() ||
            !std::equal(rows.back().begin() + 1, rows.back().end(), row.cells.begin() + 1))
            rows.push_back(std::move(row.cells));
    }
    if (rows.empty()) return section("Parameters", "<p>None were recorded.</p>\n");
    const std::size_t changes = rows.size() - 1;
    rows.resize(std::min(rows.size(), kMostRows));
    mark_changes(rows);
    return section("Parameters",
                   "<p>" +
                       (changes == 0 ? "They stayed the same."
                                     : counted(static_cast<std::int64_t>(changes), "change") +
                                           "; what changed is bold.") +
                       "</p>\n" + table_of(heads, rows));
}

std::string files_section(const SessionReport& report) {
    std::vector<Cells> rows;
    std::set<std::string> cleanings;
    std::set<std::filesystem::path> printed;
    const auto add = [&](const char* what, const SessionMedia& media) {
        if (!media.file.empty() && printed.insert(media.file).second)
            rows.push_back(media_row(what, media));
    };
    for (const SessionSource& source : report.session.sources()) {
        add("colour", source.colour);
        add("depth", source.depth);
        cleanings.insert(cleaning_text(source.source));
    }
    for (const SessionParameters& parameters : report.session.parameters())
        add("bump map", parameters.bump);
    if (rows.empty()) return section("Files", "<p>No file was touched.</p>\n");
    std::string body = table_of({"what", "file", "bytes", "SHA-256"}, rows);
    for (const std::string& cleaning : cleanings) body += "<p>Depth: " + cleaning + ".</p>\n";
    return section("Files", body);
}

std::string facts_section(const SessionReport& report) {
    std::vector<Cells> rows{{"file", html_text(report.session.file().filename().string())},
                            {"ticks", std::to_string(report.session.rows())}};
    const HandTicks hand = hand_of(report.numbers.ticks);
    for (const auto& [key, value] :
         facts_of_hand(report.session.facts(), hand, report.device_kinds)) {
        if (key == "note" || key == "participant") continue;
        const std::string text = key == "device" ? device_text(value, hand) : value;
        rows.push_back({html_text(key), text_cell(text)});
    }
    return section("Session", table_of({"fact", "value"}, rows));
}

}  // namespace

std::string page_of(const SessionReport& report) {
    const std::string title = "What was touched: " + report.session.file().filename().string();
    return page_head(title, report.program) + opening_html(report, title) + "</header>\n<main>\n" +
           remarks_section(report) + figures_html(report) + episodes_section(report) +
           marks_section(report) + parameters_section(report) + files_section(report) +
           facts_section(report) +
           section("What the numbers mean", definitions_html(definitions())) +
           page_foot(report.program, "the pictures in the files named under them");
}

}  // namespace dibhr
