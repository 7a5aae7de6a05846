// `dibhr report`: what people touched in a recorded session, as pictures, a page and numbers.
#pragma once

#include <filesystem>
#include <vector>

#include "core/plot/canvas.hpp"

namespace dibhr {

struct ReportOptions {
    std::filesystem::path session{};
    std::filesystem::path out{};  ///< folder
    std::vector<PlotFormat> plot_formats{PlotFormat::png};
};

/// Prints where the page of the report is; returns the exit code. Throws
/// InputError.
int run_report(const ReportOptions& options);

}  // namespace dibhr
