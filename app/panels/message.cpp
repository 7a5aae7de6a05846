// The box that tells what went wrong, in the words of the command line. The program goes on behind
// it.
#include "app/panels/panels.hpp"
#include "app/panels/widgets.hpp"

namespace dibhr {

void draw_message_box(ViewerState& state) {
    if (state.message.empty()) return;
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({display.x * 0.5F, display.y * 0.4F}, ImGuiCond_Always, {0.5F, 0.5F});
    ImGui::SetNextWindowSize({ImGui::GetFontSize() * 32.0F, 0.0F});
    bool open = true;
    ImGui::Begin("That did not work", &open,
                 ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoSavedSettings);
    ImGui::TextWrapped("%s", state.message.c_str());
    ImGui::Spacing();
    if (ImGui::Button("Close (Esc)")) open = false;
    ImGui::End();
    if (!open) state.message.clear();
}

}  // namespace dibhr
