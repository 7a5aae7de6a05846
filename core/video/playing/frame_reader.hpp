// Reads cleaned frames of one media, in any order.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "core/realtime/now.hpp"
#include "core/video/frames/frame_window.hpp"
#include "core/video/playing/decoded_ahead.hpp"
#include "core/video/playing/frame_assembly.hpp"
#include "core/video/playing/prepared_frames.hpp"
#include "core/video/sources/media.hpp"

namespace dibhr {

/// How long the last frame took.
struct FrameCost {
    double decode_ms{0.0};                            ///< the wait for the decoder
    double clean_ms{0.0};                             ///< on either thread
    double finish_ms{0.0};                            ///< the part of it with its neighbours
    std::chrono::steady_clock::time_point cleaned{};  ///< when it was ready
};

/// Which of the following frames are read while they play; media time [s].
struct Pace {
    double earliest_s{0.0};  ///< frames before it are skipped, but not the last frame
    double spacing_s{0.0};   ///< one frame of so much media time is shown; 0: all
    bool time_for_motion{true};
};

/// Decodes on its own thread, which also cleans waiting frames as far as they need no others. Used
/// by one thread at a time. Frames are identified by their presentation time in the file; frames
/// given out have `time_s` 0. Every method that decodes may throw InputError.
class FrameReader {
  public:
    /// Every frame carries `number`, which identifies its media. `now` is the clock that measures
    /// decoding and cleaning.
    explicit FrameReader(std::unique_ptr<Media> media, std::uint32_t number = 0,
                         ReaderHeartbeats heartbeats = {},
                         Now now = std::chrono::steady_clock::now);

    /// The frame shown at `media_s`; the first before the beginning, the last after the end.
    std::optional<Frame> at(double media_s);
    /// The frame after the one at exactly `media_s`, or the later one that `pace` selects; nothing
    /// at the end.
    std::optional<Frame> after(double media_s, const Pace& pace = {});
    /// The frame before the one at exactly `media_s`; nothing at the beginning.
    std::optional<Frame> before(double media_s);

    /// A frame near `media_s` to be drawn while at() would take long, cleaned without its
    /// neighbours. Nothing where at() is as quick.
    std::optional<Frame> preview(double media_s);

    /// The first frame, not cleaned, to be drawn while measuring how to clean takes long. Nothing
    /// where at() is as quick.
    std::optional<Frame> first_picture();

    /// How long the last frame, the one at exactly `media_s`, is shown: as long as the frame
    /// before, or, where that was skipped, the mean interval [s].
    [[nodiscard]] double last_interval_s(double media_s);

    /// Stores in `from` its motion to `next` and the in-betweens, where requested and this machine
    /// has time. Both were given out with the present cleaning, one after the other. Frames that
    /// are not neighbours in the file get no motion.
    void connect(Frame& from, const Frame& next);
    /// What connect() computes from now on.
    void set_motion(const MotionRequest& wanted) { assembly_.set_motion(wanted); }
    /// What is not paused for want of time.
    [[nodiscard]] MotionRequest affordable_motion() const {
        const bool motion = !assembly_.throttle().motion_paused();
        return {motion, motion && !assembly_.throttle().in_betweens_paused()};
    }

    /// Frames are cleaned so from now on; frames given out before have to be read again.
    void set_cleaning(const CleaningOptions& options);

    /// Cleaning leaves out so much from now on: see degraded(). Likewise.
    void set_degradation(std::size_t level);
    /// The same from the next frames on, without a jump: those that were cleaned ahead stay as they
    /// are, unless the filter in time needs others.
    void degrade_next(std::size_t level);
    [[nodiscard]] std::size_t degradation() const { return degradation_; }
    /// Frames that are kept or ahead may have been cleaned at another level.
    [[nodiscard]] bool is_mixed() const { return mixed_; }

    /// Frames are cleaned, also where their surface is prepared.
    void use_no_prepared() { prepared_.turn_off(); }
    /// The prepared surface, if there is one for this cleaning.
    [[nodiscard]] const PreparedFrames& prepared() const { return prepared_; }
    /// Whether each frame is cleaned with those around it.
    [[nodiscard]] bool filters_in_time() const { return plan().steps.steady && !prepared_.found(); }

    /// Frames carry these maps from now on; null: none.
    void set_maps(std::shared_ptr<const TouchMaps> maps);

    [[nodiscard]] const MediaDescription& description() const { return media_.description(); }
    [[nodiscard]] const FrameCost& cost() const { return cost_; }
    /// How many frames after() has skipped.
    [[nodiscard]] std::int64_t skipped_frames() const { return skipped_frames_; }
    /// Mean time that a skipped frame takes [s]: its decoding, or, where skipped frames are more
    /// than decoded, the wait for a frame less its cleaning.
    [[nodiscard]] double decoding_s() const { return decoding_s_; }

    /// Mean time that a frame given out takes in addition, on the decoding thread [s]; 0: none, or
    /// not known.
    [[nodiscard]] double conversion_s() const { return conversion_s_; }

    /// The sum of all waits for the decoder [s].
    [[nodiscard]] double waited_s() const { return waited_s_; }
    /// The time that measuring noise and motion took, in all [s]: noise is measured once, motion is
    /// paused where there is no time for it.
    [[nodiscard]] double extra_s() const { return extra_s_; }

