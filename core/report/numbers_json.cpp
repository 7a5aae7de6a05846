// The report's numbers, value by value, and all of them for scripts: JSON with stable names,
// units in them.
#include "core/report/session_report.hpp"

#include <cctype>
#include <cstddef>
#include <string_view>

#include "core/files/json.hpp"
#include "core/files/plain_text.hpp"
#include "core/plot/axes.hpp"
#include "core/report/fields.hpp"
#include "core/report/report_sentences.hpp"

namespace dibhr {

namespace {

constexpr int kReportVersion = 1;  // changes when a name is removed or changes its meaning

Json values_json(const Distribution& values) {
    constexpr int kBars = 50;
    if (!(values.total_s() > 0.0)) return nullptr;
    const Bars bars = values.bars(values.peak(), kBars);
    return {{"mean", values.mean()},
            {"peak", values.peak()},
            {"median", values.quantile(0.5)},
            {"p95", values.quantile(0.95)},
            {"histogram",
             {{"bar_width", bars.width}, {"seconds", bars.seconds}, {"beyond_s", bars.beyond_s}}}};
}

Json ticks_json(const TickCounts& ticks) {
    Json cut = Json::object();
    for (std::size_t k = 1; k < ticks.cut.size(); ++k)
        cut[name_of(static_cast<SafetyCut>(k))] = ticks.cut[k];
    return {{"all", ticks.all},
            {"missing", ticks.missing},
            {"in_contact", ticks.in_contact},
            {"without_surface", ticks.without_surface},
            {"device_not_ready", ticks.device_not_ready},
            {"stand_in", ticks.mouse_fallback},
            {"goal_refused", ticks.goal_refused},
            {"catching_up", ticks.catching_up},
            {"late", ticks.late},
            {"worst_lateness_us", ticks.worst_lateness_us},
            {"cut", cut}};
}

Json episodes_json(const SessionReport& report) {
    Json list = Json::array();
    for (std::size_t k = 0; k < report.numbers.episodes.size(); ++k)
        list.push_back(episode_fields(report, k).json);
    return list;
}

Json media_json(const SessionMedia& media) {
    if (media.file.empty()) return nullptr;
    return {{"file", utf8_text(media.file.string())},
            {"bytes", media.bytes},
            {"sha256", media.sha256.empty() ? Json() : Json(utf8_text(media.sha256))}};
}

Json source_json(const Session& session, const SessionSource& source) {
    Json json{{"media", source.source.media},
              {"first_tick", session.count_of(source.first_tick)},
              {"colour", media_json(source.colour)},
              {"depth", media_json(source.depth)}};
    visit_cleaning(source.source, [&json](std::string_view name, const auto& fact) {
        json[std::string(name)] = fact;
    });
    return json;
}

Json map_json(const HeatMapFacts& map) {
    return {{"picture", map.picture},
            {"media", map.source.source.media},
            {"contact_s", map.contact_s},
            {"frame_s", map.frame_s},
            {"over_the_frame", map.remark.empty()},
            {"columns", map.columns},
            {"rows", map.rows},
            {"sigma_px", map.sigma_px}};
}

Json texts_json(const SessionFacts& facts) {
    Json object = Json::object();
    for (const auto& [key, value] : facts) object[utf8_text(key)] = utf8_text(value);
    return object;
}

/// "damping [N s/m]"
std::string head_of(std::string_view label, std::string_view unit = {}) {
    std::string head(label);
    head[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(head[0])));
    return unit.empty() ? head : head + " [" + std::string(unit) + "]";
}

/// A file's name, with the whole path as a tooltip.
std::string file_cell(const SessionMedia& media) {
    if (media.file.empty()) return "none";
    return "<span title=\"" + html_text(media.file.string()) + "\">" +
           html_text(media.file.filename().string()) + "</span>";
}

}  // namespace

Fields episode_fields(const SessionReport& report, std::size_t k) {
    const Episode& e = report.numbers.episodes[k];
    const double begin_s = report.session.begin_s();
    const auto percent = [](double share) { return number_text(100.0 * share, 0); };
    Fields row;
    row.plain("number", k + 1, "No.");
    row.fixed("begin_s", e.begin_s - begin_s, 3, "start [s]");
    row.add("end_s", e.end_s - begin_s);
    row.add("length_s", e.length_s());
    row.add("contact_s", e.contact_s);
    row.fixed("video_begin_s", e.video_begin_s, 3, "video [s]");
    row.add("video_end_s", e.video_end_s);
    row.add("media", e.media);
    row.show("length [s]", number_text(e.length_s(), 3));
    row.fixed({"/sent/mean_newton", ""}, e.sent.mean_newton, 3, "sent, mean [N]");
    row.fixed({"/sent/peak_newton", ""}, e.sent.peak_newton, 3, "sent, peak [N]");
    row.fixed({"/spring/mean_newton", ""}, e.spring.mean_newton, 3, "spring, mean [N]");
    row.fixed({"/spring/peak_newton", ""}, e.spring.peak_newton, 3, "spring, peak [N]");
    row.fixed("path_mm", e.path_mm, 1, "path [mm]");
    row.fixed("mean_speed_mm_per_s", e.mean_speed_mm_per_s(), 1, "speed [mm/s]");
    row.add("centre_x_px", e.centre_px.x);
    row.add("centre_y_px", e.centre_px.y);
    row.show("place [px]",
             number_text(e.centre_px.x, 0) + ",&nbsp;" + number_text(e.centre_px.y, 0));
    row.add("triangle_share", e.shares.triangle);
    row.add("edge_share", e.shares.edge);
    row.add("vertex_share", e.shares.vertex);
    row.show("triangle / edge / vertex [%]", percent(e.shares.triangle) + " / " +
                                                 percent(e.shares.edge) + " / " +
                                                 percent(e.shares.vertex));
    return row;
}

