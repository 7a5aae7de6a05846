// The settings of a file that protect the hand less, beside their defaults, for a person to accept
// or refuse.
#include <string>

#include "app/panels/panels.hpp"
#include "app/panels/widgets.hpp"

namespace dibhr {

void draw_unsafe_settings(ViewerState& state) {
    const UiState& ui = state.ui;
    if (ui.unsafe_settings.empty() || state.touch.replay || ui.dialog.shown || !ui.message.empty())
        return;
    begin_card(state, "These settings protect the hand less", 32.0F);
    ImGui::TextWrapped(
        "Nobody on this machine has agreed to these values. The defaults hold until you do.");
    if (ImGui::BeginTable("doubts", 3, ImGuiTableFlags_RowBg)) {
        ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch);
        ImGui::TableSetupColumn("usual", ImGuiTableColumnFlags_WidthFixed);
        ImGui::TableSetupColumn("in the file", ImGuiTableColumnFlags_WidthFixed);
        ImGui::TableHeadersRow();
        for (const UnsafeSetting& doubt : state.ui.unsafe_settings) {
            for (const std::string& text :
                 {std::string(doubt.what), doubt.usual, doubt.requested}) {
                ImGui::TableNextColumn();
                ImGui::TextWrapped("%s", text.c_str());
            }
        }
        ImGui::EndTable();
    }
    if (item::button("Use the file's values")) state.commands.push(AnswerUnsafeSettings{true});
    constexpr const char* kKeep = "Keep the defaults";
    ImGui::SameLine();
    if (ImGui::GetContentRegionAvail().x < ImGui::CalcTextSize(kKeep).x) ImGui::NewLine();
    if (item::button(kKeep)) state.commands.push(AnswerUnsafeSettings{false});
    ImGui::End();
}

}  // namespace dibhr
