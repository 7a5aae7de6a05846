// Guides a participant through the steps of a study.
#include "app/study/study_window.hpp"

#include <algorithm>
#include <memory>
#include <string>

#include "app/touching/force_law.hpp"
#include "app/touching/picture_time.hpp"
#include "app/touching/scene.hpp"
#include "app/window/x_server.hpp"
#include "core/error.hpp"
#include "core/files/plain_text.hpp"
#include "core/realtime/now.hpp"
#include "core/video/sources/media.hpp"
#include "core/video/sources/picture_files.hpp"
#include "render/drawing_threads.hpp"

namespace dibhr {

namespace {

constexpr bool kInSync = true;      // with the display
constexpr float kTextTimes = 1.7F;  // as large as in the viewer
/// Least time before each interval, however fast its surface is ready: else the wait would reveal a
/// condition.
constexpr double kPreparing_s = 0.9;
constexpr double kLongestPreparing_s = 30.0;

double seconds(std::chrono::steady_clock::duration time) {
    return std::chrono::duration<double>(time).count();
}

WindowSize size_of(const StudyWindowOptions& options) {
    if (options.size) return {options.size->first, options.size->second, std::nullopt};
    return {options.settings.width, options.settings.height, std::nullopt};
}

/// Draws neither texture nor force. (The relief's height is visible, also where it is felt.)
void hide_condition(SceneContent& content) {
    content.bump = nullptr;
    content.maps = nullptr;
    content.shape.roughness_px = 0.0;
    content.dent = {};
    TouchMarkers& markers = content.markers;
    markers = {.visible = markers.visible,
               .contact = markers.contact,
               .goal = markers.goal,
               .proxy = markers.proxy,
               .normal = markers.normal};
}

/// Whether the press repeats while its key is held.
bool may_repeat(StudyPress::Kind kind) {
    using enum StudyPress::Kind;
    return kind == mark || kind == turn || kind == scroll;
}

/// `hand`, raised onto the surface where it is below.
Vec3 lifted(Vec3 hand, const DepthSurface& surface) {
    const bool over_it = is_finite(hand) && surface.clamped_to_frame(hand) == hand;
    if (over_it) hand.z = std::max(hand.z, surface.elevation_at(hand.x, hand.y));
    return hand;
}

/// Where the mouse points: on the surface, or above it while the button is up. (The virtual hand
/// itself does not reach this place: the force holds it back.)
Vec3 place_of(const MouseTarget& mouse, const DepthSurface& surface) {
    const Vec2 at = mouse.cursor_in_grid;
    const double above_px = mouse.pressed ? 0.0 : MouseHandOptions{}.hover_px;
    return {at.x, at.y, surface.elevation_at(at.x, at.y) + above_px};
}

}  // namespace

StudyWindow::StudyWindow(const StudyWindowOptions& options, StudyRun& run, StudyFile& file,
                         HandDevice hand, ShutdownWatchdog& shutdown)
    : after_picture_(options.after_picture),
      unsafe_settings_(options.unsafe_settings),
      run_(run),
      file_(file),
      shutdown_(shutdown),
      window_(size_of(options), kInSync, "dibhr"),
      gui_(window_,
           {kTextTimes * window_.scale(options.settings.ui_scale), options.settings.theme}),
      software_(read_limits().software),
      pace_(least_picture_time(kInSync, software_)),
      surface_(std::move(hand), options.settings,
               {heart_, shutdown.without_force(), shutdown.crash_note()}) {
    if (software_) lower_drawing_priority();
    window_.on_display_loss([this] { leave_without_display(); });
    shutdown_.watch_display(display_connection());
    if (!options.size) window_.toggle_full_screen();
    for (const UnsafeSetting& doubt : unsafe_settings_)
        view_.consent_text +=
            std::string(doubt.what) + ": " + doubt.requested + ", default " + doubt.usual + '\n';
    view_.before_start = run_.step() == StudyStep::interval || !unsafe_settings_.empty();
}

StudyWindow::~StudyWindow() {
    shutdown_.watch_display(-1);
    window_.on_display_loss({});
}

void StudyWindow::lead() {
    shutdown_.crash_note().set_activity("leading a study");
    while (!over()) {
        shutdown_.begin_turn();
        show_one_picture();
        pace_.wait({}, [] {});
    }
    shutdown_.end_loop();
    surface_.stop();
    if (run_.step() == StudyStep::finished) file_.finish();
}

bool StudyWindow::over() const {
    return left_ || run_.step() == StudyStep::finished || shutdown_.requested() ||
           window_.close_requested();
}

/// The display is lost: all answers are in the file already.
void StudyWindow::leave_without_display() {
    shutdown_.end_loop();
    surface_.stop();
}

void StudyWindow::beat() {
    window_.ping_display();
    heart_.beat();
}

bool StudyWindow::is_early(Clock::time_point press) const noexcept {
    return !seen_since_ || press < *seen_since_;
}

bool StudyWindow::touching() const noexcept {
    return (run_.step() == StudyStep::interval || run_.step() == StudyStep::adjust) &&
           !view_.asks_to_leave && !view_.before_start;
}

void StudyWindow::show_one_picture() {
    const WindowInput input = window_.take_input();
    beat();
    surface_.poll(window_.in_front());
    if (!entered_ && !view_.before_start) enter_step();
    begin_interval_if_ready();
    take(input);
    apply_time_limit(Clock::now());
    if (over()) return;
    enter_page();
    draw(input);
    surface_.publish();
    if (software_) beat_while_drawing([this] { beat(); });
    window_.show_picture();
    require_graphics();
    beat();
    note_on_screen();
    if (after_picture_) report_picture();
}

/// From now on presses count, and the time of a question runs.
void StudyWindow::note_on_screen() {
    const bool asks =
        view_.asks_to_leave || view_.before_start || (entered_.has_value() && !view_.waits);
    if (seen_since_ || !asks) return;
    beat_while_drawing([this] { beat(); });
    seen_since_ = Clock::now();
    const bool question = run_.step() == StudyStep::question && !view_.asks_to_leave;
    if (question && !since_) since_ = seen_since_;
}

void StudyWindow::report_picture() const {
    const StudyPosition place{.step = static_cast<int>(run_.step()),
                              .trial = run_.trial().number,
                              .interval = run_.interval(),
                              .waits = view_.waits,
                              .leaving = view_.asks_to_leave,
                              .asks_consent = !view_.consent_text.empty(),
                              .seen_since = seen_since_};
    after_picture_({.settings = surface_.settings(),
                    .touch = surface_.touch(),
                    .media = surface_.media(),
                    .surface = surface_.shown(),
                    .study = &place});
}

/// The next interval is entered with the next picture: by then the loop has seen the force off.
void StudyWindow::leave_step() {
    surface_.take_force_off();
    long_press_.forget();
    entered_.reset();
    seen_since_.reset();
    view_.waits = true;
    view_.mark.reset();
}

/// A page is entered in the picture that shows it first.
void StudyWindow::enter_page() {
    const bool touching = run_.step() == StudyStep::interval || run_.step() == StudyStep::adjust;
    if (!entered_ && !touching && !view_.before_start) enter_step();
}

/// Prepares the run's current step, once.
void StudyWindow::enter_step() {
    entered_ = Clock::now();
    since_.reset();
    view_.has_limit = false;
    view_.left_share = 1.0;
    view_.picture = 0;
    view_.waits = false;
    view_.first_picture = true;
    switch (run_.step()) {
        case StudyStep::instructions:
        case StudyStep::block_instructions:
        case StudyStep::thanks:
            load_picture(run_.page());
            break;
        case StudyStep::interval:
        case StudyStep::adjust:
            enter_interval();
            break;
        default:
            surface_.take_force_off();
    }
}

void StudyWindow::load_picture(const StudyPage& page) {
    surface_.take_force_off();
    if (page.picture.empty()) return;
    const auto picture = std::make_shared<const ColourImage>(read_colour_picture(page.picture));
    constexpr int kMost_px = 4096;
    view_.picture = page_picture_.show(picture, kMost_px, true);
    view_.picture_columns = picture->columns;
    view_.picture_rows = picture->rows;
}

void StudyWindow::enter_interval() {
    const Trial& trial = run_.trial();
    const auto which = static_cast<std::size_t>(run_.interval());
    if (!in_trial_) {
        session_ = file_.new_session_file();
        surface_.begin_trial(session_);
        in_trial_ = true;
        first_felt_at_.reset();
        if (trial.form == TrialForm::adjust)
            turned_ = trial.intervals.back().value.value_or(run_.block().variation.reference);
    }
    surface_.show(run_.protocol(), trial.intervals[which]);
    if (trial.form == TrialForm::adjust && which == 1)
        surface_.turn(run_.block().variation.parameter, turned_);
    view_.waits = true;
}

/// Begins the interval once its surface is ready.
void StudyWindow::begin_interval_if_ready() {
    if (!view_.waits || view_.asks_to_leave || !entered_) return;
    const double waited_s = seconds(Clock::now() - *entered_);
    if (waited_s < kPreparing_s) return;
    if (!surface_.is_ready()) {
        if (waited_s > kLongestPreparing_s)
            throw InputError("the video of trial " + std::to_string(run_.trial().number + 1) +
                             " gives no surface: check its files with dibhr info");
        return;
    }
    view_.waits = false;
    since_ = Clock::now();
    if (!first_felt_at_) first_felt_at_ = *since_;
    const MediaDescription& media = surface_.media();
    camera_.frame_relief(media.depth_columns, media.depth_rows,
                         surface_.settings().touch.shape.relief_px);
    surface_.begin_interval(run_.interval() + 1);
}

/// Ends the interval or question whose time limit is over at `now`.
void StudyWindow::apply_time_limit(Clock::time_point now) {
    if (view_.waits || view_.asks_to_leave || view_.before_start || !since_) return;
    const bool question = run_.step() == StudyStep::question;
    if (!question && run_.step() != StudyStep::interval) return;
    const double limit_s = question ? run_.block().answer_s : run_.block().interval_s;
    view_.has_limit = limit_s > 0.0;
    if (!view_.has_limit) return;
    const double passed_s = seconds(now - *since_);
    view_.left_share = std::clamp(1.0 - passed_s / limit_s, 0.0, 1.0);
    if (passed_s < limit_s) return;
    question ? answer({}, now) : act({StudyPress::Kind::go_on}, now);
}

void StudyWindow::take_button(StudyButton button, Clock::time_point at) {
    apply_time_limit(at);
    button.early = is_early(at);
    if (const auto press = press_of_button(run_, view_, button)) act(*press, at);
}

void StudyWindow::take_buttons() {
    for (const DeviceButtonPress& press : surface_.take_presses()) {
        if (press.button == kLongPressButton && run_.step() == StudyStep::adjust &&
            !is_early(press.at))
            long_press_.begin(press.at);
        else
            take_button({.number = press.button}, press.at);
    }
    const auto ended = long_press_.ended(Clock::now(), surface_.is_down(kLongPressButton));
    if (ended) take_button({.number = kLongPressButton, .held = ended->held}, ended->at);
}

/// Handles keys in the order of their presses: of two answers the first one counts.
void StudyWindow::take_keys(const WindowInput& input) {
    struct Pressed {
        std::string name{};
        bool shift{false}, repeated{false}, typed{false};
        Clock::time_point at{};
    };
    std::vector<Pressed> all;
    const auto add_key = [&all](const KeyPress& key) {
        all.push_back({list_key(key.key) == ListKey::take ? "Enter" : name_of(Key{key.key}),
                       key.shift, key.repeated, false, key.at});
    };
    const auto add_character = [&all](const TypedCharacter& typed) {
        if (typed.code <= 0x7f)
            all.push_back({std::string(1, static_cast<char>(typed.code)), typed.shift,
                           typed.repeated, true, typed.at});
    };
    each_in_order(input, add_key, add_character);
    std::optional<Clock::time_point> taken;  // by a key: its character is no second press
    for (const Pressed& one : all) {
        if (one.typed && taken == one.at) continue;
        apply_time_limit(one.at);
        const auto press = press_of_key(run_, view_, {one.name, one.shift, is_early(one.at)});
        if (!press) continue;
        if (!one.typed) taken = one.at;
        if (!one.repeated || (!one.typed && may_repeat(press->kind))) act(*press, one.at);
    }
}

void StudyWindow::take(const WindowInput& input) {
    if (input.clicked_at) clicked_at_ = *input.clicked_at;
    take_buttons();
    take_keys(input);
}

/// A click counts at the time when the mouse's button went down.
void StudyWindow::take_click(const StudyPress& press) {
    if (!is_early(clicked_at_)) return act(press, clicked_at_);
    const bool answers = run_.step() == StudyStep::question || run_.step() == StudyStep::adjust;
    if (answers && press.kind != StudyPress::Kind::mark) ++early_;
}

void StudyWindow::act(const StudyPress& press, Clock::time_point at) {
    using enum StudyPress::Kind;
    switch (press.kind) {
        case ask_to_leave:
            view_.asks_to_leave = true;
            seen_since_.reset();
            paused_at_ = Clock::now();
            surface_.take_force_off();
            return;
        case stay:
            view_.asks_to_leave = false;
            seen_since_.reset();
            if (since_) *since_ += Clock::now() - paused_at_;
            if (first_felt_at_) *first_felt_at_ += Clock::now() - paused_at_;
            // The interrupted interval begins again.
            if (touching()) leave_step();
            return;
        case leave:
            left_ = true;
            return;
        case early:
            ++early_;
            return;
        case agree:
            return agree_to_study();
        case scroll:
            view_.scroll += static_cast<float>(press.value);
            return;
        default:
            break;
    }
    if (view_.before_start) {
        view_.before_start = false;
        return leave_step();
    }
    if (run_.step() == StudyStep::question) return act_at_question(press, at);
    if (run_.step() == StudyStep::adjust) return act_at_adjustment(press, at);
    if (press.kind != go_on || view_.waits) return;
    run_.go_on();
    leave_step();
}

void StudyWindow::agree_to_study() {
    try {
        Consent().agree(unsafe_settings_);
    } catch (const InputError& error) {
        print_warning(std::string(error.what()) + "; dibhr will ask again");
    }
    view_.consent_text.clear();
    view_.before_start = run_.step() == StudyStep::interval;
    seen_since_.reset();
}

void StudyWindow::act_at_question(const StudyPress& press, Clock::time_point at) {
    using enum StudyPress::Kind;
    const Question& question = run_.block().question;
    if (press.kind == mark) {
        view_.mark = std::clamp(press.value, static_cast<double>(question.lowest),
                                static_cast<double>(question.highest));
    } else if (press.kind == feel) {
        run_.repeat_interval(press.which);
        leave_step();
    } else if (press.kind == choose) {
        answer({.choice = press.which}, at);
    } else if (press.kind == rate) {
        answer({.number = press.value}, at);
    }
}

void StudyWindow::act_at_adjustment(const StudyPress& press, Clock::time_point at) {
    using enum StudyPress::Kind;
    const Variation& vary = run_.block().variation;
    if (press.kind == turn) {
        turned_ = std::clamp(turned_ + press.value * (vary.highest - vary.lowest), vary.lowest,
                             vary.highest);
        surface_.turn(vary.parameter, turned_);
    } else if (press.kind == feel) {
        run_.compare(press.which);
        leave_step();
    } else if (press.kind == go_on && !view_.waits) {
        answer({.number = turned_}, at);
    }
}

/// Ends the session, then stores answer and session in one transaction, then shows the next page.
void StudyWindow::answer(const StudyAnswer& given, Clock::time_point at) {
    StudyAnswer whole = given;
    whole.reaction_s =
        seconds(at - (run_.step() == StudyStep::adjust ? *first_felt_at_ : since_.value_or(at)));
    whole.early = early_;
    if (!run_.accepts(whole)) return;
    const AnsweredTrial answered = run_.judged(whole, utc_now_s());
    surface_.end_trial();
    file_.add(answered, session_);
    in_trial_ = false;
    early_ = 0;
    run_.accept(answered);
    leave_step();
}

void StudyWindow::draw(const WindowInput& input) {
    const glm::ivec2 size = window_.framebuffer_size();
    const Pointer pointer = window_.pointer();
    const PointerUse use =
        mouse_.use(pointer, input.wheel_steps, mouse_is_over_button(), size, camera_);
    hand_seen_ = use.over_relief || !surface_.by_mouse();
    if (touching() && !view_.waits) point(camera_.ray_under(pointer.position_px, size), use);
    draw_relief();
    beat();
    view_.device_words = device_banner(surface_.settings(), surface_.touch());
    view_.by_mouse = surface_.by_mouse();
    if (view_.first_picture) pointer_before_px_ = pointer.position_px;
    view_.pointer_moved = pointer.position_px != pointer_before_px_;
    if (view_.pointer_moved) pointer_before_px_.reset();
    gui_.begin(input);
    const auto press = draw_study(run_, view_);
    gui_.end();
    gui_.draw();
    view_.first_picture = false;
    view_.scroll = 0.0F;
    beat();
    if (press) take_click(*press);
}

void StudyWindow::point(const Camera::Ray& ray, PointerUse use) {
    surface_.point(ray, use);
    use.pressed = use.pressed && surface_.by_mouse();
    if (surface_.shown().makes_surface()) mouse_at_ = pointer_.target(ray, seen_surface(), use);
}

/// The drawn surface, without bumps that are only felt.
DepthSurface StudyWindow::seen_surface() const {
    SurfaceShape shape = surface_.touch().shape(surface_.settings().touch);
    shape.roughness_px = 0.0;
    return surface_.shown().drawn_surface(shape);
}

/// Shows one point, which does not depend on friction or stiffness.
void StudyWindow::show_hand_only(TouchMarkers& markers) const {
    const DepthSurface surface = seen_surface();
    const bool by_mouse = surface_.by_mouse();
    const Vec3 hand = by_mouse ? place_of(mouse_at_, surface) : lifted(markers.goal, surface);
    markers = {.visible = markers.visible && (!by_mouse || mouse_at_.pointing),
               .goal = hand,
               .proxy = hand};
}

/// Draws the relief only in an interval, and only where the block shows it.
void StudyWindow::draw_relief() {
    const StudyView view = run_.block().view;
    const bool seen = touching() && !view_.waits && view != StudyView::blank;
    SceneContent content = scene_content(surface_.settings(), surface_.touch(), surface_.shown());
    if (!seen) content = {.relief_style = content.relief_style, .light_wall = content.light_wall};
    hide_condition(content);
    if (content.markers.visible && view == StudyView::relief) show_hand_only(content.markers);
    content.markers.visible = content.markers.visible && hand_seen_;
    scene_.draw(content, camera_, window_.framebuffer_size());
}

}  // namespace dibhr
