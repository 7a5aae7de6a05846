// What guides a finger: the region under it by its name and its text, and captions.
#include <algorithm>
#include <string>

#include "app/panels/labels.hpp"
#include "app/panels/panels.hpp"
#include "app/panels/widgets.hpp"

namespace dibhr {

namespace {

constexpr float kWidest_em = 24.0F;  // of a text that is easily read

}  // namespace

float draw_region(const ViewerState& state, ImVec2 low, float widest) {
    const RegionShown& region = state.ui.region;
    if (region.name.empty() || state.ui.explained) return 0.0F;
    ImFont* const font = ImGui::GetFont();
    const float size = ImGui::GetFontSize();
    ImFont* const title = state.ui.fonts.title;
    const ImVec2 pad = ImGui::GetStyle().FramePadding;
    const ImVec2 inset{1.6F * pad.x, 2.0F * pad.y};
    const float wrap = std::max(std::min(widest, kWidest_em * size) - 2.0F * inset.x, 1.0F);
    const ImVec2 name = title->CalcTextSizeA(title->FontSize, wrap, wrap, region.name.c_str());
    ImVec2 text{};
    if (region.rests && !region.text.empty())
        text = font->CalcTextSizeA(size, wrap, wrap, region.text.c_str());
    const float between = text.y > 0.0F ? 0.3F * size : 0.0F;
    const ImVec2 whole{std::max(name.x, text.x) + 2.0F * inset.x,
                       name.y + between + text.y + 2.0F * inset.y};
    draw_ground(low, whole);
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    const ImU32 ink = ImGui::GetColorU32(ImGuiCol_Text);
    const ImVec2 at{low.x + inset.x, low.y + inset.y};
    list.AddText(title, title->FontSize, at, ink, region.name.c_str(), nullptr, wrap);
    if (text.y > 0.0F)
        list.AddText(font, size, {at.x, at.y + name.y + between}, ink, region.text.c_str(), nullptr,
                     wrap);
    return whole.y + 0.3F * ImGui::GetFrameHeight();
}

void draw_caption(const ViewerState& state) {
    if (state.ui.caption.empty() || state.ui.explained) return;
    constexpr float kLinesAboveBar = 3.6F;  // hints and notices are below
    const std::string& text = state.ui.caption;
    ImFont* const title = state.ui.fonts.title;
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const float room = display.x - panel_column_width(state);
    const ImVec2 pad = ImGui::GetStyle().WindowPadding;
    const float wrap = std::max(0.86F * room - 2.0F * pad.x, 1.0F);
    const ImVec2 size = title->CalcTextSizeA(title->FontSize, wrap, wrap, text.c_str());
    const ImVec2 low{0.5F * (room - size.x) - pad.x, display.y - bottom_bar_height(state) -
                                                         kLinesAboveBar * ImGui::GetFrameHeight() -
                                                         size.y - pad.y};
    draw_ground(low, {size.x + 2.0F * pad.x, size.y + pad.y});
    ImGui::GetBackgroundDrawList()->AddText(
        title, title->FontSize, {low.x + pad.x, low.y + 0.5F * pad.y},
        ImGui::GetColorU32(ImGuiCol_Text), text.c_str(), nullptr, wrap);
}

void draw_outlines_row(ViewerState& state) {
    if (state.ui.regions == 0 || state.touch.replay) return;
    flag_row("Outlines", state.settings.outlines, Settings{}.outlines,
             "The outlines of the named regions are felt as ridges (--outlines)");
    if (!state.settings.outlines)
        text_beside_flag("of " + std::to_string(state.ui.regions) + " named regions");
}

}  // namespace dibhr
