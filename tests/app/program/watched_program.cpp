// The program as it is shipped, but for its main(): after each turn of its window it writes what is
// shown where the test reads it, and hangs when the test asks for that.
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <memory>

#include "app/commands/program.hpp"
#include "core/study/study_run.hpp"
#include "tests/app/program/seen.hpp"

namespace {

using namespace dibhr;
using dibhr::test::MappedBoard;
using dibhr::test::Seen;

double seconds_of(std::chrono::steady_clock::time_point moment) {
    return std::chrono::duration<double>(moment.time_since_epoch()).count();
}

void see_media(const PictureShown& shown, Seen& seen) {
    const auto& replay = shown.touch.replay;
    const PlaybackStatus& video = shown.media.playback;
    const std::filesystem::path& colour = shown.media.colour_path;
    seen.file.set(replay ? replay->file.string() : colour.string());
    seen.replays = replay.has_value();
    seen.open = seen.replays || video.open;
    seen.opening = shown.media.opening;
    seen.surface = shown.surface.makes_surface();
    seen.playing = video.playing;
    seen.looping = video.looping;
    const MediaPart part = video.part.value_or(MediaPart{-1.0, -1.0});
    seen.part_from_s = part.from_s;
    seen.part_to_s = part.to_s;
    seen.speed = video.speed;
    seen.media_s = video.media_s;
    seen.duration_s = video.duration_s;
    if (seen.surface && shown.drawn) {
        const Frame& frame = shown.surface.nearest();
        seen.drawn_s = frame.media_s;
        seen.drawn_frame = frame.index;
        seen.drawn_media = frame.media;
        const DepthImage& depth = *frame.drawn();
        seen.drawn_middle = depth.at(depth.columns / 2, depth.rows / 2) / depth.highest_level;
    }
    if (!replay) return;
    const SessionPlayback& playback = replay->playback;
    seen.playing = playback.playing;
    seen.looping = playback.looping;
    seen.speed = playback.speed;
    seen.media_s = playback.now_s - playback.begin_s;
    seen.duration_s = playback.end_s - playback.begin_s;
    seen.tick = replay->tick_count;
}

void see_ui(const UiState& ui, Seen& seen) {
    seen.columns = static_cast<int>(ui.window_width);
    seen.rows = static_cast<int>(ui.window_height);
    seen.help = ui.help_open;
    seen.dialog = ui.dialog.shown;
    seen.dialog_reads = ui.dialog.is_reading;
    seen.dialog_refuses = !ui.dialog.refused.empty();
    seen.dialog_typing = ui.dialog.shown && ui.dialog.pictures_to_focus == 0;
    seen.dialog_entries = ui.dialog.rows.entries.size();
    seen.dialog_folder.set(ui.dialog.folder.path.string());
    seen.dialog_chosen.set(ui.dialog.chosen.string());
    for (const FolderEntry& entry : ui.dialog.folder.entries)
        seen.dialog_recordings += entry.recording ? 1 : 0;
    seen.preview_text.set(ui.dialog.preview.text);
    seen.preview_depth = ui.dialog.preview.depth != 0;
    seen.focus.set(ui.focus.label);
    seen.focus_kind.set(ui.focus.kind);
    seen.focus_value.set(ui.focus.value);
    seen.keys_move_hand = ui.keys_move_hand;
    seen.statistics = ui.statistics;
    seen.ruler = ui.ruler.has_value();
    seen.ruler_points = ui.ruler ? static_cast<int>(ui.ruler->places.size()) : 0;
    seen.brush = ui.brush.on;
    seen.painted = ui.brush.has_paint;
    seen.can_undo = ui.brush.can_undo;
    seen.region.set(ui.region.name);
    seen.region_text = ui.region.rests;
    seen.caption.set(ui.caption);
    seen.regions = ui.regions;
    seen.lead = ui.lead ? static_cast<int>(ui.lead->step) + 1 : 0;
    seen.lead_done = ui.lead && ui.lead->done;
    seen.explained = ui.explained.has_value();
    seen.explained_steps = ui.explained ? ui.explained->taken : 0;
    seen.unsafe_settings = ui.unsafe_settings.size();
    seen.asks_command = ui.depth_offer && !ui.depth_offer->unconfirmed_command.empty();
    if (ui.depth_question) {
        seen.depth_answers = ui.depth_question->alternatives.size();
        seen.depth_reliefs = ui.depth_question->reliefs.size();
        seen.depth_for_folder = ui.depth_question->for_folder;
    }
    seen.depth_offered = ui.depth_offer.has_value();
    seen.depth_in_work = ui.depth_offer && ui.depth_offer->progress;
    seen.depth_made = ui.depth_offer && !ui.depth_offer->depth.empty();
    if (ui.under_pointer) {
        seen.pointed_column = static_cast<float>(ui.under_pointer->column);
        seen.pointed_row = static_cast<float>(ui.under_pointer->row);
    }
    seen.clip = ui.clip.has_value();
    seen.clip_finishing = ui.clip && ui.clip->finishing;
    seen.clip_s = ui.clip ? ui.clip->time_s : 0.0;
    seen.message.set(ui.message);
    seen.notice.set(ui.notice);
}

void see_touch(const TouchState& touch, Seen& seen) {
    seen.in_front = touch.in_front;
    const HapticState& haptic = touch.haptic;
    seen.ticks = haptic.ticks;
    seen.touchable = haptic.touchable;
    seen.contact = haptic.touch.proxy.contact;
    seen.ready = haptic.hand.ready;
    seen.mouse_fallback = haptic.hand.mouse_fallback;
    seen.force_enabled = touch.force_enabled;
    seen.buttons = haptic.hand.buttons;
    seen.cut = static_cast<int>(haptic.touch.cut);
    seen.spring_newton = glm::length(haptic.touch.spring_force_newton);
    seen.sent_newton = glm::length(haptic.touch.sent_force_newton);
    seen.standstills = haptic.standstill.count;
    seen.records = touch.recording.has_value();
    seen.recorded_rows = touch.recording ? touch.recording->status.rows : 0;
    seen.marks = touch.recording ? touch.recording->marks.size() : 0;
    seen.sound = static_cast<int>(touch.sound);
}

/// `last`: of the turn before, whose picture stays where none was drawn.
Seen seen_of(const PictureShown& shown, const Seen& last) {
    Seen seen;
    seen.turn = last.turn + 1;
    seen.picture = last.picture + (shown.drawn ? 1 : 0);
    if (!shown.drawn) {
        seen.drawn_middle = last.drawn_middle;
        seen.drawn_s = last.drawn_s;
        seen.drawn_frame = last.drawn_frame;
        seen.drawn_media = last.drawn_media;
    }
    see_media(shown, seen);
    see_touch(shown.touch, seen);
    seen.panels = shown.settings.panels_visible;
    seen.as_recorded = shown.media.as_recorded;
    if (shown.ui != nullptr) see_ui(*shown.ui, seen);
    if (shown.study == nullptr) return seen;
    seen.study = true;
    seen.study_step = shown.study->step;
    seen.trial = shown.study->trial;
    seen.interval = shown.study->interval;
    seen.waits = shown.study->waits;
    seen.leaving = shown.study->leaving;
    seen.asks_consent = shown.study->asks_consent;
    if (shown.study->seen_since) seen.asked_s = seconds_of(*shown.study->seen_since);
    return seen;
}

/// Stays until the next one is seen.
void see_question(const PictureShown& shown, Seen& last) {
    const StudyPosition* const place = shown.study;
    if (place == nullptr || place->step != static_cast<int>(StudyStep::question)) return;
    if (place->leaving || !place->seen_since || place->trial == last.question_trial) return;
    last.question_trial = place->trial;
    last.question_seen_s = seconds_of(*place->seen_since);
}

PictureHook hook_of(const char* file) {
    if (file == nullptr) return {};
    const auto board = std::make_shared<MappedBoard>(file);
    return [board, last = Seen{}](const PictureShown& shown) mutable {
        Seen seen = seen_of(shown, last);
        seen.question_trial = last.question_trial;
        seen.question_seen_s = last.question_seen_s;
        see_question(shown, seen);
        (*board)->write(last = seen);
        while ((*board)->hangs) (*board)->is_hanging = true;
    };
}

}  // namespace

int main(int argc, char** argv) {
    return run_program(argc, argv, hook_of(std::getenv(dibhr::test::SeenBoard::kVariable)));
}
