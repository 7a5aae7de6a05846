// The report: aligned tables of plain text for people, JSON with stable names for scripts.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/experiment/experiment.hpp"
#include "core/haptics/parameters.hpp"

namespace dibhr {

/// The paper's Table 1 beside ours; `clock_us` is what reading the clock costs.
[[nodiscard]] std::string table_of(std::span<const PathRun> paths, double clock_us);

/// The sweep in short: for each path and algorithm the range of the variation over all frictions
/// and depths, the worst error, and where an algorithm is not rougher than DIBHR.
[[nodiscard]] std::string sweep_table_of(std::span<const SweepPoint> points, double clock_us);

/// Cha, Eid and El Saddik 2008, Table 1: an update on a Pentium D of 3.4 GHz.
struct PaperResult {
    double update_us{0.0};
    double variation_mean_deg{0.0};
    double variation_sd_deg{0.0};
};

/// Nothing for what the paper did not run: the god-object.
[[nodiscard]] std::optional<PaperResult> paper_result(std::string_view path,
                                                      Algorithm algorithm) noexcept;

/// `{"clock_us", "paths": [{"path", "source", "mu", "depth_px", "columns", "rows", "updates",
///   "waited_share", "settling_updates", "reversal_updates", "exact_variation_deg": VARIATION or
///   null, "runs": [{"algorithm", "time_us": {"mean", "median", "p99", "p999", "max", "whole_run",
///     "whole_update"},
///     "moves_per_update", "contact_updates", "bounds_met", "variation_deg": VARIATION,
///     "error": ERROR or null, "paper": {"update_us", "mean_deg", "sd_deg"} or null}]}]}`
/// VARIATION is `{"mean", "sd", "mean_without_reversals", "sd_without_reversals", "pairs",
/// "pairs_without_reversals"}`, ERROR `{"max_px", "mean_px", "max_rad", "mean_rad"}`.
[[nodiscard]] std::string json_of(std::span<const PathRun> paths, double clock_us);

/// `{"clock_us", "updates", "points": [{"path", "mu", "depth_px", "algorithm", "median_us",
///   "moves_per_update", "bounds_met", "variation_deg": VARIATION, "error": ERROR}],
///   "not_rougher_than_dibhr": [{"path", "mu", "depth_px", "algorithm"}]}`
[[nodiscard]] std::string sweep_json_of(std::span<const SweepPoint> points, int updates,
                                        double clock_us);

}  // namespace dibhr
