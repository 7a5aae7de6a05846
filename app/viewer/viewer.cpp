// The viewer's window thread: input, scene, panels, and publishing to the other threads.
#include "app/viewer/viewer.hpp"

#include <algorithm>
#include <atomic>
#include <functional>
#include <thread>
#include <utility>

#include "app/panels/widgets.hpp"
#include "app/touching/device_state.hpp"
#include "app/touching/force_law.hpp"
#include "app/touching/picture_time.hpp"
#include "app/window/x_server.hpp"
#include "core/files/plain_text.hpp"
#include "render/drawing_threads.hpp"
#include "render/gl_objects.hpp"

namespace dibhr {

namespace {

using std::chrono::steady_clock;

/// After input that changed nothing visible: the pointer may move a thousand times a second.
constexpr std::chrono::milliseconds kAfterInput{8};
/// From picture to picture while late frames limit drawing and a person moves something.
constexpr std::chrono::milliseconds kInUse{50};
/// Timeout for the hashes of large files at an end by a signal or a lost display.
constexpr auto kPatienceAtAnEnd = std::chrono::milliseconds(200);

/// `begin_s`: begin of the media, on its own clock.
void apply_play_options(const ViewOptions& options, double begin_s, Transport& player) {
    if (options.end_s)
        player.set_part(MediaPart{begin_s + options.open.at_s, begin_s + *options.end_s});
    if (options.speed) player.set_speed(*options.speed);
    if (options.looping) player.set_looping(*options.looping);
}

std::optional<KioskShown> kiosk_shown(const ViewOptions& options) {
    if (!options.kiosk) return std::nullopt;
    return KioskShown{!options.kiosk->next.empty(), options.settings.speak};
}

}  // namespace

Viewer::Viewer(const ViewOptions& options, OpeningWindow& opening, ViewerParts parts,
               ShutdownWatchdog& shutdown, TaskGroup& tasks, MessageLog& log)
    : options_(options),
      shutdown_(shutdown),
      log_(log),
      window_(opening.window()),
      gui_(opening.gui()),
      software_(read_limits().software),
      pace_(least_picture_time(options.sync, software_), drawing_s),
      state_{.settings = options.settings,
             .keys = KeyTable(options.settings.keys),
             .ui = {.unsafe_settings = options.unsafe_settings, .kiosk = kiosk_shown(options)}},
      service_settings_(tasks),
      opening_(tasks),
      opening_name_(shown_name(options.open.colour)),
      opening_since_(opening.begin()),
      clip_(tasks, shutdown.crash_note()),
      estimating_(tasks),
      preparing_(tasks),
      asking_(tasks),
      browsing_(tasks),
      desktop_(tasks),
      painting_(tasks),
      guide_(tasks),
      save_queue_(tasks),
      settings_saver_(options.in_file, options.settings, options.settings_file, save_queue_),
      start_(steady_clock::now()),
      touch_(std::move(parts.hand),
             {heart_, shutdown.without_force(), shutdown.crash_note(), [this] { window_.wake(); }},
             {state_.settings, state_.touch, state_.media}) {
    opening.show();
    if (software_) lower_drawing_priority();
    window_.on_display_loss([this] { close_without_display(); });
    shutdown_.watch_display(display_connection());
    state_.touch.record_surface = options.record_surface;
    state_.touch.record_preview = options.record_preview;
    state_.touch.bump = std::move(parts.bump);
    state_.touch.bump_file = std::move(parts.bump_file);
    state_.touch.material = std::move(parts.material);
    state_.ui.materials = material_names();
    state_.ui.message = capitalised(parts.damage);
    apply_style();
    if (!options.clip.empty())
        clip_.start(options.clip, ClipNameConflict::replaces, options.pictures_of);
    OpenedFiles& files = parts.files;
    if (files.session) {
        replay_session(std::move(files.session), files.guide);
        SessionPlayer& replay = *replay_.player();
        apply_play_options(options, replay.playback().begin_s, replay);
        if (options.open.at_s > 0.0) replay.seek(replay.playback().begin_s + options.open.at_s);
        if (options.open.paused) replay.pause();
        return;
    }
    if (!files.media) {
        if (options.kiosk) {
            pass_over_in_kiosk();
            return;
        }
        const bool offered = files.lacks_depth && estimating_.offer(options.open.colour, state_);
        if (!offered)
            state_.ui.message += (parts.damage.empty() ? "" : "\n\n") + capitalised(files.trouble);
        return;
    }
    state_.media.describe(files.media->description());
    const bool live = state_.media.live;
    if (!options.record.empty() && !live) {
        fit_to_media();  // before start(): a session's facts contain it
        touch_.recording().start(options.record);
    }
    show_media(std::move(files.media), options.open, files.memory, std::move(files.maps),
               files.guide);
    if (!options.record.empty() && live) touch_.recording().start_live(options.record);
    apply_play_options(options, 0.0, touch_.player());
    if (options.may_lead() && is_sample(state_.media.colour_path))
        lead_.begin(guide_.regions(), state_, save_queue_);
}

Viewer::~Viewer() {
    shutdown_.watch_display(-1);
    window_.on_display_loss({});
}

void Viewer::run() {
    start_ = steady_clock::now();
    shutdown_.crash_note().set_activity("drawing");
    while (!over()) {
        shutdown_.begin_turn();
        wait_for_turn(take_turn());
    }
    shutdown_.end_loop();
    finish();
}

/// After a picture: as long as until the next one. Else: for input, frames, or the next turn.
void Viewer::wait_for_turn(Turn last) {
    const auto least = most_pictures_per_s() > 0.0 ? kInUse : std::chrono::milliseconds(0);
    if (last.drawn) return pace_.wait(least, [this] { follow_pointer(); });
    if (last.input) std::this_thread::sleep_for(kAfterInput);
    window_.wait_for_input(change_.pause(may_touch(state_.touch), steady_clock::now()));
}

/// Beats once the display has answered, so that a hung display stops the heartbeat, too.
void Viewer::beat() {
    window_.ping_display();
    heart_.beat();
}

/// The display is lost: saves all without the window.
void Viewer::close_without_display() {
    shutdown_.end_loop();
    shutdown_.crash_note().set_activity("closing without a display");
    desktop_.cancel();
    state_.ui.message.clear();
    touch_.stop();
    estimating_.end();
    preparing_.end();
    const std::atomic<bool> at_once{true};
    save_all(at_once, [this](const char*, const auto& step) { attempt(step); });
    touch_.close_device();
    if (!state_.ui.message.empty()) print_error_line(state_.ui.message);
}

void Viewer::finish() {
    std::string failure;
    const auto try_to = [&](const char* what, const auto& step) {
        shutdown_.crash_note().set_activity(what);
        try {
            step();
        } catch (const Error& error) {
            if (failure.empty()) failure = error.what();
        }
    };
    // First the force: no force is sent while files are written.
    try_to("taking the force off", [this] {
        if (const auto schedule = touch_.stop()) log_lateness(*schedule);
        estimating_.end();
        preparing_.end();
    });
    try_to("writing the last picture", [this] { write_last_picture(); });
    try_to("writing the last picture", [this] { take_last_screenshot(); });
    save_all(shutdown_.requested(), try_to);
    shutdown_.crash_note().set_activity("closing the window");
    if (!failure.empty()) throw InputError(failure);
}

/// Calls `try_to` with name and function of each step. `at_once`, once true, shortens the timeouts.
template <typename Try>
void Viewer::save_all(const std::atomic<bool>& at_once, const Try& try_to) {
    shutdown_.crash_note().set_activity("saving the settings");
    explaining_.end(state_, camera_);
    keep_memory();
    settings_saver_.finish(settings_to_save());
    TouchRecording& recording = touch_.recording();
    try_to("saving the settings", [&] {
        save_queue_.finish(at_once ? kPatienceAtAnEnd : std::chrono::milliseconds(10000));
    });
    try_to("writing pictures", [&] { screenshots_.finish(); });
    try_to("saving what was painted", [&] {
        at_once ? painting_.finish(recording, kPatienceAtAnEnd) : painting_.finish(recording);
    });
    try_to("finishing the clip",
           [&] { clip_.finish(at_once ? ClipEnd::at_once : ClipEnd::indexed); });
    try_to("closing the recording",
           [&] { recording.finish(at_once ? kPatienceAtAnEnd : Recorder::kPatience); });
}

/// Once a turn: the window may have moved to a display of another scale.
void Viewer::apply_style() {
    const Settings& settings = state_.settings;
    gui_.apply(gui_style(options_, settings, window_));
    state_.ui.fonts = gui_.fonts();
    state_.ui.scale = gui_.scale();
}

/// Handles input, updates the state, and draws a picture if it differs from the last one.
Viewer::Turn Viewer::take_turn() {
    apply_style();
    const WindowInput input = window_.take_input();
    beat();
    poll();
    hold_unseen_video();
    take_keys(input);
    if (!options_.kiosk) take_dropped(input.dropped);
    state_.ui.window_width = static_cast<float>(window_.framebuffer_size().x);
    state_.ui.window_height = static_cast<float>(window_.framebuffer_size().y);
    move_hand(input);
    state_.ui.focus = gui_.focus().words();
    state_.ui.keys_move_hand = key_hand_.on();
    follow_kiosk(input);
    speak();  // before the picture, which may take long
    const bool drawn = draw_if_changed(input);
    carry_out_commands();
    show_recording_trouble();  // a command may have ended it
    publish();
    keep_settings();
    log_messages();
    if (drawn) {
        if (software_) {
            beat_while_drawing([this] {
                beat();
                follow_pointer();
            });
        }
        window_.show_picture();
        require_graphics();
        beat();
    }
    pace_.count(drawn);
    if (options_.after_picture) {
        options_.after_picture({.settings = state_.settings,
                                .touch = state_.touch,
                                .media = state_.media,
                                .surface = shown_,
                                .ui = &state_.ui,
                                .drawn = drawn});
    }
    return {input.any, drawn};
}

/// A video that nobody can see, feel or record waits until the window is visible again.
void Viewer::hold_unseen_video() {
    const bool needed = window_.visible() || state_.media.live || may_touch(state_.touch) ||
                        touch_.recording().active_or_waiting() || clip_.active();
    if (needed && std::exchange(video_held_, false)) transport().play();
    if (needed || !state_.play_state().playing) return;
    transport().pause();
    video_held_ = true;
}

/// Whether a video plays: it changes the picture with each frame.
bool Viewer::video_runs() const {
    return !state_.touch.replay && !state_.media.still && state_.media.playback.playing;
}

/// While frames of the video are late; 0: no limit.
double Viewer::most_pictures_per_s() const {
    return video_runs() ? state_.media.playback.most_pictures_per_s : 0.0;
}

/// Whether the next frame replaces a picture before anybody sees its last detail, with which the
/// processor draws twice as long. The picture that stays has the detail; a replay always has.
bool Viewer::pictures_pass() const {
    constexpr int kManyColumns = 960;  // the half of fewer shows at outlines
    const bool software_saves = software_ && state_.media.depth_columns >= kManyColumns;
    return video_runs() && (software_saves || most_pictures_per_s() > 0.0);
}

void Viewer::poll() {
    poll_touch();
    state_.ui.cost = pace_.cost();
    touch_.player().set_drawing_cost(state_.ui.cost.drawing);
    take_opened();
    take_desktop_answer();
    follow_live();
    const std::string& failure =
        state_.touch.replay ? state_.touch.replay->playback.failure : state_.media.playback.failure;
    if (!failure.empty() && failure != playback_failure_) {
        state_.ui.message = failure;
        print_error_line(failure);
    }
    playback_failure_ = failure;
    attempt([this] {
        while (const auto notice = screenshots_.take()) show_notice(*notice);
    });
    attempt([this] {
        if (const auto notice = clip_.poll(state_)) show_notice(*notice);
    });
    attempt([this] { painting_.poll(state_, touch_.recording()); });
    take_report();
    take_prepared();
    if (const auto made = estimating_.poll(state_)) open(*made);
}

/// Polls replay, touching, device buttons and recording.
void Viewer::poll_touch() {
    if (replay_.player() != nullptr) replay_.advance(state_, steady_clock::now());
    // Asked only where it matters, as it takes several queries of the display server.
    const bool in_front = may_touch(state_.touch) && window_.in_front();
    for (const std::string& notice : touch_.poll(in_front)) show_notice(notice);
    service_settings_.update(state_.settings, state_.touch.devices);
    for (const DeviceButtonPress& press : touch_.take_presses()) {
        const std::optional<Action> action = entry_of(button_jobs(), press.action).perform;
        const bool writes_file = action == Action::record || action == Action::take_screenshot;
        if (options_.kiosk && writes_file) continue;  // visitors would fill the disk
        for (std::uint32_t k = 0; action && k < press.times; ++k) perform(*action);
    }
    state_.ui.touched = state_.ui.touched || state_.touch.haptic.touch.proxy.contact;
    TouchRecording& recording = touch_.recording();
    recording.poll();
    if (const auto notice = recording.take_finished()) show_notice(*notice);
    show_recording_trouble();
}

void Viewer::show_recording_trouble() {
    if (const std::string trouble = touch_.recording().take_trouble(); !trouble.empty())
        state_.ui.message = trouble + ". The force is off until it is switched on again" +
                            state_.keys.in_brackets(Action::toggle_force) + ".";
}

void Viewer::publish() {
    state_.touch.depth_in_question = state_.ui.depth_question.has_value();
    if (!state_.touch.replay) fit_to_media();
    touch_.publish();
}

void Viewer::keep_settings() {
    if (!window_.full_screen()) {
        const glm::ivec2 size = window_.window_size();
        state_.settings.width = size.x;
        state_.settings.height = size.y;
    }
    attempt([this] {
        settings_saver_.poll(settings_to_save(), now_s());
        save_queue_.poll();
    });
    if (!state_.ui.unsafe_settings.empty())
        drop_changed(state_.ui.unsafe_settings, state_.settings);
}

/// Logs new messages and device banners, wherever they were set.
void Viewer::log_messages() {
    log_.append_if_changed("message", state_.ui.message);
    log_.append_if_changed("device", device_banner(state_.settings, state_.touch));
    attempt([this] { log_.write(); });
}

void Viewer::speak() {
    const Spoken now = spoken_of(state_, now_s());
    if (!state_.settings.speak) state_.ui.speech_trouble.clear();
    if (const auto trouble = speaking_.follow(now, now_s(), state_.settings.speak)) {
        print_warning(*trouble);
        state_.ui.speech_trouble = *trouble;
        if (state_.ui.kiosk)
            state_.ui.kiosk->can_repeat = false;
        else
            show_notice(*trouble);
    }
}

void Viewer::log_lateness(const TickSchedule& schedule) {
    const double worst_ms =
        std::chrono::duration<double, std::milli>(schedule.lateness().worst()).count();
    log_.append("ticks", std::to_string(schedule.ticks()) + ", late " +
                             std::to_string(schedule.late_ticks()) + ", the worst by " +
                             number_text(worst_ms, 3) + " ms");
}

void Viewer::show_notice(const std::string& notice, double time_s) {
    const bool shown = notice == state_.ui.notice && now_s() < state_.ui.notice_until_s;
    if (!shown) log_.append("told", notice);
    state_.ui.notice = notice;
    state_.ui.notice_shows_position = false;
    state_.ui.notice_until_s = now_s() + time_s;
}

/// Called in each turn of what lasts: shows the notice until then, after others that come between.
void Viewer::keep_notice(const std::string& notice) {
    if (state_.ui.notice == notice || now_s() >= state_.ui.notice_until_s) show_notice(notice);
}

/// Takes a notice that begins so off the screen.
void Viewer::end_notice(const std::string& begin) {
    if (state_.ui.notice.starts_with(begin))
        state_.ui.notice_until_s = std::min(state_.ui.notice_until_s, now_s());
}

Transport& Viewer::transport() {
    if (replay_.player() != nullptr) return *replay_.player();
    return touch_.player();
}

double Viewer::now_s() const {
    return std::chrono::duration<double>(steady_clock::now() - start_).count();
}

bool Viewer::over() {
    const bool closed = window_.close_requested() && (!options_.kiosk || kiosk_left_);
    return shutdown_.requested() || closed || (options_.seconds && now_s() >= *options_.seconds) ||
           (!options_.clip.empty() && played_to_the_end());
}

/// Whether playing has ended and does not loop.
bool Viewer::played_to_the_end() const {
    const PlayState at = state_.play_state();
    if (at.playing || at.looping) return false;
    if (state_.touch.replay) return at.now_s >= at.last_s();
    return state_.media.playback.ended && !state_.media.still;
}

}  // namespace dibhr
