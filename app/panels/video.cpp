// The Video panel: which files, playback, and the cleaning of depth.
#include <algorithm>
#include <filesystem>
#include <string>
#include <system_error>

#include "app/panels/panels.hpp"
#include "app/panels/widgets.hpp"
#include "core/files/plain_text.hpp"
#include "core/video/live/live_name.hpp"

namespace dibhr {

namespace {

constexpr const char* kRecent = "Recent";

/// The recent files, the last one first; missing files are disabled.
void draw_recent(ViewerState& state) {
    const float width = button_width(kRecent);
    ImGui::SameLine();
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() +
                         std::max(0.0F, ImGui::GetContentRegionAvail().x - width));
    if (item::button(kRecent)) ImGui::OpenPopup("recent");
    add_tooltip("Files that were opened before");
    if (!ImGui::BeginPopup("recent")) return;
    if (state.media.recent.empty()) draw_dimmed("No file was opened yet.");
    for (const RecentFile& file : state.media.recent) {
        std::error_code unknown;
        const bool there = is_live(file.colour) || std::filesystem::exists(file.colour, unknown);
        const std::string depth =
            file.depth.empty() ? std::string{} : " + " + file.depth.filename().string();
        ImGui::BeginDisabled(!there);
        ImGui::PushID(&file);
        const std::string name =
            is_live(file.colour) ? shown_source(file.colour) : file.colour.filename().string();
        if (item::selectable((name + depth).c_str()))
            state.commands.push(OpenRequest{file.colour, file.depth});
        ImGui::PopID();
        ImGui::EndDisabled();
        add_tooltip(file.colour.c_str());
    }
    ImGui::Separator();
    item::checkbox("Go on where it was left", &state.settings.resume);
    add_tooltip("A video that is opened again goes on at the moment at which it was closed");
    desktop_dialog_box(state.settings.open_with);
    ImGui::EndPopup();
}

void draw_open(ViewerState& state) {
    const bool from_colour =
        text_field("##colour", "Colour file, or session", state.ui.fields.colour,
                   ("Path of a colour video, a picture or a recorded session, or a live source "
                    "such as v4l2:/dev/video0 or udp://...; Open without a path lists the files" +
                    state.keys.in_brackets(Action::open_file))
                       .c_str());
    const bool from_depth =
        text_field("##depth", "Depth file: found beside it", state.ui.fields.depth,
                   "Empty: the file called like the colour file, with depth in place of color");
    const bool named = state.ui.fields.colour[0] != '\0';
    const bool opening = state.media.opening;
    const bool pressed =
        button_or_drop(opening ? "Opening" : "Open", !opening, "files", button_width(kRecent));
    if (pressed && !named) state.commands.push(Action::open_file);
    if ((from_colour || from_depth || pressed) && named) {
        state.commands.push(OpenRequest{expand_home(state.ui.fields.colour.data()),
                                        expand_home(state.ui.fields.depth.data())});
    }
    draw_recent(state);
}

/// "those of 'a.mp4'; 0.2 s later" in two lines, which break no number.
std::string clause_by_line(const std::string& clauses) {
    std::string lines = capitalised(clauses);
    for (auto at = lines.find("; "); at != std::string::npos; at = lines.find("; ", at))
        lines.replace(at, 2, "\n");
    return lines;
}

/// Whether the times are the file's own, and colour and depth begin together.
bool has_plain_times(const MediaDescription& media) {
    return media.times_from == "file" && media.timing.find("; ") == std::string::npos;
}

void draw_files(const MediaDescription& media) {
    if (media.depth_path.empty()) return;  // nothing is open
    if (media.colour_path.empty()) {
        fact_row("Colour", "none: depth alone");
    } else {
        file_row("Colour", media.colour_path);
    }
    file_row("Depth", media.depth_path);
    fact_row("Size", formatted("%d x %d", media.colour_columns, media.colour_rows));
    fact_row("Depth size",
             formatted("%d x %d, %s", media.depth_columns, media.depth_rows,
                       media.has_real_numbers() ? "real numbers"
                                                : formatted("%d bit", media.depth_bits).c_str()));
    if (!media.timing.empty() && !has_plain_times(media) && !media.live)
        fact_row("Frame times", clause_by_line(media.timing),
                 "Who says when each frame is; to be changed below: Depth, Times, Offset, Rate");
    if (!media.notice.empty()) draw_dimmed(capitalised(media.notice));
}

/// The frame's number and, on a machine that is too slow, the shown rate, with the reason as
/// tooltip: one line in any case, so that no row moves while a person clicks on it.
void draw_frame(const PlaybackStatus& playback) {
    std::string value = std::to_string(playback.frame + 1);
    if (playback.playing && !playback.dropped.empty()) {
        value += formatted(", %.0f of %.0f/s", playback.shown_per_s, playback.frames_per_s);
        fact_row("Frame", value, playback.dropped.c_str());
    } else {
        value += " of " + std::to_string(std::max(playback.frames, playback.frame + 1));
        fact_row("Frame", value);
    }
}

void draw_playback(const ViewerState& state, Transport& player) {
    const PlaybackStatus& playback = state.media.playback;
    play_and_step_buttons(playback.playing, player, state.keys, "frame");
    bool looping = playback.looping;
    if (item::checkbox("Loop", &looping)) player.set_looping(looping);
    add_tooltip("Start again at the end", state.keys, Action::toggle_loop);
    fact_row("Time", clock_text(playback.media_s) + " of " + clock_text(playback.duration_s));
    draw_frame(playback);
    if (!playback.decoders.empty())
        fact_row("Decoded by", capitalised(clause_by_line(playback.decoders)),
                 "What decodes the videos: a device, or this machine's processors (--decoder)");
    speed_row(playback.speed, player);
}

/// The state of a live source.
void draw_live(const ViewerState& state, Transport& player) {
    const PlaybackStatus& playback = state.media.playback;
    const LiveStatus& live = *playback.live;
    play_button(playback.playing, player, state.keys);
    ImGui::SameLine();
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(playback.playing ? "Live" : "Held");
    if (live.signal) {
        fact_row("Delay", formatted("%.0f ms", 1000.0 * live.behind_s));
        add_tooltip(
            "Time from the arrival of a picture until the whole surface shows it: the time between "
            "frames, the time for cleaning, and a reserve for uneven arrival");
    } else {
        fact_row("Signal", formatted("lost for %.0f s", live.silent_s));
    }
    fact_row("Frames", formatted("%.1f/s, %lld left out", playback.frames_per_s,
                                 static_cast<long long>(live.dropped)));
    add_tooltip("Left out: frames that came before the frame before them was ready");
    if (live.motion_paused)
        draw_dimmed("This machine is too slow to find how frames move: nothing is carried along");
    if (live.in_betweens_paused)
        draw_dimmed("This machine is too slow for in-betweens: frames fade into each other");
    if (!live.signal && !live.trouble.empty()) draw_dimmed(capitalised(live.trouble));
}

/// A surface that was cleaned before, or the button to do so.
void draw_prepared(ViewerState& state) {
    const PlaybackStatus& playback = state.media.playback;
    if (state.ui.preparing) {
        const auto& [share, file] = *state.ui.preparing;
        const std::string words = file.empty() ? "Preparing" : "Preparing " + file;
        ImGui::ProgressBar(static_cast<float>(share), {-button_width("Cancel"), 0.0F},
                           words.c_str());
        if (!file.empty()) add_tooltip("Another recording than the shown one");
        ImGui::SameLine();
        if (item::button("Cancel##preparing")) state.commands.push(PrepareRecording{});
    } else if (playback.prepared) {
        draw_dimmed("Prepared: its cleaned surface is kept");
        add_tooltip("Nothing is cleaned while it plays; dibhr prepare --list has all that is kept");
    } else if (playback.open && !playback.live && !state.media.still && !state.media.opening) {
        if (item::button("Prepare")) state.commands.push(PrepareRecording{});
        add_tooltip(
            "Cleans the whole recording once and keeps its surface, so that it plays at its own "
            "rate, also on a slow machine; it feels the same");
    }
}

/// What the cleaning that runs mends: "Auto: mends holes, spikes, silhouettes".
std::string mended_text(const ViewerState& state, bool by_sidecar) {
    const CleaningSteps& steps = state.media.playback.steps;
    std::string mended;
    const auto add = [&mended](bool is, const char* what) {
        if (is) mended += (mended.empty() ? "" : ", ") + std::string(what);
    };
    add(steps.densify, "sparse depth");
    add(steps.fill_holes, "holes");
    add(steps.remove_spikes, "spikes");
    add(steps.sharpen_silhouettes || steps.colour_edges, "silhouettes");
    add(steps.smooth_outlines, "outlines");
    add(steps.smooth_steps, "depth steps");
    add(steps.steady || steps.smooth_noise, "noise");
    const std::string& words = state.media.playback.cleaning;  // they begin with the preset's name
    const std::string preset = words.substr(0, words.find_first_of(":,"));
    return (by_sidecar ? "By the sidecar: " + preset : capitalised(preset)) +
           (mended.empty() ? "" : ": mends " + mended);
}

/// If a person switches a step, the preset becomes `own`, with the other steps as they are now.
void draw_cleaning(ViewerState& state) {
    CleaningOptions& cleaning = state.settings.cleaning;
    const std::string held = state.keys.name_for(Action::show_as_recorded);
    const std::string compared =
        held.empty() ? "" : "; hold " + held + " to see and feel it as recorded";
    choice_row("Cleaning", kCleaningPresetNames, cleaning.preset,
               ("What is done to the depth before it is drawn and touched (--cleaning)" + compared)
                   .c_str(),
               CleaningPreset::automatic);
    const bool by_sidecar = cleaning_on(state.media, cleaning).preset != cleaning.preset;
    if (!state.touch.replay && !state.media.playback.cleaning.empty()) {
        draw_dimmed(mended_text(state, by_sidecar));
        add_tooltip((capitalised(state.media.playback.cleaning) +
                     "\nWith the noise that was measured in the depth, from near to far, and the "
                     "force that a slide trembles by, as it is and without cleaning")
                        .c_str());
    }
    const double said_mm = finger_mm_on(state.media, 0.0);
    const std::string unless_chosen =
        said_mm > 0.0 ? short_text(said_mm) + " mm (sidecar)" : "a point";
    number_row({"Fingertip", "%.1f mm", 0.0, 10.0, 0.0,
                "Radius of the ball that touches; 0: a point, or as a sidecar says (--finger)",
                false, unless_chosen.c_str()},
               state.settings.finger_mm);
    if (state.ui.preparing) draw_prepared(state);
    if (!subsection("Cleaning steps")) return;
    if (!state.touch.replay && !state.ui.preparing) draw_prepared(state);
    const bool own = cleaning.preset == CleaningPreset::own;
    CleaningSteps steps = own ? cleaning.own : state.media.playback.steps;
    const CleaningSteps standard = own ? kSensorSteps : steps;
    bool changed = false;
    const auto row = [&changed](const char* label, bool& step, bool usual, const char* help) {
        changed = flag_row(label, step, usual, help) || changed;
    };
    row("Interpolate sparse depth", steps.densify, standard.densify,
        "Between seen pixels that lie apart, as a LiDAR's, up to the colour's edges; a replay then "
        "needs the colour, too");
    row("Remove spikes", steps.remove_spikes, standard.remove_spikes,
        "Single pixels that stand out of all their neighbours");
    row("Fill holes", steps.fill_holes, standard.fill_holes,
        "Where the camera saw no depth, take the depth around it");
    row("Sharpen silhouettes", steps.sharpen_silhouettes, standard.sharpen_silhouettes,
        "Ramps between near and far become steps");
    row("Edges of colour", steps.colour_edges, standard.colour_edges,
        "Wide ramps become a step where the colour has its sharp edge; a replay then needs the "
        "colour, too");
    row("Steady in time", steps.steady, standard.steady,
        "What does not move keeps its level from frame to frame");
    row("Smooth depth steps", steps.smooth_steps, standard.smooth_steps,
        "Rounds the terraces of depth in steps, by half a step at most");
    row("Smooth noise", steps.smooth_noise, standard.smooth_noise,
        "Within the noise of the recording; what is beyond it stays");
    row("Smooth outlines", steps.smooth_outlines, standard.smooth_outlines,
        "Pixels of an outline that are on the other side than those around them change sides");
    if (changed)
        cleaning = {.preset = CleaningPreset::own, .own = steps, .finger = cleaning.finger};
    choice_row("In-betweens", kInBetweensNames, state.settings.in_betweens,
               "Between two frames, moving things are shown on their way, instead of one picture "
               "fading into the other; a replay then needs the colour, too (--in-betweens)");
}

}  // namespace

void draw_video_panel(ViewerState& state, Transport* player) {
    if (!section(state, "Video", state.settings.panels.video)) return;
    ImGui::PushID("video");
    draw_open(state);
    draw_files(state.media);
    const bool plays = state.media.opening || !state.media.depth_path.empty();
    if (player != nullptr && state.media.playback.live)
        draw_live(state, *player);
    else if (player != nullptr && plays && !state.media.still)
        draw_playback(state, *player);
    if (player != nullptr && subsection("Depth")) draw_depth_rows(state);
    ImGui::BeginDisabled(player == nullptr);  // a replay shows what was touched
    draw_cleaning(state);
    ImGui::EndDisabled();
    const std::string& failure = state.media.playback.failure;
    if (player != nullptr && !failure.empty()) draw_dimmed(failure);
    ImGui::PopID();
}

}  // namespace dibhr
