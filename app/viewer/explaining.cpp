// An update in slow motion.
#include "app/viewer/explaining.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

namespace dibhr {

namespace {

/// Before the hand has said where to: some cells around the proxy.
constexpr double kAround_px = 9.0;
constexpr double kStepTime_s = 1.0;
constexpr double kLongestRun_s = 20.0;

}  // namespace

std::optional<Answer> ViewerExplaining::perform(Action action, ViewerState& state, Player& player,
                                                SessionPlayer* replay) {
    if (action == Action::explain) {
        if (std::exchange(state.explained, {})) return Answer{"Explained"};
        if (!state.haptic.touchable) return Answer{"No surface to explain an update on"};
        begin(state, player);
        if (replay != nullptr) take_next_tick(state, *replay);
        return Answer{};
    }
    if (!state.explained) return std::nullopt;
    ExplainedNews& news = *state.explained;
    switch (action) {
        case Action::step_forward:
            news.runs = false;
            step_on(news, replay, state);
            return Answer{};
        case Action::step_back:
            news.runs = false;
            if (news.taken > 0) --news.taken;
            // Where it begins a hand may say another goal.
            if (news.taken == 0) news.held = replay != nullptr;
            return Answer{};
        case Action::play_or_pause:
            news.runs = !news.runs;
            news.held = true;
            next_step_s_ = 0.0;
            if (news.taken >= news.update.steps.size()) news.taken = 0;
            return Answer{};
        case Action::close_topmost:
            if (!state.message.empty() || state.help_open || state.dialog.shown)
                return std::nullopt;
            state.explained.reset();
            return Answer{};
        default:
            return std::nullopt;
    }
}

void ViewerExplaining::begin(ViewerState& state, Player& player) {
    player.pause();
    state.explained = ExplainedNews{};
    proxy_ = state.haptic.touch.proxy;
    goal_ = state.haptic.touch.goal;
    pressed_ = false;
    columns_ = state.media.depth_columns;
    rows_ = state.media.depth_rows;
    seen_held_.reset();
}

/// The tick shown has been: the update is that of the one after it.
void ViewerExplaining::take_next_tick(ViewerState& state, SessionPlayer& replay) {
    proxy_ = state.haptic.touch.proxy;
    *state.explained = ExplainedNews{.held = true};
    replay.step(1);
}

void ViewerExplaining::step_on(ExplainedNews& news, SessionPlayer* replay, ViewerState& state) {
    news.held = true;
    if (news.taken < news.update.steps.size()) {
        ++news.taken;
    } else if (replay != nullptr) {
        take_next_tick(state, *replay);
    }
}

void ViewerExplaining::follow_hand(const ViewerState& state) {
    const Touch& touch = state.haptic.touch;
    if (pressed_ && !touch.proxy.contact) return;  // lifted: it stays where it was pressed
    pressed_ = touch.proxy.contact;
    goal_ = touch.goal;
}

void ViewerExplaining::run(ExplainedNews& news, double now_s) {
    if (!news.runs || now_s < next_step_s_) return;
    const std::size_t steps = news.update.steps.size();
    if (next_step_s_ > 0.0 && news.taken < steps) ++news.taken;
    if (news.taken >= steps) news.runs = false;
    next_step_s_ =
        now_s + std::min(kStepTime_s, kLongestRun_s / std::max(1.0, static_cast<double>(steps)));
}

void ViewerExplaining::advance(const DepthBlend& shown, ViewerState& state, Camera& camera,
                               double now_s) {
    const bool same_ground = shown.makes_surface() && shown.from->depth->columns == columns_ &&
                             shown.from->depth->rows == rows_;
    if (state.explained && !same_ground) state.explained.reset();
    if (!state.explained) {
        if (before_) camera = *before_;
        before_.reset();
        return;
    }
    ExplainedNews& news = *state.explained;
    if (state.replay) {
        goal_ = state.haptic.touch.goal;
    } else if (!news.held) {
        follow_hand(state);
    }
    const DepthSurface surface = shown.surface(state.shape(), state.bump.get());
    news.update = explain(surface, proxy_, goal_, state.settings.touch.friction);
    news.taken = std::min(news.taken, news.update.steps.size());
    run(news, now_s);
    const std::int64_t tick = state.replay ? state.replay->tick.tick : -1;
    if (seen_held_ == news.held && seen_tick_ == tick) return;
    seen_held_ = news.held;
    seen_tick_ = tick;
    move_camera(news, camera);
}

/// All of the walk in view; before its goal stands, with room to move it.
void ViewerExplaining::move_camera(const ExplainedNews& news, Camera& camera) {
    if (!before_) before_ = camera;
    const ExplainedUpdate& update = news.update;
    Vec3 low = update.start.position;
    Vec3 high = low;
    const auto include = [&](Vec3 p) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    };
    for (const WalkStep& step : update.steps) include(step.after.position);
    include(update.goal);
    constexpr double kClosest_px = 2.5;
    constexpr double kAir = 1.35;
    const double radius = kAir * 0.5 * glm::length(high - low);
    camera.close_up(0.5 * (low + high), std::max(news.held ? kClosest_px : kAround_px, radius));
}

}  // namespace dibhr
