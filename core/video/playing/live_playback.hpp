// Plays a live source: cleans frames as they arrive, holds the last surface when none do.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "core/realtime/now.hpp"
#include "core/video/live/live_feed.hpp"
#include "core/video/live/live_record.hpp"
#include "core/video/playing/frame_assembly.hpp"
#include "core/video/playing/live_clock.hpp"
#include "core/video/playing/live_status.hpp"
#include "core/video/sources/media.hpp"

namespace dibhr {

/// Used by the player's thread. A frame is cleaned by itself, since waiting for later frames would
/// add delay; its motion is computed when the next frame arrives. The surface follows the pictures
/// by their stamps, one frame behind; pictures for which there is no time are dropped.
class LivePlayback {
  public:
    using Time = std::chrono::steady_clock::time_point;

    /// `now` is the clock that measures cleaning, which ends after the time that take() gets.
    explicit LivePlayback(Now now = std::chrono::steady_clock::now)
        : now_(std::move(now)), assembly_(now_, kLongestPause) {}
    ~LivePlayback() { close(); }

    /// The function is called on other threads whenever take() has something to do.
    void open(std::unique_ptr<Media> media, std::uint32_t number,
              std::shared_ptr<const TouchMaps> maps, std::function<void()> listener);
    void close();
    [[nodiscard]] bool is_open() const { return media_ != nullptr; }

    void play();           ///< continues with the next frame
    void pause(Time now);  ///< holds the surface
    [[nodiscard]] bool playing() const { return playing_; }
    void set_cleaning(const CleaningOptions& options, Time now);
    /// What is computed between the frames that arrive from now on.
    void set_motion(const MotionRequest& wanted) { assembly_.set_motion(wanted); }
    void set_maps(std::shared_ptr<const TouchMaps> maps);
    /// Sends frames to the sink from the shown one on, which begins a file: frames carry `number`,
    /// their times count from it, and earlier depth is forgotten. Empty: stops sending.
    void record(std::uint32_t number, LiveSink sink, Time now);

    /// Takes a frame that arrived, and drops frames that are past. True when the window changed.
    bool take(Time now);
    /// When take() is due next if no frame arrives.
    [[nodiscard]] Time next_due(Time now) const;

    [[nodiscard]] FrameWindow window() const;
    [[nodiscard]] LiveStatus status(Time now) const;
    [[nodiscard]] const MediaDescription& description() const { return media_->description(); }
    [[nodiscard]] std::string cleaning_in_words() const;
    [[nodiscard]] const CleaningSteps& steps() const { return assembly_.plan().steps; }
    [[nodiscard]] double clean_ms() const { return clean_ms_; }

  private:
    static constexpr int kLongestPause = 1920;  ///< frames without motion: a minute

    bool take_frame(Time now);
    [[nodiscard]] bool measure_noise(const RawFrame& raw);
    void make_plan();
    [[nodiscard]] Frame cleaned_frame(const RawFrame& raw);
    void show(Frame frame, Time now);
    void connect(const Frame& next, Time begin);
    void show_again(Time now);
    void send_to_sink(const RawFrame& raw);
    void detect_motion(const Frame& frame, Time now);
    [[nodiscard]] bool watch_signal(Time now);
    [[nodiscard]] Time lost_at() const;

    Now now_;
    std::unique_ptr<Media> media_{};
    std::shared_ptr<LiveFeed> feed_{};
    std::uint32_t opened_{0};  ///< number given to open()
    FrameAssembly assembly_;
    CleaningOptions options_{};
    DepthMemory memory_{};
    NoiseMeter meter_{};
    std::size_t measured_{0};  ///< frames whose noise was measured
    std::optional<DepthNoise> noise_{};
    LiveClock clock_{};
    std::deque<Frame> frames_{};  ///< from the shown one on
    RawFrame last_{};             ///< the newest frame, not cleaned
    double last_stamp_s_{0.0};
    std::uint64_t taken_{0};  ///< number of the newest pair
    std::uint64_t discontinuity_{0};
    bool playing_{true};
    std::int64_t dropped_{0};
    double behind_s_{0.0};
    Time moved_at_{};  ///< when the surface moved last
    bool lost_{false};
    Time status_at_{};  ///< of the last status update while the signal is lost
    bool force_off_{false};
    LiveSink sink_{};
    std::optional<double> file_begin_s_{};  ///< stamp of the recording's first frame
    double clean_ms_{0.0};
};

}  // namespace dibhr
