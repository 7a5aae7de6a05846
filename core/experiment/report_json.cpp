// The members of the report.
#include "core/experiment/report_json.hpp"

#include <algorithm>
#include <cstdint>

#include "core/experiment/paper_table.hpp"
#include "core/experiment/sweep.hpp"
#include "core/files/json_text.hpp"

namespace dibhr {

namespace {

std::string variation_json(const VariationStatistics& v) {
    return JsonObject()
        .add("mean", v.mean_deg)
        .add("sd", v.sd_deg)
        .add("mean_without_reversals", v.mean_without_reversals_deg)
        .add("sd_without_reversals", v.sd_without_reversals_deg)
        .add("pairs", v.pairs)
        .add("pairs_without_reversals", v.pairs_without_reversals)
        .text();
}

std::string error_json(const ExactError& error) {
    return JsonObject()
        .add("max_px", error.max_px)
        .add("mean_px", error.mean_px)
        .add("max_rad", error.max_rad)
        .add("mean_rad", error.mean_rad)
        .text();
}

std::string paper_json(const PathRun& path, const AlgorithmRun& run) {
    const auto paper = paper_result(path.name, run.algorithm);
    if (!paper) return "null";
    return JsonObject()
        .add("update_us", paper->update_us)
        .add("mean_deg", paper->variation_mean_deg)
        .add("sd_deg", paper->variation_sd_deg)
        .text();
}

std::string run_json(const PathRun& path, const AlgorithmRun& run) {
    const SampleStatistics& time = run.time_us;
    const std::string time_json = JsonObject()
                                      .add("mean", time.mean)
                                      .add("median", time.median)
                                      .add("p99", time.p99)
                                      .add("p999", time.p999)
                                      .add("max", time.highest)
                                      .add("whole_run", run.whole_run_us)
                                      .text();
    const auto contact = std::count(run.contact.begin(), run.contact.end(), char{1});
    return JsonObject()
        .add_text("algorithm", name_of(run.algorithm))
        .add("time_us", time_json)
        .add("moves_per_update", run.moves_per_update)
        .add("contact_updates", static_cast<std::uint64_t>(contact))
        .add("bounds_met", run.bounds_met)
        .add("variation_deg", variation_json(run.variation))
        .add("error", run.error ? error_json(*run.error) : "null")
        .add("paper", paper_json(path, run))
        .text();
}

std::string path_json(const PathRun& path) {
    const auto reversals = std::count(path.reversal.begin(), path.reversal.end(), char{1});
    const std::string runs = json_list(
        path.runs, "      ", [&](const AlgorithmRun& run) { return run_json(path, run); });
    return JsonObject()
        .add_text("path", path.name)
        .add_text("source", path.source)
        .add("mu", path.mu)
        .add("depth_px", path.depth_px)
        .add("columns", path.columns)
        .add("rows", path.rows)
        .add("updates", static_cast<std::uint64_t>(path.goals.size()))
        .add("settling_updates", path.settling_updates)
        .add("reversal_updates", static_cast<std::uint64_t>(reversals))
        .add("exact_variation_deg",
             path.exact_proxies.empty() ? "null" : variation_json(path.exact_variation))
        .add("runs", runs)
        .text();
}

JsonObject cell_object(const SweepPoint& point) {
    JsonObject cell;
    cell.add_text("path", point.path)
        .add("mu", point.mu)
        .add("depth_px", point.depth_px)
        .add_text("algorithm", name_of(point.algorithm));
    return cell;
}

std::string point_json(const SweepPoint& point) {
    return cell_object(point)
        .add("median_us", point.median_us)
        .add("moves_per_update", point.moves_per_update)
        .add("bounds_met", point.bounds_met)
        .add("variation_deg", variation_json(point.variation))
        .add("error", error_json(point.error))
        .text();
}

}  // namespace

std::string json_of(std::span<const PathRun> paths, double clock_us) {
    return JsonObject()
               .add("clock_us", clock_us)
               .add("paths", json_list(paths, "  ", path_json))
               .text() +
           "\n";
}

std::string sweep_json_of(std::span<const SweepPoint> points, int updates, double clock_us) {
    const auto cell_json = [](const SweepPoint& point) { return cell_object(point).text(); };
    return JsonObject()
               .add("clock_us", clock_us)
               .add("updates", updates)
               .add("points", json_list(points, "  ", point_json))
               .add("not_rougher_than_dibhr",
                    json_list(not_rougher_than_dibhr(points), "  ", cell_json))
               .text() +
           "\n";
}

}  // namespace dibhr
