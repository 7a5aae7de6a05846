// Writes the evaluation's pictures into a folder, and draws the sweep and the page that explains.
#include "core/experiment/plots.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <glm/trigonometric.hpp>
#include <set>
#include <string>
#include <vector>

#include "core/experiment/report.hpp"
#include "core/files/plain_text.hpp"
#include "core/haptics/enum_names.hpp"
#include "core/metrics/force_variation.hpp"
#include "core/plot/axes.hpp"

namespace dibhr {

namespace {

void write(const Canvas& plot, const PlotFiles& files, const std::string& name) {
    for (const PlotFormat format : files.formats) {
        files.folder.add(name + "." + std::string(name_of(format)), plot.encoded(format));
    }
}

/// Wide enough to show that the paths bend.
MagnifiedPlace explained_place(const PathRun& circle) {
    constexpr double kSide_px = 44.0;
    MagnifiedPlace place = typical_place(circle);
    place.side_px = std::max(place.side_px, kSide_px);
    return place;
}

constexpr std::size_t kMostColumns = 8;
constexpr Box kPanels{110.0, 130.0, 1560.0, 820.0};
constexpr double kPanelGap_px = 16.0;

/// The quantity that a row of panels shows of each point.
struct Quantity {
    const char* label{""};
    double (*of)(const SweepPoint&){nullptr};
    ValueSpan span{};
    double least{0.0};     ///< drawn for less: 0 has no logarithm
    bool in_paper{false};  ///< the paper prints numbers for it
};

constexpr std::array kQuantities{
    Quantity{"turn per update, mean [deg]",
             [](const SweepPoint& p) { return p.run.variation.mean_deg; },
             {0.1, 100.0},
             0.1,
             true},
    Quantity{"error of the force, mean [deg]",
             [](const SweepPoint& p) {
                 return glm::degrees(p.run.error.value_or(ExactError{}).mean_rad);
             },
             {2e-16, 100.0},
             1e-15,
             false},
};

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
        const bool shown = point.path == "circle" && point.depth_px == depth_px &&
                           point.run.algorithm == algorithm;
        if (!shown) continue;
        series.emplace_back(point.mu, std::max(quantity.of(point), quantity.least));
    }
    std::sort(series.begin(), series.end(), [](Vec2 a, Vec2 b) { return a.x < b.x; });
    return series;
}

/// "DIBHR 0.53, PGA (proxy graph) 4.13, Neighborhood 7.45": Table 1, around the circle [deg].
std::string paper_means() {
    std::string means;
    for (const NamedValue<Algorithm>& word : name_table(Algorithm{})) {
        const auto paper = paper_result("circle", word.value);
        if (!paper) continue;
        means.append(means.empty() ? "" : ", ").append(word.label);
        means.append(" ").append(number_text(paper->variation_mean_deg, 2));
    }
    return means;
}

/// The paper's Table 1.
void draw_paper_means(Canvas& canvas, const Axes& axes, ValueSpan mu) {
    for (const NamedValue<Algorithm>& word : name_table(Algorithm{})) {
        const auto paper = paper_result("circle", word.value);
        if (!paper) continue;
        const double mean_deg = paper->variation_mean_deg;
        canvas.line(axes.at(mu.low, mean_deg), axes.at(mu.high, mean_deg),
                    {style_of(word.value).stroke.ink, 1.0, Dash::dotted});
    }
}

void draw_algorithm(Canvas& canvas, const Axes& axes, const std::vector<Vec2>& series,
                    Algorithm algorithm) {
    const SeriesStyle look = style_of(algorithm);
    Stroke stroke = look.stroke;
    stroke.width_px = 1.5;
    axes.draw_series(canvas, series, stroke);
    for (const Vec2 value : series) {
        const double size = algorithm == Algorithm::god_object ? 10.0 : 7.0;
        canvas.marker(axes.at(value), look.marker, size, look.stroke.ink, kPaper);
    }
}

/// The algorithms in drawing order: DIBHR is drawn last, on top.
std::vector<Algorithm> in_drawing_order(const std::vector<SweepPoint>& points) {
    std::set<Algorithm> all;
    for (const SweepPoint& point : points) all.insert(point.run.algorithm);
    return {all.rbegin(), all.rend()};
}

}  // namespace

