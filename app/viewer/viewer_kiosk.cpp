// The window as a kiosk: what visitors can do, which recording is shown, and the return to the
// first one.
#include <cstddef>
#include <limits>

#include "app/panels/commands.hpp"
#include "app/viewer/input.hpp"
#include "app/viewer/viewer.hpp"
#include "core/error.hpp"

namespace dibhr {

/// Of all keys only a few do something; Ctrl+Shift+Q alone leaves.
void Viewer::take_kiosk_keys(const WindowInput& input) {
    const auto take_key = [this](const KeyPress& press) {
        if (press.control && press.shift && press.key == 'Q') {
            kiosk_left_ = true;
            window_.close();
        }
        const auto action =
            state_.keys.action_of_key(press.key, press.control, false, press.repeated, press.shift);
        if (action == Action::force_off) perform(*action);
        if (list_key(press.key) == ListKey::take && !press.repeated)
            state_.commands.push(KioskCommand::next);
    };
    const auto take_character = [this](const TypedCharacter& typed) {
        if (typed.code == ' ' && !typed.repeated) state_.commands.push(KioskCommand::say_again);
        if (state_.keys.action_of_character(typed.code, typed.repeated, typed.shift) ==
            Action::toggle_force)
            perform(Action::toggle_force);
    };
    each_in_order(input, take_key, take_character);
}

/// Without a person for long enough: the first recording from its begin, as it is first seen.
void Viewer::follow_kiosk(const WindowInput& input) {
    if (!options_.kiosk) return;
    if (state_.touch.haptic.touch.proxy.contact || input.by_person) kiosk_used_s_ = now_s();
    if (now_s() < kiosk_used_s_ + options_.kiosk->return_s || opening_.running()) return;
    kiosk_used_s_ = std::numeric_limits<double>::infinity();  // until somebody comes again
    state_.ui.message.clear();
    show_in_kiosk(0);
}

void Viewer::show_in_kiosk(std::size_t number) {
    const bool shown = number == kiosk_at_;
    kiosk_at_ = number;
    if (!shown) {
        OpenRequest request = number == 0 ? options_.open : OpenRequest{};
        if (number > 0) request.colour = options_.kiosk->next[number - 1];
        if (number > 0) request.request = options_.open.request;
        return open(request);
    }
    frame_relief();
    transport().seek(state_.play_state().begin_s + options_.open.at_s);
    if (!options_.open.paused) transport().play();
}

void Viewer::show_next_in_kiosk() {
    show_in_kiosk((kiosk_at_ + 1) % (options_.kiosk->next.size() + 1));
}

/// The next recording in place of one that could not be opened. Throws InputError when none of the
/// list can be; the one that is shown stays until then.
void Viewer::pass_over_in_kiosk() {
    const bool all_failed = ++kiosk_passed_ > options_.kiosk->next.size();
    if (!all_failed) return show_next_in_kiosk();
    kiosk_passed_ = 0;
    if (!state_.touch.replay && state_.media.depth_path.empty())
        throw InputError("none of the recordings of the kiosk can be opened");
}

void Viewer::perform_in_kiosk(KioskCommand command) {
    if (command == KioskCommand::say_again) return speaking_.repeat();
    if (!options_.kiosk->next.empty() && !opening_.running()) show_next_in_kiosk();
}

}  // namespace dibhr
