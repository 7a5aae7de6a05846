// The evaluation in pictures: where the proxies went, how their forces turned, how far from exact.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/experiment/experiment.hpp"
#include "core/files/output_file.hpp"
#include "core/plot/axes.hpp"
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

/// The square part of the image around one update.
struct MagnifiedPlace {
    Vec2 centre{0.0};
    double side_px{14.0};   ///< of the image
    std::size_t update{0};  ///< whose springs are drawn
};

/// The place of a typical one of the updates shown: the distance between the algorithms is the
/// median of the updates in contact. Its goal and proxies lie inside.
[[nodiscard]] MagnifiedPlace typical_place(const PathRun& path);

/// Updates from one marker to the next, so that a slow hand's markers do not cover each other.
[[nodiscard]] std::size_t updates_a_marker(const PathRun& path, const MagnifiedPlace& place);

/// Draws the place into `area`, which must be square; `under` as in plot_paths.
void draw_magnified(Canvas& canvas, Box area, const PathRun& path, const MagnifiedPlace& place,
                    const ColourImage* under);

[[nodiscard]] inline SeriesStyle style_of_exact() {
    return {"exact answer", {kExactInk, 7.0, Dash::solid}, Marker::none};
}

[[nodiscard]] inline SeriesStyle style_of_goal() {
    return {"goal (the hand)", {kGoalInk, 1.5, Dash::dotted}, Marker::none};
}

/// From `first` up to, not including, `end`.
struct UpdateSpan {
    std::size_t first{0};
    std::size_t end{0};
};

/// Three tenths of a second of a path that repeats itself, after it settled; the whole of an
/// exploration.
[[nodiscard]] UpdateSpan shown_updates(const PathRun& path);

/// A round number above nearly every turn of every algorithm in the updates shown [deg].
[[nodiscard]] double highest_turn_deg(const PathRun& path);

/// "3.90 (sd 2.10)": without the updates in which the hand reverses.
[[nodiscard]] std::string sliding_text(const VariationStatistics& variation);

struct TurningScale {
    double highest_deg{1.0};
    bool numbered{true};  ///< the time axis
};

void draw_turning(Canvas& canvas, Box area, const PathRun& path, const AlgorithmRun& run,
                  TurningScale scale);

/// Friction, depth and where the goals come from.
[[nodiscard]] std::string settings_of(const PathRun& path);

}  // namespace dibhr
