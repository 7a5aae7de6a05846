// The actions of the key table.
#include "app/viewer/input.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <locale>
#include <sstream>
#include <utility>

#include "app/panels/widgets.hpp"
#include "core/files/plain_text.hpp"

namespace dibhr {

namespace {

constexpr double kSeekStep_s = 5.0;
constexpr double kLittleStep_s = 1.0;
constexpr double kFarStep_s = 60.0;
constexpr double kBeforeEnd_s = 1.0;
constexpr double kFaster = 1.1;

/// Clamped to the playable range; a step across the normal speed stops at it.
double times_speed(double speed, double factor) {
    constexpr double kRounding = 1e-6;
    const double wanted = speed * factor;
    const bool passes = std::abs(speed - 1.0) > kRounding &&
                        (speed < 1.0 ? wanted > 1.0 - kRounding : wanted < 1.0 + kRounding);
    return passes ? 1.0 : std::clamp(wanted, kSlowestSpeed, kFastestSpeed);
}

/// Actions that the viewer performs after the picture.
constexpr std::array kAfterPicture{Action::record,
                                   Action::reset_view,
                                   Action::toggle_full_screen,
                                   Action::take_screenshot,
                                   Action::take_screenshot_of_relief,
                                   Action::take_clip,
                                   Action::take_clip_of_relief,
                                   Action::quit};

bool needs_hand(Action action) {
    return action == Action::toggle_force || action == Action::force_off ||
           action == Action::centre_workspace || action == Action::mark ||
           action == Action::toggle_sound;
}

/// An arm that moves by itself offers to be stopped, without a warning.
void stop_moving_arms(ViewerState& state) {
    for (const DeviceInfo& info : state.touch.devices) {
        const auto& offer = info.state.offer;
        if (offer && offer->warning.empty())
            state.commands.push(AgreeToDevice{info.kind, offer->number});
    }
}

/// How far an action seeks, forward or back [s]; 0: it does not seek.
double seek_step_s(Action action) {
    switch (action) {
        case Action::seek_forward:
            return kSeekStep_s;
        case Action::seek_back:
            return -kSeekStep_s;
        case Action::seek_forward_little:
            return kLittleStep_s;
        case Action::seek_back_little:
            return -kLittleStep_s;
        case Action::seek_forward_far:
            return kFarStep_s;
        case Action::seek_back_far:
            return -kFarStep_s;
        default:
            return 0.0;
    }
}

/// The speed after an action; nothing: the action does not change the speed.
std::optional<double> speed_after(Action action, double speed) {
    switch (action) {
        case Action::faster:
            return times_speed(speed, kFaster);
        case Action::slower:
            return times_speed(speed, 1.0 / kFaster);
        case Action::double_speed:
            return times_speed(speed, 2.0);
        case Action::half_speed:
            return times_speed(speed, 0.5);
        case Action::normal_speed:
            return 1.0;
        default:
            return std::nullopt;
    }
}

/// The key's 1st press sets the part's start, the 2nd its end, the 3rd plays all again.
std::optional<MediaPart> next_part(const PlayState& play_state) {
    constexpr double kForEver_s = std::numeric_limits<double>::infinity();
    constexpr double kShortest_s = 0.04;  // a frame
    if (!play_state.part) return MediaPart{play_state.now_s, kForEver_s};
    if (play_state.part->to_s < kForEver_s) return std::nullopt;
    const auto [from_s, to_s] = std::minmax(play_state.part->from_s, play_state.now_s);
    return MediaPart{from_s, std::max(to_s, from_s + kShortest_s)};
}

std::string part_text(const std::optional<MediaPart>& part, const PlayState& play_state,
                      const KeyTable& keys) {
    const auto at = [&play_state](double t_s) { return clock_text(t_s - play_state.begin_s); };
    if (!part) return "All is played, no longer a part";
    if (std::isinf(part->to_s))
        return "Loop from " + at(part->from_s) +
               keys.key_hint(Action::loop_part, " again ends it here");
    return "Loop from " + at(part->from_s) + " to " + at(part->to_s);
}

/// Actions that move a video or session; nothing: the action does not.
std::optional<Answer> move(Action action, const PlayState& play_state, Transport& player,
                           const KeyTable& keys) {
    const double end_s = std::max(play_state.begin_s, play_state.end_s);
    if (const double step_s = seek_step_s(action); std::abs(step_s) > 0.0) {
        player.seek(std::clamp(play_state.now_s + step_s, play_state.begin_s, end_s));
        return Answer{.place = true};
    }
    if (const auto speed = speed_after(action, play_state.speed)) {
        player.set_speed(*speed);
        return Answer{"Speed " + short_text(*speed, 3) + "x"};
    }
    switch (action) {
        case Action::play_or_pause:
            play_state.playing ? player.pause() : player.play();
            return Answer{play_state.playing ? "Pause" : "Play"};
        case Action::step_forward:
            player.step(1);
            return Answer{.place = true};
        case Action::step_back:
            player.step(-1);
            return Answer{.place = true};
        case Action::go_to_start:
            player.seek(play_state.begin_s);
            return Answer{.place = true};
        case Action::go_to_end:
            player.seek(std::max(play_state.begin_s, end_s - kBeforeEnd_s));
            return Answer{.place = true};
        case Action::loop_part: {
            const std::optional<MediaPart> part = next_part(play_state);
            player.set_part(part);
            if (part) player.set_looping(true);
            return Answer{part_text(part, play_state, keys)};
        }
        case Action::toggle_loop:
            player.set_looping(!play_state.looping);
            return Answer{play_state.looping ? "Loop off" : "Loop on"};
        default:
            return std::nullopt;
    }
}

/// The same for a live source, which can only be paused and continued.
std::optional<Answer> move_live(Action action, bool playing, Transport& player) {
    switch (action) {
        case Action::play_or_pause:
            playing ? player.pause() : player.play();
            return Answer{playing ? "Held: the surface stays as it is" : "Live"};
        case Action::step_forward:
        case Action::step_back:
        case Action::go_to_start:
        case Action::go_to_end:
        case Action::loop_part:
        case Action::toggle_loop:
            break;
        default:
            if (!(std::abs(seek_step_s(action)) > 0.0) && !speed_after(action, 1.0)) return {};
    }
    return Answer{"This is live: record it, and move about in the recording"};
}

}  // namespace

Answer perform(Action action, ViewerState& state, Transport& transport) {
    const bool replays = state.touch.replay.has_value();
    const PlaybackStatus& video = state.media.playback;
    if (video.live && !replays) {
        if (const auto moved = move_live(action, video.playing, transport)) return *moved;
    }
    if (const auto moved = move(action, state.play_state(), transport, state.keys)) {
        const bool still = state.media.still && !replays;
        return still ? Answer{"A still picture: nothing plays"} : *moved;
    }
    if (replays && needs_hand(action)) return {"A replay: no hand is touching"};
    if (std::find(kAfterPicture.begin(), kAfterPicture.end(), action) != kAfterPicture.end())
        state.commands.push(action);
    Settings& settings = state.settings;
    switch (action) {
        case Action::toggle_force:
            state.touch.force_enabled = !state.touch.force_enabled;
            if (!state.touch.force_enabled) stop_moving_arms(state);
            return {state.touch.force_enabled ? "Force on" : "Force off"};
        case Action::force_off:
            state.touch.force_enabled = false;
            stop_moving_arms(state);
            return {"Force off"};
        case Action::centre_workspace:
            ++state.touch.centre_count;
            return {"Workspace centred"};
        case Action::mark:
            state.commands.push(MarkMoment{std::chrono::steady_clock::now()});
            return {};
        case Action::toggle_sound:
            settings.mute = !settings.mute;
            return {settings.mute ? "Sound off" : "Sound on"};
        case Action::reset_view:
            return {"View reset"};
        case Action::toggle_straight_view:
            settings.straight_view = !settings.straight_view;
            return {settings.straight_view ? "Straight view" : "Perspective"};
        case Action::toggle_panels:
            settings.panels_visible = !settings.panels_visible;
            return {settings.panels_visible
                        ? "Panels shown"
                        : "Panels hidden" +
                              state.keys.key_hint(Action::toggle_panels, " shows them")};
        case Action::next_paint: {
            ReliefPaint& paint = settings.relief_style.paint;
            const std::size_t next = static_cast<std::size_t>(paint) + 1;
            paint = static_cast<ReliefPaint>(next % kReliefPaintNames.size());
            return {entry_of(kReliefPaintNames, paint).label};
        }
        case Action::toggle_others:
            settings.others = !settings.others;
            return {settings.others ? "Side by side: the other algorithms' proxies"
                                    : "The running algorithm's proxy alone"};
        case Action::toggle_panes:
            settings.panes = !settings.panes;
            return {settings.panes ? "Colour and depth above" : "The relief alone"};
        case Action::toggle_ruler:
            state.ui.ruler ? state.ui.ruler.reset() : static_cast<void>(state.ui.ruler.emplace());
            return {state.ui.ruler ? "Ruler" : "Ruler off"};
        case Action::toggle_statistics:
            state.ui.statistics = !state.ui.statistics;
            return {state.ui.statistics ? "Statistics" : "Statistics off"};
        case Action::toggle_help:
            state.ui.help_open = !state.ui.help_open;
            return {};
        default:
            return {};
    }
}

bool close_topmost(ViewerState& state) {
    if (!state.ui.message.empty()) {
        state.ui.message.clear();
    } else if (state.ui.dialog.shown) {
        state.ui.dialog.shown = false;
    } else if (!state.ui.unsafe_settings.empty() && !state.touch.replay) {
        state.ui.unsafe_settings.clear();  // the next start asks again
    } else if (state.ui.depth_offer && !state.ui.depth_offer->progress) {
        state.commands.push(DepthOfferCommand::close);
    } else if (asks_depth(state.ui)) {
        state.commands.push(AnswerDepth{});
    } else {
        return std::exchange(state.ui.help_open, false);
    }
    return true;
}

void Ruler::press(bool down, const std::optional<Vec3>& under) {
    const bool clicked = down && !pressed;
    pressed = down;
    if (!clicked || !under) return;
    if (places.size() == 2) places.clear();
    places.push_back(*under);
}

constexpr const char* kViewWord = "dibhr-view";

std::string text_of(const Camera::View& view) {
    std::string text = kViewWord;
    for (const double number : {view.yaw_rad, view.pitch_rad, view.zoom, view.centre_in_world.x,
                                view.centre_in_world.y, view.centre_in_world.z})
        text += " " + number_text(number);
    return text;
}

std::optional<Camera::View> view_in(const std::string& text) {
    std::istringstream in(text);
    in.imbue(std::locale::classic());
    std::string word;
    Camera::View view;
    Vec3& centre = view.centre_in_world;
    in >> word >> view.yaw_rad >> view.pitch_rad >> view.zoom >> centre.x >> centre.y >> centre.z;
    const bool whole = !in.fail() && word == kViewWord && is_finite(centre) &&
                       is_finite({view.yaw_rad, view.pitch_rad, view.zoom}) && view.zoom > 0.0;
    return whole ? std::optional(view) : std::nullopt;
}

}  // namespace dibhr
