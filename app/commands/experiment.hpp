// `dibhr experiment`: the paper's evaluation, all algorithms side by side.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/commands/experiment_human.hpp"
#include "core/haptics/touch.hpp"
#include "core/plot/canvas.hpp"

namespace dibhr {

struct ExperimentOptions {
    std::string path{"all"};        ///< linear, circle, human, all or sweep
    std::filesystem::path json{};   ///< empty: none; "-": standard output, and no table
    std::filesystem::path plots{};  ///< a folder; empty: none
    std::vector<PlotFormat> plot_formats{PlotFormat::png};
    std::vector<Algorithm> algorithms{};  ///< empty: all
    double depth_px{20.0};                ///< of linear and circle
    HumanOptions human{};                 ///< its mu is that of all paths
};

/// Runs, prints the tables and writes what was asked for. The exit code; throws InputError.
int run_experiment(const ExperimentOptions& options);

}  // namespace dibhr
