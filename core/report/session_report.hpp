// A session as a report: pictures, one page that opens anywhere, and the numbers for scripts.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/plot/canvas.hpp"
#include "core/report/page_parts.hpp"
#include "core/report/session_numbers.hpp"
#include "core/session/session.hpp"
#include "core/video/frames/frame_window.hpp"

namespace dibhr {

/// A video's picture at a moment, if its files still exist.
struct RecordedPicture {
    ColourImage colour{};     ///< empty: not known
    int columns{0}, rows{0};  ///< of the depth image; 0: not known
    std::string remark{};     ///< why there is none, in a plain sentence
    std::string warning{};    ///< why the picture may be wrong, likewise
};

/// The picture shown at `media_s` of what ticks touched.
using RecordedPictures = std::function<RecordedPicture(const SessionSource&, double media_s)>;

/// A heat map's facts.
struct HeatMapFacts {
    std::string picture{};  ///< its file
    SessionSource source{};
    std::string remark{};  ///< why it lies over plain ground; empty: it lies over the frame
    double frame_s{0.0};   ///< presentation time of the frame that was touched longest
    double contact_s{0.0};
    int columns{0}, rows{0};  ///< of the depth image, or of what is known of it
    double sigma_px{0.0};
};

/// The data of the page and the JSON.
struct SessionReport {
    const Session& session;
    SessionNumbers numbers{};
    std::vector<HeatMapFacts> maps{};
    std::vector<Figure> figures{};
    std::string program{};                    ///< that made the report, with its version
    std::vector<std::string> remarks{};       ///< on the pictures, in plain sentences
    std::vector<std::string> device_kinds{};  ///< as in ReportRequest
};

struct Fields;
// Fields for the page and the JSON: of the contact with index `k`, a mark, a version of the
// parameters.
[[nodiscard]] Fields episode_fields(const SessionReport& report, std::size_t k);
[[nodiscard]] Fields mark_fields(const SessionReport& report, const SessionMark& mark);
[[nodiscard]] Fields parameters_fields(const SessionReport& report, SessionParameters parameters);

struct ReportRequest {
    std::filesystem::path folder{};
    std::string program{};
    RecordedPictures pictures{};
    std::function<void(double)> progress{};  ///< called with the share done; may be empty
    std::vector<PlotFormat> plot_formats{PlotFormat::png};
    std::vector<std::string> device_kinds{};  ///< "falcon", as in the fact "falcon-serial"
};

/// Reads the session once and writes `report.html`, `report.json` and the pictures into the folder,
/// all of them or none. Throws InputError: what, which file, what to do next.
void write_session_report(const Session& session, const ReportRequest& request);

/// `{"report_version", "program", "session": {...}, "participant", "note", "summary",
///   "duration_s", "contact_s", "contact_share", "episode_count", "path_mm", "mean_speed_mm_per_s",
///   "force_sent_newton": VALUES, "force_spring_newton": VALUES, "speed_goal_mm_per_s": VALUES,
///   "speed_proxy_mm_per_s": VALUES, "ticks": {...}, "episodes": [...], "heat_maps": [...],
///   "parameters": [...], "sources": [...], "marks": [...], "facts": {...}, "definitions": {...}}`
/// VALUES is `{"mean", "peak", "median", "p95", "histogram": {"bar_width", "seconds": [...],
/// "beyond_s"}}` over the time in contact, null without any. Times are since the first tick.
[[nodiscard]] std::string json_of(const SessionReport& report);

/// HTML5, pictures and style inside, no script; light and dark, on a screen and on paper. Whatever
/// text the session holds is shown as text.
[[nodiscard]] std::string page_of(const SessionReport& report);

}  // namespace dibhr
