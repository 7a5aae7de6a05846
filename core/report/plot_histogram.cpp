// The histograms: force and speed in contact, and how long contacts last.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "core/files/plain_text.hpp"
#include "core/plot/axes.hpp"
#include "core/report/report_plots.hpp"

namespace dibhr {

namespace {

constexpr int kColumns = 800;
constexpr int kRows = 560;
constexpr Box kArea{100.0, 120.0, 770.0, 490.0};
constexpr int kMostBars = 40;

struct Bar {
    double from{0.0}, to{0.0};
    double height{0.0};
};

double highest_of(const std::vector<Bar>& bars) {
    return std::ranges::max(bars, {}, &Bar::height).height;
}

void draw_bars(Canvas& canvas, const Axes& axes, const std::vector<Bar>& bars) {
    const Ink ink = style_of(Algorithm::dibhr).stroke.ink;
    for (const Bar& bar : bars) {
        if (!(bar.height > 0.0)) continue;
        const Vec2 corner = axes.at(bar.from, bar.height);
        const Vec2 foot = axes.at(bar.to, 0.0);
        canvas.fill({corner.x + 0.5, corner.y, std::max(foot.x - 0.5, corner.x + 1.0), foot.y},
                    ink);
    }
}

/// A line at a value, named above the plot; the names stand aside from each other.
void draw_values(Canvas& canvas, const Axes& axes,
                 const std::vector<std::pair<double, std::string>>& values) {
    const TextStyle style{kTextInk, kNumberCap_px};
    double free_px = kArea.left;
    for (const auto& [value, name] : values) {
        const double x = axes.at(value, 0.0).x;
        if (x > kArea.right) continue;
        canvas.line({x, kArea.top}, {x, kArea.bottom}, {kTextInk, 1.5, Dash::dashed});
        const double width = text_width(name, style);
        const double left = std::clamp(x - width / 2.0, free_px, kArea.right + 24.0 - width);
        if (left < free_px) continue;
        canvas.text({left, kArea.top - 9.0}, name, style);
        free_px = left + width + 14.0;
    }
}

/// Time per value, with median, 95 % and what is beyond the plot.
Canvas plot_distribution(const std::string& title, const std::string& quantity,
                         const std::string& unit, const Distribution& values, double upto,
                         const PlotContext& context) {
    const Bars bars = values.bars(upto, kMostBars);
    std::vector<Bar> drawn;
    for (std::size_t k = 0; k < bars.seconds.size(); ++k) {
        const double from = static_cast<double>(k) * bars.width;
        drawn.push_back({from, from + bars.width, bars.seconds[k]});
    }
    Canvas canvas(kColumns, kRows, kPaper);
    draw_title(canvas, title, context.subtitle);
    const Axes axes(kArea, {{0.0, drawn.back().to}, quantity + " [" + unit + "]"},
                    {{0.0, 1.05 * highest_of(drawn)}, "time [s]"});
    axes.draw_ground(canvas);
    draw_bars(canvas, axes, drawn);
    axes.draw_frame(canvas);
    const auto named = [&](const char* name, double value) {
        return std::pair(value, name + (" " + short_text(value, 3) + " " + unit));
    };
    draw_values(
        canvas, axes,
        {named("median", values.quantile(0.5)), named("95 % below", values.quantile(0.95))});
    if (bars.beyond_s > 0.0) {
        canvas.text({kArea.right - 10.0, kArea.top + 22.0},
                    fixed_text(100.0 * bars.beyond_s / values.total_s(), 1) + " % beyond, up to " +
                        tick_text(std::round(values.peak())) + " " + unit,
                    {kTextInk, kNumberCap_px, Align::right});
    }
    return canvas;
}

/// 1, 2 and 5 times the powers of ten, in their order; 0 is 1.
double log_edge(int number) {
    constexpr double kFactors[3] = {1.0, 2.0, 5.0};
    const double decade = std::floor(number / 3.0);
    return kFactors[number - 3 * static_cast<int>(decade)] * std::pow(10.0, decade);
}

/// Edges around the values, which are positive, and one more bar on either side, so that even a
/// single value has a visible place.
std::vector<double> log_edges(double least, double most) {
    int first = 3 * static_cast<int>(std::floor(std::log10(least)));
    while (log_edge(first + 1) <= least) ++first;
    int last = first + 1;
    while (log_edge(last) <= most) ++last;
    std::vector<double> edges;
    for (int number = first - 1; number <= last + 1; ++number) edges.push_back(log_edge(number));
    return edges;
}

/// Whole numbers on the axis of counts.
std::vector<double> whole_ticks(double highest) {
    std::vector<double> ticks = round_ticks({0.0, highest}, 6);
    std::erase_if(ticks, [](double tick) { return tick != std::round(tick); });
    return ticks;
}

}  // namespace

Canvas plot_force_histogram(const SessionNumbers& numbers, const PlotContext& context) {
    return plot_distribution("Force sent while in contact", "force", "N", numbers.sent_newton,
                             numbers.sent_newton.peak(), context);
}

Canvas plot_speed_histogram(const SessionNumbers& numbers, const PlotContext& context) {
    constexpr double kNearlyAll = 0.995;  // a single fast move does not squeeze the rest
    return plot_distribution("Speed on the surface while in contact", "speed of the proxy", "mm/s",
                             numbers.proxy_mm_per_s, numbers.proxy_mm_per_s.quantile(kNearlyAll),
                             context);
}

Canvas plot_contact_histogram(const SessionNumbers& numbers, const PlotContext& context) {
    std::vector<double> lengths;
    for (const Episode& episode : numbers.episodes) {
        lengths.push_back(std::max(episode.length_s(), 1e-4));  // no tick is shorter
    }
    std::sort(lengths.begin(), lengths.end());
    const std::vector<double> edges = log_edges(lengths.front(), lengths.back());
    std::vector<Bar> bars;
    for (std::size_t k = 0; k + 1 < edges.size(); ++k) {
        const auto count = std::count_if(lengths.begin(), lengths.end(), [&](double length) {
            return length >= edges[k] && length < edges[k + 1];
        });
        bars.push_back({edges[k], edges[k + 1], static_cast<double>(count)});
    }
    Axis x{{edges.front(), edges.back()}, "length of a contact [s]", true};
    constexpr std::size_t kMostEdges = 14;  // more are too close to be read: powers of ten then
    if (edges.size() <= kMostEdges) x.ticks = edges;
    Axis y{{0.0, 1.05 * highest_of(bars)}, "contacts"};
    y.ticks = whole_ticks(y.span.high);
    Canvas canvas(kColumns, kRows, kPaper);
    draw_title(canvas, "How long contacts lasted", context.subtitle);
    const Axes axes(kArea, std::move(x), std::move(y));
    axes.draw_ground(canvas);
    draw_bars(canvas, axes, bars);
    axes.draw_frame(canvas);
    const double median = lengths[lengths.size() / 2];
    draw_values(canvas, axes, {{median, "median " + short_text(median, 3) + " s"}});
    return canvas;
}

}  // namespace dibhr
