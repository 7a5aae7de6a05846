// Puts cleaned depth, colour, maps and motion together.
#include "core/video/playing/frame_assembly.hpp"

#include <chrono>
#include <cmath>
#include <utility>
#include <vector>

namespace dibhr {

void FrameAssembly::clean_frame(RawFrame& raw, const CleaningPlan& plan) {
    const std::lock_guard lock(single_frame_mutex_);
    const auto begin = now_();
    const std::vector<HeldLevel> held = std::move(raw.held);
    if (raw.video && raw.colour_of_view && need_colour(plan.steps) && raw.colour.rgb.empty())
        raw.colour = raw.video->convert();
    const ColourImage* const colour = raw.colour_of_view ? &raw.colour : nullptr;
    SingleFrameDepth single_frame = chain_.clean_frame(std::move(raw.depth), plan, held, colour);
    // By its time: after some jumps the index is an estimate.
    single_frame.number = std::llround(raw.media_s / interval_s_);
    raw.single_frame = std::make_shared<SingleFrameDepth>(std::move(single_frame));
    if (plan.finger.radius_px > 0.0 && !plan.steps.steady) {
        const SingleFrameDepth* const alone = raw.single_frame.get();
        raw.settled = std::make_shared<const SettledDepth>(settle({&alone, 1}, 0, plan));
    }
    raw.single_frame_ms = std::chrono::duration<double, std::milli>(now_() - begin).count();
}

/// The present plan, but for a frame that was cleaned for another one: its own steps.
CleaningPlan FrameAssembly::plan_for(const SingleFrameDepth& single_frame) const {
    CleaningPlan plan = plan_;
    if (same_single_frame_steps(single_frame.steps, plan.steps)) return plan;
    plan.steps = single_frame.steps;
    plan.steps.steady = false;
    return plan;
}

SettledDepth FrameAssembly::settle(std::span<const SingleFrameDepth* const> frames, std::size_t now,
                                   const CleaningPlan& plan) {
    const std::lock_guard lock(settling_mutex_);
    return chain_.settle(frames, now, plan);
}

Frame FrameAssembly::without_depth(RawFrame& raw) const {
    Frame frame;
    frame.video = std::move(raw.video);
    if (!frame.video) frame.colour = std::make_shared<const ColourImage>(std::move(raw.colour));
    frame.colour_of_view = raw.colour_of_view;
    frame.media_s = raw.media_s;
    frame.index = raw.index;
    frame.media = number_;
    return frame;
}

Frame FrameAssembly::finish_frame(const Frame& without_depth,
                                  std::span<const SingleFrameDepth* const> single_frame,
                                  std::size_t now, const SettledDepth* settled) {
    const CleaningPlan plan = plan_for(*single_frame[now]);
    const bool is_settled = settled != nullptr && settled->plan == plan;
    return felt(is_settled ? *settled : settle(single_frame, now, plan), without_depth);
}

Frame FrameAssembly::finish_frame(const Frame& without_depth, SingleFrameDepth&& alone) {
    const std::lock_guard lock(settling_mutex_);
    const CleaningPlan plan = plan_for(alone);
    const SettledDepth settled = chain_.settle(std::move(alone), plan);
    return felt(settled, without_depth);
}

Frame FrameAssembly::felt(const SettledDepth& settled, const Frame& without_depth) {
    Frame frame = chain_.felt(settled, without_depth);
    frame.maps = maps_;
    return frame;
}

Frame FrameAssembly::finish_single_frame(RawFrame raw) {
    if (!raw.single_frame) clean_frame(raw, plan_);
    const bool is_settled = raw.settled && raw.settled->plan == plan_for(*raw.single_frame);
    Frame frame = is_settled ? felt(*raw.settled, without_depth(raw))
                             : finish_frame(without_depth(raw), std::move(*raw.single_frame));
    frame.cleaning.steps.steady = false;
    return frame;
}

void FrameAssembly::connect(Frame& from, const Frame& next, bool follows) {
    const MotionRequest affordable = throttle_.affordable(wanted_);
    done_ = follows ? affordable : MotionRequest{};
    motion_.connect(from, next, done_);
}

}  // namespace dibhr
