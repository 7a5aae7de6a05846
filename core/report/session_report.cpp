// Measures a session, draws it, and writes the report.
#include "core/report/session_report.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "core/error.hpp"
#include "core/files/output_file.hpp"
#include "core/files/plain_text.hpp"
#include "core/plot/axes.hpp"
#include "core/report/report_plots.hpp"
#include "core/report/report_sentences.hpp"
#include "core/video/sources/media.hpp"

namespace dibhr {

namespace {

constexpr std::size_t kMostMaps = 4;  // one for each of the videos that were touched longest

/// "heat-map", "heat-map-2", ...
std::string map_name(std::size_t number) {
    return number == 1 ? "heat-map" : "heat-map-" + std::to_string(number);
}

std::vector<std::string> all_names() {
    std::vector<std::string> pictures{"force-over-time", "speed-over-time", "force-histogram",
                                      "speed-histogram", "contact-histogram"};
    for (std::size_t number = 1; number <= kMostMaps; ++number)
        pictures.push_back(map_name(number));
    return report_files({"report.html", "report.json"}, pictures);
}

/// A report that is being made: its data, its pictures and the request.
struct ReportDraft {
    SessionReport& report;
    FigureMaker figures;
    const ReportRequest& request;
};

/// A fact that is a whole number of pixels; 0 for any other.
int pixels_of(const std::string& fact) {
    constexpr std::size_t kMostDigits = 5;
    const bool whole = !fact.empty() && fact.size() <= kMostDigits &&
                       fact.find_first_not_of("0123456789") == std::string::npos;
    return whole ? std::stoi(fact) : 0;
}

// 64 MB, for a map whose size only the session gives.
constexpr std::int64_t kMostMapPixels = std::int64_t{16} << 20;

/// The size of the depth image: as its file has it, or as the session says and large enough.
HeatMapGround ground_of(const Session& session, RecordedPicture picture, PixelBounds touched) {
    HeatMapGround ground{std::move(picture.colour), picture.columns, picture.rows};
    if (ground.columns == 0) {
        ground.columns = std::max(pixels_of(session.fact("depth-columns")), touched.right);
        ground.rows = std::max(pixels_of(session.fact("depth-rows")), touched.bottom);
    }
    ground.columns = std::max(ground.columns, 2);
    ground.rows = std::max(ground.rows, 2);
    if (!session.parameters().empty())
        ground.pitch_mm = session.parameters().front().touch.coupling.pixel_pitch_mm;
    return ground;
}

/// What is known of the media; a session may lack it.
SessionSource source_of(const Session& session, std::uint32_t media) {
    const auto is_it = [media](const SessionSource& one) { return one.source.media == media; };
    const auto found = std::ranges::find_if(session.sources(), is_it);
    return found != session.sources().end() ? *found : SessionSource{.source = {.media = media}};
}

// So long that a plot's second line has room for it.
constexpr std::size_t kLongestFile = 36;
constexpr std::size_t kLongestName = 16;

std::string map_caption(const HeatMapFacts& map) {
    std::string caption = "Contact time per pixel over " + number_text(map.contact_s, 1) + " s";
    if (map.remark.empty()) {
        caption += ", over the frame that was touched longest: " +
                   utf8_text(map.source.colour.file.filename().string()) + " at " +
                   number_text(map.frame_s, 3) + " s";
    } else {
        caption += ", over plain ground, for the picture is not there";
    }
    return caption + ". Spread by a Gaussian of " + tick_text(map.sigma_px) +
           " px; the numbers are those of the contacts below.";
}

void draw_map(const ReportDraft& draft, const TouchedPlaces& places, std::uint32_t media) {
    SessionReport& report = draft.report;
    const PixelBounds touched = places.bounds();
    if (touched.right == 0 || !(places.total_s() > 0.0)) return;  // no place that could be shown
    HeatMapFacts map;
    const std::string name = map_name(report.maps.size() + 1);
    map.picture = picture_file(name, draft.request.plot_formats.front());
    map.source = source_of(report.session, media);
    map.frame_s = places.longest_frame_s();
    map.contact_s = places.total_s();
    RecordedPicture picture = draft.request.pictures(map.source, map.frame_s);
    map.remark = picture.remark;
    const std::string warning = picture.warning;
    const bool size_known = picture.columns > 0;
    const HeatMapGround ground = ground_of(report.session, std::move(picture), touched);
    if (!size_known && std::int64_t{ground.columns} * ground.rows > kMostMapPixels) {
        report.remarks.push_back("A heat map was left out: " + std::to_string(ground.columns) +
                                 " x " + std::to_string(ground.rows) +
                                 " pixels are larger than any video, so the session is damaged.");
        return;
    }
    if (!places.touches(ground.columns, ground.rows)) {
        report.remarks.emplace_back(
            "A heat map was left out: every place that was touched lies outside the picture.");
        return;
    }
    if (!warning.empty()) report.remarks.push_back("Of a heat map's picture: " + warning + ".");
    map.columns = ground.columns;
    map.rows = ground.rows;
    map.sigma_px = heat_map_sigma_px(ground.columns);
    const std::string under =
        one_line(report.session.file().filename().string(), kLongestFile) + ", " +
        (map.remark.empty() ? one_line(map.source.colour.file.filename().string(), kLongestFile) +
                                  " at " + number_text(map.frame_s, 2) + " s"
                            : "plain ground") +
        ", " + number_text(map.contact_s, 1) + " s in contact";
    draft.figures.add(name, "Heat map of where the surface was touched", map_caption(map),
                      plot_heat_map(places, ground, report.numbers.episodes, media, under));
    report.maps.push_back(std::move(map));
}

void draw_maps(const ReportDraft& draft) {
    const SessionNumbers& numbers = draft.report.numbers;
    std::vector<std::pair<double, std::uint32_t>> longest;
    for (const auto& [media, places] : numbers.places)
        longest.emplace_back(-places.total_s(), media);
    std::sort(longest.begin(), longest.end());
    if (longest.size() > kMostMaps) longest.resize(kMostMaps);
    for (const auto& [time, media] : longest) draw_map(draft, numbers.places.at(media), media);
}

PlotContext plot_context(const SessionReport& report) {
    const Session& session = report.session;
    std::string subtitle = one_line(session.file().filename().string(), kLongestFile);
    const std::string who = one_line(session.fact("participant"), kLongestName);
    if (!who.empty()) subtitle += ", " + who;
    const auto contacts = static_cast<std::int64_t>(report.numbers.episodes.size());
    subtitle += ", " + counted(contacts, "contact") + ", " +
                number_text(report.numbers.contact_s, 1) + " of " +
                number_text(report.numbers.duration_s, 1) + " s in contact";
    return {subtitle, session.begin_s(), session.marks()};
}

void draw_plots(const ReportDraft& draft) {
    const SessionReport& report = draft.report;
    const SessionNumbers& numbers = report.numbers;
    const FigureMaker& figures = draft.figures;
    const PlotContext context = plot_context(report);
    const std::string range =
        shows_means(numbers.time_line) ? " Pale: the range of the values; dark: the mean." : "";
    figures.add("force-over-time", "Force over time",
                "Spring force and force sent to the hand; below, when there was contact and which "
                "moment of the video was touched. Dashed lines are marks." +
                    range,
                plot_force_over_time(numbers, context));
    const bool speeds = numbers.proxy_mm_per_s.total_s() > 0.0;
    if (speeds)
        figures.add("speed-over-time", "Speed over time",
                    "Speed of the hand and of the point on the surface, while in contact." + range,
                    plot_speed_over_time(numbers, context));
    if (numbers.sent_newton.total_s() > 0.0)
        figures.add("force-histogram", "Histogram of the force sent",
                    "For how long which force was sent while in contact.",
                    plot_force_histogram(numbers, context));
    if (numbers.episodes.empty()) return;
    figures.add("contact-histogram", "Histogram of the contacts' lengths",
                "How many contacts lasted how long (logarithmic).",
                plot_contact_histogram(numbers, context));
    if (speeds)
        figures.add("speed-histogram", "Histogram of the speed",
                    "For how long the point on the surface had which speed.",
                    plot_speed_histogram(numbers, context));
}

}  // namespace

void write_session_report(const Session& session, const ReportRequest& request) {
    if (session.rows() == 0)
        throw InputError(session.file().string() +
                         ": holds no ticks, so there is nothing to report; record it again");
    OutputFolder files(request.folder, all_names());
    SessionReport report{.session = session,
                         .numbers = numbers_of(session, request.progress),
                         .program = request.program,
                         .device_kinds = request.device_kinds};
    const ReportDraft draft{report, {files, request.plot_formats, report.figures}, request};
    draw_maps(draft);
    draw_plots(draft);
    files.add("report.json", json_of(report));
    files.add("report.html", page_of(report));
    files.commit();
}

}  // namespace dibhr
