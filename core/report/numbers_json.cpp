// The members of the report's JSON.
#include "core/report/numbers_json.hpp"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/files/json_text.hpp"
#include "core/files/plain_text.hpp"
#include "core/report/report_words.hpp"

namespace dibhr {

namespace {

constexpr int kReportVersion = 1;  // changes when a name changes its meaning or goes

std::string text_of(const std::string& text) {
    return json_quoted(utf8_text(text));
}

std::string flag(bool value) {
    return value ? "true" : "false";
}

std::string same(const std::string& json) {
    return json;
}

std::string force_json(const ForceSummary& force) {
    return JsonObject()
        .add("mean_newton", force.mean_newton)
        .add("peak_newton", force.peak_newton)
        .text();
}

std::string values_json(const Distribution& values) {
    constexpr int kBars = 50;
    if (!(values.total_s() > 0.0)) return "null";
    const Bars bars = values.bars(values.peak(), kBars);
    std::string seconds;
    for (const double bar : bars.seconds) {
        seconds += (seconds.empty() ? "" : ", ") + json_number(bar);
    }
    return JsonObject()
        .add("mean", values.mean())
        .add("peak", values.peak())
        .add("median", values.quantile(0.5))
        .add("p95", values.quantile(0.95))
        .add("histogram", JsonObject()
                              .add("bar_width", bars.width)
                              .add("seconds", "[" + seconds + "]")
                              .add("beyond_s", bars.beyond_s)
                              .text())
        .text();
}

std::string ticks_json(const TickCounts& ticks) {
    JsonObject cut;
    for (std::size_t k = 1; k < ticks.cut.size(); ++k) {
        cut.add(name_of(static_cast<SafetyCut>(k)), ticks.cut[k]);
    }
    return JsonObject()
        .add("all", ticks.all)
        .add("missing", ticks.missing)
        .add("in_contact", ticks.in_contact)
        .add("without_surface", ticks.without_surface)
        .add("device_not_ready", ticks.device_not_ready)
        .add("stand_in", ticks.stand_in)
        .add("goal_refused", ticks.goal_refused)
        .add("late", ticks.late)
        .add("worst_lateness_us", ticks.worst_lateness_us)
        .add("cut", cut.text())
        .text();
}

std::string episodes_json(const SessionReport& report) {
    std::vector<std::string> items;
    for (const Episode& e : report.numbers.episodes) {
        items.push_back(JsonObject()
                            .add("number", static_cast<std::uint64_t>(items.size() + 1))
                            .add("begin_s", e.begin_s - report.session.begin_s())
                            .add("end_s", e.end_s - report.session.begin_s())
                            .add("length_s", e.length_s())
                            .add("contact_s", e.contact_s)
                            .add("video_begin_s", e.video_begin_s)
                            .add("video_end_s", e.video_end_s)
                            .add("media", std::uint64_t{e.media})
                            .add("sent", force_json(e.sent))
                            .add("spring", force_json(e.spring))
                            .add("path_mm", e.path_mm)
                            .add("mean_speed_mm_per_s", e.mean_speed_mm_per_s())
                            .add("centre_x_px", e.centre_px.x)
                            .add("centre_y_px", e.centre_px.y)
                            .add("triangle_share", e.shares.triangle)
                            .add("edge_share", e.shares.edge)
                            .add("vertex_share", e.shares.vertex)
                            .text());
    }
    return json_list(items, "  ", same);
}

std::string media_json(const SessionMedia& media) {
    if (media.file.empty()) return "null";
    return JsonObject()
        .add("file", text_of(media.file.string()))
        .add("bytes", media.bytes)
        .add("sha256", media.sha256.empty() ? "null" : text_of(media.sha256))
        .text();
}

std::string source_json(const SessionSource& source) {
    return JsonObject()
        .add("media", std::uint64_t{source.source.media})
        .add("first_tick", source.first_tick)
        .add("colour", media_json(source.colour))
        .add("depth", media_json(source.depth))
        .add("fill_holes", flag(source.source.fill_holes))
        .add("remove_spikes", flag(source.source.remove_spikes))
        .add("smooth_steps", flag(source.source.smooth_steps))
        .text();
}

std::string parameters_json(SessionParameters parameters) {
    JsonObject object;
    object.add("version", parameters.version)
        .add("first_tick", parameters.first_tick)
        .add_text("algorithm", name_of(parameters.touch.algorithm));
    visit_numbers(parameters, [&object](std::string_view column, double number) {
        object.add(std::string(column), number);
    });
    return object.add("force_enabled", flag(parameters.force_enabled))
        .add("bump", media_json(parameters.bump))
        .text();
}

std::string map_json(const HeatMapFacts& map) {
    return JsonObject()
        .add_text("picture", map.picture)
        .add("media", std::uint64_t{map.source.source.media})
        .add("contact_s", map.contact_s)
        .add("frame_s", map.frame_s)
        .add("over_the_frame", flag(map.remark.empty()))
        .add("columns", map.columns)
        .add("rows", map.rows)
        .add("sigma_px", map.sigma_px)
        .text();
}

std::string session_json(const SessionReport& report) {
    const Session& session = report.session;
    return JsonObject()
        .add("file", text_of(session.file().string()))
        .add("begin_utc_s", report.numbers.begin_utc_s)
        .add("begin_utc", text_of(wall_time_text(report.numbers.begin_utc_s)))
        .add("row_count", session.rows())
        .text();
}

std::string texts_json(const SessionFacts& facts) {
    JsonObject object;
    for (const auto& [key, value] : facts) object.add(utf8_text(key), text_of(value));
    return object.text();
}

/// The members that are numbers of the whole session.
void add_numbers(JsonObject& object, const SessionNumbers& numbers) {
    const double way_mm = path_mm(numbers);
    object.add("duration_s", numbers.duration_s)
        .add("contact_s", numbers.contact_s)
        .add("contact_share", numbers.contact_share())
        .add("episode_count", static_cast<std::uint64_t>(numbers.episodes.size()))
        .add("path_mm", way_mm)
        .add("mean_speed_mm_per_s", numbers.contact_s > 0.0 ? way_mm / numbers.contact_s : 0.0)
        .add("force_sent_newton", values_json(numbers.sent_newton))
        .add("force_spring_newton", values_json(numbers.spring_newton))
        .add("speed_goal_mm_per_s", values_json(numbers.goal_mm_per_s))
        .add("speed_proxy_mm_per_s", values_json(numbers.proxy_mm_per_s))
        .add("ticks", ticks_json(numbers.ticks));
}

}  // namespace

std::string json_of(const SessionReport& report) {
    const Session& session = report.session;
    const auto mark_json = [&](const SessionMark& mark) {
        return JsonObject()
            .add("t_s", mark.t_s - session.begin_s())
            .add("tag", text_of(mark.tag))
            .add("text", text_of(mark.text))
            .text();
    };
    SessionFacts meanings;
    for (const Definition& each : definitions()) meanings[each.name] = each.meaning;
    JsonObject object;
    object.add("report_version", kReportVersion)
        .add_text("program", report.program)
        .add("session", session_json(report))
        .add("participant", text_of(session.fact("participant")))
        .add("note", text_of(session.fact("note")))
        .add("summary", text_of(summary_of(report)));
    add_numbers(object, report.numbers);
    object.add("episodes", episodes_json(report))
        .add("heat_maps", json_list(report.maps, "  ", map_json))
        .add("parameters", json_list(session.parameters(), "  ", parameters_json))
        .add("sources", json_list(session.sources(), "  ", source_json))
        .add("marks", json_list(session.marks(), "  ", mark_json))
        .add("facts", texts_json(session.facts()))
        .add("definitions", texts_json(meanings));
    return object.text() + "\n";
}

}  // namespace dibhr