    /// The cleaning in use, once a frame has been given out.
    [[nodiscard]] const CleaningPlan& plan() const { return assembly_.plan(); }
    /// The same with nothing left out.
    [[nodiscard]] const CleaningPlan& whole_plan() const { return whole_plan_; }

  private:
    static constexpr int kLongestPause = 20'000;  ///< frames without motion
    /// What a kept frame is used for: to give it out, or to clean its neighbours with it.
    enum class Needs { surface, depth };
    /// A decoded frame, and the times of its neighbours where those were read directly before or
    /// after it. It is cleaned by itself, then with its neighbours on request. To save memory only
    /// the result may be kept.
    struct Kept {
        Frame frame{};   ///< without depth until that is cleaned
        RawFrame raw{};  ///< without colour; single_frame_ms until cleaned() has counted it
        std::optional<double> previous_s{}, next_s{};
        bool first{false}, last{false};  ///< of the media

        [[nodiscard]] bool is_cleaned() const { return frame.depth != nullptr; }
        void forget_cleaned();
        [[nodiscard]] bool can_be_cleaned() const {
            return raw.single_frame || !raw.depth.levels.empty() || raw.depth_left_out;
        }
        [[nodiscard]] bool has(Needs needs) const {
            if (needs == Needs::depth) return can_be_cleaned();
            return frame.colour_object() && (is_cleaned() || can_be_cleaned());
        }
        [[nodiscard]] std::size_t bytes() const;
    };
    /// The last decoded frame. Gapless: no frame after it is skipped.
    struct Position {
        double media_s{0.0};
        bool gapless{true};
        std::int64_t index{0};
    };
    /// Where the decoder was sent ahead of time, and the last frame that is kept.
    struct Prefetch {
        double from_s{0.0}, kept_to_s{0.0};
    };
    struct Neighbours {
        std::vector<std::shared_ptr<const SingleFrameDepth>> frames{};
        std::size_t now{0};
    };

    // Null: not kept. The pointer is valid until the next frame is read.
    Kept* find(double media_s);        ///< the frame at exactly that time
    Kept* find_shown(double media_s);  ///< the frame shown then, if it can be given out
    /// Decodes and keeps the next frame that the pace selects; null at the end.
    Kept* read(const Pace& pace = {});
    void update_timing(const RawFrame& raw, std::int64_t frames, double waited_s);
    Kept* keep(RawFrame raw);
    std::shared_ptr<const SingleFrameDepth> single_frame_of(Kept& kept);
    Kept* kept_after(const Kept& kept, Needs needs);
    Kept* next_of(double media_s, Needs needs);  ///< after the one at exactly media_s; null: end
    Kept* neighbour_after(double media_s);
    Kept* neighbour_before(double media_s);
    Kept* previous_of(double media_s, Needs needs);  ///< null at the beginning
    void jump_to(double media_s);
    [[nodiscard]] bool prefetches_past(double media_s) const;
    [[nodiscard]] bool decoder_is_after(double media_s) const;
    const Kept* next_wanted(double media_s, const Pace& pace);
    void prefetch_after_kept(double media_s);
    void evict();
    [[nodiscard]] double frames_read_back() const;
    [[nodiscard]] std::size_t reach() const;
    [[nodiscard]] bool is_large() const {
        return description().depth_pixels() > kMostPixelsForSensor;
    }
    void make_plan();
    void measure();
    [[nodiscard]] bool tries() const;
    [[nodiscard]] bool needs_measuring() const;
    std::optional<Frame> decoded_alone();
    Neighbours neighbours(double media_s);
    bool fill_prepared(double media_s);
    Frame cleaned(double media_s);  ///< of a kept frame at exactly that time
    [[nodiscard]] double seconds_since(std::chrono::steady_clock::time_point begin) const;

    Now now_;
    FrameAssembly assembly_;
    DecodedAhead media_;  // declared after all that its thread uses
    CleaningOptions options_{};
    CleaningPlan whole_plan_{};
    std::size_t degradation_{0};
    PreparedFrames prepared_{};
    bool cleans_{true};                   ///< the plan is for cleaning, not for a prepared surface
    std::optional<DepthNoise> noise_{};   ///< of the clip, measured when first needed
    std::optional<FeltCleaning> felt_{};  ///< what felt best on its first frames
    bool tried_{false};                   ///< felt_ is known, or that nothing tells
    /// A read error after a frame that was read ahead: thrown when that frame is requested.
    struct PendingError {
        double after_s{0.0};
        std::exception_ptr why{};
    };
    std::optional<PendingError> pending_error_{};
    bool planned_{false};                 ///< the assembly has the plan of the options
    bool goes_on_{false};                 ///< the new plan is for the next frames only
    bool mixed_{false};                   ///< frames ahead or kept may be of another plan
    std::map<double, Kept> kept_{};       ///< by presentation time
    double wanted_s_{0.0};                ///< the frame to give out now, or the last one
    bool at_beginning_{true};             ///< the next frame is the first one
    std::optional<Position> position_{};  ///< nothing: the decoder is not after a known frame
    std::optional<Prefetch> prefetch_{};  ///< until the decoder is read again
    int consecutive_frames_{0};           ///< frames that after() gave out since a jump or a step
    double decoding_s_{0.0};
    double conversion_s_{0.0};
    double waited_s_{0.0};
    double extra_s_{0.0};
    double jump_s_;  ///< how long the last jump to a frame that was not kept took
    std::int64_t skipped_frames_{0};
    FrameCost cost_{};
};

}  // namespace dibhr
