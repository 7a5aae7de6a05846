// The Touch panel: what is computed at each tick, from the table of options.

#include "app/panels/falcon_state.hpp"
#include "app/panels/panels.hpp"
#include "app/panels/widgets.hpp"

namespace dibhr {

namespace {

/// In a replay: whose parameters these are, and the way back to those of the recording.
void draw_origin(ViewerState& state) {
    if (!state.replay) return;
    if (!state.replay->computes) {
        quiet_text("As recorded. Change something: the forces are computed again.");
        return;
    }
    quiet_text("Computed again with these. The pale ball is the recorded proxy.");
    if (ImGui::Button("As recorded", {-1.0F, 0.0F})) state.requests.as_recorded = true;
    explain("Back to the recorded parameters, proxies and forces");
}

/// Says so when the Falcon cannot be as stiff, or damp as much, as it was asked for.
void draw_held_coupling(const ViewerState& state) {
    const Coupling held = felt_coupling(state);
    if (!(held == state.settings.touch.coupling)) {
        quiet_text(
            formatted("Felt as %.2f N/mm and %.1f N s/m: at this scale of the workspace the Falcon "
                      "can give no more.",
                      held.stiffness_newton_per_mm, held.damping_newton_s_per_m));
    }
}

void draw_bump(ViewerState& state) {
    if (state.replay) {
        if (state.bump) fact_row("Bump map", state.bump_file.filename().string());
        return;
    }
    if (text_field("##bump", "Bump map: a grey picture", state.fields.bump,
                   "Path of a picture laid over the surface as fine relief; Enter takes it")) {
        state.requests.bump = std::filesystem::path(state.fields.bump.data());
    }
    if (!state.bump) return;
    fact_row("Bump map", state.bump_file.filename().string());
    if (ImGui::Button("Remove the bump map")) state.requests.bump = std::filesystem::path{};
}

}  // namespace

void draw_touch_panel(ViewerState& state) {
    if (!section(state, "Touch", state.settings.panels.touch)) return;
    ImGui::PushID("touch");
    draw_origin(state);
    choice_row(
        "Algorithm", algorithm_words(), state.settings.touch.algorithm,
        "How the proxy follows the goal (--algorithm); another one goes on from where it is");
    draw_numbers(TouchTopic::spring, state.settings.touch);
    draw_held_coupling(state);
    draw_numbers(TouchTopic::damper, state.settings.touch);
    draw_numbers(TouchTopic::friction, state.settings.touch);
    draw_bump(state);
    draw_numbers(TouchTopic::texture, state.settings.touch);
    if (!state.bump && !state.replay) quiet_text("Roughness needs a bump map to be felt.");
    ImGui::PopID();
}

}  // namespace dibhr
