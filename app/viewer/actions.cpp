// The actions of the key table.
#include "app/viewer/actions.hpp"

#include <algorithm>
#include <iterator>

namespace dibhr {

namespace {

constexpr double kSeekStep_s = 5.0;
constexpr int kPicturesToFocus = 30;  // it takes two; a field out of sight never gets it
constexpr double kSpeeds[] = {0.1, 0.25, 0.5, 0.75, 1.0, 1.25, 1.5, 2.0, 3.0, 4.0};

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

/// How what plays goes on: a video or a session.
struct Course {
    bool playing, looping;
    double speed;
    double now_s, begin_s, end_s;
};

/// What moves a video or a session; false when the action is not about that.
template <typename AnyPlayer>
bool move(Action action, const Course& course, AnyPlayer& player) {
    const auto seek_by = [&](double step_s) {
        const double end_s = std::max(course.begin_s, course.end_s);
        player.seek(std::clamp(course.now_s + step_s, course.begin_s, end_s));
    };
    switch (action) {
        case Action::play_or_pause:
            course.playing ? player.pause() : player.play();
            return true;
        case Action::step_forward:
            player.step(1);
            return true;
        case Action::step_back:
            player.step(-1);
            return true;
        case Action::seek_forward:
            seek_by(kSeekStep_s);
            return true;
        case Action::seek_back:
            seek_by(-kSeekStep_s);
            return true;
        case Action::go_to_start:
            player.seek(course.begin_s);
            return true;
        case Action::faster:
            player.set_speed(faster_than(course.speed));
            return true;
        case Action::slower:
            player.set_speed(slower_than(course.speed));
            return true;
        case Action::toggle_loop:
            player.set_looping(!course.looping);
            return true;
        default:
            return false;
    }
}

}  // namespace

void perform(Action action, ViewerState& state, Player& player) {
    const PlaybackStatus& now = state.playback;
    if (move(action, {now.playing, now.looping, now.speed, now.media_s, 0.0, now.duration_s},
             player)) {
        return;
    }
    Requests& requests = state.requests;
    Settings& settings = state.settings;
    switch (action) {
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
            requests.toggle_recording = true;
            break;
        case Action::mark:
            requests.mark = true;
            break;
        case Action::reset_view:
            requests.reset_view = true;
            break;
        case Action::toggle_straight_view:
            settings.straight_view = !settings.straight_view;
            break;
        case Action::toggle_panels:
            settings.panels_visible = !settings.panels_visible;
            break;
        case Action::toggle_full_screen:
            requests.full_screen = true;
            break;
        case Action::take_screenshot:
            requests.screenshot = true;
            break;
        case Action::open_file:
            settings.panels_visible = settings.panels.video = true;
            state.fields.ask_for_keyboard = kPicturesToFocus;
            break;
        case Action::toggle_help:
            state.help_open = !state.help_open;
            break;
        case Action::close_topmost:
            close_topmost(state);
            break;
        case Action::quit:
            requests.quit = true;
            break;
        default:
            break;
    }
}

bool perform_in_replay(Action action, SessionPlayer& replay) {
    const SessionPlayback& now = replay.playback();
    if (move(action, {now.playing, now.looping, now.speed, now.now_s, now.begin_s, now.end_s},
             replay)) {
        return true;
    }
    // No hand is touching.
    return action == Action::toggle_force || action == Action::force_off ||
           action == Action::centre_workspace || action == Action::mark;
}

}  // namespace dibhr
