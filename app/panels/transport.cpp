// The bar under the relief: playback and the force switch, always in reach.
#include "app/panels/panels.hpp"
#include "app/panels/widgets.hpp"

namespace dibhr {

namespace {

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
        const TimeLineContents times{.now_s = playback.media_s, .length_s = playback.duration_s};
        if (const auto wanted_s = draw_time_line(times, line)) player.seek(*wanted_s);
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
    const ImGuiStyle& style = ImGui::GetStyle();
    begin_bottom_bar(state, "Transport");
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
