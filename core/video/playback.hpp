// What is shown when: the frames around now on the playback timeline, and the clock that moves over
// them.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <memory>

#include "core/video/frame_reader.hpp"
#include "core/video/frame_window.hpp"

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

    void play(Time now);
    void pause(Time now);
    void seek(double media_s, Time now);
    void step(int frames, Time now);
    void set_looping(bool looping);
    void set_speed(double speed, Time now);
    void set_cleaning(const CleaningOptions& options);

    /// Leaves frames that are past, stops at the end. True when the window changed.
    bool advance(Time now);
    /// Whether a frame ahead is missing.
    [[nodiscard]] bool needs_frame() const;
    /// Decodes one frame ahead. True when the window changed.
    bool read_ahead();
    /// Reading failed: plays what is there and stops.
    void end_here() { complete_ = true; }
    /// After `read_ahead`: when the frames had run out, the clock goes on from where the surface
    /// was held.
    void hold_if_behind(Time now);
    /// When `advance` is due next; never when paused.
    [[nodiscard]] Time next_due() const;

    [[nodiscard]] FrameWindow window() const;
    [[nodiscard]] bool is_open() const { return reader_ != nullptr; }
    [[nodiscard]] bool playing() const { return playing_; }
    [[nodiscard]] bool looping() const { return looping_; }
    [[nodiscard]] double speed() const { return speed_; }
    [[nodiscard]] const MediaDescription& description() const { return reader_->description(); }
    [[nodiscard]] const FrameCost& cost() const { return reader_->cost(); }

  private:
    void jump_to(Frame frame, Time now);
    void clean_again(const CleaningOptions& options);
    void anchor(double playback_s, Time now);
    [[nodiscard]] double moment(Time now) const;  ///< playback time, held at the newest frame
    [[nodiscard]] bool at_seam() const;  ///< from the last frame to the first of the next lap
    [[nodiscard]] bool single() const;   ///< one frame is all there is

    std::unique_ptr<FrameReader> reader_{};
    std::deque<Frame> frames_{};  ///< from the shown one on
    PlaybackClock clock_{};
    CleaningOptions cleaning_{};
    std::uint64_t discontinuity_{0};
    double first_media_s_{0.0};
    double read_to_s_{0.0};  ///< time of the newest frame before the last reading
    double speed_{1.0};
    bool playing_{false};
    bool looping_{true};
    bool complete_{false};  ///< no frame follows the newest
};

}  // namespace dibhr
