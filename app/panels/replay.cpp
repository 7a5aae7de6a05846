// The Replay panel: the session's facts, the touch at the shown moment, and its marks.
#include <algorithm>
#include <glm/geometric.hpp>
#include <string>

#include "app/panels/panels.hpp"
#include "app/panels/widgets.hpp"
#include "core/files/plain_text.hpp"
#include "core/report/report_sentences.hpp"

namespace dibhr {

namespace {

constexpr float kMarkRows = 6.0F;

void fact_if_any(const char* label, const std::string& value) {
    if (!value.empty()) fact_row(label, value);
}

void draw_about(const ReplayInfo& replay) {
    file_row("Session", replay.file);
    fact_if_any("Participant", replay.participant);
    fact_if_any("Recorded", date_text(replay.started));
    const HandTicks hand = replay.contacts == nullptr ? HandTicks{} : replay.contacts->hand;
    fact_if_any("Device", device_text(replay.device, hand));
    fact_if_any("Note", replay.note);
}

void draw_moment(const ViewerState& state) {
    const ReplayInfo& replay = *state.touch.replay;
    const Touch& touch = state.touch.haptic.touch;
    fact_row("Tick", std::to_string(replay.tick_count));
    fact_row("Video", replay.tick.surface ? clock_text(replay.tick.video_s) + ", frame " +
                                                std::to_string(replay.tick.frames.from_frame + 1)
                                          : "no surface");
    const Primitive& on = touch.proxy.active;
    fact_row("Touches", touch.proxy.contact ? formatted("%s (%d, %d)", name_of(on.kind), on.i, on.j)
                                            : std::string("nothing"));
    fact_row("Force", formatted("%.2f N", glm::length(touch.sent_force_newton)));
    if (replay.computed) {
        fact_row("From recorded",
                 formatted("%.2f px", glm::distance(touch.proxy.position, replay.tick.proxy)));
    }
}

void draw_marks(const ReplayInfo& replay, Transport& player) {
    if (replay.marks.empty()) return;
    const float line = ImGui::GetTextLineHeightWithSpacing();
    const float rows = std::min(static_cast<float>(replay.marks.size()), kMarkRows);
    ImGui::BeginChild("marks", {0.0F, rows * line});
    for (const SessionMark& mark : replay.marks) {
        ImGui::PushID(&mark);
        const std::string text =
            clock_text(mark.t_s - replay.playback.begin_s) + "   " + mark.tag + "  " + mark.text;
        if (item::selectable(text.c_str())) player.seek(mark.t_s);
        ImGui::PopID();
    }
    ImGui::EndChild();
}

}  // namespace

void draw_replay_panel(ViewerState& state, Transport& replay) {
    bool open = true;  // what a replay is for
    section(state, "Replay", open);
    ImGui::PushID("replay");
    const ReplayInfo& info = *state.touch.replay;
    draw_about(info);
    if (item::button("Touch this video", {half_width(), 0.0F})) state.commands.push(LeaveReplay{});
    add_tooltip("Leaves the replay: the hand touches the video it was recorded over");
    ImGui::SameLine();
    report_button(state, info.file);
    draw_clip_button(state);
    if (!info.playback.failure.empty()) draw_warning(capitalised(info.playback.failure));
    speed_row(info.playback.speed, replay);
    draw_moment(state);
    draw_strip_charts(state);
    draw_marks(info, replay);
    ImGui::PopID();
}

}  // namespace dibhr
