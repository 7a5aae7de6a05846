// The bar under the relief: playback and the force switch, always in reach; or a replay.
#include <string>

#include "app/panels/panels.hpp"
#include "app/panels/widgets.hpp"

namespace dibhr {

namespace {

void draw_playback(const ViewerState& state, Player& player, float right_of_line) {
    const PlaybackStatus& playback = state.playback;
    play_button(playback.playing, player);
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

void draw_buttons(const SessionPlayback& playback, SessionPlayer& replay) {
    if (icon_button("back", Icon::step_back, "One tick back ( , )")) replay.step(-1);
    ImGui::SameLine(0.0F, 0.0F);
    play_button(playback.playing, replay);
    ImGui::SameLine(0.0F, 0.0F);
    if (icon_button("forward", Icon::step_forward, "One tick forward ( . )")) replay.step(1);
    ImGui::SameLine(0.0F, 0.0F);
    if (icon_button("loop", Icon::loop, "Start again at the end (L)", playback.looping)) {
        replay.set_looping(!playback.looping);
    }
}

TimeLineContents line_of(const ReplayNews& news) {
    const SessionPlayback& playback = news.playback;
    TimeLineContents line{.now_s = playback.now_s - playback.begin_s,
                          .length_s = playback.end_s - playback.begin_s,
                          .contacts = news.contacts,
                          .marks = news.marks};
    for (SessionMark& mark : line.marks) mark.t_s -= playback.begin_s;
    return line;
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

void draw_replay_bar(ViewerState& state, SessionPlayer& replay) {
    const ImGuiStyle& style = ImGui::GetStyle();
    begin_bottom_bar(state, "Replay");
    const SessionPlayback& playback = state.replay->playback;
    draw_buttons(playback, replay);
    ImGui::SameLine();
    const TimeLineContents line = line_of(*state.replay);
    const std::string time = clock_text(line.now_s) + " / " + clock_text(line.length_s);
    const std::string video = "video " + clock_text(state.replay->tick.video_s);
    const float texts = ImGui::CalcTextSize(time.c_str()).x + ImGui::CalcTextSize(video.c_str()).x;
    const float width = ImGui::GetContentRegionAvail().x - texts - 3.0F * style.ItemSpacing.x;
    if (width > 40.0F) {
        if (const auto wanted_s = draw_time_line(line, width)) {
            replay.seek(playback.begin_s + *wanted_s);
        }
        ImGui::SameLine();
    }
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(time.c_str());
    ImGui::SameLine();
    ImGui::TextDisabled("%s", video.c_str());
    ImGui::End();
}

}  // namespace dibhr