void write_plots(const std::vector<PathRun>& paths, const ColourImage* torso_colour,
                 const PlotFiles& files) {
    for (const PathRun& path : paths) {
        const ColourImage* under = path.name == "human" ? torso_colour : nullptr;
        write(plot_paths(path, under), files, "paths-" + path.name);
        write(plot_force(path), files, "force-" + path.name);
        if (path.name == "circle") write(plot_explanation(path), files, "explained");
        if (!path.exact_proxies.empty()) write(plot_error(path), files, "error-" + path.name);
    }
}

void write_sweep_plot(const std::vector<SweepPoint>& points, const PlotFiles& files) {
    write(plot_sweep(points), files, "sweep");
}

Canvas plot_explanation(const PathRun& circle) {
    constexpr Box kMagnified{70.0, 100.0, 570.0, 600.0};
    constexpr double kGap_px = 36.0;
    Canvas canvas(1200, 680, kPaper);
    const TextStyle head{kTextInk, kLabelCap_px, Align::left, true};
    draw_title(canvas, "Around a circle on a plane: where the proxy goes, how its force turns",
               settings_of(circle));
    draw_magnified(canvas, kMagnified, circle, explained_place(circle), nullptr);
    canvas.text({kMagnified.left, kMagnified.bottom + 62.0},
                "dotted: the hand; pale: exact; one marker per ms; lines to the black dot: springs "
                "of one moment",
                {kQuietInk, kNumberCap_px});
    const auto panels = static_cast<double>(std::max<std::size_t>(circle.runs.size(), 1));
    const double each = (kMagnified.height() - kGap_px * (panels - 1.0)) / panels;
    const double highest = highest_turn_deg(circle);
    double top = kMagnified.top;
    for (const AlgorithmRun& run : circle.runs) {
        const Box area{670.0, top, 1160.0, top + each};
        const SeriesStyle look = style_of(run.algorithm);
        canvas.marker({area.left + 5.0, top - 13.0}, look.marker, 10.0, look.stroke.ink, kPaper);
        canvas.text({area.left + 20.0, top - 8.0},
                    look.name + ": turns " + sliding_text(run.variation) + " deg", head);
        draw_turning(canvas, area, circle, run, {highest, &run == &circle.runs.back()});
        top += each + kGap_px;
    }
    return canvas;
}

Canvas plot_sweep(const std::vector<SweepPoint>& points) {
    Canvas canvas(1600, 960, kPaper);
    draw_title(canvas, "How friction and depth change the force's turning: circle",
               "thin dotted lines: what the paper prints, " + paper_means() +
                   ", without saying \u03bc or depth");
    const std::vector<double> depths = shown_depths(points);
    const std::vector<Algorithm> algorithms = in_drawing_order(points);
    const ValueSpan mu = span_of_mu(points);
    const double columns = static_cast<double>(std::max<std::size_t>(depths.size(), 1));
    const double width = (kPanels.width() - kPanelGap_px * (columns - 1.0)) / columns;
    const double height = (kPanels.height() - 56.0) / 2.0;
    for (std::size_t column = 0; column < depths.size(); ++column) {
        const double left = kPanels.left + static_cast<double>(column) * (width + kPanelGap_px);
        double top = kPanels.top;
        canvas.text({left + width / 2.0, top - 14.0}, "depth " + tick_text(depths[column]) + " px",
                    {kTextInk, kLabelCap_px, Align::centre, true});
        for (const Quantity& quantity : kQuantities) {
            const bool lowest = &quantity == &kQuantities.back();
            Axis x{mu, lowest ? "friction \u03bc" : "", false, lowest, 6};
            Axis y{quantity.span, column == 0 ? quantity.label : "", true, column == 0, 9};
            const Axes axes({left, top, left + width, top + height}, x, y);
            axes.draw_ground(canvas);
            if (quantity.in_paper) draw_paper_means(canvas, axes, mu);
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
        draw_legend(canvas, {left, 900.0}, {style_of(*algorithm)});
        left += 280.0;
    }
    return canvas;
}

}  // namespace dibhr
