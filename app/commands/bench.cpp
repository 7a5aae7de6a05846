// Prints what the bench measured: a table for people, JSON for scripts.
#include "app/commands/bench.hpp"

#include <iomanip>
#include <iostream>
#include <optional>
#include <sstream>
#include <string>
#include <utility>

#include "app/commands/bench_measurements.hpp"
#include "core/files/output_file.hpp"

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
    for (const char* head : {"median", "mean", "p99", "p99.9", "max"})
        text << std::setw(11) << head;
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
             << " ticks, " << lateness.late_ticks << " late, 99 % within " << std::setprecision(0)
             << std::fixed << lateness.p99_us << " us, worst " << lateness.worst_us << " us\n"
             << std::defaultfloat << std::setprecision(6);
    }
    return text.str();
}

std::string json_of(const SampleStatistics& s, const std::string& unit) {
    std::ostringstream json;
    json << std::setprecision(17) << "\"median_" << unit << "\": " << s.median << ", \"mean_"
         << unit << "\": " << s.mean << ", \"p99_" << unit << "\": " << s.p99 << ", \"p999_" << unit
         << "\": " << s.p999 << ", \"max_" << unit << "\": " << s.highest
         << ", \"samples\": " << s.count;
    return json.str();
}

std::string json_of(const LoopRun::Lateness& lateness) {
    std::ostringstream json;
    json << "{\"ticks\": " << lateness.ticks << ", \"late_ticks\": " << lateness.late_ticks
         << ", \"p99_us\": " << lateness.p99_us << ", \"max_us\": " << lateness.worst_us << "}";
    return json.str();
}

std::string size_json(int columns, int rows) {
    return "\"columns\": " + std::to_string(columns) + ", \"rows\": " + std::to_string(rows);
}

std::string json_of(const BenchResults& results) {
    std::ostringstream json;
    json << "{\n  \"mu\": " << results.mu << ", \"depth_px\": " << results.depth_px
         << ", \"clock_us\": " << results.clock_us << ",\n  \"updates\": [";
    const char* separator = "\n    ";
    for (const UpdateRun& run : results.updates) {
        json << separator << "{\"algorithm\": \"" << name_of(run.algorithm) << "\", \"path\": \""
             << run.path << "\", " << size_json(run.columns, run.rows) << ", "
             << json_of(run.timing.update_us, "us")
             << ", \"moves\": " << run.timing.moves_per_update << "}";
        separator = ",\n    ";
    }
    json << "\n  ],\n  \"teleports\": [";
    separator = "\n    ";
    for (const TeleportRun& run : results.teleports) {
        json << separator << "{\"where\": \"" << run.where << "\", "
             << size_json(run.columns, run.rows) << ", " << json_of(run.update_us, "us") << "}";
        separator = ",\n    ";
    }
    const HandoverRun& handover = results.handover;
    json << "\n  ],\n  \"handover\": {" << size_json(handover.columns, handover.rows)
         << ",\n    \"cleaning\": {" << json_of(handover.cleaning_ms, "ms")
         << "},\n    \"cleaned_to_touchable\": {" << json_of(handover.cleaned_to_touchable_us, "us")
         << "},\n    \"swap\": {" << json_of(handover.swap_us, "us")
         << "}\n  },\n  \"loops\": {\"seconds\": " << results.loop.seconds
         << ", \"empty\": " << json_of(results.loop.empty)
         << ", \"haptic\": " << json_of(results.loop.haptic) << "}\n}\n";
    return json.str();
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

int run_bench(const BenchOptions& options) {
    std::optional<OutputFile> json;
    if (!options.json.empty())
        json.emplace(options.json);  // before the work: an unwritable file is said at once
    const BenchResults results = measure();
    if (options.json != "-") std::cout << table_of(results);
    if (json) {
        json->write(json_of(results));
        json->commit();
    }
    return 0;
}

}  // namespace dibhr
