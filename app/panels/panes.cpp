// The colour picture and the depth, side by side above the relief.
#include <algorithm>
#include <array>
#include <cmath>

#include "app/panels/panels.hpp"
#include "app/panels/widgets.hpp"

namespace dibhr {

namespace {

constexpr float kPaneGap = 6.0F;                          // layout pixels
constexpr float kMostOfHeight = 0.36F;                    // the relief keeps the larger part
constexpr ImU32 kProxyDot = IM_COL32(64, 156, 255, 255);  // as the ball on the relief
constexpr ImU32 kRoundMark = IM_COL32(0, 0, 0, 200);
constexpr ImU32 kPointerMark = IM_COL32(255, 255, 255, 230);

struct PaneRect {
    ImVec2 low{}, size{};
};

/// Both panes have the picture's proportions and are centred above the relief.
std::array<PaneRect, 2> pane_rects(const ViewerState& state) {
    const float gap = std::round(kPaneGap * state.ui.scale);
    const float room = state.ui.window_width - panel_column_width(state);
    const float shape = static_cast<float>(std::max(state.media.depth_columns, 1)) /
                        static_cast<float>(std::max(state.media.depth_rows, 1));
    const float most_width = std::max(0.5F * (room - 3.0F * gap), 1.0F);
    const float height = std::min(most_width / shape, kMostOfHeight * state.ui.window_height);
    const ImVec2 size{std::floor(height * shape), std::floor(height)};
    const float left = std::floor(0.5F * (room - gap) - size.x);
    return {PaneRect{{left, gap}, size}, PaneRect{{left + size.x + gap, gap}, size}};
}

/// The place of a pixel's middle in a pane.
ImVec2 place_of(const ViewerState& state, const PaneRect& pane, double column, double row) {
    const auto along = [](double pixel, int pixels, float size) {
        return static_cast<float>((pixel + 0.5) / std::max(pixels, 1)) * size;
    };
    return {pane.low.x + along(column, state.media.depth_columns, pane.size.x),
            pane.low.y + along(row, state.media.depth_rows, pane.size.y)};
}

void draw_pane(const ViewerState& state, const PaneRect& pane, std::uintptr_t texture,
               const char* name) {
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    const ImVec2 high{pane.low.x + pane.size.x, pane.low.y + pane.size.y};
    list.PushClipRect(pane.low, high);
    if (texture != 0) list.AddImage(texture_id<ImTextureID>(texture), pane.low, high);
    const float radius = std::round(4.0F * state.ui.scale);
    if (state.ui.under_pointer) {
        const PixelShown& pixel = *state.ui.under_pointer;
        const ImVec2 at = place_of(state, pane, pixel.column, pixel.row);
        list.AddCircle(at, 1.8F * radius, kRoundMark, 24, 3.0F * state.ui.scale);
        list.AddCircle(at, 1.8F * radius, kPointerMark, 24, 1.2F * state.ui.scale);
    }
    if (state.touch.haptic.touchable) {
        const Vec3& proxy = state.touch.haptic.touch.proxy.position;
        const ImVec2 at = place_of(state, pane, proxy.x, proxy.y);
        list.AddCircleFilled(at, radius + 2.0F * state.ui.scale, kRoundMark, 20);
        list.AddCircleFilled(at, radius + 1.0F * state.ui.scale, kPointerMark, 20);
        list.AddCircleFilled(at, radius - 0.5F * state.ui.scale, kProxyDot, 20);
    }
    const ImVec2 pad = ImGui::GetStyle().FramePadding;
    const ImVec2 text = ImGui::CalcTextSize(name);
    const ImVec2 ground{pane.low.x + text.x + 2.0F * pad.x, high.y - text.y - pad.y};
    list.AddRectFilled({pane.low.x, ground.y}, {ground.x, high.y},
                       ImGui::GetColorU32(ImGuiCol_PopupBg, 0.7F));
    list.AddText({pane.low.x + pad.x, ground.y + 0.5F * pad.y}, ImGui::GetColorU32(ImGuiCol_Text),
                 name);
    list.PopClipRect();
}

}  // namespace

bool shows_panes(const ViewerState& state) {
    return state.settings.panes && !state.ui.explained && state.media.depth_columns > 0;
}

float panes_height(const ViewerState& state) {
    if (!shows_panes(state)) return 0.0F;
    const PaneRect pane = pane_rects(state)[0];
    return std::round(pane.size.y + 2.0F * pane.low.y);
}

ReliefPaint depth_paint(const ViewerState& state) {
    const ReliefPaint paint = state.settings.relief_style.paint;
    return depth_colours(paint) != nullptr || !shows_panes(state) ? paint : ReliefPaint::turbo;
}

std::optional<Vec3> place_on_panes(const ViewerState& state, glm::dvec2 position_px) {
    if (!shows_panes(state)) return {};
    for (const PaneRect& pane : pane_rects(state)) {
        const double x = (position_px.x - pane.low.x) / pane.size.x;
        const double y = (position_px.y - pane.low.y) / pane.size.y;
        if (x >= 0.0 && x < 1.0 && y >= 0.0 && y < 1.0)
            return Vec3{std::floor(x * state.media.depth_columns),
                        std::floor(y * state.media.depth_rows), 0.0};
    }
    return {};
}

void draw_panes(const ViewerState& state) {
    if (!shows_panes(state)) return;
    const float room = state.ui.window_width - panel_column_width(state);
    ImGui::GetBackgroundDrawList()->AddRectFilled({0.0F, 0.0F}, {room, panes_height(state)},
                                                  ImGui::GetColorU32(ImGuiCol_WindowBg));
    const std::array<PaneRect, 2> panes = pane_rects(state);
    draw_pane(state, panes[0], state.ui.panes.colour, "Colour");
    draw_pane(state, panes[1], state.ui.panes.depth,
              entry_of(kReliefPaintNames, depth_paint(state)).label);
}

}  // namespace dibhr