Fields mark_fields(const SessionReport& report, const SessionMark& mark) {
    Fields row;
    row.fixed("t_s", mark.t_s - report.session.begin_s(), 3, "time [s]");
    row.add("tag", mark.tag);
    row.show("tag", text_cell(mark.tag));
    row.add("text", mark.text);
    row.show("text", text_cell(mark.text));
    return row;
}

Fields parameters_fields(const SessionReport& report, SessionParameters parameters) {
    const auto& used_from_s = report.numbers.settings_from_s;
    const auto from = used_from_s.find(parameters.version);
    Fields row;
    row.show("from [s]", from == used_from_s.end()
                             ? "not used"
                             : number_text(from->second - report.session.begin_s(), 3));
    row.add("version", parameters.version);
    row.add("first_tick", report.session.count_of(parameters.first_tick));
    for (const TouchChoice& choice : touch_choices()) {
        const std::string word(choice.of(parameters.touch));
        row.add(std::string(choice.column), word);
        row.show(head_of(choice.label), html_text(word));
    }
    visit_numbers(parameters, [&row](std::string_view column, double number) {
        row.add(std::string(column), number);
    });
    for (const TouchNumber& number : touch_numbers()) {
        const double value = number.of(parameters.touch);
        const bool named = number.zero != nullptr && !(value > 0.0);
        row.show(head_of(number.label, number.unit), named ? number.zero : tick_text(value));
    }
    row.add("force_enabled", parameters.force_enabled);
    row.show("bump map", file_cell(parameters.bump));
    for (const TouchSwitch& entry : touch_switches()) {
        row.add(std::string(entry.column), entry.of(parameters.touch));
        row.show(head_of(entry.label), entry.of(parameters.touch) ? "yes" : "no");
    }
    row.add("bump", media_json(parameters.bump));
    row.show("force limit [N]", tick_text(parameters.limits.max_force_newton));
    row.show("force", parameters.force_enabled ? "on" : "off");
    return row;
}

std::string json_of(const SessionReport& report) {
    const Session& session = report.session;
    const SessionNumbers& numbers = report.numbers;
    const double path_length_mm = path_mm(numbers);
    SessionFacts meanings;
    for (const Definition& each : definitions()) meanings[each.name] = each.meaning;
    return json_text(
        {{"report_version", kReportVersion},
         {"program", report.program},
         {"session",
          {{"file", utf8_text(session.file().string())},
           {"begin_utc_s", numbers.begin_utc_s},
           {"begin_utc", wall_time_text(numbers.begin_utc_s)},
           {"row_count", session.rows()}}},
         {"participant", utf8_text(session.fact("participant"))},
         {"note", utf8_text(session.fact("note"))},
         {"summary", utf8_text(summary_of(report))},
         {"duration_s", numbers.duration_s},
         {"contact_s", numbers.contact_s},
         {"contact_share", numbers.contact_share()},
         {"episode_count", numbers.episodes.size()},
         {"path_mm", path_length_mm},
         {"mean_speed_mm_per_s",
          numbers.contact_s > 0.0 ? path_length_mm / numbers.contact_s : 0.0},
         {"force_sent_newton", values_json(numbers.sent_newton)},
         {"force_spring_newton", values_json(numbers.spring_newton)},
         {"speed_goal_mm_per_s", values_json(numbers.goal_mm_per_s)},
         {"speed_proxy_mm_per_s", values_json(numbers.proxy_mm_per_s)},
         {"ticks", ticks_json(numbers.ticks)},
         {"episodes", episodes_json(report)},
         {"heat_maps", json_list(report.maps, map_json)},
         {"parameters",
          json_list(session.parameters(),
                    [&](const SessionParameters& p) { return parameters_fields(report, p).json; })},
         {"sources", json_list(session.sources(),
                               [&](const SessionSource& s) { return source_json(session, s); })},
         {"marks",
          json_list(session.marks(),
                    [&](const SessionMark& mark) { return mark_fields(report, mark).json; })},
         {"facts",
          texts_json(facts_of_hand(session.facts(), hand_of(numbers.ticks), report.device_kinds))},
         {"definitions", texts_json(meanings)}});
}

}  // namespace dibhr
