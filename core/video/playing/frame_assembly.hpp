// Decoded frames made into those that are felt and drawn: in one place for files, sessions and what
// is live.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <utility>

#include "core/realtime/now.hpp"
#include "core/video/cleaning/cleaning_chain.hpp"
#include "core/video/frames/frame_window.hpp"
#include "core/video/motion/frame_motion.hpp"
#include "core/video/motion/motion_throttle.hpp"
#include "core/video/sources/media.hpp"

namespace dibhr {

/// Cleans frames, lays on them what lies on all of them, and tells how each becomes the next. One
/// thread at a time but for clean_alone().
class FrameAssembly {
  public:
    /// `now` is what cleaning is measured by. Motion that there is no time for rests for so many
    /// frames at most.
    FrameAssembly(Now now, int longest_rest) : now_(std::move(now)), throttle_(longest_rest) {}

    // Of frames that are made from here on.

    void set_plan(const CleaningPlan& plan) { plan_ = plan; }
    [[nodiscard]] const CleaningPlan& plan() const { return plan_; }
    void set_maps(std::shared_ptr<const TouchMaps> maps) { maps_ = std::move(maps); }
    void set_number(std::uint32_t number) { number_ = number; }
    [[nodiscard]] std::uint32_t number() const { return number_; }
    void set_motion(const MotionWanted& wanted) { wanted_ = wanted; }
    [[nodiscard]] const MotionWanted& motion() const { return wanted_; }

    /// By itself, with its depth moved into `lone`. Any thread.
    void clean_alone(RawFrame& raw, const CleaningPlan& plan);
    /// The frame without its depth, whose colour it takes.
    [[nodiscard]] Frame without_depth(RawFrame& raw) const;
    /// The same with the depth of frame `now` of `lone`, which follow each other in time.
    [[nodiscard]] Frame finished(const Frame& without_depth, std::span<const LoneDepth* const> lone,
                                 std::size_t now);
    /// All of a frame whose neighbours in time are not looked at.
    [[nodiscard]] Frame single(RawFrame raw);

    /// Tells `from` how it becomes `next`, as far as that is wanted and there is time for it;
    /// nothing where that does not follow it.
    void connect(Frame& from, const Frame& next, bool follows);
    /// There was no time for what the last connect() found out.
    void begin_rest() { throttle_.begin_rest(done_); }
    /// See MotionThrottle.
    void took(double busy_s, double interval_s) { throttle_.took(done_, busy_s, interval_s); }
    void forget_rests() { throttle_.forget(); }
    [[nodiscard]] const MotionThrottle& throttle() const { return throttle_; }

  private:
    Now now_;
    std::mutex alone_{};  ///< the chain's alone() is in use
    CleaningChain chain_{};
    CleaningPlan plan_{};
    std::shared_ptr<const TouchMaps> maps_{};
    std::uint32_t number_{0};
    FrameMotion motion_{};
    MotionThrottle throttle_;
    MotionWanted wanted_{};
    MotionWanted done_{};  ///< of it, at the last frame
};

}  // namespace dibhr
