// Runs the paths that were asked for, then reports.
#include "app/commands/experiment.hpp"

#include <iostream>
#include <optional>
#include <span>
#include <utility>

#include "app/commands/progress_bar.hpp"
#include "core/error.hpp"
#include "core/experiment/experiment.hpp"
#include "core/experiment/plots.hpp"
#include "core/experiment/report.hpp"
#include "core/files/output_folder.hpp"

namespace dibhr {

namespace {

/// The outputs, tried before the work: what cannot be written is said at once.
class Outputs {
  public:
    explicit Outputs(const ExperimentOptions& options) : with_table_(options.json != "-") {
        if (!options.json.empty()) json_.emplace(options.json);
        if (!options.plots.empty()) plots_.emplace(options.plots);
    }

    /// Null where none were asked for.
    OutputFolder* plots() { return plots_ ? &*plots_ : nullptr; }

    void write(const std::string& table, const std::string& json) {
        if (plots_) plots_->commit();
        if (with_table_) std::cout << table << std::flush;
        if (!json_) return;
        json_->write(json);
        json_->commit();
    }

  private:
    std::optional<OutputFile> json_{};
    std::optional<OutputFolder> plots_{};
    bool with_table_{true};
};

std::span<const Algorithm> algorithms_of(const ExperimentOptions& options) {
    if (options.algorithms.empty()) return all_algorithms();
    return options.algorithms;
}

/// Runs one path with a bar of its own.
PathRun run_path(PathRun path, const DepthClip& clip, const ExperimentOptions& options) {
    ProgressBar bar(path.name);
    run_algorithms(path, clip, algorithms_of(options), Timing::careful,
                   [&bar](double share) { bar.show(share); });
    return path;
}

void run_sweep_command(const ExperimentOptions& options, Outputs& outputs) {
    const double clock_us = clock_cost_us();
    const SweepRange range;
    std::vector<SweepPoint> points;
    {
        ProgressBar bar("sweep");
        points =
            run_sweep(range, algorithms_of(options), [&bar](double share) { bar.show(share); });
    }
    if (outputs.plots() != nullptr) {
        write_sweep_plot(points, {*outputs.plots(), options.plot_formats});
    }
    outputs.write(sweep_table_of(points, clock_us), sweep_json_of(points, range.updates, clock_us));
}

void run_paths(const ExperimentOptions& options, Outputs& outputs) {
    const double clock_us = clock_cost_us();
    const bool all = options.path == "all";
    std::vector<PathRun> paths;
    std::optional<SampleClip> sample;
    std::optional<PathRun> human;
    if (all || options.path == "human") {  // first: an unreadable hand is said at once
        const HandInput hand = read_hand(options.human);
        ProgressBar bar("reading the sample");
        sample = read_sample(options.human, [&bar](double share) { bar.show(share); });
        human = human_goals(hand, *sample, options.human.mu);
    }
    const DepthClip plane = paper_plane();
    const double mu = options.human.mu;
    if (all || options.path == "linear") {
        paths.push_back(run_path(linear_path(mu, options.depth_px), plane, options));
    }
    if (all || options.path == "circle") {
        paths.push_back(run_path(circle_path(mu, options.depth_px), plane, options));
    }
    if (human) paths.push_back(run_path(std::move(*human), sample->depth, options));
    if (outputs.plots() != nullptr) {
        write_plots(paths, sample ? &sample->colour : nullptr,
                    {*outputs.plots(), options.plot_formats});
    }
    outputs.write(table_of(paths, clock_us), json_of(paths, clock_us));
}

}  // namespace

int run_experiment(const ExperimentOptions& options) {
    Outputs outputs(options);
    if (options.path == "sweep") {
        run_sweep_command(options, outputs);
    } else {
        run_paths(options, outputs);
    }
    return 0;
}

}  // namespace dibhr
