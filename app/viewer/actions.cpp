// The actions of the key table.
#include "app/viewer/actions.hpp"

#include <algorithm>
#include <iterator>

namespace dibhr {

namespace {

constexpr double kSeekStep_s = 5.0;
constexpr int kPicturesToFocus = 30;  // it takes two; a field out of sight never gets it
constexpr double kSpeeds[] = {0.1, 0.25, 0.5, 0.75, 1.0, 1.25, 1.5, 2.0, 3.0, 4.0};

void seek_by(double step_s, const PlaybackStatus& playback, Player& player) {
    player.seek(std::clamp(playback.media_s + step_s, 0.0, std::max(0.0, playback.duration_s)));
}

double faster_than(double speed) {
    const auto* next = std::upper_bound(std::begin(kSpeeds), std::end(kSpeeds), speed + 1e-6);
    return next == std::end(kSpeeds) ? *std::prev(std::end(kSpeeds)) : *next;
}

double slower_than(double speed) {
    const auto* here = std::lower_bound(std::begin(kSpeeds), std::end(kSpeeds), speed - 1e-6);
    return here == std::begin(kSpeeds) ? *here : *std::prev(here);
}

void close_topmost(ViewerState& state) {
    if (!state.message.empty()) {
        state.message.clear();
    } else {
        state.help_open = false;
    }
}

}  // namespace

void perform(Action action, ViewerState& state, Player& player) {
    const PlaybackStatus& playback = state.playback;
    switch (action) {
        case Action::play_or_pause:
            playback.playing ? player.pause() : player.play();
            break;
        case Action::step_forward:
            player.step(1);
            break;
        case Action::step_back:
            player.step(-1);
            break;
        case Action::seek_forward:
            seek_by(kSeekStep_s, playback, player);
            break;
        case Action::seek_back:
            seek_by(-kSeekStep_s, playback, player);
            break;
        case Action::go_to_start:
            player.seek(0.0);
            break;
        case Action::faster:
            player.set_speed(faster_than(playback.speed));
            break;
        case Action::slower:
            player.set_speed(slower_than(playback.speed));
            break;
        case Action::toggle_loop:
            player.set_looping(!playback.looping);
            break;
        case Action::toggle_force:
            state.force_enabled = !state.force_enabled;
            break;
        case Action::force_off:
            state.force_enabled = false;
            break;
        case Action::centre_workspace:
            ++state.centred;
            break;
        case Action::record:
            state.requests.toggle_recording = true;
            break;
        case Action::mark:
            state.requests.mark = true;
            break;
        case Action::reset_view:
            state.requests.reset_view = true;
            break;
        case Action::toggle_straight_view:
            state.settings.straight_view = !state.settings.straight_view;
            break;
        case Action::toggle_panels:
            state.settings.panels_visible = !state.settings.panels_visible;
            break;
        case Action::toggle_full_screen:
            state.requests.full_screen = true;
            break;
        case Action::take_screenshot:
            state.requests.screenshot = true;
            break;
        case Action::open_file:
            state.settings.panels_visible = state.settings.panels.video = true;
            state.fields.ask_for_keyboard = kPicturesToFocus;
            break;
        case Action::toggle_help:
            state.help_open = !state.help_open;
            break;
        case Action::close_topmost:
            close_topmost(state);
            break;
        case Action::quit:
            state.requests.quit = true;
            break;
    }
}

bool perform_in_replay(Action action, SessionPlayer& replay) {
    const SessionPlayback& playback = replay.playback();
    switch (action) {
        case Action::play_or_pause:
            playback.playing ? replay.pause() : replay.play();
            return true;
        case Action::step_forward:
            replay.step(1);
            return true;
        case Action::step_back:
            replay.step(-1);
            return true;
        case Action::seek_forward:
            replay.seek(playback.now_s + kSeekStep_s);
            return true;
        case Action::seek_back:
            replay.seek(playback.now_s - kSeekStep_s);
            return true;
        case Action::go_to_start:
            replay.seek(playback.begin_s);
            return true;
        case Action::faster:
            replay.set_speed(faster_than(playback.speed));
            return true;
        case Action::slower:
            replay.set_speed(slower_than(playback.speed));
            return true;
        case Action::toggle_loop:
            replay.set_looping(!playback.looping);
            return true;
        case Action::toggle_force:
        case Action::force_off:
        case Action::centre_workspace:
        case Action::mark:
            return true;  // no hand is touching
        default:
            return false;
    }
}

}  // namespace dibhr
