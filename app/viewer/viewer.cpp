// The viewer's window thread: input, scene, panels, and the hand-over to the other threads.
#include "app/viewer/viewer.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <numbers>
#include <utility>

#include "app/panels/panels.hpp"
#include "app/panels/widgets.hpp"
#include "app/touching/force_law.hpp"
#include "app/touching/picture_time.hpp"
#include "app/viewer/picture_time.hpp"
#include "app/window/display_loss.hpp"
#include "app/window/x_server.hpp"
#include "core/files/plain_text.hpp"
#include "core/haptics/surface.hpp"
#include "render/drawing_threads.hpp"
#include "render/gl_objects.hpp"

namespace dibhr {

namespace {

using std::chrono::steady_clock;

constexpr double kNoticeTime_s = 4.0;
/// For the sums of large files, when the end is asked for by a signal or there is no display.
constexpr auto kPatienceAtAnEnd = std::chrono::milliseconds(200);

/// `begin_s`: of what is played, on its own clock.
template <typename AnyPlayer>
void play_as_asked(const ViewOptions& options, double begin_s, AnyPlayer& player) {
    if (options.end_s)
        player.set_part(MediaPart{begin_s + options.open.at_s, begin_s + *options.end_s});
    if (options.speed) player.set_speed(*options.speed);
    if (options.looping) player.set_looping(*options.looping);
}

/// As a person left it, or asks for; else one that grows with its text.
WindowSize asked_size(const ViewOptions& options) {
    const Settings& settings = options.settings;
    const Settings standard;
    const bool chosen = options.size_given || settings.width != standard.width ||
                        settings.height != standard.height;
    return {settings.width, settings.height,
            chosen ? std::nullopt : std::optional(settings.ui_scale)};
}

}  // namespace

Viewer::Viewer(const ViewOptions& options, ViewerParts parts, Ending& ending, Errands& errands,
               ToldLog& log)
    : options_(options),
      ending_(ending),
      log_(log),
      window_(asked_size(options), options.sync, "dibhr"),
      gui_(window_, {window_.scale(options.settings.ui_scale), options.settings.theme}),
      software_(read_limits().software),
      pace_(shortest_picture(options.sync, software_)),
      state_{.settings = options.settings,
             .keys = KeyTable(options.settings.keys),
             .ui = {.doubts = options.doubts}},
      service_settings_(errands),
      opening_(errands),
      clip_(errands, ending.words()),
      estimating_(errands),
      browsing_(errands),
      desktop_(errands),
      painting_(errands),
      lasting_(errands),
      keeper_(options.in_file, options.settings, options.settings_file, lasting_),
      start_(steady_clock::now()),
      touch_(std::move(parts.hand), {heart_, ending.without_force(), ending.words()},
             {state_.settings, state_.touch, state_.media}) {
    if (software_) let_drawing_give_way();
    window_.on_display_loss([this] { close_without_display(); });
    ending_.watch_display(display_connection());
    state_.touch.bump = std::move(parts.bump);
    state_.touch.bump_file = std::move(parts.bump_file);
    state_.touch.material = std::move(parts.material);
    state_.ui.materials = material_names();
    state_.ui.message = capitalised(parts.damage);
    wear_look();
    if (options.full_screen) window_.toggle_full_screen();
    if (!options.clip.empty()) clip_.start(options.clip, ClipName::replaces, options.pictures_of);
    if (parts.session) {
        replay_session(std::move(parts.session));
        SessionPlayer& replay = *replay_.player();
        play_as_asked(options, replay.playback().begin_s, replay);
        if (options.open.at_s > 0.0) replay.seek(replay.playback().begin_s + options.open.at_s);
        if (options.open.paused) replay.pause();
        return;
    }
    if (!parts.media) {
        const bool offered = parts.lacks_depth && estimating_.offer(options.open.colour, state_);
        if (!offered)
            state_.ui.message += (parts.damage.empty() ? "" : "\n\n") + capitalised(parts.trouble);
        return;
    }
    state_.media.describe(parts.media->description());
    const bool live = state_.media.live;
    if (!options.record.empty() && !live) {
        fit_to_media();  // what is told of a session is what is touched with
        touch_.recording().start(options.record);
    }
    show_media(std::move(parts.media), options.open, parts.memory, std::move(parts.maps));
    if (!options.record.empty() && live) touch_.recording().start_live(options.record);
    play_as_asked(options, 0.0, touch_.player());
}

Viewer::~Viewer() {
    ending_.watch_display(-1);
    window_.on_display_loss({});
}

void Viewer::run() {
    start_ = steady_clock::now();
    ending_.words().doing("drawing");
    while (!over()) {
        show_one_picture();
        pace_.wait();
    }
    finish();
}

/// Each time the display has answered: a beat is never younger than the last sign of it.
void Viewer::beat() {
    window_.meet_display();
    heart_.beat();
}

/// Ends what goes on, and writes what is to last, without the window.
void Viewer::close_without_display() {
    ending_.words().doing("closing without a display");
    desktop_.call_off();
    state_.ui.message.clear();
    touch_.stop();
    estimating_.end();
    explaining_.end(state_, camera_);
    keep_memory();
    keeper_.finish(lasting_settings());
    attempt([this] { lasting_.finish(kPatienceAtAnEnd); });
    attempt([this] { screenshots_.finish(); });
    attempt([this] { painting_.finish(touch_.recording(), kPatienceAtAnEnd); });
    attempt([this] { clip_.finish(ClipEnd::at_once); });
    attempt([this] { touch_.recording().finish(kPatienceAtAnEnd); });
    touch_.close_device();
    if (!state_.ui.message.empty()) print_error_line(state_.ui.message);
}

void Viewer::finish() {
    const auto now = [this](const char* what) { ending_.words().doing(what); };
    now("taking the force off");
    // No force is sent any more when files are written.
    if (const auto schedule = touch_.stop()) keep_lateness(*schedule);
    estimating_.end();
    std::string failure;
    const auto try_to = [&failure](auto&& step) {
        try {
            step();
        } catch (const Error& error) {
            if (failure.empty()) failure = error.what();
        }
    };
    now("writing the last picture");
    try_to([this] { write_last_picture(); });
    try_to([this] { take_last_screenshot(); });
    now("saving the settings");
    explaining_.end(state_, camera_);
    keep_memory();
    keeper_.finish(lasting_settings());
    try_to([this] {
        lasting_.finish(ending_.asked() ? kPatienceAtAnEnd : std::chrono::milliseconds(10000));
    });
    now("writing pictures");
    try_to([this] { screenshots_.finish(); });
    now("saving what was painted");
    try_to([this] {
        ending_.asked() ? painting_.finish(touch_.recording(), kPatienceAtAnEnd)
                        : painting_.finish(touch_.recording());
    });
    now("finishing the clip");
    try_to([this] { clip_.finish(ending_.asked() ? ClipEnd::at_once : ClipEnd::well); });
    now("closing the recording");
    try_to([this] {
        touch_.recording().finish(ending_.asked() ? kPatienceAtAnEnd : Recorder::kPatience);
    });
    now("closing the window");
    if (!failure.empty()) throw InputError(failure);
}

/// Also when the window was moved to a display of another scale.
void Viewer::wear_look() {
    const Settings& settings = state_.settings;
    gui_.wear({window_.scale(settings.ui_scale), settings.theme});
    state_.ui.fonts = gui_.fonts();
    state_.ui.scale = gui_.scale();
}

void Viewer::show_one_picture() {
    wear_look();
    const WindowInput input = window_.take_input();
    beat();
    poll();
    take_keys(input);
    take_dropped(input.dropped);
    state_.ui.window_width = static_cast<float>(window_.framebuffer_size().x);
    state_.ui.window_height = static_cast<float>(window_.framebuffer_size().y);
    const glm::ivec2 viewport = relief_viewport();
    move_hand(input, viewport);
    draw_picture(input);
    carry_out_requests();
    publish();
    keep_settings();
    keep_told();
    if (software_) beat_while_drawing([this] { beat(); });
    window_.show_picture();
    require_graphics();
    beat();
    if (options_.after_picture)
        options_.after_picture(
            {state_.settings, state_.touch, state_.media, shown_, &state_.ui});
}

/// The relief and all that is over it, for whoever wants to save it, too.
void Viewer::draw_picture(const WindowInput& input) {
    const glm::ivec2 viewport = relief_viewport();
    draw_scene(viewport);
    if (wants_picture(PictureOf::relief)) hand_out(PictureOf::relief, read_framebuffer(viewport));
    beat();
    draw_panels(input.keys);
    beat();
}

void Viewer::poll() {
    poll_touch();
    state_.ui.pictures_per_s = pace_.pictures_per_s();
    take_opened();
    take_desktop_answer();
    follow_live();
    const std::string& failure = state_.touch.replay ? state_.touch.replay->playback.failure
                                                     : state_.media.playback.failure;
    if (!failure.empty() && failure != playback_failure_) {
        state_.ui.message = failure;
        print_error_line(failure);
    }
    playback_failure_ = failure;
    attempt([this] {
        while (const auto notice = screenshots_.take()) tell(*notice);
    });
    attempt([this] {
        if (const auto notice = clip_.take_news(state_)) tell(*notice);
    });
    attempt([this] { painting_.take_news(state_, touch_.recording()); });
    take_report();
    if (const auto made = estimating_.take_news(state_)) open(*made);
}

/// What was felt since the last picture, by whom, and what was recorded of it.
void Viewer::poll_touch() {
    if (replay_.player() != nullptr) replay_.advance(state_, steady_clock::now());
    for (const std::string& notice : touch_.poll(window_.in_front())) tell(notice);
    service_settings_.follow(state_.settings.inverse3, state_.touch.inverse3);
    for (const GripPress& press : touch_.take_presses()) {
        const std::optional<Action> action = entry_of(button_jobs(), press.action).perform;
        for (std::uint32_t k = 0; action && k < press.times; ++k) perform(*action);
    }
    state_.ui.touched = state_.ui.touched || state_.touch.haptic.touch.proxy.contact;
    TouchRecording& recording = touch_.recording();
    recording.poll();
    if (const auto notice = recording.take_finished()) tell(*notice);
    if (const std::string trouble = recording.take_trouble(); !trouble.empty())
        state_.ui.message = trouble + ". The force is off until it is switched on again" +
                            state_.keys.in_brackets(Action::toggle_force) + ".";
}

void Viewer::make_report(const std::filesystem::path& session) {
    attempt([&] {
        const bool begun = reporting_.start(std::filesystem::absolute(session));
        tell(begun ? "Making the report" : "Still making the last report");
    });
}

void Viewer::take_report() {
    attempt([this] {
        const auto page = reporting_.take();
        if (!page) return;
        tell("Report: " + page->string());
        show_in_browser(*page);
    });
}

void Viewer::take_keys(const WindowInput& input) {
    // A name typed right after the key that opens is none, even before the field has the keyboard.
    const bool typing = gui_.wants_keyboard() || state_.ui.dialog.shown;
    const std::vector<int> held = state_.keys.held_keys(Action::show_as_recorded);
    const bool as_recorded = !typing && std::any_of(held.begin(), held.end(),
                                                    [this](int key) { return window_.holds(key); });
    if (as_recorded && !state_.media.as_recorded && !state_.touch.replay) tell("Depth as recorded");
    state_.media.as_recorded = as_recorded;
    const auto take = [this](Action action, EventTimes::Time at) {
        if (action == Action::mark && !state_.touch.replay)
            state_.requests.marks.push_back(at);
        else
            perform(action);
    };
    for (const KeyPress& press : input.keys) {
        if (takes_keys(state_.ui.dialog) && state_.ui.message.empty()) take_dialog_key(press);
        if (const auto action = state_.keys.action_of_key(press.key, press.control, typing,
                                                          press.repeated, press.shift))
            take(*action, press.at);
    }
    if (typing) return;
    for (const TypedCharacter& typed : input.characters) {
        if (const auto action =
                state_.keys.action_of_character(typed.code, typed.repeated, typed.shift))
            take(*action, typed.at);
    }
}

void Viewer::take_dialog_key(const KeyPress& press) {
    const auto key = list_key(press.key);
    if (key == ListKey::down) ++state_.ui.dialog.move;
    if (key == ListKey::up) --state_.ui.dialog.move;
    if (key == ListKey::take && !press.repeated) state_.ui.dialog.enter = true;
}

std::optional<Answer> Viewer::perform_with_files(Action action) {
    switch (action) {
        case Action::open_file:
            return open_by_dialog();
        case Action::open_file_in_window:
            desktop_.call_off();
            browsing_.toggle(state_);
            return Answer{};
        case Action::next_file:
        case Action::previous_file:
            if (browsing_.go_by(action == Action::next_file ? 1 : -1, state_)) return Answer{};
            return Answer{"Still looking into the folder"};
        default:
            return std::nullopt;
    }
}

std::optional<Answer> Viewer::perform_with_view(Action action) {
    if (action == Action::copy_view) {
        gui_.copy(text_of(camera_.view()));
        return Answer{"View copied" + state_.keys.told(Action::paste_view, " takes it again")};
    }
    if (action != Action::paste_view) return std::nullopt;
    const auto view = view_in(gui_.copied());
    if (!view)
        return Answer{"No view was copied" + state_.keys.told(Action::copy_view, " copies one")};
    explaining_.leave_camera();
    camera_.set_view(*view);
    return Answer{"View taken"};
}

std::optional<Answer> Viewer::perform_with_brush(Action action) {
    Brush& brush = state_.ui.brush;
    if (action != Action::toggle_brush && action != Action::undo && action != Action::redo)
        return std::nullopt;
    if (state_.touch.replay) return Answer{"A replay is felt as it was recorded: nothing is painted"};
    if (!brush.refusal.empty()) return Answer{brush.refusal};
    if (action == Action::toggle_brush) {
        brush.on = !brush.on;
        if (!brush.on) return Answer{"Brush off"};
        if (state_.media.playback.playing) touch_.player().pause();
        state_.ui.show_paint = true;
        return Answer{"Brush: drag over the relief to paint"};
    }
    if (action == Action::undo) {
        if (!brush.can_undo) return Answer{"Nothing is painted that could be taken back"};
        painting_.undo(state_, touch_.player());
        return Answer{"Taken back" + state_.keys.told(Action::redo, " paints it again")};
    }
    if (!brush.can_redo) return Answer{"Nothing was taken back"};
    painting_.redo(state_, touch_.player());
    return Answer{"Painted again"};
}

void Viewer::perform(Action action) {
    SessionPlayer* const replay = replay_.player();
    Player& player = touch_.player();
    std::optional<Answer> answer = perform_with_files(action);
    if (!answer) answer = perform_with_view(action);
    if (!answer) answer = perform_with_brush(action);
    if (!answer) answer = explaining_.perform(action, state_, player, replay);
    if (!answer && replay != nullptr) answer = perform_in_replay(action, *replay, state_.keys);
    if (!answer) answer = dibhr::perform(action, state_, player);
    state_.media.playback = player.status();  // the next key of this picture goes on from here
    if (!answer->place && answer->words.empty()) return;
    tell(answer->words);
    state_.ui.notice_of_place = answer->place;
}

void Viewer::move_hand(const WindowInput& input, glm::ivec2 viewport) {
    shown_ = state_.touch.replay ? replay_.shown() : touch_.frames_now();
    Pointer pointer = window_.pointer();
    const auto on_panes = place_on_panes(state_, pointer.position_px);
    pointer.position_px.y -= panes_height(state_);  // the relief is below them
    PointerUse use =
        mouse_.use(pointer, input.wheel_steps, gui_.wants_pointer(), viewport, camera_);
    pressed_deeper_ = pressed_deeper_ || (use.pressed && use.wheel_steps != 0.0);
    pointed_at_.reset();
    const Camera::Ray ray = camera_.ray_under(pointer.position_px, viewport);
    const bool measures = state_.ui.ruler && !state_.ui.explained;
    const bool paints = state_.ui.brush.on && !state_.ui.explained && !state_.touch.replay;
    if (use.over_relief && (measures || paints || !use.pressed) && shown_.makes_surface())
        pointed_at_ = surface_under(ray, shown_.drawn_surface(state_.shape(), state_.touch.bump.get()));
    if (on_panes && !gui_.wants_pointer() && !use.pressed) pointed_at_ = on_panes;
    if (paints) {
        paint(use);
        use.pressed = false;
    } else if (measures) {  // its clicks touch nothing
        state_.ui.ruler->press(use.pressed, pointed_at_);
        use.pressed = false;
    }
    touch_.point(ray, shown_, use);
}

/// What it paints is not touched meanwhile.
void Viewer::paint(const PointerUse& use) {
    Brush& brush = state_.ui.brush;
    painting_.use(use.pressed, pointed_at_, shown_, state_, touch_.player());
    brush.ring.clear();
    if (!pointed_at_ || !shown_.makes_surface()) return;
    const DepthSurface surface = shown_.drawn_surface(state_.shape(), state_.touch.bump.get());
    const double radius_px = 0.5 * brush.width * surface.columns();
    constexpr int kCorners = 48;
    for (int k = 0; k < kCorners; ++k) {
        const double angle = 2.0 * std::numbers::pi * k / kCorners;
        const Vec3 at =
            surface.clamped_to_frame({pointed_at_->x + radius_px * std::cos(angle),
                                      pointed_at_->y + radius_px * std::sin(angle), 0.0});
        brush.ring.emplace_back(at.x, at.y, surface.elevation_at(at.x, at.y));
    }
}

void Viewer::draw_panels(std::span<const KeyPress> pressed) {
    gui_.begin(pressed);
    panes_.show(shown_, state_);
    draw_panes(state_);
    const glm::ivec2 viewport = relief_viewport();
    const glm::dmat4 clip_from_grid =
        camera_.clip_from_grid(static_cast<double>(viewport.x) / viewport.y);
    draw_ruler(state_, clip_from_grid);
    draw_brush(state_, clip_from_grid);
    Player& player = touch_.player();
    if (state_.settings.panels_visible) draw_panel_column(state_, player, replay_.player());
    draw_bottom_bar(state_, player, replay_.player());
    const auto fade = [](float& alpha) { alpha = std::max(0.0F, alpha - 0.03F); };
    if (state_.ui.touched) fade(hint_alpha_);
    if (pressed_deeper_) fade(wheel_hint_alpha_);
    const bool mouse_touches =
        shown_.makes_surface() && !state_.touch.replay && touch_.by_mouse();
    if (mouse_touches && state_.ui.message.empty() && !state_.ui.explained && !state_.ui.ruler &&
        !state_.ui.brush.on) {
        draw_hint(state_, Hint::touch, hint_alpha_);
        const bool wonders = hint_alpha_ <= 0.0F && state_.touch.haptic.touch.proxy.contact;
        if (wonders) draw_hint(state_, Hint::press_deeper, wheel_hint_alpha_);
    }
    draw_overlay(state_, now_s());
    draw_nothing_open(state_);
    draw_explained();
    draw_doubts(state_);
    draw_depth_offer(state_);
    draw_open_dialog(state_);
    draw_help_sheet(state_);
    draw_message_box(state_);
    // What is drawn after that is seen, and not in pictures.
    ColourImage picture;
    const bool wanted = wants_picture(PictureOf::window);
    const std::function<void()> read = [&] {
        if (wanted) picture = read_framebuffer(window_.framebuffer_size());
    };
    draw_over_pictures(state_, read);
    gui_.end();
    if (wanted) hand_out(PictureOf::window, std::move(picture));
}

void Viewer::draw_explained() {
    explaining_.advance(shown_, state_, camera_, now_s());
    if (!state_.ui.explained) return;
    const glm::ivec2 viewport = relief_viewport();
    const DepthSurface surface = shown_.surface(state_.shape(), state_.touch.bump.get());
    draw_explanation(state_, surface,
                     camera_.clip_from_grid(static_cast<double>(viewport.x) / viewport.y));
}

void Viewer::carry_out_requests() {
    if (state_.touch.replay) replay_.follow_panels(state_);
    if (const auto notice = browsing_.advance(state_)) tell(*notice);
    const Requests asked = std::exchange(state_.requests, {});
    if (asked.open) open(*asked.open);
    if (asked.meaning) open_again(*asked.meaning);
    if (asked.save_sidecar) attempt([&] { tell(save_sidecar()); });
    if (asked.bump) load_bump(*asked.bump);
    if (asked.material) take_material(*asked.material);
    if (!asked.keep_material.empty()) keep_material(asked.keep_material);
    if (asked.firmware) attempt([&] { tell(touch_.use_firmware(*asked.firmware)); });
    if (!asked.report.empty()) make_report(asked.report);
    if (asked.agreed) take_word(*asked.agreed);
    if (asked.depth)
        attempt([&] {
            if (const auto made = estimating_.perform(*asked.depth, state_)) open(*made);
        });
    if (asked.remove_paint) painting_.remove_all(state_, touch_.player());
    if (asked.reset_view) frame_relief();
    if (asked.full_screen) {
        window_.toggle_full_screen();
        tell(window_.full_screen() ? "Full screen" : "Full screen off");
    }
    if (asked.toggle_recording) start_or_stop_recording();
    for (const auto moment : asked.marks) tell(touch_.recording().mark(state_.keys, moment));
    if (asked.leave_replay) open({state_.media.colour_path, state_.media.depth_path});
    if (asked.action) perform(*asked.action);
    if (asked.screenshot) screenshots_.ask(PictureOf::window);
    if (asked.screenshot_of_relief) screenshots_.ask(PictureOf::relief);
    if (asked.toggle_clip) start_or_stop_clip(PictureOf::window);
    if (asked.toggle_clip_of_relief) start_or_stop_clip(PictureOf::relief);
    if (asked.quit) window_.close();
}

void Viewer::publish() {
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
        keeper_.look(lasting_settings(), now_s());
        lasting_.look();
    });
    if (!state_.ui.doubts.empty()) drop_changed(state_.ui.doubts, state_.settings);
}

