// The Surface panel: the shape of the relief, how it is drawn, and from where.
#include "app/panels/panels.hpp"
#include "app/panels/widgets.hpp"
#include "core/files/plain_text.hpp"

namespace dibhr {

namespace {

/// A number that is moved is a person's own from then on.
void draw_shape(ViewerState& state) {
    Settings& settings = state.settings;
    const TouchParameters before = settings.touch;
    draw_numbers(TouchTopic::shape, settings.touch);
    const TouchParameters& now = settings.touch;
    if (now.shape.relief_px != before.shape.relief_px) settings.fit_relief = false;
    if (now.coupling.pixel_pitch_mm != before.coupling.pixel_pitch_mm) settings.fit_pitch = false;
    if (state.replay) return;
    flag_row("Relief as fits the picture", settings.fit_relief, true,
             "From the farthest to the nearest a third of the picture's width (--relief auto)");
    flag_row("Pitch as fits the picture", settings.fit_pitch, true,
             "The hand's reach is the picture's width (--pixel-pitch auto)");
}

/// The pixel under the hand, in the depth's own words and as it stands.
void draw_under_hand(const ViewerState& state) {
    if (!state.under_hand) {
        fact_row("Under the hand", "beside the picture");
        return;
    }
    const UnderHand& here = *state.under_hand;
    const double pitch_mm = state.settings.touch.coupling.pixel_pitch_mm;
    fact_row("Under the hand", formatted("pixel %d, %d", here.column, here.row));
    fact_row("Stands",
             formatted("%.1f px, %.2f mm", here.elevation_px, here.elevation_px * pitch_mm));
    if (here.unseen) {
        fact_row("Depth", "no data");
    } else if (state.media.meaning) {
        const DepthMeaning& meaning = *state.media.meaning;
        const double value = value_at(meaning, here.nearness);
        const std::string unit(meaning.unit.value == DepthUnit::levels
                                   ? std::string_view{}
                                   : name_of(meaning.unit.value));
        fact_row("Depth", short_text(value, 5) + " " + unit +
                              formatted(" (level %.1f)", value / meaning.scale.value));
    }
}

}  // namespace

void draw_surface_panel(ViewerState& state) {
    if (!section(state, "Surface", state.settings.panels.surface)) return;
    ImGui::PushID("surface");
    Settings& settings = state.settings;
    const ReliefLook standard;
    draw_shape(state);
    draw_under_hand(state);
    number_row({"Shading", "%.2f", 0.0, 1.0, standard.light, "0: flat colour, 1: strong"},
               settings.look.light);
    flag_row("Colour of the video", settings.look.textured, standard.textured,
             "Off: plain clay, which shows the shape");
    flag_row("Cut silhouettes", settings.look.discard_silhouettes, standard.discard_silhouettes,
             "Leaves out the stretched walls between near and far; they are still there to touch");
    ImGui::BeginDisabled(!settings.look.discard_silhouettes);
    number_row({"Cut steeper than", "%.0f px/px", 1.0, 40.0, standard.silhouette_slope,
                "Elevation change per pixel"},
               settings.look.silhouette_slope);
    ImGui::EndDisabled();
    flag_row("Coarse drawing", settings.look.coarse, standard.coarse,
             "Every second point, for slow machines; touch stays exact");
    flag_row("Dent and shadow", settings.look.dent, standard.dent,
             "The skin gives way under the proxy: drawn only, what is felt stays as it is");
    flag_row("Trace", settings.look.trace, standard.trace,
             "Dots where you have touched in the last seconds");
    int straight = settings.straight_view ? 1 : 0;
    ImGui::RadioButton("Perspective", &straight, 0);
    ImGui::SameLine();
    ImGui::RadioButton("Straight", &straight, 1);
    explain("As the camera that recorded it (V)");
    settings.straight_view = straight == 1;
    ImGui::SameLine();
    if (ImGui::Button("Reset view")) state.requests.reset_view = true;
    explain("R");
    ImGui::PopID();
}

}  // namespace dibhr
