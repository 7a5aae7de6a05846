// Decides when each frame is shown: the frames around the current time on the playback timeline,
// and the clock that moves over them.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <thread>

#include "core/video/frames/frame_window.hpp"
#include "core/video/playing/cleaning_degradation.hpp"
#include "core/video/playing/drawing_rate.hpp"
#include "core/video/playing/frame_plan.hpp"
#include "core/video/playing/frame_reader.hpp"

namespace dibhr {

/// Used by the player's thread; callers pass the time. Times on the timeline only increase. They
/// continue across loops, where the last frame blends into the first and the discontinuity count
/// rises (a recording may end unlike it began). A jump begins just after all that was shown.
class Playback {
  public:
    using Time = std::chrono::steady_clock::time_point;

    /// `processors`: on two or fewer decoding takes its time from cleaning.
    explicit Playback(unsigned processors = std::thread::hardware_concurrency());

    /// Plays a media from its first frame. Throws InputError, and then keeps the media it had.
    void open(std::unique_ptr<FrameReader> reader, Time now);

    /// Ends reading; settings stay.
    void close();
    void play(Time now);
    void pause(Time now);
    void seek(double media_s, Time now);
    void step(int frames, Time now);
    void set_looping(bool looping);
    /// Plays only this part of the media: at its end playback stops, or loops the part. From
    /// behind the part, where a seek or a step may lead, the media plays to its own end.
    void set_part(const std::optional<MediaPart>& part);
    void set_speed(double speed, Time now);
    void set_cleaning(const CleaningOptions& options);
    /// What is computed between frames read from now on; in-betweens also between present frames.
    void set_motion(const MotionRequest& wanted);
    /// What the window takes for drawing.
    void set_drawing_cost(const DrawingCost& drawing) { drawing_cost_ = drawing; }
    /// Puts them on all frames at once; null: none.
    void set_maps(const std::shared_ptr<const TouchMaps>& maps);

    /// Drops frames that are past, stops at the end. True when the window changed.
    bool advance(Time now);
    /// Whether a frame ahead is missing.
    [[nodiscard]] bool needs_frame() const;
    /// Reads the target of a seek, or one frame ahead: the next one, or, where that would be late,
    /// the first that is in time. True when the window changed; then call on_frame_read().
    bool read_ahead(Time now);
    /// A frame was read ahead, and is ready now. After a jump the clock starts now. Where frames
    /// had run out, the surface moves on from where it was held, towards the clock.
    void on_frame_read(Time now);
    /// Reading failed: plays the present frames and stops.
    void end_here();
    /// Whether another step back can be prepared: paused after one, and nothing else to read.
    [[nodiscard]] bool can_prepare_step_back() const;
    /// Reads the frame before, so that a step back need not wait.
    void prepare_step_back();
    /// When advance() is due next; never when paused.
    [[nodiscard]] Time next_due() const;

    /// To be drawn.
    [[nodiscard]] FrameWindow window() const;
    /// To be touched: empty while only a preview is shown.
    [[nodiscard]] FrameWindow touchable() const;
    /// Mean number of frames shown of each second of the video [1/s].
    [[nodiscard]] double shown_per_s() const;
    /// Drawn, not touched: the frame itself is being read, or cannot be.
    [[nodiscard]] bool shows_preview() const { return is_preview_; }
    /// The frame that is being read, by its media time [s].
    [[nodiscard]] std::optional<double> seek_target_s() const { return seek_target_s_; }
    /// Even with skipped frames this machine is too slow: the clock is slower than requested, or
    /// waited for frames lately.
    [[nodiscard]] bool falls_behind() const { return falls_behind_ || clock_is_slowed(); }
    /// That the window draws while frames are late; 0: as many as it likes.
    [[nodiscard]] double most_pictures_per_s() const {
        return playing_ ? drawing_rate_.most_per_s() : 0.0;
    }
    /// What is dropped on a machine that is too slow, and why, as sentences; empty: nothing.
    [[nodiscard]] std::string dropped_in_words() const;
    [[nodiscard]] bool is_open() const { return reader_ != nullptr; }
    [[nodiscard]] bool playing() const { return playing_; }
    /// The last frame that playing shows is shown, of the media or its part, and nothing plays on.
    /// On a slow machine that may be an earlier one than the file's last.
    [[nodiscard]] bool ended() const {
        return complete_ && !playing_ && !seek_target_s_ && frames_.size() == 1;
    }
    [[nodiscard]] bool looping() const { return looping_; }
    [[nodiscard]] const std::optional<MediaPart>& part() const { return part_; }
    [[nodiscard]] double speed() const { return speed_; }
    [[nodiscard]] const MediaDescription& description() const { return reader_->description(); }
    [[nodiscard]] const PreparedFrames& prepared() const { return reader_->prepared(); }
    [[nodiscard]] const FrameCost& cost() const { return reader_->cost(); }
    /// The cleaning of the depth with nothing left out, as a sentence and as steps.
    [[nodiscard]] std::string cleaning_in_words() const {
        return in_words(cleaning_, reader_->whole_plan());
    }
    [[nodiscard]] const CleaningSteps& steps() const { return reader_->whole_plan().steps; }

