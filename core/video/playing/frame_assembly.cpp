// Puts cleaned depth, colour, maps and motion together.
#include "core/video/playing/frame_assembly.hpp"

#include <chrono>
#include <vector>

namespace dibhr {

void FrameAssembly::clean_alone(RawFrame& raw, const CleaningPlan& plan) {
    const std::lock_guard lock(alone_);
    const auto begin = now_();
    const std::vector<HeldLevel> held = std::move(raw.held);
    const ColourImage* const colour = raw.colour_of_view ? &raw.colour : nullptr;
    raw.lone =
        std::make_shared<const LoneDepth>(chain_.alone(std::move(raw.depth), plan, held, colour));
    raw.lone_ms = std::chrono::duration<double, std::milli>(now_() - begin).count();
}

Frame FrameAssembly::without_depth(RawFrame& raw) const {
    Frame frame;
    frame.colour = std::make_shared<const ColourImage>(std::move(raw.colour));
    frame.colour_of_view = raw.colour_of_view;
    frame.media_s = raw.media_s;
    frame.index = raw.index;
    frame.media = number_;
    return frame;
}

Frame FrameAssembly::finished(const Frame& without_depth, std::span<const LoneDepth* const> lone,
                              std::size_t now) {
    Frame frame = chain_.finished(lone, now, plan_, without_depth);
    frame.maps = maps_;
    return frame;
}

Frame FrameAssembly::single(RawFrame raw) {
    if (!raw.lone) clean_alone(raw, plan_);
    const LoneDepth* const lone = raw.lone.get();
    Frame frame = finished(without_depth(raw), {&lone, 1}, 0);
    frame.cleaning.steps.steady = false;
    return frame;
}

void FrameAssembly::connect(Frame& from, const Frame& next, bool follows) {
    const MotionWanted affordable = throttle_.affordable(wanted_);
    done_ = follows ? affordable : MotionWanted{};
    motion_.connect(from, next, done_);
}

}  // namespace dibhr
