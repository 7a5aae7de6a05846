// Tables and JSON of the evaluation, and what the paper printed.
#include "core/experiment/report.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <sstream>

#include <glm/trigonometric.hpp>

#include "core/experiment/experiment.hpp"
#include "core/files/json.hpp"
#include "core/files/plain_text.hpp"

namespace dibhr {

namespace {

constexpr std::size_t kNameWidth = 16;
constexpr std::size_t kPaperWidth = 15;

/// With few digits, also for small numbers: 0, 3.1e-14, 0.0123, 12.3.
std::string short_number(double value) {
    return short_text(value, std::abs(value) < 1e-3 ? 2 : 3);
}

/// Round-off is shown as 0.
std::string degrees_text(double deg) {
    constexpr double kShown = 1e-9;
    return deg < kShown ? std::string("0") : number_text(deg, 3);
}

/// "0.528 (0.003)".
std::string mean_and_sd(double mean_deg, double sd_deg) {
    return degrees_text(mean_deg) + " (" + degrees_text(sd_deg) + ")";
}

/// The blanks that fill up to `width`; at least one.
std::string blanks_beside(const std::string& text, std::size_t width) {
    return std::string(text.size() < width ? width - text.size() : 1, ' ');
}

std::string right(const std::string& text, std::size_t width) {
    return blanks_beside(text, width) + text;
}

std::string left(const std::string& text, std::size_t width) {
    return text + blanks_beside(text, width);
}

std::string name_cell(const AlgorithmRun& run) {
    return "  " + left(name_of(run.algorithm), kNameWidth);
}

std::string heading_of(const PathRun& path) {
    std::ostringstream text;
    text << path.name << ": " << path.source << ", " << path.columns << "x" << path.rows << ", "
         << path.goals.size() << " updates, mu " << short_number(path.mu) << ", depth "
         << (path.exact_proxies.empty() ? "on average " : "") << short_number(path.depth_px)
         << " px\n";
    return text.str();
}

std::string time_row(const PathRun& path, const AlgorithmRun& run) {
    const auto paper = paper_result(path.name, run.algorithm);
    std::string row = name_cell(run) + right(paper ? number_text(paper->update_us, 2) : "-", 9);
    for (const double us : {run.time_us.mean, run.time_us.median, run.time_us.p99, run.time_us.p999,
                            run.time_us.highest, run.whole_run_us, run.whole_update_us}) {
        row += right(number_text(us, 3), 9);
    }
    return row + right(number_text(run.moves_per_update, 2), 9) +
           right(std::to_string(run.bounds_met), 8) + "\n";
}

std::string variation_row(const PathRun& path, const AlgorithmRun& run) {
    const auto paper = paper_result(path.name, run.algorithm);
    const VariationStatistics& v = run.variation;
    std::string paper_cell = "-";
    if (paper) {
        paper_cell = short_number(paper->variation_mean_deg) + " (" +
                     short_number(paper->variation_sd_deg) + ")";
    }
    std::string row =
        name_cell(run) + right(paper_cell, kPaperWidth) +
        right(mean_and_sd(v.mean_deg, v.sd_deg), 18) +
        right(mean_and_sd(v.mean_without_reversals_deg, v.sd_without_reversals_deg), 18);
    if (run.error) {
        row += right(short_number(run.error->max_px), 12) +
               right(short_number(glm::degrees(run.error->mean_rad)), 11) +
               right(short_number(glm::degrees(run.error->max_rad)), 11);
    } else {
        row += right("-", 12) + right("-", 11) + right("-", 11);
    }
    return row + "\n";
}

std::string exact_row(const PathRun& path) {
    const VariationStatistics& v = path.exact_variation;
    return "  " + left("exact answer", kNameWidth) + right("", kPaperWidth) +
           right(mean_and_sd(v.mean_deg, v.sd_deg), 18) +
           right(mean_and_sd(v.mean_without_reversals_deg, v.sd_without_reversals_deg), 18) + "\n";
}

std::string time_table(std::span<const PathRun> paths) {
    std::string text = "\nTime of an update [us]\n" + left("", kNameWidth + 2);
    for (const char* head :
         {"paper", "mean", "median", "p99", "p99.9", "max", "whole", "+ force", "moves"}) {
        text += right(head, 9);
    }
    text += right("bound", 8) + "\n";
    for (const PathRun& path : paths) {
        text += path.name + "\n";
        for (const AlgorithmRun& run : path.runs) text += time_row(path, run);
    }
    return text;
}

std::string variation_table(std::span<const PathRun> paths) {
    std::string text =
        "\nForce variation [degrees per update], mean (sd), and the error against the exact "
        "answer\n" +
        left("", kNameWidth + 2) + right("paper", kPaperWidth) + right("all", 18) +
        right("sliding", 18) + right("max px", 12) + right("mean deg", 11) + right("max deg", 11) +
        "\n";
    for (const PathRun& path : paths) {
        text += path.name + "\n";
        for (const AlgorithmRun& run : path.runs) text += variation_row(path, run);
        if (!path.exact_proxies.empty()) text += exact_row(path);
    }
    return text;
}

/// All that the sweep found for one path and algorithm.
struct SweepSummary {
    double least_deg{INFINITY};
    double most_deg{0.0};
    double most_px{0.0};
    double most_error_deg{0.0};
    std::uint64_t bounds_met{0};

