// The motion of a clip, and its pictures.
#include "app/viewer/offline_clip.hpp"

#include <algorithm>
#include <utility>

#include "app/touching/scene.hpp"
#include "render/gl_objects.hpp"

namespace dibhr {

namespace {

constexpr double kUsualTick_s = 0.001;

}  // namespace

void ClipMotion::take(const Touch& touch) {
    touch_.haptic.touch = touch;
    touch_.catching_up = touch_.catching_up || touch.proxy.bound_met;
}

GoalMotion::GoalMotion(std::unique_ptr<DepthTimeline> depth, const TouchParameters& parameters,
                       std::shared_ptr<const BumpMap> bump, std::vector<TimedGoal> goals)
    : run_(std::move(depth), parameters, std::move(bump)), goals_(std::move(goals)) {
    parameters_ = parameters;
    touch_.bump = run_.bump();
    touch_.haptic.shape = parameters.shape;
}

double GoalMotion::lap_s() const noexcept {
    const std::size_t count = goals_.size();
    const double tick_s = count > 1 ? goals_[count - 1].t_s - goals_[count - 2].t_s : 0.0;
    return goals_.back().t_s - goals_.front().t_s + (tick_s > 0.0 ? tick_s : kUsualTick_s);
}

double GoalMotion::goals_end_s() const noexcept {
    return goals_.empty() ? 0.0 : goals_.front().t_s + lap_s();
}

void GoalMotion::advance_to(double t_s) {
    touch_.catching_up = false;
    while (!goals_.empty() && lap_begin_s_ + goals_[next_].t_s <= t_s) {
        const TimedGoal& goal = goals_[next_];
        take(run_.update(lap_begin_s_ + goal.t_s, goal.goal_in_grid));
        touch_.haptic.touchable = true;
        next_ = (next_ + 1) % goals_.size();
        if (next_ == 0) lap_begin_s_ += lap_s();
    }
    run_.advance_to(t_s);
}

SessionMotion::SessionMotion(std::unique_ptr<OpenedSession> opened, const GivenParameters& given,
                             double from_s)
    : opened_(std::move(opened)),
      given_(given),
      replay_(opened_->session, *opened_->frames.surfaces,
              {[this](TouchParameters& parameters) { given_.apply(parameters); }},
              warm_up_s(opened_->session, opened_->session.begin_s() + from_s)),
      waits_(replay_.next()) {
    touch_.replay.emplace();
    if (!opened_->session.parameters().empty())
        parameters_ = opened_->session.parameters().front().touch;
    given_.apply(parameters_);
}

double SessionMotion::duration_s() const noexcept {
    return opened_->session.end_s() - opened_->session.begin_s() + kUsualTick_s;
}

void SessionMotion::advance_to(double t_s) {
    touch_.catching_up = false;
    while (waits_ && replay_.recorded().t_s - opened_->session.begin_s() <= t_s) {
        take_tick();
        waits_ = replay_.next();
    }
}

void SessionMotion::take_tick() {
    const TickRecord& tick = replay_.recorded();
    take(replay_.touch(0));
    touch_.replay->tick = tick;
    touch_.haptic.touchable = tick.surface;
    if (!tick.surface) return;
    frames_ = replay_.frames();
    blend_ = tick.blend;
    if (version_ == tick.settings) return;
    version_ = tick.settings;
    const SessionParameters& recorded = *opened_->session.parameters_of(tick.settings);
    parameters_ = recorded.touch;
    given_.apply(parameters_);
    max_force_newton_ = recorded.limits.max_force_newton;
    touch_.replay->computed = !(parameters_ == recorded.touch);
    touch_.haptic.shape = parameters_.shape;
    touch_.bump = replay_.bump();
}

DepthBlend SessionMotion::shown() const {
    if (!frames_) return {};
    return {&frames_->from, &frames_->to, blend_};
}

ClipPainter::ClipPainter(const ClipLook& look, int columns, int rows, double relief_px)
    : size_px_(look.size_px),
      surface_(look.surface),
      settings_{.theme = look.theme},
      window_({kSmallestWindow, kSmallestWindow}, false, "dibhr", Window::Shown::later) {
    camera_.set_projection(look.straight ? Camera::Projection::straight
                                         : Camera::Projection::perspective);
    camera_.frame_relief(columns, rows, relief_px);
    if (look.view) camera_.set_view(*look.view);
}

ColourImage ClipPainter::picture(const ClipMotion& motion, double shown_s) {
    settings_.touch = motion.parameters();
    settings_.max_force_newton = motion.max_force_newton();
    const DepthBlend shown = motion.shown();
    const TouchState& touch = motion.touch();
    SceneContent content = scene_content(settings_, touch, shown);
    content.look = surface_;
    if (shown.makes_surface())
        trace_.mark(shown.drawn_surface(content.shape, content.bump), shown_s, content.markers);
    ColourImage picture = scene_.capture(content, camera_, size_px_);
    require_graphics();
    return picture;
}

}  // namespace dibhr