/// On what the settings file takes away from what protects the hand.
void Viewer::take_word(bool agreed) {
    const std::vector<Doubt> doubts = std::exchange(state_.ui.doubts, {});
    if (!agreed) return keeper_.forget(doubts);
    copy_doubted(doubts, options_.in_file, state_.settings);
    lasting_.add([doubts] { Consent().agree(doubts); });
}

void Viewer::start_or_stop_recording() {
    TouchRecording& recording = touch_.recording();
    if (state_.touch.replay) {
        tell("A replay is not recorded: open a video to touch");
    } else if (recording.asked_for()) {
        painting_.hand_over(recording);
        tell(recording.stop());
    } else if (recording.finishing()) {
        tell("Still finishing the last recording");
    } else if (!touch_.may_record()) {
        state_.requests.toggle_recording = true;  // with the next picture
    } else {
        attempt([&] {
            const std::string file = new_file_name("dibhr");
            state_.media.live ? recording.start_live(file) : recording.start(file);
            state_.ui.show_session = true;
            tell("Recording into " + file);
        });
    }
}

void Viewer::start_or_stop_clip(PictureOf of) {
    if (clip_.stopped()) {
        tell("Still finishing the last clip");
    } else if (clip_.active()) {
        clip_.stop();
        tell("Finishing the clip");
    } else {
        attempt([&] {
            clip_.start(picture_name(state_) + ".mp4", ClipName::stands_beside, of);
            state_.ui.notice_until_s = 0.0;  // the sign tells it, which is not in the clip
        });
    }
}

