// What is being opened, until its first frame is there.
#include <algorithm>
#include <cfloat>
#include <string>

#include "app/panels/labels.hpp"
#include "app/panels/panels.hpp"
#include "app/panels/widgets.hpp"

namespace dibhr {

namespace {

/// A line of text in its font.
struct Line {
    std::string text{};
    ImFont* font{nullptr};
    ImVec2 size{};

    void draw(ImVec2 low, ImGuiCol colour) const {
        ImGui::GetBackgroundDrawList()->AddText(font, font->FontSize, low,
                                                ImGui::GetColorU32(colour), text.c_str());
    }
};

Line line_of(const std::string& text, ImFont* font) {
    if (font == nullptr) font = ImGui::GetFont();
    return {text, font, font->CalcTextSizeA(font->FontSize, FLT_MAX, 0.0F, text.c_str())};
}

}  // namespace

/// Under all panels, so that no window of the panels' library is needed for it.
void draw_opening(const OpeningShown& opening, const Fonts& fonts, float width_px) {
    constexpr float kHeight = 0.42F;  // a little above the middle
    const float gap = 0.4F * ImGui::GetTextLineHeight();
    const Line name = line_of(opening.name, fonts.title);
    const Line step = line_of(opening.step, fonts.text);
    const auto left_of = [width_px](float width) {
        return std::max(0.0F, 0.5F * (width_px - width));
    };
    const float pad = 2.0F * gap;
    const float wide = std::max(name.size.x, step.size.x) + 2.0F * pad;
    const float top = kHeight * ImGui::GetIO().DisplaySize.y;
    const float below = top + name.size.y + gap;
    draw_ground({left_of(wide), top - pad}, {wide, below + step.size.y - top + 2.0F * pad});
    name.draw({left_of(name.size.x), top}, ImGuiCol_Text);
    step.draw({left_of(step.size.x), below}, ImGuiCol_TextDisabled);
}

}  // namespace dibhr
