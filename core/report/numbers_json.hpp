// The report's numbers for scripts: JSON with names that stay, units in them.
#pragma once

#include <string>

#include "core/report/session_report.hpp"

namespace dibhr {

/// `{"report_version", "program", "session": {...}, "participant", "note", "summary",
///   "duration_s", "contact_s", "contact_share", "episode_count", "path_mm", "mean_speed_mm_per_s",
///   "force_sent_newton": VALUES, "force_spring_newton": VALUES, "speed_goal_mm_per_s": VALUES,
///   "speed_proxy_mm_per_s": VALUES, "ticks": {...}, "episodes": [...], "heat_maps": [...],
///   "parameters": [...], "sources": [...], "marks": [...], "facts": {...}, "definitions": {...}}`
/// VALUES is `{"mean", "peak", "median", "p95", "histogram": {"bar_width", "seconds": [...],
/// "beyond_s"}}` over the time in contact, null without any. Times are since the first tick.
[[nodiscard]] std::string json_of(const SessionReport& report);

}  // namespace dibhr
