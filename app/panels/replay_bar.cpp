// The bar under the relief while a session is replayed.
#include <string>

#include "app/panels/panels.hpp"
#include "app/panels/widgets.hpp"

namespace dibhr {

namespace {

void draw_buttons(const SessionPlayback& playback, SessionPlayer& replay) {
    if (icon_button("back", Icon::step_back, "One tick back ( , )")) replay.step(-1);
    ImGui::SameLine(0.0F, 0.0F);
    if (icon_button("play", playback.playing ? Icon::pause : Icon::play,
                    playback.playing ? "Pause (Space)" : "Play (Space)")) {
        playback.playing ? replay.pause() : replay.play();
    }
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