bool Viewer::wants_picture(PictureOf of) const {
    return screenshots_.wants(of) ||
           (shown_.makes_surface() && clip_.wants(of, steady_clock::now()));
}

/// Of what was drawn up to now, to whoever wants it.
void Viewer::hand_out(PictureOf of, ColourImage picture) {
    const auto now = steady_clock::now();
    if (screenshots_.wants(of)) screenshots_.save(of, picture, picture_name(state_));
    if (shown_.makes_surface() && clip_.wants(of, now)) clip_.add(std::move(picture), now);
}

void Viewer::write_last_picture() {
    if (options_.screenshot.empty()) return;
    // Drawn again: what a buffer holds after it was shown is up to the driver.
    const glm::ivec2 relief = relief_viewport();
    draw_scene(relief);
    const bool whole = options_.pictures_of == PictureOf::window;
    if (whole) draw_panels();
    write_png(read_framebuffer(whole ? window_.framebuffer_size() : relief), options_.screenshot);
}

/// Asked for in the picture in which the end was.
void Viewer::take_last_screenshot() {
    if (screenshots_.wants(PictureOf::window) || screenshots_.wants(PictureOf::relief))
        draw_picture();
}

/// Messages are set wherever something goes wrong; a banner is what a device lacks.
void Viewer::keep_told() {
    log_.keep_change("message", state_.ui.message);
    log_.keep_change("device", device_banner(state_.settings, state_.touch));
    attempt([this] { log_.write(); });
}

