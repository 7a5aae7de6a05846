// One panel: how much an algorithm's force turns from update to update.
#include "core/experiment/plot_turning.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include <glm/trigonometric.hpp>

#include "core/metrics/force_variation.hpp"
#include "core/plot/axes.hpp"
#include "core/plot/style.hpp"

namespace dibhr {

namespace {

/// Turn of each update [deg]; NaN where one of the two was not in contact.
std::vector<Vec2> turns_deg(const PathRun& path, std::span<const Vec3> proxies,
                            std::span<const char> contact, UpdateSpan updates) {
    std::vector<Vec2> series;
    for (std::size_t k = std::max<std::size_t>(updates.first, 1); k < updates.end; ++k) {
        const bool touching = contact.empty() || (contact[k - 1] != 0 && contact[k] != 0);
        const double turn = glm::degrees(
            angle_between_rad(proxies[k - 1] - path.goals[k - 1], proxies[k] - path.goals[k]));
        series.emplace_back(seconds_of(k),
                            touching ? turn : std::numeric_limits<double>::quiet_NaN());
    }
    return series;
}

}  // namespace

UpdateSpan shown_updates(const PathRun& path) {
    constexpr std::size_t kRepeating = 300;
    const std::size_t count = path.goals.size();
    if (path.exact_proxies.empty()) return {0, count};
    const std::size_t settled = static_cast<std::size_t>(path.settling_updates);
    const std::size_t first = std::min(std::max(settled, kRepeating), count);
    if (first + kRepeating > count) return {count > kRepeating ? count - kRepeating : 0, count};
    return {first, first + kRepeating};
}

Axis time_axis(UpdateSpan updates, bool numbered) {
    Axis axis{{seconds_of(updates.first), seconds_of(std::max(updates.end, updates.first + 2) - 1)},
              numbered ? "time [s]" : ""};
    axis.numbered = numbered;
    axis.most_ticks = 8;
    return axis;
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

std::string turning_words(const VariationStatistics& variation) {
    return "turns " + fixed_text(variation.mean_deg, 2) + " deg an update (sd " +
           fixed_text(variation.sd_deg, 2) + "), sliding " + sliding_words(variation);
}

std::string sliding_words(const VariationStatistics& variation) {
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
                     {look_of(run.algorithm).stroke.ink, 1.0, Dash::solid});
    axes.draw_frame(canvas);
}

std::string settings_of(const PathRun& path) {
    const bool mean = path.exact_proxies.empty();
    return "friction \u03bc " + tick_text(path.mu) + ",  " + (mean ? "mean depth " : "depth ") +
           tick_text(path.depth_px) + " px,  1 kHz,  " + path.source;
}

}  // namespace dibhr
