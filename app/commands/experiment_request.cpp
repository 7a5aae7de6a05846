// The options of `dibhr experiment` and what refuses them.
#include "app/commands/experiment_request.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "app/settings/command_options.hpp"

namespace dibhr {

namespace {

constexpr std::array<std::string_view, 5> kPaths{"linear", "circle", "human", "all", "sweep"};
constexpr double kHighestFriction = 5.0;
constexpr double kLeastDepth_px = 0.1;
constexpr double kMostDepth_px = 1000.0;
constexpr double kHighestRelief_px = 4096.0;

void check_path(const std::string& path) {
    if (std::find(kPaths.begin(), kPaths.end(), path) != kPaths.end()) return;
    std::string choices;
    for (const std::string_view name : kPaths) {
        choices += (choices.empty() ? "" : ", ") + std::string(name);
    }
    throw CLI::ValidationError("PATH", "'" + path + "' is none of " + choices);
}

void add_numbers(CLI::App& app, ExperimentRequest& request) {
    app.add_option_function<std::string>(
           "--friction,--mu",
           [&request](const std::string& text) {
               request.options.human.mu = parse_number("--friction", text, 0.0, kHighestFriction);
               request.mu_given = true;
           },
           "Coefficient of friction, 0 to 5; not for sweep")
        ->type_name("MU")
        ->default_str("0.4");
    app.add_option_function<std::string>(
           "--depth",
           [&request](const std::string& text) {
               request.options.depth_px =
                   parse_number("--depth", text, kLeastDepth_px, kMostDepth_px);
               request.depth_given = true;
           },
           "Of the goals of linear and circle below the surface, 0.1 to 1000")
        ->type_name("PX")
        ->default_str("20");
    app.add_option_function<std::string>(
           "--relief",
           [&request](const std::string& text) {
               request.options.human.shape.relief_px =
                   parse_number("--relief", text, 0.0, kHighestRelief_px);
           },
           "Elevation of the sample's nearest depth, for human, 0 to 4096")
        ->type_name("PX")
        ->default_str("255");
}

}  // namespace

void add_experiment_options(CLI::App& app, ExperimentRequest& request) {
    ExperimentOptions& options = request.options;
    app.add_option_function<std::string>(
           "PATH",
           [&options](const std::string& path) {
               check_path(path);
               options.path = path;
           },
           "linear, circle, human, all of them, or sweep: every friction with every depth")
        ->type_name("")
        ->default_str("all");
    app.add_option("--json", request.json, "Writes all numbers as JSON; - is standard output")
        ->type_name("FILE");
    app.add_option("--plots", request.plots, "Writes pictures into this folder")->type_name("DIR");
    add_plot_format_option(app, options.plot_formats);
    app.add_option("--session", request.session, "Hand of human: the goals of a recorded session")
        ->type_name("FILE");
    app.add_option("--trace", request.trace,
                   "Hand of human: a pen's or mouse's trace (CSV: t_s,x_mm,y_mm[,pressure01]"
                   "[,pen_down]); without either a modelled one")
        ->type_name("FILE");
    add_algorithms_option(app, options.algorithms);
    add_numbers(app, request);
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

ExperimentOptions experiment_options(const ExperimentRequest& request) {
    const std::string& path = request.options.path;
    const bool has_hand = !request.session.empty() || !request.trace.empty();
    if (has_hand && path != "human" && path != "all") {
        throw UsageError("--session and --trace are the hand of human, not of " + path +
                         " (see dibhr experiment --help)");
    }
    if (!request.session.empty() && !request.trace.empty()) {
        throw UsageError(
            "--session and --trace are two hands; give one (see dibhr experiment --help)");
    }
    if (path == "sweep" && (request.mu_given || request.depth_given)) {
        throw UsageError(
            "sweep goes through its own --friction and --depth; leave them out (see dibhr "
            "experiment --help)");
    }
    ExperimentOptions options = request.options;
    options.algorithms.clear();
    for (const Algorithm algorithm : request.options.algorithms) {  // each once
        auto& all = options.algorithms;
        if (std::find(all.begin(), all.end(), algorithm) == all.end()) all.push_back(algorithm);
    }
    options.json = request.json;
    options.plots = request.plots;
    options.human.session = request.session;
    options.human.trace = request.trace;
    return options;
}

}  // namespace dibhr
