// The program as it is shipped, but for its main(): after each picture it writes what it has shown
// where the test reads it, and hangs when the test asks for that.
#include <chrono>
#include <cstdlib>
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
    const ViewerState& state = shown.state;
    seen.file.set(state.touch.replay ? state.touch.replay->file.string() : state.media.colour_path.string());
    seen.replays = state.touch.replay.has_value();
    seen.open = seen.replays || state.media.playback.open;
    seen.opening = state.media.opening;
    seen.surface = shown.surface.makes_surface();
    seen.playing = state.media.playback.playing;
    seen.looping = state.media.playback.looping;
    const MediaPart part = state.media.playback.part.value_or(MediaPart{-1.0, -1.0});
    seen.part_from_s = part.from_s;
    seen.part_to_s = part.to_s;
    seen.speed = state.media.playback.speed;
    seen.media_s = state.media.playback.media_s;
    seen.duration_s = state.media.playback.duration_s;
    if (seen.surface) {
        const Frame& frame = shown.surface.nearest();
        seen.drawn_s = frame.media_s;
        seen.drawn_frame = frame.index;
        seen.drawn_media = frame.media;
    }
    if (!state.touch.replay) return;
    const SessionPlayback& playback = state.touch.replay->playback;
    seen.playing = playback.playing;
    seen.looping = playback.looping;
    seen.speed = playback.speed;
    seen.media_s = playback.now_s - playback.begin_s;
    seen.duration_s = playback.end_s - playback.begin_s;
    seen.tick = state.touch.replay->tick_count;
}

void see_window(const ViewerState& state, Seen& seen) {
    seen.in_front = state.touch.in_front;
    seen.columns = static_cast<int>(state.ui.window_width);
    seen.rows = static_cast<int>(state.ui.window_height);
    seen.panels = state.settings.panels_visible;
    seen.help = state.ui.help_open;
    seen.dialog = state.ui.dialog.shown;
    seen.dialog_reads = state.ui.dialog.reads;
    seen.dialog_typing = state.ui.dialog.shown && state.ui.dialog.asks_for_keyboard == 0;
    seen.dialog_entries = state.ui.dialog.rows.entries.size();
    seen.statistics = state.ui.statistics;
    seen.ruler = state.ui.ruler.has_value();
    seen.ruler_points = state.ui.ruler ? static_cast<int>(state.ui.ruler->places.size()) : 0;
    seen.brush = state.ui.brush.on;
    seen.painted = state.ui.brush.has_paint;
    seen.can_undo = state.ui.brush.can_undo;
    seen.as_recorded = state.media.as_recorded;
    seen.explained = state.ui.explained.has_value();
    seen.explained_steps = state.ui.explained ? state.ui.explained->taken : 0;
    seen.doubts = state.ui.doubts.size();
    seen.asks_command = state.ui.depth_offer && !state.ui.depth_offer->asks.empty();
    seen.depth_offered = state.ui.depth_offer.has_value();
    seen.depth_made = state.ui.depth_offer && !state.ui.depth_offer->depth.empty();
    if (state.ui.under_pointer) {
        seen.pointed_column = static_cast<float>(state.ui.under_pointer->column);
        seen.pointed_row = static_cast<float>(state.ui.under_pointer->row);
    }
    seen.message.set(state.ui.message);
    seen.notice.set(state.ui.notice);
}

void see_touch(const ViewerState& state, Seen& seen) {
    const HapticState& haptic = state.touch.haptic;
    seen.ticks = haptic.ticks;
    seen.touchable = haptic.touchable;
    seen.contact = haptic.touch.proxy.contact;
    seen.ready = haptic.hand.ready;
    seen.mouse_fallback = haptic.hand.stand_in;
    seen.force_enabled = state.touch.force_enabled;
    seen.buttons = haptic.hand.buttons;
    seen.cut = static_cast<int>(haptic.touch.cut);
    seen.spring_newton = glm::length(haptic.touch.spring_force_newton);
    seen.sent_newton = glm::length(haptic.touch.sent_force_newton);
    seen.standstills = haptic.standstill.count;
}

void see_outputs(const ViewerState& state, Seen& seen) {
    seen.records = state.touch.recording.has_value();
    seen.recorded_rows = state.touch.recording ? state.touch.recording->status.rows : 0;
    seen.marks = state.touch.recording ? state.touch.recording->marks.size() : 0;
    seen.clip = state.ui.clip.has_value();
    seen.clip_finishing = state.ui.clip && state.ui.clip->finishing;
    seen.clip_s = state.ui.clip ? state.ui.clip->time_s : 0.0;
    seen.sound = static_cast<int>(state.touch.sound);
}

Seen seen_of(const PictureShown& shown, std::uint64_t number) {
    Seen seen;
    seen.picture = number;
    see_media(shown, seen);
    see_window(shown.state, seen);
    see_touch(shown.state, seen);
    see_outputs(shown.state, seen);
    if (shown.study == nullptr) return seen;
    seen.study = true;
    seen.study_step = shown.study->step;
    seen.trial = shown.study->trial;
    seen.interval = shown.study->interval;
    seen.waits = shown.study->waits;
    seen.leaving = shown.study->leaving;
    seen.agrees = shown.study->agrees;
    if (shown.study->seen_since) seen.asked_s = seconds_of(*shown.study->seen_since);
    return seen;
}

/// Stays until the next one is seen.
void see_question(const PictureShown& shown, Seen& last) {
    const StudyPlace* const place = shown.study;
    if (place == nullptr || place->step != static_cast<int>(StudyStep::question)) return;
    if (place->leaving || !place->seen_since || place->trial == last.question_trial) return;
    last.question_trial = place->trial;
    last.question_seen_s = seconds_of(*place->seen_since);
}

PictureHook hook_of(const char* file) {
    if (file == nullptr) return {};
    const auto board = std::make_shared<MappedBoard>(file);
    return [board, last = Seen{}](const PictureShown& shown) mutable {
        Seen seen = seen_of(shown, last.picture + 1);
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
