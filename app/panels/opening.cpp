// What is being opened, until its first frame is there.
#include <algorithm>

#include "app/panels/panels.hpp"
#include "app/panels/widgets.hpp"

namespace dibhr {

namespace {

/// Under all panels, so that no window of the panels' library is needed for it. Returns its lower
/// end.
float centred(const std::string& text, ImFont* font, ImGuiCol colour, float width_px, float y) {
    if (font == nullptr) font = ImGui::GetFont();
    const ImVec2 size = font->CalcTextSizeA(font->FontSize, width_px, 0.0F, text.c_str());
    const ImVec2 low{std::max(0.0F, 0.5F * (width_px - size.x)), y};
    ImGui::GetBackgroundDrawList()->AddText(font, font->FontSize, low, ImGui::GetColorU32(colour),
                                            text.c_str());
    return y + size.y;
}

}  // namespace

void draw_opening(const OpeningShown& opening, const Fonts& fonts, float width_px) {
    constexpr float kHeight = 0.42F;  // a little above the middle
    constexpr float kGap = 0.4F;      // of the lines, in lines
    const float y = centred(opening.name, fonts.title, ImGuiCol_Text, width_px,
                            kHeight * ImGui::GetIO().DisplaySize.y);
    centred(opening.step, fonts.text, ImGuiCol_TextDisabled, width_px,
            y + kGap * ImGui::GetTextLineHeight());
}

}  // namespace dibhr
