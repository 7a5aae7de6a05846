// The force over time: its direction, how much it turns in each update, how far it is from exact.
#include "core/experiment/plots.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/trigonometric.hpp>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/metrics/force_variation.hpp"
#include "core/plot/axes.hpp"

namespace dibhr {

namespace {

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
constexpr double kLeastError_deg = 1e-15;  // drawn for less: an error of 0 has no logarithm
// Directions from -90 to 270 degrees: the line's 0 and 180 are away from the ends.
constexpr ValueSpan kDirections_deg{-90.0, 270.0};

/// Direction of the force along the image, 0 to the right, 90 down [deg].
double direction_deg(Vec3 force) {
    const double deg = glm::degrees(std::atan2(force.y, force.x));
    return deg < kDirections_deg.low ? deg + 360.0 : deg;
}

std::vector<Vec2> directions(const PathRun& path, std::span<const Vec3> proxies,
                             std::span<const char> contact, UpdateSpan updates) {
    constexpr double kNoDirection_px = 1e-9;
    std::vector<Vec2> series;
    double last_deg = kNothing;
    for (std::size_t k = updates.first; k < updates.end; ++k) {
        const Vec3 force = proxies[k] - path.goals[k];
        const bool directed = std::hypot(force.x, force.y) > kNoDirection_px;
        const bool touching = contact.empty() || contact[k] != 0;
        const double deg = touching && directed ? direction_deg(force) : kNothing;
        if (std::abs(deg - last_deg) > 185.0) series.emplace_back(seconds_of(k), kNothing);
        series.emplace_back(seconds_of(k), deg);
        last_deg = deg;
    }
    return series;
}

/// "turns 4.13 deg per update (sd 6.77), sliding 3.90 (sd 2.10)".
std::string turning_text(const VariationStatistics& variation) {
    return "turns " + fixed_text(variation.mean_deg, 2) + " deg per update (sd " +
           fixed_text(variation.sd_deg, 2) + "), sliding " + sliding_text(variation);
}

Axis time_axis(UpdateSpan updates, bool numbered) {
    Axis axis{{seconds_of(updates.first), seconds_of(std::max(updates.end, updates.first + 2) - 1)},
              numbered ? "time [s]" : ""};
    axis.numbered = numbered;
    axis.most_ticks = 8;
    return axis;
}

void draw_directions(Canvas& canvas, Box area, const PathRun& path, const AlgorithmRun& run,
                     bool lowest) {
    const UpdateSpan updates = shown_updates(path);
    Axis y{kDirections_deg, "direction [deg]"};
    y.ticks = {-90.0, 0.0, 90.0, 180.0, 270.0};
    const Axes axes(area, time_axis(updates, lowest), y);
    axes.draw_ground(canvas);
    if (!path.exact_proxies.empty()) {
        axes.draw_series(canvas, directions(path, path.exact_proxies, {}, updates),
                         style_of_exact().stroke);
    }
    Stroke stroke{style_of(run.algorithm).stroke.ink, 1.5, Dash::solid};
    axes.draw_series(canvas, directions(path, run.proxies, run.contact, updates), stroke);
    axes.draw_frame(canvas);
}

std::vector<Vec2> errors_deg(const PathRun& path, const AlgorithmRun& run, UpdateSpan updates) {
    std::vector<Vec2> series;
    for (std::size_t k = updates.first; k < updates.end; ++k) {
        const double error = glm::degrees(angle_between_rad(path.exact_proxies[k] - path.goals[k],
                                                            run.proxies[k] - path.goals[k]));
        series.emplace_back(seconds_of(k),
                            run.contact[k] != 0 ? std::max(error, kLeastError_deg) : kNothing);
    }
    return series;
}

/// Turn of each update [deg]; NaN where one of the two was not in contact.
std::vector<Vec2> turns_deg(const PathRun& path, std::span<const Vec3> proxies,
                            std::span<const char> contact, UpdateSpan updates) {
    std::vector<Vec2> series;
    for (std::size_t k = std::max<std::size_t>(updates.first, 1); k < updates.end; ++k) {
        const bool touching = contact.empty() || (contact[k - 1] != 0 && contact[k] != 0);
        const double turn = glm::degrees(
            angle_between_rad(proxies[k - 1] - path.goals[k - 1], proxies[k] - path.goals[k]));
        series.emplace_back(seconds_of(k), touching ? turn : kNothing);
    }
    return series;
}

}  // namespace

Canvas plot_force(const PathRun& path) {
    constexpr double kTop_px = 118.0;
    constexpr double kGap_px = 44.0;
    const auto panels = static_cast<double>(std::max<std::size_t>(path.runs.size(), 1));
    const double each = (800.0 - kTop_px - 56.0 - kGap_px * (panels - 1.0)) / panels;
    Canvas canvas(1200, 800, kPaper);
    draw_title(canvas, "How the force turned: " + path.name, settings_of(path));
    const double highest = highest_turn_deg(path);
    double top = kTop_px;
    for (const AlgorithmRun& run : path.runs) {
        const bool lowest = &run == &path.runs.back();
        const Box left{100.0, top, 570.0, top + each};
        const Box right{690.0, top, 1160.0, top + each};
        canvas.text({left.left, top - 10.0},
                    style_of(run.algorithm).name + ": direction along the image",
                    {kTextInk, kLabelCap_px, Align::left, true});
        canvas.text({right.left, top - 10.0}, turning_text(run.variation),
                    {kTextInk, kLabelCap_px});
        draw_directions(canvas, left, path, run, lowest);
        draw_turning(canvas, right, path, run, {highest, lowest});
        top += each + kGap_px;
    }
    return canvas;
}

Canvas plot_error(const PathRun& path) {
    constexpr Box kArea{110.0, 110.0, 930.0, 730.0};
    Canvas canvas(1200, 800, kPaper);
    draw_title(canvas, "How far the force was from exact: " + path.name, settings_of(path));
    const UpdateSpan updates = shown_updates(path);
    Axis y{{kLeastError_deg / 5.0, 100.0}, "angle to the exact force [deg]", true};
    y.most_ticks = 9;
    const Axes axes(kArea, time_axis(updates, true), y);
    axes.draw_ground(canvas);
    std::vector<SeriesStyle> entries;
    for (const AlgorithmRun& run : path.runs) {
        SeriesStyle look = style_of(run.algorithm);
        axes.draw_series(canvas, errors_deg(path, run, updates), look.stroke);
        look.marker = Marker::none;
        entries.push_back(look);
    }
    axes.draw_frame(canvas);
    draw_legend(canvas, {kArea.right + 24.0, kArea.top}, entries);
    const double least_y = axes.at(0.0, kLeastError_deg).y;
    canvas.text({kArea.right + 12.0, least_y + kNumberCap_px / 2.0}, "0, or 1e-15 at most",
                {kQuietInk, kNumberCap_px});
    return canvas;
}

UpdateSpan shown_updates(const PathRun& path) {
    constexpr std::size_t kRepeating = 300;
    const std::size_t count = path.goals.size();
    if (path.exact_proxies.empty()) return {0, count};
    const std::size_t settled = static_cast<std::size_t>(path.settling_updates);
    const std::size_t first = std::min(std::max(settled, kRepeating), count);
    if (first + kRepeating > count) return {count > kRepeating ? count - kRepeating : 0, count};
    return {first, first + kRepeating};
}

double highest_turn_deg(const PathRun& path) {
    constexpr double kNearlyAll = 0.998;
    std::vector<double> turns{1.0};
    for (const AlgorithmRun& run : path.runs) {
        for (const Vec2 turn : turns_deg(path, run.proxies, run.contact, shown_updates(path))) {
            if (!std::isnan(turn.y)) turns.push_back(turn.y);
        }
    }
    const auto at = turns.begin() +
                    static_cast<std::ptrdiff_t>(kNearlyAll * static_cast<double>(turns.size() - 1));
    std::nth_element(turns.begin(), at, turns.end());
    const double wanted = std::max(1.0, *at);
    const double step = std::pow(10.0, std::floor(std::log10(wanted)));
    return step * std::ceil(1.05 * wanted / step);
}

std::string sliding_text(const VariationStatistics& variation) {
    return fixed_text(variation.mean_without_reversals_deg, 2) + " (sd " +
           fixed_text(variation.sd_without_reversals_deg, 2) + ")";
}

void draw_turning(Canvas& canvas, Box area, const PathRun& path, const AlgorithmRun& run,
                  TurningScale scale) {
    const UpdateSpan updates = shown_updates(path);
    Axis y{{0.0, scale.highest_deg}, "turn [deg]"};
    y.most_ticks = 4;
    const Axes axes(area, time_axis(updates, scale.numbered), std::move(y));
    axes.draw_ground(canvas);
    if (!path.exact_proxies.empty()) {
        axes.draw_series(canvas, turns_deg(path, path.exact_proxies, {}, updates),
                         {kExactInk, 4.0, Dash::solid});
    }
    axes.draw_series(canvas, turns_deg(path, run.proxies, run.contact, updates),
                     {style_of(run.algorithm).stroke.ink, 1.0, Dash::solid});
    axes.draw_frame(canvas);
}

std::string settings_of(const PathRun& path) {
    const bool mean = path.exact_proxies.empty();
    return "friction \u03bc " + tick_text(path.mu) + ",  " + (mean ? "mean depth " : "depth ") +
           tick_text(path.depth_px) + " px,  1 kHz,  " + path.source;
}

}  // namespace dibhr
