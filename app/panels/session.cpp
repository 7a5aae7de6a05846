// The Session panel: recording the touch, with participant, notes and marks.
#include <algorithm>
#include <chrono>
#include <cstddef>
#include <string>
#include <vector>

#include "app/panels/panels.hpp"
#include "app/panels/widgets.hpp"
#include "core/files/plain_text.hpp"

namespace dibhr {

namespace {

constexpr std::size_t kMarksShown = 5;
constexpr double kBytesPerMegabyte = 1e6;
constexpr int kRecordingColours = 4;

/// The colours of a button that stops a recording or clip; readable in every theme.
void push_recording_colours() {
    const ImU32 raised = IM_COL32(168, 49, 43, 255);
    ImGui::PushStyleColor(ImGuiCol_Text, IM_COL32(255, 255, 255, 255));
    ImGui::PushStyleColor(ImGuiCol_Button, IM_COL32(140, 41, 36, 255));
    ImGui::PushStyleColor(ImGuiCol_ButtonHovered, raised);
    ImGui::PushStyleColor(ImGuiCol_ButtonActive, raised);
}

void draw_switch(ViewerState& state, float width) {
    const bool on = state.touch.recording.has_value();
    if (on) push_recording_colours();
    if (item::button(on ? "Stop recording###record" : "Record###record", {width, 0.0F})) {
        state.commands.push(Action::record);
    }
    if (on) ImGui::PopStyleColor(kRecordingColours);
    add_tooltip(on ? "Closes the file" : "Every tick goes into a new file in the current folder",
                state.keys, Action::record);
}

void draw_progress(const RecordingInfo& recording) {
    const RecorderStatus& status = recording.status;
    file_row("File", recording.file);
    fact_row("Time", clock_text(recording.time_s));
    fact_row("Ticks", std::to_string(status.rows));
    const double per_minute = status.bytes_per_minute / kBytesPerMegabyte;
    fact_row("Size", formatted("%.1f MB", static_cast<double>(status.bytes) / kBytesPerMegabyte) +
                         (per_minute > 0.0 ? formatted(", %.1f MB a minute", per_minute) : ""));
    fact_row("Lost", status.dropped == 0 ? "nothing" : std::to_string(status.dropped) + " ticks");
}

void draw_about(SessionFields& fields) {
    const char* help = "Kept with the session; may be typed before or during the recording";
    text_field("##participant", "Participant", fields.participant, help, false);
    text_field("##note", "Note", fields.note, help, false);
}

void draw_marks(ViewerState& state) {
    const float beside = button_width("Mark") + ImGui::GetStyle().ItemSpacing.x;
    const std::string key = state.keys.name_for(Action::mark);
    const std::string or_key = key.empty() ? "" : ", or " + key + " while nothing is typed";
    const bool entered = text_field("##tag", "Tag of the next mark", state.touch.session_fields.tag,
                                    ("Enter" + or_key + ", marks the moment with it").c_str(), true,
                                    ImGui::GetContentRegionAvail().x - beside);
    ImGui::SameLine();
    if (item::button("Mark") || entered)
        state.commands.push(MarkMoment{std::chrono::steady_clock::now()});
    add_tooltip("Marks this moment", state.keys, Action::mark);
    const std::vector<SessionMark>& marks = state.touch.recording->marks;
    const std::size_t first = marks.size() - std::min(marks.size(), kMarksShown);
    for (std::size_t k = marks.size(); k > first; --k) {
        fact_row(clock_text(marks[k - 1].t_s).c_str(), marks[k - 1].tag);
    }
}

}  // namespace

void draw_clip_button(ViewerState& state) {
    const bool on = state.ui.clip && !state.ui.clip->finishing;
    if (on) push_recording_colours();
    ImGui::BeginDisabled(state.ui.clip && state.ui.clip->finishing);
    if (item::button(on ? "End the clip###clip" : "Save a clip###clip", {-1.0F, 0.0F}))
        state.commands.push(Action::take_clip);
    ImGui::EndDisabled();
    if (on) ImGui::PopStyleColor(kRecordingColours);
    if (on) {
        add_tooltip("Finishes its file", state.keys, Action::take_clip);
        return;
    }
    const std::string without = state.keys.name_for(Action::take_clip_of_relief);
    const std::string way = without.empty() ? "" : "; " + without + ": without panels";
    add_tooltip(("What this window shows, as MP4 in the current folder" +
                 state.keys.in_brackets(Action::take_clip) + way)
                    .c_str());
}

void draw_session_panel(ViewerState& state) {
    if (!section(state, "Session", state.settings.panels.session, &state.ui.show_session)) return;
    ImGui::PushID("session");
    const bool one_row = button_width("Stop recording") <= half_width();
    draw_switch(state, one_row ? half_width() : -1.0F);
    if (one_row) ImGui::SameLine();
    draw_clip_button(state);
    const TouchState& touch = state.touch;
    if (!touch.recording_trouble.empty()) draw_warning(capitalised(touch.recording_trouble));
    if (touch.recording) {
        draw_progress(*touch.recording);
    } else if (!touch.recorded_file.empty()) {
        file_row("Recorded", touch.recorded_file);
        if (item::button("Replay it", {half_width(), 0.0F})) {
            state.commands.push(OpenRequest{.colour = touch.recorded_file});
        }
        ImGui::SameLine();
        report_button(state, touch.recorded_file);
    }
    draw_about(state.touch.session_fields);
    if (touch.recording) draw_marks(state);
    ImGui::PopID();
}

}  // namespace dibhr
