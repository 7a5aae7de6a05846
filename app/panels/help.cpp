// The help sheet, from the table of keys, and the mouse.
#include <string>
#include <string_view>

#include "app/panels/panels.hpp"
#include "app/panels/widgets.hpp"
#include "app/settings/keys.hpp"

namespace dibhr {

namespace {

struct Explained {
    const char* what;
    const char* help;
};

constexpr Explained kMarks[] = {
    {"Orange ring", "The goal: where the hand is"},
    {"Blue ball", "The proxy: stays on the surface"},
    {"Pale ball", "In a replay: the proxy as recorded"},
    {"Line between", "The spring that pulls the hand"},
    {"Yellow arrow", "The force on the hand"},
    {"Green rod", "The surface's normal"},
    {"Pale cone", "The friction cone: a proxy inside it sticks"},
};

constexpr Explained kMouse[] = {
    {"Move", "The hand hovers over the surface"},
    {"Hold left", "Press in, deeper for the first second"},
    {"Hold left + wheel", "Deeper still, less deep"},
    {"Drag right", "Turn the view"},
    {"Drag middle, Shift + right", "Shift the view"},
    {"Wheel", "Nearer, farther"},
};

void row(const char* left, const char* right) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(left);
    ImGui::TableNextColumn();
    ImGui::TextDisabled("%s", right);
}

void heading(const ViewerState& state, const std::string& text) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::Spacing();
    ImGui::PushFont(state.fonts.heading);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopFont();
}

void draw_keys(const ViewerState& state) {
    std::string_view group;
    for (const KeyBinding& binding : key_bindings()) {
        if (binding.shown.empty()) continue;
        if (binding.group != group) {
            group = binding.group;
            heading(state, std::string(group));
        }
        row(std::string(binding.shown).c_str(), std::string(binding.help).c_str());
    }
}

}  // namespace

void draw_help_sheet(ViewerState& state) {
    if (!state.help_open) return;
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({display.x * 0.5F, display.y * 0.5F}, ImGuiCond_Appearing,
                            {0.5F, 0.5F});
    ImGui::Begin("Keys and mouse", &state.help_open,
                 ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_AlwaysAutoResize |
                     ImGuiWindowFlags_NoSavedSettings);
    if (ImGui::BeginTable("sheet", 2, ImGuiTableFlags_SizingFixedFit)) {
        heading(state, "Mouse");
        for (const Explained& use : kMouse) row(use.what, use.help);
        heading(state, "Marks");
        for (const Explained& mark : kMarks) row(mark.what, mark.help);
        draw_keys(state);
        ImGui::EndTable();
    }
    ImGui::End();
}

}  // namespace dibhr
