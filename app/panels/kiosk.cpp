// The buttons of a kiosk, large enough for every hand.
#include <algorithm>
#include <vector>

#include "app/panels/panels.hpp"
#include "app/panels/widgets.hpp"

namespace dibhr {

namespace {

struct KioskButton {
    const char* label;
    KioskCommand command;
};

std::vector<KioskButton> kiosk_buttons(const KioskShown& kiosk) {
    std::vector<KioskButton> buttons;
    if (kiosk.can_repeat) buttons.push_back({"Say again", KioskCommand::say_again});
    if (kiosk.has_next) buttons.push_back({"Next", KioskCommand::next});
    return buttons;
}

/// Of one button: a share of the screen, and never smaller than its text needs.
ImVec2 button_size() {
    constexpr float kShareOfHeight = 0.1F;
    constexpr float kWideness = 3.2F;
    const float height =
        std::max(kShareOfHeight * ImGui::GetIO().DisplaySize.y, 4.0F * ImGui::GetFontSize());
    return {kWideness * height, height};
}

float margin() {
    return ImGui::GetFontSize();
}

}  // namespace

float kiosk_height(const ViewerState& state) {
    if (!state.ui.kiosk || kiosk_buttons(*state.ui.kiosk).empty()) return 0.0F;
    return button_size().y + 2.0F * margin();
}

void draw_kiosk(ViewerState& state) {
    const std::vector<KioskButton> buttons = kiosk_buttons(*state.ui.kiosk);
    if (buttons.empty()) return;
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const ImVec2 size = button_size();
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2{0.0F, 0.0F});
    ImGui::SetNextWindowPos({0.5F * display.x, display.y - margin()}, ImGuiCond_Always,
                            {0.5F, 1.0F});
    ImGui::Begin("Kiosk", nullptr,
                 kBareWindow | ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_AlwaysAutoResize);
    ImGui::PushFont(state.ui.fonts.title);
    const float text_scale = 0.36F * size.y / state.ui.fonts.title->FontSize;
    ImGui::SetWindowFontScale(std::max(text_scale, 1.0F));
    for (const KioskButton& button : buttons) {
        if (&button != buttons.data()) ImGui::SameLine(0.0F, 2.0F * margin());
        if (item::button(button.label, size)) state.commands.push(button.command);
    }
    ImGui::PopFont();
    ImGui::End();
    ImGui::PopStyleVar();
}

}  // namespace dibhr