  private:
    void jump_to(Frame frame, Time now, bool is_preview = false);
    bool read_seek_target(Time now);
    bool read_next(Time now);
    [[nodiscard]] Pace pace(Time now) const;
    [[nodiscard]] double earliest_in_time_s(Time now) const;
    [[nodiscard]] bool filters_in_time() const { return reader_->filters_in_time(); }
    [[nodiscard]] FrameCosts measured_costs() const;
    [[nodiscard]] FrameCosts costs() const;
    void add_cost(double took_s, double waited_s);
    void place_late_frame(bool starts, Time now);
    void update_plan(Time now);
    [[nodiscard]] bool clock_is_slowed() const { return plan_.speed < speed_; }
    [[nodiscard]] double interval_s() const;
    void clean_again();
    void degrade();
    /// Whether a frame was cleaned as the reader cleans now.
    [[nodiscard]] bool is_of_plan(const Frame& frame) const {
        return frame.cleaning.steps == reader_->plan().steps;
    }
    [[nodiscard]] bool holds_other_steps() const;
    void apply_degradation();
    void drop_frames_ahead();
    void forget_costs();
    bool update_in_betweens(bool wanted);
    void anchor(double playback_s, Time now);
    [[nodiscard]] double moment(Time now) const;  ///< playback time, at most the newest frame's
    [[nodiscard]] bool in_part() const;
    [[nodiscard]] bool lap_ends_before(const std::optional<Frame>& next) const;
    [[nodiscard]] double lap_begins_s() const;
    [[nodiscard]] bool at_seam() const;  ///< between the last frame and the first of the next loop
    [[nodiscard]] bool single() const;   ///< the media has one frame

    unsigned processors_;
    std::unique_ptr<FrameReader> reader_{};
    std::deque<Frame> frames_{};  ///< from the shown one on
    PlaybackClock clock_{};
    CleaningOptions cleaning_{};
    CleaningDegradation degradation_{};  ///< while playing; at rest nothing is left out
    DrawingRate drawing_rate_{};         ///< likewise
    DrawingCost drawing_cost_{};
    MotionRequest motion_request_{};
    std::uint64_t discontinuity_{0};
    double first_media_s_{0.0};
    double offset_s_{0.0};                   ///< from media time to playback time, in this loop
    std::optional<double> seek_target_s_{};  ///< media time
    bool is_preview_{false};
    bool starts_{false};            ///< the clock stands until the second frame after a jump
    std::optional<Time> waited_{};  ///< when the clock last waited for a late frame
    bool falls_behind_{false};      ///< it did so lately
    Time reading_since_{};
    double waited_before_s_{0.0};  ///< sum of the reader's waits before this frame
    double extra_before_s_{0.0};   ///< likewise of its extra time
    double cleaning_s_{0.0};       ///< mean time of a frame without decoding
    double each_frame_s_{0.0};     ///< with the filter in time: of each frame, also of one left out
    double skipped_frames_{0.0};   ///< mean number of frames skipped between two shown
    double read_frames_{1.0};      ///< how many the newest is after the one before
    double load_{1.0};             ///< of the time a frame takes, to the time that is explained
    FramePlan plan_{};
    double speed_{1.0};
    bool playing_{false};
    bool looping_{true};
    std::optional<MediaPart> part_{};
    bool beyond_part_{false};  ///< a seek or step led there since the part was set
    bool complete_{false};     ///< no frame follows the newest
    bool steps_back_{false};
    std::optional<double> prepared_before_s_{};  ///< media time; the frame before it is read
};

}  // namespace dibhr
