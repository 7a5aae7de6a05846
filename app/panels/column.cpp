// The column of panels at the right of the window.
#include <algorithm>
#include <cmath>

#include "app/panels/panels.hpp"
#include "app/panels/widgets.hpp"
#include "render/scene_view.hpp"

namespace dibhr {

namespace {

constexpr float kColumnWidth = 340.0F;  // layout pixels
constexpr float kMostOfWindow = 0.45F;  // a small window keeps room for the relief

}  // namespace

float panel_column_width(const ViewerState& state) {
    if (!state.settings.panels_visible) return 0.0F;
    const UiState& ui = state.ui;
    return std::floor(std::min(kColumnWidth * ui.scale, kMostOfWindow * ui.window_width));
}

/// Cleared, as software takes several times as long for a rectangle that is blended.
void draw_panel_ground(const ViewerState& state) {
    const float width = panel_column_width(state);
    if (!(width > 0.0F)) return;
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    ImDrawList& under = *ImGui::GetBackgroundDrawList();
    under.PushClipRect({display.x - width, 0.0F}, display);
    under.AddCallback(
        [](const ImDrawList*, const ImDrawCmd* command) {
            const ImVec4& area = command->ClipRect;
            const auto px = [](float length) { return static_cast<int>(length); };
            const ImVec4& colour = ImGui::GetStyleColorVec4(ImGuiCol_WindowBg);
            clear_area({px(area.x), px(ImGui::GetDrawData()->DisplaySize.y - area.w)},
                       {px(area.z - area.x), px(area.w - area.y)}, {colour.x, colour.y, colour.z});
        },
        nullptr);
    under.PopClipRect();
}

void draw_panel_column(ViewerState& state, Transport& transport) {
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const float width = panel_column_width(state);
    ImGui::SetNextWindowPos({display.x - width, 0.0F});
    ImGui::SetNextWindowSize({width, display.y});
    ImGui::Begin("Panels", nullptr,
                 ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                     ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus |
                     ImGuiWindowFlags_NoBackground);
    if (state.touch.replay) {
        draw_replay_panel(state, transport);
        draw_touch_panel(state);
        draw_surface_panel(state);
        draw_video_panel(state, nullptr);
    } else {
        draw_video_panel(state, &transport);
        draw_surface_panel(state);
        draw_touch_panel(state);
        draw_device_panel(state);
        draw_session_panel(state);
        draw_loop_panel(state);
        draw_paint_panel(state);
    }
    ImGui::End();
}

}  // namespace dibhr
