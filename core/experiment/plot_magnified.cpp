// A few pixels of a path magnified: grid, goals, exact orbit, proxies and one update's springs.
#include "core/experiment/plots.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/plot/axes.hpp"

namespace dibhr {

namespace {

constexpr std::size_t kAround = 60;  // updates before and after: less than half a lap of the circle
constexpr double kWidest_px = 160.0;
constexpr double kWidestWithCells_px = 64.0;

Axes axes_of(Box area, const MagnifiedPlace& place) {
    const double half = place.side_px / 2.0;
    return {area, Axis{{place.centre.x - half, place.centre.x + half}, "x [px]"},
            Axis{{place.centre.y + half, place.centre.y - half}, "y [px]"}};
}

/// The image's pixels are centred on whole numbers.
Box box_of_image(const Axes& axes, const PathRun& path) {
    const Vec2 first = axes.at(-0.5, -0.5);
    const Vec2 last = axes.at(path.columns - 0.5, path.rows - 0.5);
    return {first.x, first.y, last.x, last.y};
}

/// The cells' edges, the diagonals as the surface has them, and the vertices PGA moves on.
void draw_cells(Canvas& canvas, const Axes& axes, const MagnifiedPlace& place, bool over_picture) {
    const Stroke edge =
        over_picture ? Stroke{kPaper, 0.5, Dash::solid} : Stroke{kGridInk, 1.0, Dash::solid};
    const int reach = static_cast<int>(place.side_px / 2.0) + 2;
    const int i0 = static_cast<int>(place.centre.x) - reach;
    const int j0 = static_cast<int>(place.centre.y) - reach;
    const int many = 2 * reach + 1;
    for (int k = 0; k <= many; ++k) {
        canvas.line(axes.at(i0 + k, j0), axes.at(i0 + k, j0 + many), edge);
        canvas.line(axes.at(i0, j0 + k), axes.at(i0 + many, j0 + k), edge);
        canvas.line(axes.at(i0 + k, j0), axes.at(i0, j0 + k), edge);
        canvas.line(axes.at(i0 + many, j0 + k), axes.at(i0 + k, j0 + many), edge);
    }
}

UpdateSpan updates_around(const MagnifiedPlace& place, const PathRun& path) {
    return {place.update > kAround ? place.update - kAround : 0,
            std::min(path.goals.size(), place.update + kAround + 1)};
}

/// The points as seen from above.
std::vector<Vec2> trajectory_of(const Axes& axes, std::span<const Vec3> points,
                                UpdateSpan updates) {
    std::vector<Vec2> trajectory;
    for (std::size_t k = updates.first; k < updates.end; ++k) {
        trajectory.push_back(axes.at(Vec2(points[k])));
    }
    return trajectory;
}

/// Those drawn first are larger, so that markers on one another all show.
double marker_px(Marker marker) {
    if (marker == Marker::square) return 17.0;
    if (marker == Marker::diamond) return 13.0;
    return marker == Marker::triangle ? 11.0 : 8.0;
}

void draw_trajectory(Canvas& canvas, const std::vector<Vec2>& trajectory, const SeriesStyle& look,
                     std::size_t step) {
    canvas.polyline(trajectory, look.stroke);
    const double size = marker_px(look.marker);
    for (std::size_t k = 0; k < trajectory.size(); k += step) {
        canvas.marker(trajectory[k], look.marker, size, look.stroke.ink, kPaper);
    }
}

/// From the goal of one update to where each proxy was, and the disc friction lets it rest in.
void draw_springs(Canvas& canvas, const Axes& axes, const PathRun& path, std::size_t update) {
    const Vec2 goal = axes.at(Vec2(path.goals[update]));
    for (auto run = path.runs.rbegin(); run != path.runs.rend(); ++run) {  // the first on top
        canvas.line(goal, axes.at(Vec2(run->proxies[update])),
                    {style_of(run->algorithm).stroke.ink, 1.5, Dash::solid});
    }
    if (!path.exact_proxies.empty()) {
        const double radius = path.mu * path.depth_px;
        canvas.ring(goal, radius * (axes.at(1.0, 0.0).x - axes.at(0.0, 0.0).x),
                    {kQuietInk, 1.0, Dash::dashed});
    }
    canvas.marker(goal, Marker::circle, 11.0, kGoalInk, kPaper);
}

/// How far apart the proxies were in this update, seen from above, summed over the runs [px].
double separation_px(const PathRun& path, std::size_t update) {
    double apart = 0.0;
    for (const AlgorithmRun& run : path.runs) {
        apart += glm::distance(Vec2(run.proxies[update]), Vec2(path.runs.front().proxies[update]));
    }
    return apart;
}

bool all_in_contact(const PathRun& path, std::size_t update) {
    return std::all_of(path.runs.begin(), path.runs.end(),
                       [&](const AlgorithmRun& run) { return run.contact[update] != 0; });
}

double mean_step_px(const PathRun& path, UpdateSpan updates) {
    double travelled = 0.0;
    for (std::size_t k = updates.first + 1; k < updates.end; ++k) {
        travelled += glm::distance(path.goals[k - 1], path.goals[k]);
    }
    return travelled /
           static_cast<double>(std::max<std::size_t>(updates.end - updates.first, 2) - 1);
}

/// Centres the place on the goal and the proxies of its update, with room around them.
void centre_on_proxies(const PathRun& path, MagnifiedPlace& place) {
    Vec2 low = Vec2(path.goals[place.update]);
    Vec2 high = low;
    for (const AlgorithmRun& run : path.runs) {
        low = glm::min(low, Vec2(run.proxies[place.update]));
        high = glm::max(high, Vec2(run.proxies[place.update]));
    }
    place.centre = (low + high) / 2.0;
    const double extent = std::max(high.x - low.x, high.y - low.y);
    place.side_px = std::clamp(std::ceil(1.7 * extent), place.side_px, kWidest_px);
}

constexpr Box kMagnifiedArea{636.0, 130.0, 1164.0, 658.0};

/// The image's own shape, as large as fits on the left.
Box overview_area(const PathRun& path) {
    constexpr Box kRoom{76.0, 130.0, 560.0, 560.0};
    const double scale = std::min(kRoom.width() / path.columns, kRoom.height() / path.rows);
    return {kRoom.left, kRoom.top, kRoom.left + scale * path.columns,
            kRoom.top + scale * path.rows};
}

/// A long exploration: its overview shows only the first algorithm's path.
bool is_long(const PathRun& path) {
    return path.exact_proxies.empty();
}

std::string overview_text(const PathRun& path) {
    const UpdateSpan shown = shown_updates(path);
    const std::string seconds = tick_text(seconds_of(shown.end - shown.first)) + " s from above";
    return (is_long(path) ? style_of(path.runs.front().algorithm).name + ", " : "") + seconds +
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
        Stroke stroke = style_of(run->algorithm).stroke;
        if (is_long(path)) stroke.width_px = 1.0;
        canvas.polyline(trajectory_of(axes, run->proxies, shown), stroke);
    }
    const double half = place.side_px / 2.0;
    const Vec2 first = axes.at(place.centre - half);
    const Vec2 last = axes.at(place.centre + half);
    canvas.outline({first.x, first.y, last.x, last.y}, {kPaper, 4.0, Dash::solid});
    canvas.outline({first.x, first.y, last.x, last.y}, {kTextInk, 2.0, Dash::solid});
    canvas.clip_to_whole();
    axes.draw_frame(canvas);
}

std::vector<SeriesStyle> legend_of(const PathRun& path) {
    std::vector<SeriesStyle> entries{style_of_goal()};
    if (!path.exact_proxies.empty()) entries.push_back(style_of_exact());
    for (const AlgorithmRun& run : path.runs) entries.push_back(style_of(run.algorithm));
    return entries;
}

std::string magnified_text(const PathRun& path, const MagnifiedPlace& place) {
    const std::string side = tick_text(place.side_px);
    const std::size_t step = updates_a_marker(path, place);
    const std::string markers = step == 1 ? "an update" : "in " + std::to_string(step) + " updates";
    const bool together = separation_px(path, place.update) < 0.01 * place.side_px;
    return side + " \u00d7 " + side + " px, one marker " + markers +
           (together ? "; all proxies coincide" : "; springs of one update");
}

}  // namespace

