// The picture of the page that explains: a few pixels of the circle, and how the forces turn.
#include <algorithm>
#include <string>

#include "core/experiment/plot_magnified.hpp"
#include "core/experiment/plot_settings.hpp"
#include "core/experiment/plot_turning.hpp"
#include "core/experiment/plots.hpp"
#include "core/plot/style.hpp"

namespace dibhr {

namespace {

/// Wide enough for the ways to bend.
MagnifiedPlace explained_place(const PathRun& circle) {
    constexpr double kSide_px = 44.0;
    MagnifiedPlace place = typical_place(circle);
    place.side_px = std::max(place.side_px, kSide_px);
    return place;
}

}  // namespace

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
