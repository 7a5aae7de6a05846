// Makes the frames that are touched and drawn out of decoded frames: the same code for files,
// sessions and live sources.
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

/// Cleans frames, adds the touch maps, and computes the motion from each frame to the next. Used by
/// one thread at a time; clean_frame() may be called by any thread.
class FrameAssembly {
  public:
    /// `now` is the clock that measures cleaning. Motion for which there is no time is paused for
    /// at most `longest_pause` frames.
    FrameAssembly(Now now, int longest_pause) : now_(std::move(now)), throttle_(longest_pause) {}

    // Settings of frames that are made from now on.

    void set_plan(const CleaningPlan& plan) { plan_ = plan; }
    [[nodiscard]] const CleaningPlan& plan() const { return plan_; }
    void set_maps(std::shared_ptr<const TouchMaps> maps) { maps_ = std::move(maps); }
    [[nodiscard]] const std::shared_ptr<const TouchMaps>& maps() const { return maps_; }
    void set_number(std::uint32_t number) { number_ = number; }
    [[nodiscard]] std::uint32_t number() const { return number_; }
    /// From frame to frame, by which frames are numbered.
    void set_interval(double interval_s) { interval_s_ = interval_s; }
    void set_motion(const MotionRequest& wanted) { wanted_ = wanted; }
    [[nodiscard]] const MotionRequest& motion() const { return wanted_; }

    /// Does the cleaning that needs no other frame. Moves the depth into `raw.single_frame`. Before
    /// a fingertip, which takes as long, also `raw.settled`, so that the next frame is cleaned
    /// while one is dilated. Any thread.
    void clean_frame(RawFrame& raw, const CleaningPlan& plan);
    /// The frame without its depth. Moves the colour out of `raw`.
    [[nodiscard]] Frame without_depth(RawFrame& raw) const;
    /// Adds the depth of frame number `now` of the span, whose frames are in order of time.
    /// `settled`: of that frame; null, or of another plan: not used.
    [[nodiscard]] Frame finish_frame(const Frame& without_depth,
                                     std::span<const SingleFrameDepth* const> single_frame,
                                     std::size_t now, const SettledDepth* settled = nullptr);
    /// The same of a frame alone, in its own memory.
    [[nodiscard]] Frame finish_frame(const Frame& without_depth, SingleFrameDepth&& alone);
    /// Cleans a frame completely, without its neighbours in time.
    [[nodiscard]] Frame finish_single_frame(RawFrame raw);

    /// Stores in `from` its motion to `next`, as far as it is requested and there is time;
    /// none when `next` does not follow `from`.
    void connect(Frame& from, const Frame& next, bool follows);
    /// There was no time for what the last connect() computed.
    void pause_motion() { throttle_.pause_motion(done_); }
    /// See MotionThrottle.
    void add_cost(double busy_s, double interval_s) {
        throttle_.add_cost(done_, busy_s, interval_s);
    }
    void forget_motion_pauses() { throttle_.forget(); }
    [[nodiscard]] const MotionThrottle& throttle() const { return throttle_; }
    /// Memory of frames that are not needed any more.
    [[nodiscard]] const ObjectPool<DepthImage>& images() const noexcept { return chain_.images(); }

  private:
    [[nodiscard]] CleaningPlan plan_for(const SingleFrameDepth& single_frame) const;
    [[nodiscard]] SettledDepth settle(std::span<const SingleFrameDepth* const> frames,
                                      std::size_t now, const CleaningPlan& plan);
    [[nodiscard]] Frame felt(const SettledDepth& settled, const Frame& without_depth);

    Now now_;
    std::mutex single_frame_mutex_{};  ///< guards the chain's cleaning of single frames
    std::mutex settling_mutex_{};      ///< and what follows it
    CleaningChain chain_{};
    CleaningPlan plan_{};
    std::shared_ptr<const TouchMaps> maps_{};
    std::uint32_t number_{0};
    double interval_s_{1.0 / 25.0};
    FrameMotion motion_{};
    MotionThrottle throttle_;
    MotionRequest wanted_{};
    MotionRequest done_{};  ///< what was computed for the last frame
};

}  // namespace dibhr
