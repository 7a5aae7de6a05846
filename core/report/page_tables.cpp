// The tables of the report's page.
#include "core/report/page_tables.hpp"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <numeric>
#include <set>
#include <vector>

#include "core/files/plain_text.hpp"
#include "core/plot/axes.hpp"
#include "core/report/device_text.hpp"
#include "core/report/report_words.hpp"

namespace dibhr {

namespace {

// A browser is slow with more, and nobody reads them: the JSON has them all.
constexpr std::size_t kMostRows = 300;

/// Cells of a row as HTML.
using Cells = std::vector<std::string>;

std::string row_of(const Cells& cells, const std::string& begin, const std::string& end) {
    std::string row = "<tr>";
    for (const std::string& text : cells) row += begin + text + end;
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
    const auto percent = [](double share) { return decimals(100.0 * share, 0); };
    return percent(shares.triangle) + " / " + percent(shares.edge) + " / " + percent(shares.vertex);
}

Cells episode_row(const SessionReport& report, std::size_t k) {
    const Episode& e = report.numbers.episodes[k];
    return {std::to_string(k + 1),
            decimals(e.begin_s - report.session.begin_s(), 3),
            decimals(e.video_begin_s, 3),
            decimals(e.length_s(), 3),
            decimals(e.sent.mean_newton, 3),
            decimals(e.sent.peak_newton, 3),
            decimals(e.spring.mean_newton, 3),
            decimals(e.spring.peak_newton, 3),
            decimals(e.path_mm, 1),
            decimals(e.mean_speed_mm_per_s(), 1),
            decimals(e.centre_px.x, 0) + ",&nbsp;" + decimals(e.centre_px.y, 0),
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
    heads.insert(heads.end(), {"bump map", "force limit [N]", "force"});
    return heads;
}

Cells parameters_row(const SessionReport& report, const SessionParameters& parameters) {
    const auto from = report.numbers.settings_from_s.find(parameters.version);
    Cells row{from == report.numbers.settings_from_s.end()
                  ? "not used"
                  : decimals(from->second - report.session.begin_s(), 3),
              html_text(name_of(parameters.touch.algorithm))};
    for (const TouchNumber& number : touch_numbers()) {
        const double value = number.of(parameters.touch);
        const bool named = number.zero != nullptr && !(value > 0.0);
        row.push_back(named ? number.zero : tick_text(value));
    }
    row.insert(row.end(),
               {file_cell(parameters.bump), tick_text(parameters.limits.max_force_newton),
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
    add(source.fill_holes, "holes filled");
    add(source.remove_spikes, "spikes removed");
    add(source.smooth_steps, "steps smoothed");
    return text.empty() ? "as it is in the file" : text;
}

}  // namespace

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

std::string marks_section(const SessionReport& report) {
    if (report.session.marks().empty()) return {};
    std::vector<Cells> rows;
    for (const SessionMark& mark : report.session.marks()) {
        if (rows.size() == kMostRows) break;
        rows.push_back({decimals(mark.t_s - report.session.begin_s(), 3),
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
    const TickCounts& ticks = report.numbers.ticks;
    const HandTicks hand{ticks.all - ticks.without_surface, ticks.stand_in};
    for (const auto& [key, value] : report.session.facts()) {
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

}  // namespace dibhr
