// Tooltips of the panels' items, by mouse and by keyboard.
#include <algorithm>
#include <string>

#include "app/panels/widgets.hpp"

namespace dibhr {

namespace {

constexpr float kTooltip_em = 22.0F;  // widest text

}  // namespace

void place_next_tooltip() {
    const ImVec2 window = ImGui::GetWindowPos();
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const float gap = ImGui::GetStyle().ItemSpacing.x;
    const float widest =
        kTooltip_em * ImGui::GetFontSize() + 2.0F * ImGui::GetStyle().WindowPadding.x;
    const float right = window.x + ImGui::GetWindowWidth() + gap;
    // Shifted by its place on the display, or above a window in that, so that it stays inside.
    if (right < 0.25F * display.x) {  // of a narrow window at the left
        const float y = ImGui::GetItemRectMin().y;
        ImGui::SetNextWindowPos({right, y}, ImGuiCond_Always,
                                {0.0F, std::clamp(y / display.y, 0.0F, 1.0F)});
    } else if (window.x > widest + gap) {
        const float y = ImGui::GetItemRectMin().y;
        ImGui::SetNextWindowPos({window.x - gap, y}, ImGuiCond_Always,
                                {1.0F, std::clamp(y / display.y, 0.0F, 1.0F)});
    } else {
        const float x = ImGui::GetIO().MousePos.x;
        const float share = (x - window.x) / std::max(1.0F, ImGui::GetWindowWidth());
        ImGui::SetNextWindowPos({x, window.y - gap}, ImGuiCond_Always,
                                {std::clamp(share, 0.0F, 1.0F), 1.0F});
    }
}

void draw_tooltip(const std::string& text) {
    const float wrap = ImGui::GetFontSize() * kTooltip_em;
    const ImVec2 size = ImGui::CalcTextSize(text.c_str(), nullptr, false, wrap);
    const ImVec2 pad = ImGui::GetStyle().WindowPadding;
    place_next_tooltip();
    // Else its first picture would have the size of the tooltip before it.
    ImGui::SetNextWindowSize({size.x + 2.0F * pad.x, size.y + 2.0F * pad.y});
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(pad.x + wrap);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

void add_tooltip(const std::string& text, const KeyTable& keys, Action action) {
    add_tooltip((text + keys.in_brackets(action)).c_str());
}

void add_tooltip(const char* text) {
    const bool wanted = item::keyboard_is_on() ? item::has_keyboard() : ImGui::IsItemHovered();
    if (*text == '\0' || !wanted) return;
    if (item::keyboard_is_on()) KeyboardFocus::current()->explain(text);
    draw_tooltip(text);
}

}  // namespace dibhr
