// The buttons of a kiosk, large enough for every hand.
#include <array>
#include <string>

#include "app/panels/panels.hpp"
#include "app/panels/widgets.hpp"

namespace dibhr {

namespace {

struct KioskButton {
    const char* label;
    KioskCommand command;
    bool shown;
};

}  // namespace

void draw_kiosk(ViewerState& state) {
    if (!state.ui.kiosk) return;
    const std::array<KioskButton, 2> buttons{
        {{"Say again", KioskCommand::say_again, state.ui.kiosk->can_repeat},
         {"Next", KioskCommand::next, state.ui.kiosk->has_next}}};
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const float em = ImGui::GetFontSize();
    const ImVec2 size{16.0F * em, 5.0F * em};
    int count = 0;
    for (const KioskButton& button : buttons) count += button.shown ? 1 : 0;
    if (count == 0) return;
    ImGui::SetNextWindowPos({0.5F * display.x, display.y - em}, ImGuiCond_Always, {0.5F, 1.0F});
    ImGui::Begin("Kiosk", nullptr,
                 kBareWindow | ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_AlwaysAutoResize);
    ImGui::PushFont(state.ui.fonts.title);
    bool first = true;
    for (const KioskButton& button : buttons) {
        if (!button.shown) continue;
        if (!first) ImGui::SameLine(0.0F, 2.0F * em);
        first = false;
        if (ImGui::Button(button.label, size)) state.commands.push(button.command);
    }
    ImGui::PopFont();
    ImGui::End();
}

}  // namespace dibhr
