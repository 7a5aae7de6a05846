// Where the numbers of a table without mu and depth may come from: both swept.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <set>
#include <string>
#include <vector>

#include <glm/trigonometric.hpp>

#include "core/experiment/plots.hpp"
#include "core/metrics/force_variation.hpp"
#include "core/plot/axes.hpp"
#include "core/plot/style.hpp"

namespace dibhr {
namespace {

constexpr std::size_t kMostColumns = 8;
constexpr Box kPanels{110.0, 130.0, 1560.0, 820.0};
constexpr double kGap_px = 16.0;

/// What a row of panels shows of each point.
struct Quantity {
    const char* label{""};
    double (*of)(const SweepPoint&){nullptr};
    ValueSpan span{};
    double least{0.0};   ///< drawn for less, as 0 has no logarithm
    bool papers{false};  ///< the paper prints numbers for it
};

constexpr std::array kQuantities{
    Quantity{"turn an update, mean [deg]",
             [](const SweepPoint& p) { return p.variation.mean_deg; },
             {0.1, 100.0},
             0.1,
             true},
    Quantity{"error of the force, mean [deg]",
             [](const SweepPoint& p) { return glm::degrees(p.error.mean_rad); },
             {2e-16, 100.0},
             1e-15,
             false},
};

/// The paper's Table 1, the circle's force variation, mean [deg].
struct Printed {
    Algorithm algorithm;
    double mean_deg;
};
constexpr std::array kPrinted{Printed{Algorithm::dibhr, 0.53}, Printed{Algorithm::pga, 4.13},
                              Printed{Algorithm::neighborhood, 7.45}};

/// As many as there is room for, evenly from all.
std::vector<double> shown_depths(const std::vector<SweepPoint>& points) {
    std::set<double> all;
    for (const SweepPoint& point : points) all.insert(point.depth_px);
    std::vector<double> depths(all.begin(), all.end());
    if (depths.size() <= kMostColumns) return depths;
    std::vector<double> shown;
    for (std::size_t k = 0; k < kMostColumns; ++k) {
        shown.push_back(depths[k * (depths.size() - 1) / (kMostColumns - 1)]);
    }
    return shown;
}

ValueSpan span_of_mu(const std::vector<SweepPoint>& points) {
    double highest = 0.1;
    for (const SweepPoint& point : points) highest = std::max(highest, point.mu);
    return {0.0, 1.04 * highest};
}

std::vector<Vec2> series_of(const std::vector<SweepPoint>& points, double depth_px,
                            Algorithm algorithm, const Quantity& quantity) {
    std::vector<Vec2> series;
    for (const SweepPoint& point : points) {
        if (point.path != "circle" || point.depth_px != depth_px || point.algorithm != algorithm)
            continue;
        series.emplace_back(point.mu, std::max(quantity.of(point), quantity.least));
    }
    std::sort(series.begin(), series.end(), [](Vec2 a, Vec2 b) { return a.x < b.x; });
    return series;
}

void draw_printed(Canvas& canvas, const Axes& axes, ValueSpan mu) {
    for (const Printed& printed : kPrinted) {
        const Ink ink = look_of(printed.algorithm).stroke.ink;
        canvas.line(axes.at(mu.low, printed.mean_deg), axes.at(mu.high, printed.mean_deg),
                    {ink, 1.0, Dash::dotted});
    }
}

void draw_algorithm(Canvas& canvas, const Axes& axes, const std::vector<Vec2>& series,
                    Algorithm algorithm) {
    const SeriesLook look = look_of(algorithm);
    Stroke stroke = look.stroke;
    stroke.width_px = 1.5;
    axes.draw_series(canvas, series, stroke);
    for (const Vec2 value : series) {
        const double size = algorithm == Algorithm::god_object ? 10.0 : 7.0;
        canvas.marker(axes.at(value), look.marker, size, look.stroke.ink, kPaper);
    }
}

/// Drawn from the back: the first one listed, DIBHR, comes on top.
std::vector<Algorithm> from_the_back(const std::vector<SweepPoint>& points) {
    std::set<Algorithm> all;
    for (const SweepPoint& point : points) all.insert(point.algorithm);
    return {all.rbegin(), all.rend()};
}

}  // namespace

Canvas plot_sweep(const std::vector<SweepPoint>& points) {
    Canvas canvas(1600, 960, kPaper);
    draw_title(canvas, "How friction and depth change the force's turning: circle",
               "thin dotted lines: what the paper prints for DIBHR (0.53), PGA (4.13) and "
               "Neighborhood (7.45) without saying \u03bc or depth");
    const std::vector<double> depths = shown_depths(points);
    const std::vector<Algorithm> algorithms = from_the_back(points);
    const ValueSpan mu = span_of_mu(points);
    const double columns = static_cast<double>(std::max<std::size_t>(depths.size(), 1));
    const double width = (kPanels.width() - kGap_px * (columns - 1.0)) / columns;
    const double height = (kPanels.height() - 56.0) / 2.0;
    for (std::size_t column = 0; column < depths.size(); ++column) {
        const double left = kPanels.left + static_cast<double>(column) * (width + kGap_px);
        double top = kPanels.top;
        canvas.text({left + width / 2.0, top - 14.0}, "depth " + tick_text(depths[column]) + " px",
                    {kTextInk, kLabelCap_px, Align::centre, true});
        for (const Quantity& quantity : kQuantities) {
            const bool lowest = &quantity == &kQuantities.back();
            Axis x{mu, lowest ? "friction \u03bc" : "", false, lowest, 6};
            Axis y{quantity.span, column == 0 ? quantity.label : "", true, column == 0, 9};
            const Axes axes({left, top, left + width, top + height}, x, y);
            axes.draw_ground(canvas);
            if (quantity.papers) draw_printed(canvas, axes, mu);
            for (const Algorithm algorithm : algorithms) {
                draw_algorithm(canvas, axes, series_of(points, depths[column], algorithm, quantity),
                               algorithm);
            }
            axes.draw_frame(canvas);
            top += height + 40.0;
        }
    }
    double left = kPanels.left;
    for (auto algorithm = algorithms.rbegin(); algorithm != algorithms.rend(); ++algorithm) {
        draw_legend(canvas, {left, 900.0}, {look_of(*algorithm)});
        left += 280.0;
    }
    return canvas;
}

}  // namespace dibhr
