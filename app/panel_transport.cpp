// The bar under the relief: playback and the force switch, always in reach.
#include <algorithm>

#include "app/panel_list.hpp"
#include "app/panel_widgets.hpp"

namespace dibhr {

namespace {

/// The time line: click or drag to go there.
void draw_time_line(const PlaybackStatus& playback, Player& player, float width) {
    const float height = ImGui::GetFrameHeight();
    const ImVec2 low = ImGui::GetCursorScreenPos();
    ImGui::InvisibleButton("time line", {std::max(width, 1.0F), height});
    const bool hovered = ImGui::IsItemHovered();
    const bool held = ImGui::IsItemActive();
    const float under =
        std::clamp((ImGui::GetIO().MousePos.x - low.x) / std::max(width, 1.0F), 0.0F, 1.0F);
    const double under_s = static_cast<double>(under) * playback.duration_s;
    if (held && (ImGui::IsItemActivated() || ImGui::GetIO().MouseDelta.x != 0.0F))
        player.seek(under_s);
    if (hovered || held) ImGui::SetTooltip("%s", clock_text(under_s).c_str());

    const double shown_s = held ? under_s : playback.media_s;
    const double share = playback.duration_s > 0.0 ? shown_s / playback.duration_s : 0.0;
    const float x = low.x + width * static_cast<float>(std::clamp(share, 0.0, 1.0));
    const float y = low.y + height * 0.5F;
    const float thick = height * 0.09F;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled({low.x, y - thick}, {low.x + width, y + thick},
                       ImGui::GetColorU32(ImGuiCol_FrameBgActive), thick);
    list.AddRectFilled({low.x, y - thick}, {x, y + thick},
                       ImGui::GetColorU32(ImGuiCol_SliderGrabActive), thick);
    list.AddCircleFilled(
        {x, y}, height * (hovered || held ? 0.28F : 0.22F),
        ImGui::GetColorU32(hovered || held ? ImGuiCol_CheckMark : ImGuiCol_SliderGrabActive), 24);
}

void draw_playback(const ViewerState& state, Player& player, float right_of_line) {
    const PlaybackStatus& playback = state.playback;
    if (icon_button("play", playback.playing ? Icon::pause : Icon::play,
                    playback.playing ? "Pause (Space)" : "Play (Space)")) {
        playback.playing ? player.pause() : player.play();
    }
    ImGui::SameLine();
    const std::string time = clock_text(playback.media_s) + " / " + clock_text(playback.duration_s);
    const std::string frame = formatted("frame %lld", static_cast<long long>(playback.frame + 1));
    const float gap = ImGui::GetStyle().ItemSpacing.x;
    const float texts =
        ImGui::CalcTextSize(time.c_str()).x + gap + ImGui::CalcTextSize("frame 00000").x;
    const float line = ImGui::GetContentRegionAvail().x - texts - 2.0F * gap - right_of_line;
    if (line > 40.0F) {
        draw_time_line(playback, player, line);
        ImGui::SameLine();
    }
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(time.c_str());
    ImGui::SameLine();
    const float begin = ImGui::GetCursorPosX();
    ImGui::TextDisabled("%s", frame.c_str());
    ImGui::SameLine(begin + ImGui::CalcTextSize("frame 00000").x + gap);
}

}  // namespace

void draw_transport_bar(ViewerState& state, Player& player) {
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const ImGuiStyle& style = ImGui::GetStyle();
    const float height = ImGui::GetFrameHeight() + 2.0F * style.WindowPadding.y;
    ImGui::SetNextWindowPos({0.0F, display.y - height});
    ImGui::SetNextWindowSize({display.x - panel_column_width(state), height});
    ImGui::SetNextWindowBgAlpha(0.85F);
    ImGui::Begin("Transport", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus);
    const float force_width = ImGui::CalcTextSize("Force is OFF").x + 2.0F * style.FramePadding.x;
    if (state.media.still) {
        const float right = ImGui::GetCursorPosX() + ImGui::GetContentRegionAvail().x;
        ImGui::AlignTextToFramePadding();
        ImGui::TextDisabled("A still picture");
        ImGui::SameLine(right - force_width);
    } else {
        draw_playback(state, player, force_width + style.ItemSpacing.x);
    }
    draw_force_switch(state, force_width);
    ImGui::End();
}

}  // namespace dibhr