MagnifiedPlace typical_place(const PathRun& path) {
    std::vector<std::pair<double, std::size_t>> apart;
    const UpdateSpan shown = shown_updates(path);
    const double at_least_px = 0.9 * mean_step_px(path, shown);  // strokes, not pauses
    for (std::size_t k = shown.first; k + 1 < shown.end; ++k) {
        const bool moving = glm::distance(path.goals[k], path.goals[k + 1]) > at_least_px;
        if (moving && all_in_contact(path, k)) apart.emplace_back(separation_px(path, k), k);
    }
    MagnifiedPlace place;
    place.update = shown.first;
    if (!apart.empty()) {
        const auto middle = apart.begin() + static_cast<std::ptrdiff_t>(apart.size() / 2);
        std::nth_element(apart.begin(), middle, apart.end());
        place.update = middle->second;
    }
    centre_on_proxies(path, place);
    return place;
}

std::size_t updates_a_marker(const PathRun& path, const MagnifiedPlace& place) {
    constexpr double kMarkersAcross = 28.0;
    const std::size_t end = updates_around(place, path).end;
    double travelled = 0.0;
    for (std::size_t k = place.update + 1; k < end; ++k) {
        travelled += glm::distance(Vec2(path.goals[k - 1]), Vec2(path.goals[k]));
    }
    const double apart = place.side_px / kMarkersAcross;
    const double steps = static_cast<double>(std::max<std::size_t>(end - place.update, 2) - 1);
    const double wanted = travelled > 0.0 ? apart * steps / travelled : 1.0;
    return static_cast<std::size_t>(std::clamp(std::ceil(wanted), 1.0, 20.0));
}