void Viewer::keep_lateness(const TickSchedule& schedule) {
    const double worst_ms =
        std::chrono::duration<double, std::milli>(schedule.lateness().worst()).count();
    log_.keep("ticks", std::to_string(schedule.ticks()) + ", late " +
                           std::to_string(schedule.late_ticks()) + ", the worst by " +
                           number_text(worst_ms, 3) + " ms");
}

void Viewer::tell(const std::string& notice) {
    const bool shown = notice == state_.ui.notice && now_s() < state_.ui.notice_until_s;
    if (!shown) log_.keep("told", notice);
    state_.ui.notice = notice;
    state_.ui.notice_of_place = false;
    state_.ui.notice_until_s = now_s() + kNoticeTime_s;
}

double Viewer::now_s() const {
    return std::chrono::duration<double>(steady_clock::now() - start_).count();
}

bool Viewer::over() {
    return ending_.asked() || window_.wants_to_close() ||
           (options_.seconds && now_s() >= *options_.seconds) ||
           (!options_.clip.empty() && played_to_the_end());
}

/// And does not begin again.
bool Viewer::played_to_the_end() const {
    if (state_.touch.replay) {
        const SessionPlayback& at = state_.touch.replay->playback;
        return !at.playing && !at.looping &&
               at.now_s >= (at.part ? std::min(at.part->to_s, at.end_s) : at.end_s);
    }
    const PlaybackStatus& at = state_.media.playback;
    if (!at.open || at.playing || at.looping || state_.media.still || !(at.frames_per_s > 0.0))
        return false;
    const double end_s = at.part ? std::min(at.part->to_s, at.duration_s) : at.duration_s;
    constexpr double kFramesBefore = 1.5;  // the last one is shown
    return at.media_s + kFramesBefore / at.frames_per_s >= end_s;
}

glm::ivec2 Viewer::relief_viewport() const {
    glm::ivec2 size = window_.framebuffer_size();
    size.x -= static_cast<int>(panel_column_width(state_));
    size.y -= static_cast<int>(panes_height(state_));
    return glm::max(size, glm::ivec2(1));
}

}  // namespace dibhr
