// The Video panel: which files, playback, and the cleaning of depth.
#include <algorithm>

#include "app/panels/panels.hpp"
#include "app/panels/widgets.hpp"

namespace dibhr {

namespace {

void draw_open(ViewerState& state) {
    if (state.fields.ask_for_keyboard > 0) {
        ImGui::SetWindowFocus();  // newer ImGui looks for the next field in that window only
        ImGui::SetKeyboardFocusHere();
        --state.fields.ask_for_keyboard;
    }
    const bool from_colour =
        text_field("##colour", "Colour file, or session", state.fields.colour,
                   "Path of a colour video or picture, or of a recorded session (Ctrl+O)");
    const bool from_depth =
        text_field("##depth", "Depth file: found beside it", state.fields.depth,
                   "Empty: the file called like the colour file, with depth in place of color");
    const bool named = state.fields.colour[0] != '\0';
    const bool pressed =
        button_or_drop(state.opening ? "Opening" : "Open", named && !state.opening, "files");
    if ((from_colour || from_depth || pressed) && named) {
        state.requests.open = OpenRequest{state.fields.colour.data(), state.fields.depth.data()};
    }
}

void draw_files(const MediaDescription& media) {
    file_row("Colour", media.colour_path);
    file_row("Depth", media.depth_path);
    fact_row("Size", formatted("%d x %d", media.colour_columns, media.colour_rows));
    fact_row("Depth size",
             formatted("%d x %d, %s", media.depth_columns, media.depth_rows,
                       media.has_real_numbers() ? "real numbers"
                                                : formatted("%d bit", media.depth_bits).c_str()));
    if (!media.notice.empty()) quiet_text(capitalised(media.notice));
}

void draw_playback(const ViewerState& state, Player& player) {
    const PlaybackStatus& playback = state.playback;
    play_and_step_buttons(playback.playing, player, "frame");
    bool looping = playback.looping;
    if (ImGui::Checkbox("Loop", &looping)) player.set_looping(looping);
    explain("Start again at the end (L)");
    fact_row("Time", clock_text(playback.media_s) + " of " + clock_text(playback.duration_s));
    fact_row("Frame", std::to_string(playback.frame + 1) + " of " +
                          std::to_string(std::max(playback.frames, playback.frame + 1)));
    speed_row(playback.speed, player);
}

}  // namespace

void draw_video_panel(ViewerState& state, Player* player) {
    if (!section(state, "Video", state.settings.panels.video)) return;
    ImGui::PushID("video");
    draw_open(state);
    draw_files(state.media);
    if (player != nullptr && !state.media.still) draw_playback(state, *player);
    if (player != nullptr && part("Depth")) draw_depth_rows(state);
    ImGui::BeginDisabled(player == nullptr);  // a replay shows what was touched
    CleaningOptions& cleaning = state.settings.cleaning;
    const CleaningOptions standard;
    flag_row("Fill holes", cleaning.fill_holes, standard.fill_holes,
             "Where the camera saw no depth, take the depth around it");
    flag_row("Remove spikes", cleaning.remove_spikes, standard.remove_spikes,
             "Single pixels that stand out of all their neighbours");
    flag_row("Smooth depth steps", cleaning.smooth_steps, standard.smooth_steps,
             "Rounds the terraces of 8-bit depth, by half a level at most");
    ImGui::EndDisabled();
    if (player != nullptr && !state.playback.failure.empty()) quiet_text(state.playback.failure);
    ImGui::PopID();
}

}  // namespace dibhr
