// Writes the evaluation's pictures into a folder, and draws that of the page that explains.
#include "core/experiment/plots.hpp"

#include <algorithm>
#include <string>

#include "core/experiment/plot_magnified.hpp"
#include "core/experiment/plot_turning.hpp"
#include "core/plot/style.hpp"

namespace dibhr {

namespace {

void write(const Canvas& plot, const PlotFiles& files, const std::string& name) {
    for (const PlotFormat format : files.formats) {
        files.folder.add(name + "." + std::string(name_of(format)), plot.encoded(format));
    }
}

/// Wide enough for the ways to bend.
MagnifiedPlace explained_place(const PathRun& circle) {
    constexpr double kSide_px = 44.0;
    MagnifiedPlace place = typical_place(circle);
    place.side_px = std::max(place.side_px, kSide_px);
    return place;
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
                "dotted: the hand; pale: exact; a marker a millisecond; lines to the black dot: "
                "one moment's springs",
                {kQuietInk, kNumberCap_px});
    const auto panels = static_cast<double>(std::max<std::size_t>(circle.runs.size(), 1));
    const double each = (kMagnified.height() - kGap_px * (panels - 1.0)) / panels;
    const double highest = highest_turn_deg(circle);
    double top = kMagnified.top;
    for (const AlgorithmRun& run : circle.runs) {
        const Box area{670.0, top, 1160.0, top + each};
        const SeriesLook look = look_of(run.algorithm);
        canvas.marker({area.left + 5.0, top - 13.0}, look.marker, 10.0, look.stroke.ink, kPaper);
        canvas.text({area.left + 20.0, top - 8.0},
                    look.name + ": turns " + sliding_words(run.variation) + " deg", head);
        draw_turning(canvas, area, circle, run, {highest, &run == &circle.runs.back()});
        top += each + kGap_px;
    }
    return canvas;
}

}  // namespace dibhr
