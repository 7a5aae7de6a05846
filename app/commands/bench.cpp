// Prints what the bench measured: a table for people, JSON for scripts.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <optional>
#include <sstream>
#include <string>
#include <utility>

#include "app/commands/bench_measurements.hpp"
#include "app/commands/command_line.hpp"
#include "core/files/json.hpp"
#include "core/files/output_file.hpp"
#include "core/files/plain_text.hpp"

namespace dibhr {

namespace {

struct Size {
    int columns, rows;
};
constexpr Size kPaper{720, 486};
constexpr Size kLarge{7680, 4320};
constexpr double kLoopSeconds = 5.0;

std::string size_text(int columns, int rows) {
    return std::to_string(columns) + "x" + std::to_string(rows);
}

std::string row(const std::string& name, const SampleStatistics& s, const std::string& unit) {
    std::ostringstream line;
    line << "  " << std::left << std::setw(38) << name << std::right << std::fixed
         << std::setprecision(3);
    for (const double value : {s.median, s.mean, s.p99, s.p999, s.highest})
        line << std::setw(11) << value;
    line << "  " << unit << '\n';
    return line.str();
}

std::string table_of(const BenchResults& results) {
    std::ostringstream text;
    text << "  " << std::left << std::setw(38) << "" << std::right;
    for (const char* head : {"median", "mean", "p99", "p99.9", "max"}) {
        text << std::setw(11) << head;
    }
    text << "\n\nUpdate, mu " << results.mu << ", depth " << results.depth_px
         << " px, two blended images (reading the clock, " << results.clock_us
         << " us, is part of each)\n";
    for (const UpdateRun& run : results.updates) {
        text << row(
            name_of(run.algorithm) + (" " + run.path) + " " + size_text(run.columns, run.rows),
            run.timing.update_us, "us");
    }
    text << "\nA goal that jumps from corner to corner\n";
    for (const TeleportRun& run : results.teleports) {
        text << row("in " + run.where + " " + size_text(run.columns, run.rows), run.update_us,
                    "us");
    }
    const HandoverRun& handover = results.handover;
    text << "\nA new depth frame of " << size_text(handover.columns, handover.rows) << '\n'
         << row("cleaning", handover.cleaning_ms, "ms")
         << row("from cleaned to touchable", handover.cleaned_to_touchable_us, "us")
         << row("its swap in the tick", handover.swap_us, "us");
    const LoopRun& loop = results.loop;
    text << "\n1 kHz loops side by side for " << loop.seconds << " s, 640x480 video at 30 fps\n";
    for (const auto& [name, lateness] :
         {std::pair{"empty loop", loop.empty}, std::pair{"haptic loop", loop.haptic}}) {
        text << "  " << std::left << std::setw(16) << name << std::right << lateness.ticks
             << " ticks, " << lateness.late_ticks << " late, 99 % within "
             << number_text(lateness.p99_us, 0) << " us, worst "
             << number_text(lateness.worst_us, 0) << " us\n";
    }
    return text.str();
}

Json json_of(const SampleStatistics& s, const std::string& unit) {
    return {{"median_" + unit, s.median}, {"mean_" + unit, s.mean},   {"p99_" + unit, s.p99},
            {"p999_" + unit, s.p999},     {"max_" + unit, s.highest}, {"samples", s.count}};
}

Json json_of(const LoopRun::Lateness& lateness) {
    return {{"ticks", lateness.ticks},
            {"late_ticks", lateness.late_ticks},
            {"p99_us", lateness.p99_us},
            {"max_us", lateness.worst_us}};
}

Json json_of(const UpdateRun& run) {
    Json json{{"algorithm", name_of(run.algorithm)},
              {"path", run.path},
              {"columns", run.columns},
              {"rows", run.rows}};
    json.update(json_of(run.timing.update_us, "us"));
    json["moves"] = run.timing.moves_per_update;
    return json;
}

Json json_of(const TeleportRun& run) {
    Json json{{"where", run.where}, {"columns", run.columns}, {"rows", run.rows}};
    json.update(json_of(run.update_us, "us"));
    return json;
}

Json json_of(const BenchResults& results) {
    Json updates = Json::array();
    for (const UpdateRun& run : results.updates) updates.push_back(json_of(run));
    Json teleports = Json::array();
    for (const TeleportRun& run : results.teleports) teleports.push_back(json_of(run));
    const HandoverRun& handover = results.handover;
    const LoopRun& loop = results.loop;
    return {{"mu", results.mu},
            {"depth_px", results.depth_px},
            {"clock_us", results.clock_us},
            {"updates", std::move(updates)},
            {"teleports", std::move(teleports)},
            {"handover",
             {{"columns", handover.columns},
              {"rows", handover.rows},
              {"cleaning", json_of(handover.cleaning_ms, "ms")},
              {"cleaned_to_touchable", json_of(handover.cleaned_to_touchable_us, "us")},
              {"swap", json_of(handover.swap_us, "us")}}},
            {"loops",
             {{"seconds", loop.seconds},
              {"empty", json_of(loop.empty)},
              {"haptic", json_of(loop.haptic)}}}};
}

BenchResults measure() {
    BenchResults results;
    results.clock_us = clock_cost_us();
    std::cerr << "Timing updates..." << std::flush;
    for (const Size& size : {kPaper, kLarge}) {
        for (UpdateRun& run : measure_updates(results, size.columns, size.rows)) {
            results.updates.push_back(std::move(run));
        }
    }
    results.teleports = measure_teleports(results, kLarge.columns, kLarge.rows);
    std::cerr << " frame hand-over..." << std::flush;
    results.handover = measure_handover(kPaper.columns, kPaper.rows);
    std::cerr << " loops..." << std::flush;
    results.loop = measure_loops(kLoopSeconds);
    std::cerr << " done.\n";
    return results;
}

}  // namespace

int run_bench(CLI::App& app, const Arguments& arguments) {
    std::filesystem::path file;
    add_file(app, "--json", file, "Writes the numbers as JSON; - is standard output");
    if (!parse(app, arguments)) return 0;
    std::optional<OutputFile> json;
    if (!file.empty()) json.emplace(file);  // before the work: an unwritable file is said at once
    const BenchResults results = measure();
    if (file != "-") std::cout << table_of(results);
    if (json) {
        json->write(json_text(json_of(results)));
        json->commit();
    }
    return 0;
}

}  // namespace dibhr