void draw_magnified(Canvas& canvas, Box area, const PathRun& path, const MagnifiedPlace& place,
                    const ColourImage* under) {
    const std::size_t step = updates_a_marker(path, place);
    const Axes axes = axes_of(area, place);
    canvas.clip_to(area);
    canvas.fill(area, kPlotGround);
    if (under != nullptr) canvas.picture(*under, box_of_image(axes, path), 0.55);
    if (place.side_px <= kWidestWithCells_px) draw_cells(canvas, axes, place, under != nullptr);
    const UpdateSpan around = updates_around(place, path);
    if (!path.exact_proxies.empty()) {
        canvas.polyline(trajectory_of(axes, path.exact_proxies, around), style_of_exact().stroke);
    }
    draw_trajectory(canvas, trajectory_of(axes, path.goals, around), style_of_goal(), step);
    draw_springs(canvas, axes, path, place.update);
    for (auto run = path.runs.rbegin(); run != path.runs.rend(); ++run) {
        draw_trajectory(canvas, trajectory_of(axes, run->proxies, around), style_of(run->algorithm),
                        step);
    }
    canvas.clip_to_whole();
    axes.draw_frame(canvas);
}

Canvas plot_paths(const PathRun& path, const ColourImage* under) {
    Canvas canvas(1200, 730, kPaper);
    const MagnifiedPlace place = typical_place(path);
    draw_title(canvas, "Where the proxy went: " + path.name, settings_of(path));
    const TextStyle head{kTextInk, kLabelCap_px};
    const Box overview = overview_area(path);
    canvas.text({overview.left, overview.top - 14.0}, overview_text(path), head);
    draw_overview(canvas, overview, path, place, under);
    canvas.text({kMagnifiedArea.left, kMagnifiedArea.top - 14.0}, magnified_text(path, place),
                head);
    draw_magnified(canvas, kMagnifiedArea, path, place, under);
    draw_legend(canvas, {overview.left, overview.bottom + 60.0}, legend_of(path));
    return canvas;
}

}  // namespace dibhr
