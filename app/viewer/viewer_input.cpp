// Keys and mouse: what the viewer does at once.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

#include "app/panels/panels.hpp"
#include "app/viewer/viewer.hpp"
#include "core/haptics/surface.hpp"

namespace dibhr {

using std::chrono::steady_clock;

/// With the dialog open keys are text, even before its field has the keyboard; with a question on
/// the depth they answer; with a list open they are the list's.
bool Viewer::keys_are_text() const {
    return keys_are_taken() || state_.ui.depth_question.has_value();
}

/// By a field, the dialog or a list.
bool Viewer::keys_are_taken() const {
    return gui_.wants_keyboard() || text_opens() || state_.ui.dialog.shown || gui_.list_is_open();
}

/// A field that Enter opens, or a dialog's, is typed in one or two pictures later.
bool Viewer::text_opens() const {
    const bool by_keys = gui_.focus().on() && gui_.in_use() &&
                         (state_.ui.focus.kind == "slider" || state_.ui.focus.kind == "text");
    return by_keys || is_opening(state_.ui.dialog);
}

/// Of the hand by keyboard, while no panel has the keyboard.
HandKeys Viewer::hand_keys() const {
    const bool taken = !key_hand_.on() || gui_.focus().on() || keys_are_text();
    return taken ? HandKeys{} : HandKeys::of(window_);
}

bool Viewer::quits(const TypedCharacter& typed) const {
    return state_.keys.action_of_character(typed.code, typed.repeated, typed.shift) == Action::quit;
}

void Viewer::take_keys(const WindowInput& input) {
    if (options_.kiosk) return take_kiosk_keys(input);
    if (!input.keys.empty()) lead_.end(state_);
    const KeyboardUse before{.typing = keys_are_text(),
                             .in_list = gui_.list_is_open(),
                             .asked = !keys_are_taken() && state_.ui.depth_question.has_value()};
    const std::vector<int> held = state_.keys.held_keys(Action::show_as_recorded);
    const bool as_recorded =
        !before.typing &&
        std::any_of(held.begin(), held.end(), [this](int key) { return window_.holds(key); });
    if (as_recorded && !state_.media.as_recorded && !state_.touch.replay)
        show_notice("Depth as recorded");
    state_.media.as_recorded = as_recorded;
    std::size_t were_keys = 0;
    each_in_order(
        input, [&](const KeyPress& press) { take_key(press, before); },
        [&](const TypedCharacter& typed) {
            if (before.asked && quits(typed)) return perform(Action::quit);
            if (before.typing || text_opens()) return;
            ++were_keys;
            take_character(typed, before);
        });
    gui_.drop_characters(were_keys);
}

void Viewer::take_key(const KeyPress& press, KeyboardUse before) {
    if (takes_keys(state_.ui.dialog) && state_.ui.message.empty() && take_dialog_key(press)) return;
    if (gui_.focus().take(press, gui_.wants_keyboard())) return;
    if (!before.typing && key_hand_.take(press, relief_viewport(), camera_)) return;
    const std::optional<int> digit = digit_of(press.key);
    if (digit && !press.repeated && asks_depth(state_.ui)) take_digit(*digit, state_);
    if (const auto action = state_.keys.action_of_key(press.key, press.control, before.typing,
                                                      press.repeated, press.shift))
        perform_key(*action, press.at, before);
}

void Viewer::take_character(const TypedCharacter& typed, KeyboardUse before) {
    if (typed.code == ' ' && (gui_.focus().on() || key_hand_.on())) return;
    if (const auto action =
            state_.keys.action_of_character(typed.code, typed.repeated, typed.shift))
        perform_key(*action, typed.at, before);
}

void Viewer::perform_key(Action action, EventTimes::Time at, KeyboardUse before) {
    if (action == Action::close_topmost)
        close_topmost(before.in_list);
    else if (action == Action::mark && !state_.touch.replay)
        state_.commands.push(MarkMoment{at});
    else
        perform(action);
}

/// While its line has the keyboard, also before it is drawn. True: no other part takes the key.
bool Viewer::take_dialog_key(const KeyPress& press) {
    OpenDialog& dialog = state_.ui.dialog;
    if (gui_.focus().on() && !gui_.wants_keyboard()) return false;
    const auto key = list_key(press.key);
    if (key == ListKey::down) ++dialog.move;
    if (key == ListKey::up) --dialog.move;
    if (key == ListKey::take && !press.repeated) dialog.enter = true;
    if (key != ListKey::complete) return key.has_value();
    const bool completes = !press.shift && dialog.typed.front() != '\0';
    if (completes) state_.commands.push(CompleteTyped{dialog.typed.data()});
    return completes;  // else it goes on to the next item
}

/// Closes what is on top; if that is nothing, the picture has the keyboard again.
void Viewer::close_topmost(bool in_list) {
    if (in_list)
        gui_.close_lists();
    else if (gui_.wants_keyboard() && gui_.focus().on() && !takes_keys(state_.ui.dialog))
        return;  // it ends the typing
    else if (!dibhr::close_topmost(state_))
        gui_.focus().on() ? gui_.focus().leave() : key_hand_.end();
}

/// The keyboard in the panels, or on the hand.
std::optional<Answer> Viewer::perform_with_keyboard(Action action) {
    switch (action) {
        case Action::next_pane:
        case Action::previous_pane:
            gui_.focus().go_to_area(action == Action::next_pane ? 1 : -1);
            return Answer{};
        case Action::touch_by_keys:
            break;
        default:
            return std::nullopt;
    }
    gui_.focus().leave();
    if (state_.touch.replay) return Answer{"A replay: no hand is touching"};
    if (key_hand_.on()) {
        key_hand_.end();
        return Answer{"The hand is the mouse's again"};
    }
    glm::dvec2 place_px = window_.pointer().position_px;
    place_px.y -= panes_height(state_);
    const glm::ivec2 viewport = relief_viewport();
    if (!relief_under(camera_.ray_under(place_px, viewport))) place_px = 0.5 * glm::dvec2(viewport);
    key_hand_.begin(place_px, viewport);
    return Answer{"Arrows move the hand, Space presses, Enter keeps pressing" +
                  state_.keys.key_hint(Action::touch_by_keys, " ends it")};
}

std::optional<Answer> Viewer::perform_with_files(Action action) {
    switch (action) {
        case Action::open_file:
            return open_by_dialog();
        case Action::open_file_in_window:
            desktop_.cancel();
            browsing_.toggle(state_);
            return Answer{};
        case Action::next_file:
        case Action::previous_file:
            if (browsing_.read_neighbours(action == Action::next_file ? 1 : -1, state_))
                return Answer{};
            return Answer{"Still looking into the folder"};
        case Action::turn_depth:
            return turn_depth();
        default:
            return std::nullopt;
    }
}

std::optional<Answer> Viewer::perform_with_view(Action action) {
    if (action == Action::copy_view) {
        gui_.copy(text_of(camera_.view()));
        return Answer{"View copied" + state_.keys.key_hint(Action::paste_view, " takes it again")};
    }
    if (action != Action::paste_view) return std::nullopt;
    const auto view = view_in(gui_.copied());
    if (!view)
        return Answer{"No view was copied" +
                      state_.keys.key_hint(Action::copy_view, " copies one")};
    explaining_.keep_camera();
    camera_.set_view(*view);
    return Answer{"View taken"};
}

std::optional<Answer> Viewer::perform_with_brush(Action action) {
    Brush& brush = state_.ui.brush;
    if (action != Action::toggle_brush && action != Action::undo && action != Action::redo)
        return std::nullopt;
    if (state_.touch.replay)
        return Answer{"A replay is felt as it was recorded: nothing is painted"};
    if (!brush.refusal.empty()) return Answer{brush.refusal};
    if (action == Action::toggle_brush) {
        brush.on = !brush.on;
        if (!brush.on) return Answer{"Brush off"};
        if (state_.media.playback.playing) touch_.player().pause();
        state_.ui.show_paint = true;
        return Answer{"Brush: drag over the relief to paint"};
    }
    if (action == Action::undo) {
        if (!brush.can_undo) return Answer{"There is no paint to take back"};
        painting_.undo(state_, touch_.player());
        return Answer{"Taken back" + state_.keys.key_hint(Action::redo, " paints it again")};
    }
    if (!brush.can_redo) return Answer{"Nothing was taken back that could be painted again"};
    painting_.redo(state_, touch_.player());
    return Answer{"Painted again"};
}

void Viewer::perform(Action action) {
    SessionPlayer* const replay = replay_.player();
    Player& player = touch_.player();
    std::optional<Answer> answer = perform_with_files(action);
    if (!answer) answer = perform_with_view(action);
    if (!answer) answer = perform_with_keyboard(action);
    if (!answer) answer = perform_with_brush(action);
    if (!answer) answer = explaining_.perform(action, state_, player, replay);
    if (!answer) answer = dibhr::perform(action, state_, transport());
    // For the next key in the same picture.
    state_.media.playback = player.status();
    if (replay != nullptr) state_.touch.replay->playback = replay->playback();
    if (!answer->place && answer->words.empty()) return;
    show_notice(answer->words);
    state_.ui.notice_shows_position = answer->place;
}

/// All clicks since the last picture, in their order, and then the pointer as it is now.
void Viewer::move_hand(const WindowInput& input) {
    shown_ = state_.touch.replay ? replay_.shown() : touch_.frames_now();
    use_clicks(input.clicks, input.wheel_steps);
    if (!state_.touch.replay) guide_.show(painting_.regions(), state_);
    guide_.follow(shown_, now_s(), state_);
    if (!touch_.by_mouse()) lead_.end(state_);
    lead_.follow(shown_, now_s(), state_);
    if (!state_.touch.replay) guide_.follow_ridges(shown_, state_, painting_, touch_.player());
}

/// Between two pictures: the hand follows the pointer however long a picture takes.
void Viewer::follow_pointer() {
    const auto clicks = window_.take_pointer();
    if (clicks || hand_keys().any()) use_clicks(clicks.value_or(std::vector<PointerClick>{}), 0.0);
}

void Viewer::use_clicks(std::span<const PointerClick> clicks, double wheel_steps) {
    for (const PointerClick& click : clicks) {
        key_hand_.end();
        use_pointer(click.pointer, 0.0, click.at);
    }
    const auto now = steady_clock::now();
    if (!key_hand_.on()) return use_pointer(window_.pointer(), wheel_steps, now);
    Pointer pointer = key_hand_.follow(hand_keys(), now, relief_viewport());
    pointer.position_px.y += panes_height(state_);
    use_pointer(pointer, wheel_steps + key_hand_.take_wheel(), now);
}

std::optional<Vec3> Viewer::relief_under(const Camera::Ray& ray) const {
    if (!shown_.makes_surface()) return std::nullopt;
    return surface_under(ray, shown_.drawn_surface(state_.shape(), state_.touch.bump.get()));
}

/// `at`: when the pointer was so.
void Viewer::use_pointer(const Pointer& now, double wheel_steps, EventTimes::Time at) {
    const glm::ivec2 viewport = relief_viewport();
    Pointer pointer = now;
    // The place of a dialog is known once it is drawn.
    const bool over_panel =
        !key_hand_.on() && (is_opening(state_.ui.dialog) || gui_.covers(pointer.position_px));
    const auto on_panes = place_on_panes(state_, pointer.position_px);
    pointer.position_px.y -= panes_height(state_);  // the relief is below the panes
    PointerUse use = mouse_.use(pointer, wheel_steps, over_panel, viewport, camera_);
    if (state_.ui.kiosk) camera_.keep_in_front();  // visitors have no key that goes back
    pressed_deeper_ = pressed_deeper_ || (use.pressed && use.wheel_steps != 0.0);
    if (state_.touch.depth_in_question) use = {};  // the hand stays where it is
    pointed_at_.reset();
    const Camera::Ray ray = camera_.ray_under(pointer.position_px, viewport);
    const bool measures = state_.ui.ruler && !state_.ui.explained;
    const bool paints = state_.ui.brush.on && !state_.ui.explained && !state_.touch.replay;
    if (use.over_relief && (measures || paints || !use.pressed)) pointed_at_ = relief_under(ray);
    if (on_panes && !over_panel && !use.pressed) pointed_at_ = on_panes;
    if (paints) {
        paint(use);
        use.pressed = false;
    } else if (measures) {  // the ruler's clicks do not touch
        state_.ui.ruler->press(use.pressed, pointed_at_);
        use.pressed = false;
    }
    touch_.point(ray, shown_, use, at);
}

/// Paints, and computes the ring that shows the brush.
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

}  // namespace dibhr
