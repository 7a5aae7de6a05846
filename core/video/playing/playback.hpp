// What is shown when: the frames around now on the playback timeline, and the clock that moves over
// them.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>

#include "core/video/frames/frame_window.hpp"
#include "core/video/playing/frame_reader.hpp"

namespace dibhr {

/// Belongs to the player's thread; every time comes in as an argument. The timeline only ever
/// grows: it goes on across loops, where the last frame blends into the first and the discontinuity
/// rises (not every recording ends as it began), and a jump begins a moment later than all that was
/// shown.
class Playback {
  public:
    using Time = std::chrono::steady_clock::time_point;

    /// Takes a media from its first frame on, playing. Throws InputError, and then keeps what it
    /// had.
    void open(std::unique_ptr<FrameReader> reader, Time now);

    /// Nothing is read any more; what is chosen stays chosen.
    void close();
    void play(Time now);
    void pause(Time now);
    void seek(double media_s, Time now);
    void step(int frames, Time now);
    void set_looping(bool looping);
    /// Only this part of the media is played: at its end it stops, or begins the part again. From
    /// beyond it, where a seek or a step may lead, the media is played to its own end.
    void set_part(const std::optional<MediaPart>& part);
    void set_speed(double speed, Time now);
    void set_cleaning(const CleaningOptions& options);
    /// What is to be found out of the time between frames: of those read from now on, but
    /// in-betweens of all at once.
    void set_motion(const MotionWanted& wanted);
    /// Lays them on all frames at once; null: none.
    void set_maps(const std::shared_ptr<const TouchMaps>& maps);

    /// Leaves frames that are past, stops at the end. True when the window changed.
    bool advance(Time now);
    /// Whether a frame ahead is missing.
    [[nodiscard]] bool needs_frame() const;
    /// Reads the frame that was sought, or one ahead: the next one, or, where that would come too
    /// late, the first that comes in time. True when the window changed; then `arrived` is told.
    bool read_ahead(Time now);
    /// When what was read ahead was there. After a jump the clock begins now; where the frames had
    /// run out the surface goes on from where it was held, to meet the clock.
    void arrived(Time now);
    /// Reading failed: plays what is there and stops.
    void end_here();
    /// Whether there is time to make ready for another step back: paused after one, and nothing
    /// else to read.
    [[nodiscard]] bool has_time() const;
    /// Then a step back has nothing to wait for.
    void make_ready_to_step_back();
    /// When `advance` is due next; never when paused.
    [[nodiscard]] Time next_due() const;

    /// To be drawn.
    [[nodiscard]] FrameWindow window() const;
    /// To be touched: nothing while a sought frame is only previewed.
    [[nodiscard]] FrameWindow touchable() const;
    /// How many frames of the video are shown, of those in a second of it; as of late [1/s].
    [[nodiscard]] double shown_per_s() const;
    /// Where it goes, while what is shown is a preview; media time [s].
    [[nodiscard]] std::optional<double> sought_s() const { return sought_s_; }
    /// Not even so the time is kept.
    [[nodiscard]] bool waits() const { return waits_; }
    [[nodiscard]] bool is_open() const { return reader_ != nullptr; }
    [[nodiscard]] bool playing() const { return playing_; }
    [[nodiscard]] bool looping() const { return looping_; }
    [[nodiscard]] const std::optional<MediaPart>& part() const { return part_; }
    [[nodiscard]] double speed() const { return speed_; }
    [[nodiscard]] const MediaDescription& description() const { return reader_->description(); }
    [[nodiscard]] const FrameCost& cost() const { return reader_->cost(); }
    /// What is done to its depth, in words and step by step.
    [[nodiscard]] std::string cleaning_in_words() const {
        return in_words(cleaning_, reader_->plan());
    }
    [[nodiscard]] const CleaningSteps& steps() const { return reader_->plan().steps; }

  private:
    void jump_to(Frame frame, Time now);
    bool read_sought(Time now);
    bool read_next(Time now);
    [[nodiscard]] Pace pace(Time now) const;
    [[nodiscard]] double earliest_s(Time now, double takes_s) const;
    [[nodiscard]] std::optional<double> taken_s() const;
    [[nodiscard]] double interval_s() const;
    void clean_again(const CleaningOptions& options);
    bool put_between(bool wanted);
    void anchor(double playback_s, Time now);
    [[nodiscard]] double moment(Time now) const;  ///< playback time, held at the newest frame
    [[nodiscard]] bool in_part() const;
    [[nodiscard]] bool lap_ends_before(const std::optional<Frame>& next) const;
    [[nodiscard]] double lap_begins_s() const;
    [[nodiscard]] bool at_seam() const;  ///< from the last frame to the first of the next lap
    [[nodiscard]] bool single() const;   ///< one frame is all there is

    std::unique_ptr<FrameReader> reader_{};
    std::deque<Frame> frames_{};  ///< from the shown one on
    PlaybackClock clock_{};
    CleaningOptions cleaning_{};
    MotionWanted motion_wanted_{};
    std::uint64_t discontinuity_{0};
    double first_media_s_{0.0};
    double offset_s_{0.0};              ///< from media time to playback time, on this lap
    std::optional<double> sought_s_{};  ///< media time; what is shown meanwhile is a preview
    bool starts_{false};                ///< the clock stands until the frame after a jump is there
    std::optional<Time> waited_{};
    bool waits_{false};  ///< the clock did, for a frame that was too late
    Time reading_since_{};
    double waited_before_s_{0.0};  ///< for frames, before this one was read
    double cleaning_s_{0.0};       ///< how long a frame takes beyond decoding, as of late
    double passed_over_{0.0};      ///< frames between two that are shown, as of late
    double speed_{1.0};
    bool playing_{false};
    bool looping_{true};
    std::optional<MediaPart> part_{};
    bool beyond_part_{false};  ///< sought or stepped there, since the part was set
    bool complete_{false};     ///< no frame follows the newest
    bool steps_back_{false};
    std::optional<double> ready_before_s_{};  ///< media time of the frame before which one is ready
};

}  // namespace dibhr
