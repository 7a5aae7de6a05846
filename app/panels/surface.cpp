// The Surface panel: the shape of the relief, how it is drawn, and from where.
#include <algorithm>
#include <cmath>
#include <string>

#include "app/panels/panels.hpp"
#include "app/panels/widgets.hpp"
#include "core/files/plain_text.hpp"

namespace dibhr {

namespace {

/// A change by a person switches the automatic value off.
void draw_shape(ViewerState& state) {
    Settings& settings = state.settings;
    const TouchParameters before = settings.touch;
    TouchParameters usual;  // an automatic value counts as its default
    if (settings.fit_relief) usual.shape.relief_px = before.shape.relief_px;
    if (settings.fit_pitch) usual.coupling.pixel_pitch_mm = before.coupling.pixel_pitch_mm;
    draw_parameters(TouchTopic::shape, settings.touch, usual);
    const TouchParameters& now = settings.touch;
    if (now.shape.relief_px != before.shape.relief_px) settings.fit_relief = false;
    if (now.coupling.pixel_pitch_mm != before.coupling.pixel_pitch_mm) settings.fit_pitch = false;
    if (state.touch.replay) return;
    flag_row("Relief as fits the picture", settings.fit_relief, true,
             "Height from the farthest to the nearest depth: about a third of the picture's width "
             "(--relief auto)");
    flag_row("Pitch as fits the picture", settings.fit_pitch, true,
             "The reach of the device is laid over the picture's width (--pixel-pitch auto)");
}

/// The pixel under the hand: its elevation, and its depth in the file's own unit.
void draw_under_hand(const ViewerState& state) {
    if (!state.ui.under_hand) {
        fact_row("Under the hand", "beside the picture");
        return;
    }
    const PixelShown& here = *state.ui.under_hand;
    fact_row("Under the hand", formatted("pixel %d, %d", here.column, here.row));
    fact_row("Elevation", elevation_text(state, here), "How high, over the farthest depth");
    if (here.unseen || state.media.meaning)
        fact_row("Depth", depth_text(state, here), "As the file has it");
}

/// Buttons, not a slider, which would change its size while it is dragged.
void draw_text_size(ViewerState& state) {
    constexpr double kStep = 1.25;
    double& scale = state.settings.ui_scale;
    const auto choose = [&](const char* label, double wanted, const char* help) {
        if (item::button(label)) scale = wanted;
        add_tooltip(help);
    };
    const double now = static_cast<double>(state.ui.scale);
    choose("Smaller text", std::max(now / kStep, kSmallestUi), "Of all panels; as --ui-scale");
    ImGui::SameLine();
    choose("Larger text", std::min(now * kStep, kLargestUi), "Of all panels; as --ui-scale");
    ImGui::SameLine();
    ImGui::BeginDisabled(!(scale > 0.0));
    choose("Default size", 0.0, "As large as the display says");
    ImGui::EndDisabled();
}

}  // namespace

std::string elevation_text(const ViewerState& state, const PixelShown& pixel) {
    const double pitch_mm = state.settings.touch.coupling.pixel_pitch_mm;
    return formatted("%.1f px, %.2f mm", pixel.elevation_px, pixel.elevation_px * pitch_mm);
}

int depth_digits(const DepthMeaning& meaning) {
    constexpr double kSteps = 4.0;
    constexpr double kMost = 6.0;
    const double step = std::abs(value_at(meaning, 1.0) - value_at(meaning, 0.0)) / kSteps;
    if (!(step > 0.0)) return 0;
    return static_cast<int>(std::clamp(std::ceil(-std::log10(step)) + 1.0, 0.0, kMost));
}

std::string depth_text(const ViewerState& state, const PixelShown& pixel) {
    if (pixel.unseen) return "no data";
    if (!state.media.meaning) return {};
    const DepthMeaning& meaning = *state.media.meaning;
    const double value = value_at(meaning, pixel.nearness);
    std::string level = formatted("level %.1f", value / meaning.scale.value);
    if (meaning.unit.value == DepthUnit::levels) return level;
    return decimal(value, depth_digits(meaning) + 1) + " " +
           std::string(name_of(meaning.unit.value)) + " (" + level + ")";
}

void draw_surface_panel(ViewerState& state) {
    if (!section(state, "Surface", state.settings.panels.surface)) return;
    ImGui::PushID("surface");
    Settings& settings = state.settings;
    const ReliefStyle standard;
    draw_shape(state);
    draw_under_hand(state);
    number_row({"Shading", "%.2f", 0.0, 1.0, standard.light, "0: flat colour, 1: strong"},
               settings.relief_style.light);
    const std::string next = state.keys.name_for(Action::next_paint);
    const std::string one_by_one = next.empty() ? "" : " (" + next + ": one after the other)";
    choice_row("Painted with", kReliefPaintNames, settings.relief_style.paint,
               ("Clay shows the shape; the depth's colours have a legend" + one_by_one).c_str());
    flag_row("Colour and depth above", settings.panes, false,
             ("Both as pictures above the relief, with the proxy and the pointer on them" +
              state.keys.in_brackets(Action::toggle_panes))
                 .c_str());
    flag_row("Cut silhouettes", settings.relief_style.discard_silhouettes,
             standard.discard_silhouettes,
             "Draws what is behind instead of stretched walls; the walls can still be touched");
    ImGui::BeginDisabled(!settings.relief_style.discard_silhouettes);
    number_row({"Cut steeper than", "%.0f px/px", 1.0, 40.0, standard.silhouette_slope,
                "Elevation change per pixel, and a step of twice that height"},
               settings.relief_style.silhouette_slope);
    ImGui::EndDisabled();
    flag_row("Coarse drawing", settings.relief_style.coarse, standard.coarse,
             "Every second point, for slow machines; touch stays exact");
    flag_row("Dent and shadow", settings.relief_style.dent, standard.dent,
             "The skin gives way under the proxy: drawn only, what is felt stays as it is");
    flag_row("Trace", settings.relief_style.trace, standard.trace,
             "Dots where you have touched in the last seconds");
    int straight = settings.straight_view ? 1 : 0;
    item::radio_button("Perspective", &straight, 0);
    ImGui::SameLine();
    item::radio_button("Straight", &straight, 1);
    add_tooltip("As seen by the camera that recorded it", state.keys, Action::toggle_straight_view);
    settings.straight_view = straight == 1;
    ImGui::SameLine();
    if (item::button("Reset view")) state.commands.push(Action::reset_view);
    add_tooltip(state.keys.name_for(Action::reset_view).c_str());
    choice_row("Theme", kThemeNames, settings.theme,
               "The colours of the panels and the wall (--theme)");
    draw_text_size(state);
    ImGui::PopID();
}

}  // namespace dibhr
