// The proxies from above over the image: the paper's figure 5.
#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "core/experiment/plot_magnified.hpp"
#include "core/experiment/plot_turning.hpp"
#include "core/experiment/plots.hpp"
#include "core/plot/axes.hpp"
#include "core/plot/style.hpp"

namespace dibhr {
namespace {

constexpr Box kMagnifiedArea{636.0, 130.0, 1164.0, 658.0};

/// The image's own shape, as large as fits on the left.
Box overview_area(const PathRun& path) {
    constexpr Box kRoom{76.0, 130.0, 560.0, 560.0};
    const double scale = std::min(kRoom.width() / path.columns, kRoom.height() / path.rows);
    return {kRoom.left, kRoom.top, kRoom.left + scale * path.columns,
            kRoom.top + scale * path.rows};
}

/// An exploration: of it only the first algorithm's way can be made out as a whole.
bool is_long(const PathRun& path) {
    return path.exact_proxies.empty();
}

std::vector<Vec2> way_from_above(const Axes& axes, const std::vector<Vec3>& points,
                                 UpdateSpan updates) {
    std::vector<Vec2> way;
    for (std::size_t k = updates.first; k < updates.end; ++k) {
        way.push_back(axes.at(points[k].x, points[k].y));
    }
    return way;
}

std::string overview_words(const PathRun& path) {
    const UpdateSpan shown = shown_updates(path);
    const std::string seconds = tick_text(seconds_of(shown.end - shown.first)) + " s from above";
    return (is_long(path) ? look_of(path.runs.front().algorithm).name + ", " : "") + seconds +
           "; the square is magnified";
}

void draw_overview(Canvas& canvas, Box area, const PathRun& path, const MagnifiedPlace& place,
                   const ColourImage* under) {
    const Axes axes(area, Axis{{-0.5, path.columns - 0.5}, "x [px]"},
                    Axis{{path.rows - 0.5, -0.5}, "y [px]"});
    axes.draw_ground(canvas);
    canvas.clip_to(area);
    if (under != nullptr) canvas.picture(*under, area, 0.8);
    const UpdateSpan shown = shown_updates(path);
    for (auto run = path.runs.rbegin(); run != path.runs.rend(); ++run) {  // the first on top
        if (is_long(path) && run + 1 != path.runs.rend()) continue;
        Stroke stroke = look_of(run->algorithm).stroke;
        if (is_long(path)) stroke.width_px = 1.0;
        canvas.polyline(way_from_above(axes, run->proxies, shown), stroke);
    }
    const double half = place.side_px / 2.0;
    const Vec2 first = axes.at(place.centre - half);
    const Vec2 last = axes.at(place.centre + half);
    canvas.outline({first.x, first.y, last.x, last.y}, {kPaper, 4.0, Dash::solid});
    canvas.outline({first.x, first.y, last.x, last.y}, {kTextInk, 2.0, Dash::solid});
    canvas.clip_to_whole();
    axes.draw_frame(canvas);
}

std::vector<SeriesLook> legend_of(const PathRun& path) {
    std::vector<SeriesLook> entries{look_of_goal()};
    if (!path.exact_proxies.empty()) entries.push_back(look_of_exact());
    for (const AlgorithmRun& run : path.runs) entries.push_back(look_of(run.algorithm));
    return entries;
}

std::string magnified_words(const PathRun& path, const MagnifiedPlace& place) {
    const std::string side = tick_text(place.side_px);
    const std::size_t step = updates_a_marker(path, place);
    const std::string markers = step == 1 ? "an update" : "in " + std::to_string(step) + " updates";
    const bool together = separation_px(path, place.update) < 0.01 * place.side_px;
    return side + " \u00d7 " + side + " px, one marker " + markers +
           (together ? "; all proxies coincide" : "; springs of one update");
}

}  // namespace

Canvas plot_paths(const PathRun& path, const ColourImage* under) {
    Canvas canvas(1200, 730, kPaper);
    const MagnifiedPlace place = typical_place(path);
    draw_title(canvas, "Where the proxy went: " + path.name, settings_of(path));
    const TextStyle head{kTextInk, kLabelCap_px};
    const Box overview = overview_area(path);
    canvas.text({overview.left, overview.top - 14.0}, overview_words(path), head);
    draw_overview(canvas, overview, path, place, under);
    canvas.text({kMagnifiedArea.left, kMagnifiedArea.top - 14.0}, magnified_words(path, place),
                head);
    draw_magnified(canvas, kMagnifiedArea, path, place, under);
    draw_legend(canvas, {overview.left, overview.bottom + 60.0}, legend_of(path));
    return canvas;
}

}  // namespace dibhr
