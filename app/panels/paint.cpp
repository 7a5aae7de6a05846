// The Paint panel: what a brush paints on the relief and how, undo and redo; and the brush's edge.
#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "app/panels/panels.hpp"
#include "app/panels/relief_screen.hpp"
#include "app/panels/widgets.hpp"
#include "app/settings/keys.hpp"

namespace dibhr {

namespace {

constexpr ImU32 kRing = IM_COL32(255, 255, 255, 235);
constexpr ImU32 kRingEdge = IM_COL32(0, 0, 0, 190);

void draw_material_row(ViewerState& state) {
    std::vector<std::string> all = state.ui.materials.shipped;
    all.insert(all.end(), state.ui.materials.own.begin(), state.ui.materials.own.end());
    std::vector<std::string> spoken;
    spoken.reserve(all.size());
    for (const std::string& name : all) spoken.push_back(display_name(name));
    std::vector<const char*> names;
    names.reserve(all.size());
    for (const std::string& name : spoken) names.push_back(name.c_str());
    Brush& brush = state.ui.brush;
    int chosen = static_cast<int>(std::find(all.begin(), all.end(), brush.material) - all.begin());
    if (index_row("Made of", names, chosen,
                  "Its stiffness and friction, and its bumps as height where the brush goes", 0))
        brush.material = all[static_cast<std::size_t>(chosen)];
}

void set_text(TextField& field, const std::string& text) {
    field.fill('\0');
    std::copy_n(text.data(), std::min(text.size(), field.size() - 1), field.data());
}

/// Empty, too, where no region has that name.
std::string text_of(const Regions& regions, std::string_view name) {
    const auto found = std::ranges::find(regions.regions, name, &Region::name);
    return found == regions.regions.end() ? std::string() : found->text;
}

/// The region that is painted: one of those there are, or a new one.
void draw_region_rows(ViewerState& state) {
    Brush& brush = state.ui.brush;
    if (brush.regions) {
        std::vector<const char*> names;
        for (const Region& region : brush.regions->regions) names.push_back(region.name.c_str());
        names.push_back("A new one");
        const auto at =
            std::find(names.begin(), names.end() - 1, std::string_view(brush.region_name.data()));
        const int fresh = static_cast<int>(names.size()) - 1;
        int chosen = static_cast<int>(at - names.begin());
        if (index_row("Region", names, chosen, "One that there is, to paint more of it", fresh)) {
            const Region region = chosen == fresh
                                      ? Region{}
                                      : brush.regions->regions[static_cast<std::size_t>(chosen)];
            set_text(brush.region_name, region.name);
            set_text(brush.region_text, region.text);
        }
    }
    const bool named = text_row("Name", "Name of the region", brush.region_name,
                                "Shown and spoken where the region is touched");
    if (named && brush.regions && brush.region_text.front() == '\0')
        set_text(brush.region_text, text_of(*brush.regions, brush.region_name.data()));
    text_row("Text", "Text on it, if any", brush.region_text,
             "Shown and spoken once the finger rests; may be empty");
    if (brush.region_name.front() == '\0') draw_dimmed("Give the region a name, then paint it.");
}

/// The value that the brush paints.
void draw_value_row(ViewerState& state) {
    Brush& brush = state.ui.brush;
    const Brush standard;
    const auto row = [](const char* label, const char* format, TouchMapKind kind, double usual,
                        const char* help, double& value) {
        const MapLimits limits = standard_limits(kind);
        number_row({label, format, limits.lowest, limits.highest, usual, help}, value);
        value = std::clamp(value, limits.lowest, limits.highest);
    };
    switch (brush.layer) {
        case BrushLayer::material:
            return draw_material_row(state);
        case BrushLayer::stiffness:
            return row("Stiffness", "%.2f N/mm", TouchMapKind::stiffness,
                       standard.stiffness_newton_per_mm,
                       "Stiffness of the spring, instead of the Touch panel's",
                       brush.stiffness_newton_per_mm);
        case BrushLayer::friction:
            return row(
                "Friction", "%.2f", TouchMapKind::friction, standard.friction,
                "The static coefficient, instead of the Touch panel's; the dynamic one keeps "
                "its ratio to it",
                brush.friction);
        case BrushLayer::height:
            return row("Height", "%.1f px", TouchMapKind::height, standard.height_px,
                       "On top of the depth; below 0: pressed in", brush.height_px);
        case BrushLayer::region:
            return draw_region_rows(state);
        case BrushLayer::nothing:
            return draw_dimmed("Erases what was painted, of every kind.");
    }
}

void draw_undo_buttons(ViewerState& state) {
    const float gap = ImGui::GetStyle().ItemSpacing.x;
    const float third = (ImGui::GetContentRegionAvail().x - 2.0F * gap) / 3.0F;
    const bool one_row = button_width("Remove all") <= third;
    const auto button = [&](const char* label, bool enabled, const std::string& help) {
        ImGui::BeginDisabled(!enabled);
        const bool pressed = item::button(label, {one_row ? third : half_width(), 0.0F});
        ImGui::EndDisabled();
        add_tooltip(help.c_str());
        return pressed;
    };
    const KeyTable& keys = state.keys;
    if (button("Undo", state.ui.brush.can_undo,
               "Takes back what was painted last" + keys.in_brackets(Action::undo)))
        state.commands.push(Action::undo);
    ImGui::SameLine();
    if (button("Redo", state.ui.brush.can_redo, "Paints it again" + keys.in_brackets(Action::redo)))
        state.commands.push(Action::redo);
    if (one_row) ImGui::SameLine();
    if (button("Remove all", state.ui.brush.has_paint, "All that is painted on this recording"))
        state.commands.push(RemovePaint{});
}

}  // namespace

void draw_paint_panel(ViewerState& state) {
    const bool comes = state.ui.show_paint;
    if (!section(state, "Paint", state.settings.panels.paint, &state.ui.show_paint)) return;
    Brush& brush = state.ui.brush;
    if (!brush.refusal.empty()) return draw_dimmed(brush.refusal);
    ImGui::PushID("paint");
    bool on = brush.on;
    if (item::checkbox("Brush", &on)) state.commands.push(Action::toggle_brush);
    add_tooltip(("The left mouse button paints on the relief instead of touching it" +
                 state.keys.in_brackets(Action::toggle_brush))
                    .c_str());
    choice_row("Paints", kBrushLayerNames, brush.layer,
               "What the brush lays; there it counts instead of the Touch panel");
    draw_value_row(state);
    const Brush standard;
    double percent = 100.0 * brush.width;
    if (number_row({"Width", "%.1f %%", 0.5, 50.0, 100.0 * standard.width,
                    "Width of the brush, as a share of the picture's width"},
                   percent))
        brush.width = std::clamp(percent / 100.0, 0.001, 1.0);
    double strength = 100.0 * brush.strength;
    if (number_row({"Strength", "%.0f %%", 1.0, 100.0, 100.0, "How much of it a stroke lays"},
                   strength))
        brush.strength = std::clamp(strength / 100.0, 0.0, 1.0);
    draw_undo_buttons(state);
    if (brush.has_paint && !brush.on)
        draw_dimmed("What is painted is felt now; its colour is seen while the brush is on.");
    if (brush.saved_as.empty()) {
        draw_dimmed(
            "Paint on the sample is not kept: it is gone when another recording is opened.");
    } else {
        draw_dimmed("Kept beside the recording as " + brush.saved_as.filename().string() +
                    " and files named like it, regions too; dibhr finds them again.");
    }
    // To the end of the panel; the column's new height is known only a picture later.
    constexpr int kPicturesToScroll = 3;
    if (comes) brush.scrolls = kPicturesToScroll;
    if (brush.scrolls > 0) {
        --brush.scrolls;
        ImGui::SetScrollHereY(1.0F);
    }
    ImGui::PopID();
}

void draw_brush(const ViewerState& state, const glm::dmat4& clip_from_grid) {
    const std::vector<Vec3>& ring = state.ui.brush.ring;
    if (!state.ui.brush.on || state.ui.explained || ring.empty()) return;
    const ReliefScreen screen(state, clip_from_grid);
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    list.PushClipRect(screen.low(), screen.high());
    for (const auto& [colour, thick] : {std::pair(kRingEdge, 3.5F), std::pair(kRing, 1.5F)}) {
        for (std::size_t k = 0; k < ring.size(); ++k) {
            const auto a = screen.at(ring[k]);
            const auto b = screen.at(ring[(k + 1) % ring.size()]);
            if (a && b) list.AddLine(*a, *b, colour, thick * state.ui.scale);
        }
    }
    list.PopClipRect();
}

}  // namespace dibhr