    void add(const SweepPoint& point) {
        const ExactError error = point.run.error.value_or(ExactError{});
        least_deg = std::min(least_deg, point.run.variation.mean_without_reversals_deg);
        most_deg = std::max(most_deg, point.run.variation.mean_without_reversals_deg);
        most_px = std::max(most_px, error.max_px);
        most_error_deg = std::max(most_error_deg, glm::degrees(error.max_rad));
        bounds_met += point.run.bounds_met;
    }
};

/// How many of `points` are of one path and algorithm.
std::size_t count_of(const char* path, Algorithm algorithm, std::span<const SweepPoint> points) {
    const auto count = std::count_if(points.begin(), points.end(), [&](const SweepPoint& point) {
        return point.path == path && point.run.algorithm == algorithm;
    });
    return static_cast<std::size_t>(count);
}

std::string sweep_row(const char* path, Algorithm algorithm, std::span<const SweepPoint> points,
                      std::span<const SweepPoint> smooth) {
    SweepSummary summary;
    for (const SweepPoint& point : points) {
        if (point.path == path && point.run.algorithm == algorithm) summary.add(point);
    }
    const std::size_t cells = count_of(path, algorithm, points);
    if (cells == 0) return {};
    const std::size_t rougher = cells - count_of(path, algorithm, smooth);
    const std::string rougher_cell =
        algorithm == Algorithm::dibhr ? "-" : std::to_string(rougher) + "/" + std::to_string(cells);
    return "  " + left(path, 8) + left(name_of(algorithm), kNameWidth) +
           right(degrees_text(summary.least_deg), 10) + right(degrees_text(summary.most_deg), 10) +
           right(rougher_cell, 10) + right(short_number(summary.most_px), 12) +
           right(short_number(summary.most_error_deg), 12) +
           right(std::to_string(summary.bounds_met), 8) + "\n";
}

struct Entry {
    std::string_view path;
    Algorithm algorithm;
    PaperResult result;
};

constexpr std::array kTable{
    Entry{"linear", Algorithm::dibhr, {188.61, 0.0, 0.0}},
    Entry{"linear", Algorithm::pga, {43.38, 0.0, 0.0}},
    Entry{"linear", Algorithm::neighborhood, {159.22, 0.0, 0.0}},
    Entry{"circle", Algorithm::dibhr, {207.31, 0.53, 0.85}},
    Entry{"circle", Algorithm::pga, {47.40, 4.13, 6.77}},
    Entry{"circle", Algorithm::neighborhood, {161.31, 7.45, 10.48}},
    Entry{"human", Algorithm::dibhr, {94.21, 1.81, 4.13}},
    Entry{"human", Algorithm::pga, {80.97, 3.01, 7.97}},
    Entry{"human", Algorithm::neighborhood, {81.74, 4.74, 6.39}},
};

Json variation_json(const VariationStatistics& v) {
    return {{"mean", v.mean_deg},
            {"sd", v.sd_deg},
            {"mean_without_reversals", v.mean_without_reversals_deg},
            {"sd_without_reversals", v.sd_without_reversals_deg},
            {"pairs", v.pairs},
            {"pairs_without_reversals", v.pairs_without_reversals}};
}

Json error_json(const ExactError& error) {
    return {{"max_px", error.max_px},
            {"mean_px", error.mean_px},
            {"max_rad", error.max_rad},
            {"mean_rad", error.mean_rad}};
}

Json paper_json(const PathRun& path, const AlgorithmRun& run) {
    const auto paper = paper_result(path.name, run.algorithm);
    if (!paper) return nullptr;
    return {{"update_us", paper->update_us},
            {"mean_deg", paper->variation_mean_deg},
            {"sd_deg", paper->variation_sd_deg}};
}

Json run_json(const PathRun& path, const AlgorithmRun& run) {
    const SampleStatistics& time = run.time_us;
    return {{"algorithm", name_of(run.algorithm)},
            {"time_us",
             {{"mean", time.mean},
              {"median", time.median},
              {"p99", time.p99},
              {"p999", time.p999},
              {"max", time.highest},
              {"whole_run", run.whole_run_us},
              {"whole_update", run.whole_update_us}}},
            {"moves_per_update", run.moves_per_update},
            {"contact_updates", std::count(run.contact.begin(), run.contact.end(), char{1})},
            {"bounds_met", run.bounds_met},
            {"variation_deg", variation_json(run.variation)},
            {"error", run.error ? error_json(*run.error) : Json()},
            {"paper", paper_json(path, run)}};
}

Json path_json(const PathRun& path) {
    return {{"path", path.name},
            {"source", path.source},
            {"mu", path.mu},
            {"depth_px", path.depth_px},
            {"columns", path.columns},
            {"rows", path.rows},
            {"updates", path.goals.size()},
            {"waited_share", path.timed.waited_share()},
            {"settling_updates", path.settling_updates},
            {"reversal_updates", std::count(path.reversal.begin(), path.reversal.end(), char{1})},
            {"exact_variation_deg",
             path.exact_proxies.empty() ? Json() : variation_json(path.exact_variation)},
            {"runs", json_list(path.runs,
                               [&path](const AlgorithmRun& run) { return run_json(path, run); })}};
}

Json cell_json(const SweepPoint& point) {
    return {{"path", point.path},
            {"mu", point.mu},
            {"depth_px", point.depth_px},
            {"algorithm", name_of(point.run.algorithm)}};
}

Json point_json(const SweepPoint& point) {
    Json json = cell_json(point);
    json["median_us"] = point.run.time_us.median;
    json["moves_per_update"] = point.run.moves_per_update;
    json["bounds_met"] = point.run.bounds_met;
    json["variation_deg"] = variation_json(point.run.variation);
    json["error"] = error_json(point.run.error.value_or(ExactError{}));
    return json;
}

}  // namespace

std::string table_of(std::span<const PathRun> paths, double clock_us) {
    std::string text;
    for (const PathRun& path : paths) text += heading_of(path);
    text += time_table(paths);
    text +=
        "  Reading the clock, " + number_text(clock_us, 3) +
        " us, is part of each time except \"whole\": the processor's time of a\n"
        "  whole run, divided by its updates, and the same with the force, its stability and its "
        "limits.\n"
        "  Moves: primitives visited; bound: updates that ended before the proxy had caught up. "
        "Paper: a Pentium\n  D, 3.4 GHz.\n";
    text += variation_table(paths);
    text +=
        "  Sliding: without the updates in which the goal's motion turns by more than 90 degrees "
        "and those\n  until it drags the proxy again, and without the circle's first revolution. "
        "The error is that of\n  the proxy [px] and of the force's direction [degrees].\n";
    return text;
}

std::string sweep_table_of(std::span<const SweepPoint> points, double clock_us) {
    std::string text =
        "Force variation while sliding [degrees per update], over all frictions and depths\n  " +
        left("", 8 + kNameWidth) + right("least", 10) + right("most", 10) + right("rougher", 10) +
        right("max px", 12) + right("max deg", 12) + right("bound", 8) + "\n";
    const auto smooth = not_rougher_than_dibhr(points);
    for (const char* path : {"linear", "circle"}) {
        for (const Algorithm algorithm : all_algorithms()) {
            text += sweep_row(path, algorithm, points, smooth);
        }
    }
    return text +
           "  Rougher: in how many of the cells the force turns more than dibhr's, which is exact: "
           "nothing can be\n  smoother and right. Max px, max deg: worst error of proxy and force "
           "direction against the exact answer.\n  Bound: updates that ended before the proxy "
           "had caught up.\n  Reading the clock, " +
           number_text(clock_us, 3) + " us, is part of the times in the JSON file.\n";
}

std::optional<PaperResult> paper_result(std::string_view path, Algorithm algorithm) noexcept {
    for (const Entry& entry : kTable) {
        if (entry.path == path && entry.algorithm == algorithm) return entry.result;
    }
    return std::nullopt;
}

std::string json_of(std::span<const PathRun> paths, double clock_us) {
    return json_text({{"clock_us", clock_us}, {"paths", json_list(paths, path_json)}});
}

std::string sweep_json_of(std::span<const SweepPoint> points, int updates, double clock_us) {
    return json_text(
        {{"clock_us", clock_us},
         {"updates", updates},
         {"points", json_list(points, point_json)},
         {"not_rougher_than_dibhr", json_list(not_rougher_than_dibhr(points), cell_json)}});
}

}  // namespace dibhr
