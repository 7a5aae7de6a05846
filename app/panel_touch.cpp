// The Touch panel: what is computed at each tick, from the table of options.
#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include "app/options.hpp"
#include "app/panel_list.hpp"
#include "app/panel_options.hpp"
#include "app/panel_widgets.hpp"

namespace dibhr {

namespace {

constexpr std::array kAlgorithmLabels{"DIBHR", "Proxy graph (PGA)", "Neighborhood", "God-object"};

void draw_algorithm(Algorithm& algorithm) {
    int chosen = static_cast<int>(algorithm);
    choice_row(
        "Algorithm", kAlgorithmLabels, chosen,
        "How the proxy follows the goal (--algorithm); another one goes on from where it is");
    algorithm = static_cast<Algorithm>(chosen);
}

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
    draw_algorithm(state.settings.touch.algorithm);
    for (const char* name : {"stiffness", "damping", "static-friction", "dynamic-friction"}) {
        draw_option(name, state.settings.touch);
    }
    draw_bump(state);
    draw_option("roughness", state.settings.touch);
    if (!state.bump) quiet_text("Roughness needs a bump map to be felt.");
    ImGui::PopID();
}

}  // namespace dibhr
