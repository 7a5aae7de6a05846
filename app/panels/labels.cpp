// Draws labels.
#include "app/panels/labels.hpp"

#include <algorithm>

namespace dibhr {

namespace {

float wrap_of(float widest, ImVec2 pad) {
    return widest > 0.0F ? std::max(widest - 2.0F * pad.x, 1.0F) : -1.0F;
}

}  // namespace

void draw_ground(ImVec2 low, ImVec2 size, float alpha, ImDrawList& list) {
    constexpr float kOpacity = 0.92F;  // texts below must not show
    list.AddRectFilled(low, {low.x + size.x, low.y + size.y},
                       ImGui::GetColorU32(ImGuiCol_PopupBg, kOpacity * alpha), 5.0F);
}

ImVec2 label_size(const std::string& text, float widest, ImVec2 pad) {
    const ImVec2 size = ImGui::CalcTextSize(text.c_str(), nullptr, false, wrap_of(widest, pad));
    return {size.x + 2.0F * pad.x, size.y + 2.0F * pad.y};
}

float label(const std::string& text, ImVec2 low, float alpha, float widest, ImDrawList& list,
            ImVec2 pad) {
    const ImVec2 size = label_size(text, widest, pad);
    draw_ground(low, size, alpha, list);
    list.AddText(ImGui::GetFont(), ImGui::GetFontSize(), {low.x + pad.x, low.y + pad.y},
                 ImGui::GetColorU32(ImGuiCol_Text, alpha), text.c_str(), nullptr,
                 std::max(wrap_of(widest, pad), 0.0F));
    return size.y;
}

}  // namespace dibhr
