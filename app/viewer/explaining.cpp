// An update in slow motion.
#include "app/viewer/explaining.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

namespace dibhr {

namespace {

/// View before the hand has chosen a goal: some cells around the proxy.
constexpr double kAround_px = 9.0;
constexpr double kStepTime_s = 1.0;
constexpr double kLongestRun_s = 20.0;

bool is_at_its_end(const SessionPlayer& replay) {
    return replay.moment() != nullptr && replay.moment()->tick.t_s >= replay.playback().end_s;
}

}  // namespace

std::optional<Answer> ViewerExplaining::perform(Action action, ViewerState& state, Player& player,
                                                SessionPlayer* replay) {
    if (action == Action::explain) {
        if (std::exchange(state.ui.explained, {})) return Answer{"Explained"};
        if (!state.touch.haptic.touchable) return Answer{"No surface to explain an update on"};
        if (replay != nullptr && is_at_its_end(*replay))
            return Answer{"No update comes after this"};
        begin(state, player);
        if (replay != nullptr) take_next_tick(state, *replay);
        return Answer{};
    }
    if (!state.ui.explained) return std::nullopt;
    ExplainedInfo& info = *state.ui.explained;
    switch (action) {
        case Action::step_forward:
            info.runs = false;
            return step_on(info, replay, state);
        case Action::step_back:
            info.runs = false;
            if (info.taken > 0) --info.taken;
            // Before the first step a hand may choose another goal.
            if (info.taken == 0) info.held = replay != nullptr;
            return Answer{};
        case Action::play_or_pause:
            info.runs = !info.runs;
            info.held = true;
            next_step_s_ = 0.0;
            if (info.taken >= info.update.steps.size()) info.taken = 0;
            return Answer{};
        case Action::close_topmost:
            if (!state.ui.message.empty() || state.ui.help_open || state.ui.dialog.shown)
                return std::nullopt;
            state.ui.explained.reset();
            return Answer{};
        default:
            return std::nullopt;
    }
}

void ViewerExplaining::begin(ViewerState& state, Player& player) {
    player.pause();
    state.ui.explained = ExplainedInfo{};
    proxy_ = state.touch.haptic.touch.proxy;
    goal_ = state.touch.haptic.touch.goal;
    pressed_ = false;
    columns_ = state.media.depth_columns;
    rows_ = state.media.depth_rows;
    tick_ = -1;
    input_.reset();
    seen_held_.reset();
}

/// The shown tick is done: explain the tick after it.
void ViewerExplaining::take_next_tick(ViewerState& state, SessionPlayer& replay) {
    proxy_ = state.touch.haptic.touch.proxy;
    left_tick_ = state.touch.replay->tick.tick;
    tick_ = -1;
    *state.ui.explained = ExplainedInfo{.held = true};
    replay.step(1);
}

Answer ViewerExplaining::step_on(ExplainedInfo& info, SessionPlayer* replay, ViewerState& state) {
    info.held = true;
    if (info.taken < info.update.steps.size()) {
        ++info.taken;
    } else if (replay != nullptr) {
        if (is_at_its_end(*replay)) return {"No update comes after this"};
        take_next_tick(state, *replay);
    }
    return {};
}

void ViewerExplaining::follow_hand(const ViewerState& state) {
    const Touch& touch = state.touch.haptic.touch;
    if (pressed_ && !touch.proxy.contact) return;  // lifted: goal_ stays at the last press
    pressed_ = touch.proxy.contact;
    goal_ = touch.goal;
}

void ViewerExplaining::run(ExplainedInfo& info, double now_s) {
    if (!info.runs || now_s < next_step_s_) return;
    const std::size_t steps = info.update.steps.size();
    if (next_step_s_ > 0.0 && info.taken < steps) ++info.taken;
    if (info.taken >= steps) info.runs = false;
    next_step_s_ =
        now_s + std::min(kStepTime_s, kLongestRun_s / std::max(1.0, static_cast<double>(steps)));
}

void ViewerExplaining::end(ViewerState& state, Camera& camera) {
    state.ui.explained.reset();
    if (before_) camera = *std::exchange(before_, {});
}

/// The surface has another size, or the replay was moved or plays on.
bool ViewerExplaining::is_outdated(const DepthBlend& shown, const ViewerState& state) const {
    if (!shown.makes_surface() || shown.from->depth->columns != columns_ ||
        shown.from->depth->rows != rows_)
        return true;
    if (!state.touch.replay) return false;
    const std::int64_t tick = state.touch.replay->tick.tick;
    if (tick_ < 0) return tick != left_tick_;
    return state.touch.replay->playback.playing || tick != tick_;
}

/// Computes the update only when its input changed: the cost grows with the walk's square.
void ViewerExplaining::explain_if_changed(const DepthBlend& shown, ViewerState& state) {
    const DepthBlend pair = shown.with_in_betweens();
    UpdateInput input{pair.from->depth, pair.to->depth, pair.blend, state.shape(),
                      state.touch.bump, proxy_,         goal_,      state.settings.touch.friction};
    if (input_ == input) return;
    const DepthSurface surface = shown.surface(input.shape, input.bump.get());
    ExplainedInfo& info = *state.ui.explained;
    info.update = explain(surface, proxy_, goal_, input.friction);
    info.taken = std::min(info.taken, info.update.steps.size());
    input_ = std::move(input);
}

void ViewerExplaining::advance(const DepthBlend& shown, ViewerState& state, Camera& camera,
                               double now_s) {
    if (!state.ui.explained) return end(state, camera);
    const bool reads = state.touch.replay && tick_ < 0;
    if (reads && state.touch.replay->tick.tick > left_tick_) tick_ = state.touch.replay->tick.tick;
    if (is_outdated(shown, state)) return end(state, camera);
    ExplainedInfo& info = *state.ui.explained;
    info.waits = state.touch.replay && tick_ < 0;
    if (info.waits) return;
    if (state.touch.replay) {
        goal_ = state.touch.haptic.touch.goal;
    } else if (!info.held) {
        follow_hand(state);
    }
    explain_if_changed(shown, state);
    run(info, now_s);
    if (seen_held_ == info.held && seen_tick_ == tick_) return;
    seen_held_ = info.held;
    seen_tick_ = tick_;
    move_camera(info, camera);
}

/// Shows the whole walk; with room to move the goal until it is fixed.
void ViewerExplaining::move_camera(const ExplainedInfo& info, Camera& camera) {
    if (!before_) before_ = camera;
    const PathBox walked = box_of(info.update);
    const Vec3 low = glm::min(walked.low, info.update.goal);
    const Vec3 high = glm::max(walked.high, info.update.goal);
    constexpr double kClosest_px = 2.5;
    constexpr double kAir = 1.35;
    const double radius = kAir * 0.5 * glm::length(high - low);
    camera.close_up(0.5 * (low + high), std::max(info.held ? kClosest_px : kAround_px, radius));
}

}  // namespace dibhr
