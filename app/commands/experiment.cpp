// `dibhr experiment`: the paper's evaluation, all algorithms side by side. Runs the requested
// paths, then prints the report.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "app/commands/command_line.hpp"
#include "app/commands/experiment_human.hpp"
#include "app/commands/output.hpp"
#include "app/settings/command_options.hpp"
#include "core/experiment/experiment.hpp"
#include "core/experiment/plots.hpp"
#include "core/experiment/report.hpp"
#include "core/files/output_file.hpp"
#include "core/files/plain_text.hpp"

namespace dibhr {

namespace {

struct ExperimentOptions {
    std::string path{"all"};        ///< linear, circle, human, all or sweep
    std::filesystem::path json{};   ///< empty: none; "-": standard output, and no table
    std::filesystem::path plots{};  ///< a folder; empty: none
    std::vector<PlotFormat> plot_formats{PlotFormat::png};
    std::vector<Algorithm> algorithms{};  ///< empty: all
    std::optional<double> depth_px{};     ///< of linear and circle; nothing: 20
    std::optional<double> mu{};           ///< of all paths; nothing: 0.4
    HumanOptions human{};
};

/// The outputs, opened before the work, so that errors are reported at once.
class Outputs {
  public:
    explicit Outputs(const ExperimentOptions& options) : with_table_(options.json != "-") {
        if (!options.json.empty()) json_.emplace(options.json);
        if (!options.plots.empty()) plots_.emplace(options.plots);
    }

    /// Null: none requested.
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
    TimeTaken timed;
    for (const SweepPoint& point : points) timed += point.timed;
    print_warning(busy_machine_text(timed));
    outputs.write(sweep_table_of(points, clock_us), sweep_json_of(points, range.updates, clock_us));
}

void run_paths(const ExperimentOptions& options, Outputs& outputs) {
    const double clock_us = clock_cost_us();
    const bool all = options.path == "all";
    const double mu = options.mu.value_or(kExperimentFriction);
    const double depth_px = options.depth_px.value_or(kExperimentDepth_px);
    std::vector<PathRun> paths;
    std::optional<SampleClip> sample;
    std::optional<PathRun> human;
    if (all || options.path == "human") {  // first: reports an unreadable hand at once
        const HandInput hand = read_hand(options.human);
        ProgressBar bar("reading the sample");
        sample = read_sample(options.human, [&bar](double share) { bar.show(share); });
        human = human_goals(hand, *sample, mu);
    }
    const DepthClip plane = paper_plane();
    if (all || options.path == "linear")
        paths.push_back(run_path(linear_path(mu, depth_px), plane, options));
    if (all || options.path == "circle")
        paths.push_back(run_path(circle_path(mu, depth_px), plane, options));
    if (human) paths.push_back(run_path(std::move(*human), sample->depth, options));
    if (outputs.plots() != nullptr) {
        write_plots(paths, sample ? &sample->colour : nullptr,
                    {*outputs.plots(), options.plot_formats});
    }
    TimeTaken timed;
    for (const PathRun& path : paths) timed += path.timed;
    print_warning(busy_machine_text(timed));
    outputs.write(table_of(paths, clock_us), json_of(paths, clock_us));
}

void add_options(CLI::App& app, ExperimentOptions& options) {
    add_choice_option(
        app, "PATH", {"linear", "circle", "human", "all", "sweep"},
        "linear, circle, human, all of them, or sweep: every friction with every depth",
        [&options](const std::string& path) { options.path = path; })
        ->type_name("")
        ->default_str("all");
    add_file(app, "--json", options.json, "Writes all numbers as JSON; - is standard output");
    add_file(app, "--plots", options.plots, "Writes pictures into this folder", "DIR");
    add_plot_format_option(app, options.plot_formats)->needs("--plots");
    add_file(app, "--session", options.human.session,
             "For human: takes the hand of this recorded session");
    add_file(
        app, "--trace", options.human.trace,
        "For human: takes the trace of a pen or a mouse (CSV: "
        "t_s,x_mm,y_mm[,pressure01][,pen_down]); without --session and --trace a modelled hand");
    add_algorithms_option(app, options.algorithms);
    TouchParameters any;
    const TouchNumber& friction = number_of(any.friction.static_coefficient, any);
    add_number_option(app, "--friction,--mu", friction.lowest, friction.highest,
                      "Coefficient of friction, not for sweep",
                      [&options](double mu) { options.mu = mu; })
        ->type_name("MU")
        ->default_str(number_text(kExperimentFriction));
    add_number_option(app, "--depth", 0.1, 1000.0,
                      "How deep the goals of linear and circle are below the surface",
                      [&options](double depth_px) { options.depth_px = depth_px; })
        ->type_name("PX")
        ->default_str(number_text(kExperimentDepth_px));
    add_touch_option(app, number_of(any.shape.relief_px, any),
                     "Elevation of the sample's nearest depth, for human",
                     [&options](double relief_px) { options.human.shape.relief_px = relief_px; });
    app.add_flag("--raw-depth", options.human.raw_depth, "The sample's depth without cleaning");
    app.footer(
        "Human is 20 s on the built-in sample; the trace's full pressure is 25 px below the "
        "surface.\n"
        "JSON: clock_us and paths, each with path, source, mu, depth_px, updates,\n"
        "exact_variation_deg and runs, each with algorithm, time_us, variation_deg, error, paper,\n"
        "moves_per_update and bounds_met; of sweep: points and not_rougher_than_dibhr.\n"
        "Examples:\n"
        "  dibhr experiment --plots pictures --json numbers.json\n"
        "  dibhr experiment human --trace pen.csv\n"
        "  dibhr experiment circle --friction 0.8 --depth 5 --algorithm dibhr --algorithm pga\n"
        "  dibhr experiment sweep --json sweep.json --plots pictures\n"
        "  dibhr experiment circle --plots pictures --plot-format pdf,svg");
}

/// Throws UsageError for options that do not go together; keeps each algorithm once.
void check_options(ExperimentOptions& options) {
    const std::string& path = options.path;
    const bool has_session = !options.human.session.empty();
    const bool has_trace = !options.human.trace.empty();
    if ((has_session || has_trace) && path != "human" && path != "all")
        throw UsageError("--session and --trace give the hand for human, not for " + path +
                         " (see dibhr experiment --help)");
    if (has_session && has_trace)
        throw UsageError(
            "--session and --trace both give a hand; give only one of them (see dibhr experiment "
            "--help)");
    if (path == "sweep" && (options.mu || options.depth_px))
        throw UsageError(
            "sweep goes through its own --friction and --depth; leave them out (see dibhr "
            "experiment --help)");
    std::vector<Algorithm>& all = options.algorithms;
    for (auto one = all.begin(); one != all.end(); ++one)
        all.erase(std::remove(one + 1, all.end(), *one), all.end());
}

}  // namespace

int run_experiment(CLI::App& app, const Arguments& arguments) {
    ExperimentOptions options;
    add_options(app, options);
    if (!parse(app, arguments)) return 0;
    check_options(options);
    Outputs outputs(options);
    if (options.path == "sweep")
        run_sweep_command(options, outputs);
    else
        run_paths(options, outputs);
    return 0;
}

}  // namespace dibhr
