// Times the algorithms on every ground; the results as table and JSON.
#include "app/commands/bench_updates.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string_view>
#include <utility>

#include "app/commands/output.hpp"
#include "app/settings/assets_path.hpp"
#include "core/experiment/grounds.hpp"
#include "core/experiment/report.hpp"
#include "core/files/plain_text.hpp"
#include "core/haptics/touch.hpp"
#include "core/video/sources/media.hpp"

namespace dibhr {

namespace {

constexpr std::string_view kFlat = "bit-flat";  // the ground of "updates" and "teleports"

PathCost cost_of(const Ground& ground, PathRun path) {
    run_algorithms(path, ground.clip, all_algorithms(), Timing::careful);
    PathCost cost{ground.name, path.name, path.columns, path.rows, path.depth_px};
    cost.algorithms.assign(path.runs.begin(), path.runs.end());
    cost.timed = path.timed;
    return cost;
}

double update_ns(const RunFigures& run) {
    return 1e3 * run.whole_run_us;
}

double move_ns(const RunFigures& run) {
    return update_ns(run) / run.moves_per_update;
}

CatchUpCost cost_of(const Ground& ground, const Jump& jump, Algorithm which) {
    constexpr int kJumps = 50;
    constexpr int kMostUpdates = 100000;  // ends the wait for one that never catches up
    const Friction friction{kExperimentFriction, kExperimentFriction};
    const DepthSurface surface = ground.clip.at(0.0);
    const auto algorithm = make_algorithm(which);
    algorithm->update(surface, jump.from, friction);
    CatchUpCost cost{which};
    std::vector<double> first_us;
    std::vector<double> slowest_us;
    for (int k = 0; k < kJumps; ++k) {
        const Vec3 goal = k % 2 == 0 ? jump.to : jump.from;
        int updates = 0;
        for (bool behind = true; behind && updates < kMostUpdates; ++updates) {
            const Stopwatch watch;
            behind = algorithm->update(surface, goal, friction).bound_met;
            const TimeTaken taken = watch.taken();
            // The processor's clock has what reading it costs, but not what another program took.
            const double us = std::min(taken.wall_us, taken.processor_us);
            if (updates == 0) {
                first_us.push_back(us);
                slowest_us.push_back(us);
            }
            slowest_us.back() = std::max(slowest_us.back(), us);
        }
        cost.most_updates = std::max(cost.most_updates, updates);
    }
    cost.first_us = statistics_of(std::move(first_us));
    cost.slowest_us = statistics_of(std::move(slowest_us));
    return cost;
}

JumpCost cost_of(const Ground& ground, const Jump& jump) {
    JumpCost cost{ground.name, jump.name, ground.clip.columns(), ground.clip.rows()};
    for (const Algorithm algorithm : all_algorithms())
        cost.algorithms.push_back(cost_of(ground, jump, algorithm));
    return cost;
}

void measure(const Ground& ground, UpdateCosts& costs) {
    for (const PathRun& path : ground.paths) costs.paths.push_back(cost_of(ground, path));
    for (const Jump& jump : ground.jumps) costs.jumps.push_back(cost_of(ground, jump));
}

/// Extra time of DIBHR's updates, for each extra TRIANGLE that they cross, when the hand goes four
/// times as fast over a plane.
double coplanar_crossing_ns(const Ground& flat) {
    constexpr Algorithm kDibhr[]{Algorithm::dibhr};
    const auto run_at = [&](double step_px) {
        PathRun path = slanted_path(flat.clip, step_px);
        run_algorithms(path, flat.clip, kDibhr, Timing::careful);
        return path.runs.front();
    };
    constexpr double kMovesPerCrossing = 2.0;  // the EDGE, and the TRIANGLE behind it
    const AlgorithmRun slow = run_at(kHandStep_px);
    const AlgorithmRun fast = run_at(4.0 * kHandStep_px);
    return 1e3 * kMovesPerCrossing * (fast.whole_run_us - slow.whole_run_us) /
           (fast.moves_per_update - slow.moves_per_update);
}

std::optional<double> paper_dibhr_to_pga(std::string_view path) {
    const auto dibhr = paper_result(path, Algorithm::dibhr);
    const auto pga = paper_result(path, Algorithm::pga);
    if (!dibhr || !pga) return std::nullopt;
    return dibhr->update_us / pga->update_us;
}

std::string right(const std::string& text, std::size_t width) {
    return std::string(width - std::min(width, text.size()), ' ') + text;
}

std::string left(const std::string& text, std::size_t width) {
    return text + std::string(width - std::min(width, text.size()), ' ');
}

constexpr std::size_t kNameWidth = 28;
constexpr std::size_t kCellWidth = 18;
constexpr std::size_t kRatioWidth = 14;

std::string name_cell(const std::string& ground, const std::string& path, int columns, int rows) {
    return "  " + left(left(ground, 10) + left(path, 8) + size_text(columns, rows), kNameWidth);
}

std::string head() {
    std::string text = "  " + std::string(kNameWidth, ' ');
    for (const Algorithm algorithm : all_algorithms())
        text += right(name_of(algorithm), kCellWidth);
    return text;
}

/// A row for each cost, its name and then a cell for each algorithm.
template <typename Cost, typename Cell>
std::string row_of(const Cost& cost, const std::string& path, Cell&& cell) {
    std::string row = name_cell(cost.ground, path, cost.columns, cost.rows);
    for (const auto& algorithm : cost.algorithms) row += right(cell(algorithm), kCellWidth);
    return row;
}

std::string mean_table(const UpdateCosts& costs) {
    std::string text = "The walk of an update on average [ns] = moves x time of a move; friction " +
                       short_text(kExperimentFriction) + ", " + short_text(kExperimentDepth_px) +
                       " px deep, 700 mm/s\n" + head() + right("dibhr : pga", kRatioWidth) + "\n";
    for (const PathCost& cost : costs.paths) {
        text += row_of(cost, cost.path,
                       [](const RunFigures& run) {
                           const double ns = move_ns(run);
                           return number_text(update_ns(run), 0) + " = " +
                                  number_text(run.moves_per_update, 1) + " x " +
                                  number_text(ns, ns < 100.0 ? 1 : 0);
                       }) +
                right(number_text(cost.dibhr_to_pga(), 2), kRatioWidth) + "\n";
    }
    for (const char* path : {"linear", "circle"})
        text += name_cell("the paper", path, kPaperColumns, kPaperRows) +
                std::string(kCellWidth * all_algorithms().size(), ' ') +
                right(number_text(paper_dibhr_to_pga(path).value_or(0.0), 2), kRatioWidth) + "\n";
    return text + "  DIBHR from a TRIANGLE to the next one of its plane, two moves: " +
           number_text(costs.crossing_ns, 1) + " ns in this run, the least a crossing can take\n" +
           "  Two blended images each. near-flat: a 16-bit level of noise; bumpy: 16-bit waves; "
           "bump map: 2 px of\n  white noise, stretched; crease: along one; sample: the built-in "
           "video, cleaned and playing\n";
}

std::string whole_table(const UpdateCosts& costs) {
    std::string text =
        "\nThe whole update of a tick on average [ns]: as above, with the force, its stability and "
        "its limits\n" +
        head() + "\n";
    for (const PathCost& cost : costs.paths)
        text += row_of(cost, cost.path,
                       [](const RunFigures& run) {
                           return number_text(1e3 * run.whole_update_us, 0);
                       }) +
                "\n";
    return text;
}

std::string single_table(const UpdateCosts& costs) {
    std::string text = "\nSingle updates [us], 99 % within / slowest (reading the clock, " +
                       short_text(costs.clock_us, 2) + " us, is part of each)\n" + head() + "\n";
    for (const PathCost& cost : costs.paths) {
        text += row_of(cost, cost.path,
                       [](const RunFigures& run) {
                           return number_text(run.time_us.p99, 2) + " / " +
                                  number_text(run.time_us.highest, 1);
                       }) +
                "\n";
    }
    return text;
}

std::string jump_table(const UpdateCosts& costs) {
    std::string text =
        "\nA goal that jumps across the image: a jump's slowest update [us], median / worst of all "
        "jumps; updates until the proxy is there\n" +
        head() + "\n";
    for (const JumpCost& cost : costs.jumps) {
        text += row_of(cost, cost.jump,
                       [](const CatchUpCost& jump) {
                           return number_text(jump.slowest_us.median, 0) + " / " +
                                  number_text(jump.slowest_us.highest, 0) + "; " +
                                  std::to_string(jump.most_updates);
                       }) +
                "\n";
    }
    return text;
}

Json json_of(const PathCost& cost) {
    Json algorithms = Json::array();
    for (const RunFigures& run : cost.algorithms) {
        algorithms.push_back({{"algorithm", name_of(run.algorithm)},
                              {"update_ns", update_ns(run)},
                              {"moves", run.moves_per_update},
                              {"move_ns", move_ns(run)},
                              {"whole_update_ns", 1e3 * run.whole_update_us},
                              {"single", json_of(run.time_us, "us")},
                              {"bounds_met", run.bounds_met}});
    }
    const auto paper = paper_dibhr_to_pga(cost.path);
    return {{"ground", cost.ground},
            {"path", cost.path},
            {"columns", cost.columns},
            {"rows", cost.rows},
            {"depth_px", cost.depth_px},
            {"waited_share", cost.timed.waited_share()},
            {"dibhr_to_pga", cost.dibhr_to_pga()},
            {"paper_dibhr_to_pga", paper ? Json(*paper) : Json(nullptr)},
            {"algorithms", std::move(algorithms)}};
}

Json json_of(const JumpCost& cost) {
    Json algorithms = Json::array();
    for (const CatchUpCost& jump : cost.algorithms) {
        algorithms.push_back({{"algorithm", name_of(jump.algorithm)},
                              {"first_update", json_of(jump.first_us, "us")},
                              {"slowest_update", json_of(jump.slowest_us, "us")},
                              {"updates_to_catch_up", jump.most_updates}});
    }
    return {{"ground", cost.ground},
            {"jump", cost.jump},
            {"columns", cost.columns},
            {"rows", cost.rows},
            {"algorithms", std::move(algorithms)}};
}

Json with_size(Json json, int columns, int rows, const SampleStatistics& us) {
    json["columns"] = columns;
    json["rows"] = rows;
    json.update(json_of(us, "us"));
    return json;
}

}  // namespace

double PathCost::dibhr_to_pga() const {
    const auto of = [this](Algorithm algorithm) {
        return update_ns(*std::ranges::find(algorithms, algorithm, &RunFigures::algorithm));
    };
    return of(Algorithm::dibhr) / of(Algorithm::pga);
}

UpdateCosts measure_updates() {
    UpdateCosts costs;
    costs.clock_us = clock_cost_us();
    for (const MakeGround make : made_grounds()) {
        const Ground ground = make();
        if (costs.paths.empty()) costs.crossing_ns = coplanar_crossing_ns(ground);
        measure(ground, costs);
    }
    measure(video_ground("sample", read_depth_clip(open_depth(sample_files().depth), {}, {}, {})),
            costs);
    return costs;
}

Json json_of(const SampleStatistics& s, const std::string& unit) {
    return {{"median_" + unit, s.median}, {"mean_" + unit, s.mean},   {"p99_" + unit, s.p99},
            {"p999_" + unit, s.p999},     {"max_" + unit, s.highest}, {"samples", s.count}};
}

std::string table_of(const UpdateCosts& costs) {
    return mean_table(costs) + whole_table(costs) + single_table(costs) + jump_table(costs);
}

void add_to_json(const UpdateCosts& costs, Json& json) {
    Json updates = Json::array();
    Json teleports = Json::array();
    Json grounds = Json::array();
    Json jumps = Json::array();
    for (const PathCost& cost : costs.paths) {
        grounds.push_back(json_of(cost));
        if (cost.ground != kFlat) continue;
        for (const RunFigures& run : cost.algorithms) {
            Json row = with_size({{"algorithm", name_of(run.algorithm)}, {"path", cost.path}},
                                 cost.columns, cost.rows, run.time_us);
            row["moves"] = run.moves_per_update;
            updates.push_back(std::move(row));
        }
    }
    for (const JumpCost& cost : costs.jumps) {
        jumps.push_back(json_of(cost));
        if (cost.ground != kFlat) continue;
        teleports.push_back(with_size({{"where", cost.jump}}, cost.columns, cost.rows,
                                      cost.algorithms.front().first_us));
    }
    json["updates"] = std::move(updates);
    json["teleports"] = std::move(teleports);
    json["grounds"] = std::move(grounds);
    json["jumps"] = std::move(jumps);
    json["coplanar_crossing_ns"] = costs.crossing_ns;
}

}  // namespace dibhr
