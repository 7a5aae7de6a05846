// What is written over the relief: the force in numbers, the first hint, and short notices.
#include <algorithm>
#include <glm/geometric.hpp>

#include "app/panel_list.hpp"
#include "app/panel_widgets.hpp"

namespace dibhr {

namespace {

ImU32 with_alpha(ImGuiCol colour, float alpha) {
    ImVec4 value = ImGui::GetStyleColorVec4(colour);
    value.w *= alpha;
    return ImGui::GetColorU32(value);
}

/// Text on a dark rounded ground, so that it can be read over any picture.
void label(const std::string& text, ImVec2 low, float alpha) {
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    const ImVec2 pad = ImGui::GetStyle().FramePadding;
    list.AddRectFilled({low.x, low.y},
                       {low.x + size.x + 2.0F * pad.x, low.y + size.y + 2.0F * pad.y},
                       with_alpha(ImGuiCol_PopupBg, 0.8F * alpha), 5.0F);
    list.AddText({low.x + pad.x, low.y + pad.y}, with_alpha(ImGuiCol_Text, alpha), text.c_str());
}

void centred_label(const ViewerState& state, const std::string& text, float lines_above_bar,
                   float alpha) {
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const float line = ImGui::GetFrameHeight();
    const float bar = line + 2.0F * ImGui::GetStyle().WindowPadding.y;
    const float width = display.x - panel_column_width(state);
    label(text,
          {(width - ImGui::CalcTextSize(text.c_str()).x) * 0.5F,
           display.y - bar - (1.4F + lines_above_bar) * line},
          alpha);
}

std::string touch_text(const ViewerState& state) {
    const HapticState& haptic = state.haptic;
    if (!state.force_enabled) return "Force off";
    if (!haptic.touchable) return "No surface yet";
    if (haptic.touch.cut != SafetyCut::none)
        return std::string("No force: ") + name_of(haptic.touch.cut);
    if (!haptic.touch.proxy.contact) return "Free";
    const Vec3& f = haptic.touch.sent_force_newton;
    const bool limited = glm::length(haptic.touch.spring_force_newton) > 1.001 * glm::length(f);
    return formatted("Touching   %.2f N%s   (%+.2f, %+.2f, %+.2f)", glm::length(f),
                     limited ? ", limited" : "", f.x, f.y, f.z);
}

}  // namespace

void draw_overlay(const ViewerState& state, double now_s) {
    const float margin = 12.0F * state.scale;
    label(touch_text(state), {margin, margin}, 1.0F);
    if (state.recording) {
        label(formatted("Recording   %llu rows",
                        static_cast<unsigned long long>(state.recording->rows)),
              {margin, margin + 1.3F * ImGui::GetFrameHeight()}, 1.0F);
    }
    if (now_s < state.notice_until_s) {
        const double left_s = state.notice_until_s - now_s;
        centred_label(state, state.notice, 1.5F, static_cast<float>(std::min(1.0, left_s)));
    }
}

void draw_hint(const ViewerState& state, float alpha) {
    if (alpha <= 0.0F) return;
    const std::string whole = "Move the mouse over the picture. Hold the left button to touch.";
    const float room = ImGui::GetIO().DisplaySize.x - panel_column_width(state);
    const bool fits = ImGui::CalcTextSize(whole.c_str()).x + 40.0F * state.scale < room;
    centred_label(state, fits ? whole : "Hold the left button to touch.", 0.0F, alpha);
}

}  // namespace dibhr
