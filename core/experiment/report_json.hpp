// The report for scripts: JSON with names that stay.
#pragma once

#include <span>
#include <string>

#include "core/experiment/experiment.hpp"

namespace dibhr {

/// `{"clock_us", "paths": [{"path", "source", "mu", "depth_px", "columns", "rows", "updates",
///   "settling_updates", "reversal_updates", "exact_variation_deg": VARIATION or null,
///   "runs": [{"algorithm", "time_us": {"mean", "median", "p99", "p999", "max", "whole_run"},
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
