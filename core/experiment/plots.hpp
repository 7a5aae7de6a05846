// The evaluation in pictures: where the proxies went, how their forces turned, how far from exact.
#pragma once

#include <vector>

#include "core/experiment/experiment.hpp"
#include "core/files/output_folder.hpp"
#include "core/plot/canvas.hpp"

namespace dibhr {

// Every path drawn has at least one goal and one run; all runs are as long as the goals.

/// Where plots go, and as what.
struct PlotFiles {
    OutputFolder& folder;
    std::vector<PlotFormat> formats{PlotFormat::png};
};

/// For each path `paths-NAME.png`, `force-NAME.png` and, where an exact answer is known,
/// `error-NAME.png`, and for the circle `explained.png`, likewise in the other formats.
/// `torso_colour` lies under the human path; null for none. Throws InputError when a file cannot be
/// written.
void write_plots(const std::vector<PathRun>& paths, const ColourImage* torso_colour,
                 const PlotFiles& files);

/// `sweep.png`, likewise.
void write_sweep_plot(const std::vector<SweepPoint>& points, const PlotFiles& files);

/// The proxies from above over the image, whole and a few pixels of it magnified: the paper's
/// figure 5. `under` lies beneath; null for none.
[[nodiscard]] Canvas plot_paths(const PathRun& path, const ColourImage* under);

/// The direction of the force and how much it turns in each update: the paper's figure 12.
[[nodiscard]] Canvas plot_force(const PathRun& path);

/// Angle between each algorithm's force and the exact one over time. The path must have an exact
/// answer.
[[nodiscard]] Canvas plot_error(const PathRun& path);

/// Turning and error of the force over friction, one column a depth.
[[nodiscard]] Canvas plot_sweep(const std::vector<SweepPoint>& points);

/// A few pixels of the circle beside the turning of the force: the picture of the page that
/// explains.
[[nodiscard]] Canvas plot_explanation(const PathRun& circle);

}  // namespace dibhr
