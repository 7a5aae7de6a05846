// The Touch panel: what is computed at each tick, from the table of options.
#include <algorithm>
#include <string>
#include <string_view>

#include "app/options.hpp"
#include "app/panel_list.hpp"
#include "app/panel_options.hpp"
#include "app/panel_widgets.hpp"

namespace dibhr {

namespace {

void draw_bump(ViewerState& state) {
    ImGui::SetNextItemWidth(-1.0F);
    if (ImGui::InputTextWithHint("##bump", "Bump map: a grey picture", state.fields.bump.data(),
                                 state.fields.bump.size(), ImGuiInputTextFlags_EnterReturnsTrue)) {
        state.requests.bump = std::filesystem::path(state.fields.bump.data());
    }
    explain("Path of a picture laid over the surface as fine relief; Enter takes it");
    if (!state.bump) return;
    fact_row("Bump map", state.bump_file.filename().string());
    if (ImGui::Button("Remove the bump map")) state.requests.bump = std::filesystem::path{};
}

}  // namespace

void draw_touch_panel(ViewerState& state) {
    if (!section(state, "Touch", state.settings.panels.touch)) return;
    ImGui::PushID("touch");
    fact_row("Algorithm", "DIBHR");
    for (const char* name : {"stiffness", "damping", "static-friction", "dynamic-friction"}) {
        draw_option(name, state.settings.touch);
    }
    draw_bump(state);
    draw_option("roughness", state.settings.touch);
    if (!state.bump) quiet_text("Roughness needs a bump map to be felt.");
    ImGui::PopID();
}

}  // namespace dibhr
