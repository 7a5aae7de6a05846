// The toolbar: what most people look for, as pictures at the left edge of the relief.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>

#include "app/panels/panels.hpp"
#include "app/panels/widgets.hpp"

namespace dibhr {

namespace {

constexpr ImGuiWindowFlags kBehindOthers =
    ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoFocusOnAppearing;
constexpr float kSide = 1.45F;  // of a button, as a multiple of a row's height
constexpr int kTools = 7;

float side_of_tool() {
    return std::round(kSide * ImGui::GetFrameHeight());
}

struct Tool {
    Icon icon;
    Action action;
    std::string help{};
    bool lit{false};
    bool enabled{true};
};

/// What each does now: the first picture of two, and whether it is on.
std::array<Tool, kTools> tools_of(const ViewerState& state) {
    const bool plays = state.play_state().playing;
    const bool records = state.touch.recording.has_value();
    return {
        {{Icon::open, Action::open_file, "Open a recording"},
         {plays ? Icon::pause : Icon::play, Action::play_or_pause, plays ? "Pause" : "Play", false,
          state.touch.replay || !state.media.still},
         {Icon::record, Action::record, records ? "End the recording" : "Record what is touched",
          records},
         {Icon::explain, Action::explain, "Explain how the force is found, step by step",
          state.ui.explained.has_value()},
         {Icon::paint, Action::toggle_brush, "Paint materials on the surface", state.ui.brush.on},
         {Icon::ruler, Action::toggle_ruler, "Measure between two points",
          state.ui.ruler.has_value()},
         {Icon::clip, Action::take_clip, state.ui.clip ? "End the clip" : "Save a clip",
          state.ui.clip.has_value()}}};
}

}  // namespace

std::optional<ToolbarPlace> toolbar_place(const ViewerState& state) {
    const ImGuiStyle& style = ImGui::GetStyle();
    const float side = side_of_tool();
    const float pad = style.FramePadding.y;
    const float height = kTools * side + (kTools - 1) * pad + 2.0F * pad;
    const float first = panes_height(state) + 3.0F * ImGui::GetFrameHeight();  // below the texts
    const float room = ImGui::GetIO().DisplaySize.y - bottom_bar_height(state) - first;
    if (!state.settings.panels_visible || state.ui.explained || height > room) return std::nullopt;
    const float left = style.WindowPadding.x * 0.5F;
    const float top = first + 0.5F * (room - height);
    return ToolbarPlace{left, top, left + side + 2.0F * pad, top + height};
}

void draw_toolbar(ViewerState& state) {
    const auto place = toolbar_place(state);
    if (!place) return;
    const float pad = ImGui::GetStyle().FramePadding.y;
    ImGui::SetNextWindowPos({place->left, place->top});
    ImGui::SetNextWindowSize({place->right - place->left, place->bottom - place->top});
    ImGui::SetNextWindowBgAlpha(0.85F);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {pad, pad});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 2.0F * ImGui::GetStyle().FrameRounding);
    ImGui::Begin("Tools", nullptr, kBareWindow | kBehindOthers);
    ImGui::PopStyleVar(2);
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {pad, pad});
    for (const Tool& tool : tools_of(state)) {
        const std::string help = tool.help + state.keys.in_brackets(tool.action);
        const std::string id(job_of(tool.action).name);
        ImGui::BeginDisabled(!tool.enabled);
        if (icon_button(id.c_str(), tool.icon, help.c_str(), tool.lit, kSide))
            state.commands.push(tool.action);
        ImGui::EndDisabled();
    }
    ImGui::PopStyleVar();
    ImGui::End();
}

}  // namespace dibhr
