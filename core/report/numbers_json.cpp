// The report's numbers for scripts: JSON with names that stay, units in them.
#include "core/report/session_report.hpp"

#include <cstddef>
#include <string_view>

#include "core/files/json.hpp"
#include "core/files/plain_text.hpp"
#include "core/report/report_words.hpp"

namespace dibhr {

namespace {

constexpr int kReportVersion = 1;  // changes when a name changes its meaning or goes

Json force_json(const ForceSummary& force) {
    return {{"mean_newton", force.mean_newton}, {"peak_newton", force.peak_newton}};
}

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
    for (std::size_t k = 1; k < ticks.cut.size(); ++k) {
        cut[name_of(static_cast<SafetyCut>(k))] = ticks.cut[k];
    }
    return {{"all", ticks.all},
            {"missing", ticks.missing},
            {"in_contact", ticks.in_contact},
            {"without_surface", ticks.without_surface},
            {"device_not_ready", ticks.device_not_ready},
            {"stand_in", ticks.stand_in},
            {"goal_refused", ticks.goal_refused},
            {"catching_up", ticks.catching_up},
            {"late", ticks.late},
            {"worst_lateness_us", ticks.worst_lateness_us},
            {"cut", cut}};
}

Json episodes_json(const SessionReport& report) {
    const double begin_s = report.session.begin_s();
    Json list = Json::array();
    for (const Episode& e : report.numbers.episodes) {
        list.push_back({{"number", list.size() + 1},
                        {"begin_s", e.begin_s - begin_s},
                        {"end_s", e.end_s - begin_s},
                        {"length_s", e.length_s()},
                        {"contact_s", e.contact_s},
                        {"video_begin_s", e.video_begin_s},
                        {"video_end_s", e.video_end_s},
                        {"media", e.media},
                        {"sent", force_json(e.sent)},
                        {"spring", force_json(e.spring)},
                        {"path_mm", e.path_mm},
                        {"mean_speed_mm_per_s", e.mean_speed_mm_per_s()},
                        {"centre_x_px", e.centre_px.x},
                        {"centre_y_px", e.centre_px.y},
                        {"triangle_share", e.shares.triangle},
                        {"edge_share", e.shares.edge},
                        {"vertex_share", e.shares.vertex}});
    }
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

Json parameters_json(const Session& session, SessionParameters parameters) {
    Json json{{"version", parameters.version},
              {"first_tick", session.count_of(parameters.first_tick)}};
    for (const TouchChoice& choice : touch_choices())
        json[std::string(choice.column)] = std::string(choice.of(parameters.touch));
    visit_numbers(parameters, [&json](std::string_view column, double number) {
        json[std::string(column)] = number;
    });
    json["force_enabled"] = parameters.force_enabled;
    for (const TouchSwitch& entry : touch_switches())
        json[std::string(entry.column)] = entry.of(parameters.touch);
    json["bump"] = media_json(parameters.bump);
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

}  // namespace

std::string json_of(const SessionReport& report) {
    const Session& session = report.session;
    const SessionNumbers& numbers = report.numbers;
    const double way_mm = path_mm(numbers);
    const auto mark_json = [&](const SessionMark& mark) -> Json {
        return {{"t_s", mark.t_s - session.begin_s()},
                {"tag", utf8_text(mark.tag)},
                {"text", utf8_text(mark.text)}};
    };
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
         {"path_mm", way_mm},
         {"mean_speed_mm_per_s", numbers.contact_s > 0.0 ? way_mm / numbers.contact_s : 0.0},
         {"force_sent_newton", values_json(numbers.sent_newton)},
         {"force_spring_newton", values_json(numbers.spring_newton)},
         {"speed_goal_mm_per_s", values_json(numbers.goal_mm_per_s)},
         {"speed_proxy_mm_per_s", values_json(numbers.proxy_mm_per_s)},
         {"ticks", ticks_json(numbers.ticks)},
         {"episodes", episodes_json(report)},
         {"heat_maps", json_list(report.maps, map_json)},
         {"parameters",
          json_list(session.parameters(),
                    [&](const SessionParameters& p) { return parameters_json(session, p); })},
         {"sources", json_list(session.sources(),
                               [&](const SessionSource& s) { return source_json(session, s); })},
         {"marks", json_list(session.marks(), mark_json)},
         {"facts", texts_json(facts_of_hand(session.facts(), hand_of(numbers.ticks)))},
         {"definitions", texts_json(meanings)}});
}

}  // namespace dibhr
