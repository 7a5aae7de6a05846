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
#include "core/report/page_parts.hpp"
#include "core/report/report_words.hpp"

namespace dibhr {

namespace {

/// The figures, histograms side by side where there is room.
std::string figures_html(const SessionReport& report) {
    std::string whole;
    std::string pair;
    for (const Figure& figure : report.figures) {
        (figure.name.ends_with("-histogram") ? pair : whole) += figure_html(figure);
    }
    return pair.empty() ? whole : whole + "<div class=\"pair\">\n" + pair + "</div>\n";
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
std::string head_of(std::string_view label, std::string_view unit = {}) {
    std::string head(label);
    head[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(head[0])));
    return unit.empty() ? head : head + " [" + std::string(unit) + "]";
}

Cells parameters_heads() {
    Cells heads{"from [s]"};
    for (const TouchChoice& choice : touch_choices()) heads.push_back(head_of(choice.label));
    for (const TouchNumber& number : touch_numbers())
        heads.push_back(head_of(number.label, number.unit));
    heads.emplace_back("bump map");
    for (const TouchSwitch& entry : touch_switches()) heads.push_back(head_of(entry.label));
    heads.insert(heads.end(), {"force limit [N]", "force"});
    return heads;
}

Cells parameters_row(const SessionReport& report, const SessionParameters& parameters) {
    const auto from = report.numbers.settings_from_s.find(parameters.version);
    Cells row{from == report.numbers.settings_from_s.end()
                  ? "not used"
                  : number_text(from->second - report.session.begin_s(), 3)};
    for (const TouchChoice& choice : touch_choices())
        row.push_back(html_text(choice.of(parameters.touch)));
    for (const TouchNumber& number : touch_numbers()) {
        const double value = number.of(parameters.touch);
        const bool named = number.zero != nullptr && !(value > 0.0);
        row.push_back(named ? number.zero : tick_text(value));
    }
    row.push_back(file_cell(parameters.bump));
    for (const TouchSwitch& entry : touch_switches())
        row.emplace_back(entry.of(parameters.touch) ? "yes" : "no");
    row.insert(row.end(), {tick_text(parameters.limits.max_force_newton),
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
    return page_head("What was touched: " + report.session.file().filename().string(),
                     report.program) +
           "<body>\n<header>\n" + opening_html(report) + "</header>\n<main>\n" +
           remarks_html(report) + figures_html(report) + episodes_section(report) +
           marks_section(report) + parameters_section(report) + files_section(report) +
           facts_section(report) + definitions_section() +
           "</main>\n<footer class=\"quiet\">\n<p>Made by " + html_text(report.program) +
           ". The numbers are in report.json beside this page, the pictures in the files named "
           "under them.</p>\n</footer>\n</body>\n</html>\n";
}

}  // namespace dibhr
