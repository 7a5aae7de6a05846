// Runs ticks at the times of their goals.
#include "core/loop/goal_run.hpp"

#include <utility>

namespace dibhr {

namespace {

constexpr double kUsualTick_s = 0.001;

}  // namespace

GoalRun::GoalRun(std::unique_ptr<DepthTimeline> depth, const TouchParameters& parameters,
                 std::shared_ptr<const BumpMap> bump)
    : parameters_(parameters), depth_(std::move(depth)), bump_(std::move(bump)) {
    const DepthImage& image = *depth_->now().from->depth;
    stretch(bump_, image.columns, image.rows, parameters_.shape.bump_size_px);
}

void GoalRun::advance_to(double t_s) {
    if (depth_->advance_to(t_s)) started_again_ = true;
}

const Touch& GoalRun::update(double t_s, Vec3 goal) {
    advance_to(t_s);
    // Recorded goals may have equal times: such an update has the usual length.
    const double step_s = last_t_s_ ? t_s - *last_t_s_ : 0.0;
    const bool from_zero = std::exchange(started_again_, false) || !last_t_s_;
    const TickInput input{
        .pair = frames(),
        .bump = bump_.get(),
        .goal = goal,
        .safety = {.dt_s = step_s > 0.0 ? step_s : kUsualTick_s, .from_zero = from_zero}};
    last_t_s_ = t_s;
    return runner_.run(input, {parameters_, SafetyLimits{}});
}

}  // namespace dibhr
