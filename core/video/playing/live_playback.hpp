// Shows what is live: cleans frames as they come, holds the last surface when none do.
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

/// Belongs to the player's thread. A frame is cleaned by itself: what needs those after it would be
/// felt too late; how it moves is known when the next one comes. The surface follows the pictures
/// by their stamps, a frame behind; pictures that cannot be made in time are left out.
class LivePlayback {
  public:
    using Time = std::chrono::steady_clock::time_point;

    /// `now` is what cleaning is measured by: it ends later than the time that take() is given.
    explicit LivePlayback(Now now = std::chrono::steady_clock::now)
        : now_(std::move(now)), assembly_(now_, kLongestRest) {}
    ~LivePlayback() { close(); }

    /// `news` is called on other threads whenever take() has something to do.
    void open(std::unique_ptr<Media> media, std::uint32_t number,
              std::shared_ptr<const TouchMaps> maps, std::function<void()> news);
    void close();
    [[nodiscard]] bool is_open() const { return media_ != nullptr; }

    void play();           ///< on with what comes now
    void pause(Time now);  ///< the surface stays as it is
    [[nodiscard]] bool playing() const { return playing_; }
    void set_cleaning(const CleaningOptions& options, Time now);
    /// What is to be found out of the time between the frames that come from now on.
    void set_motion(const MotionWanted& wanted) { assembly_.set_motion(wanted); }
    void set_maps(std::shared_ptr<const TouchMaps> maps);
    /// From the one that is there on frames carry that number, their presentation times count from
    /// it, and what was before it is forgotten: it is the first one of a file. Empty: no more.
    void record(std::uint32_t number, LiveSink sink, Time now);

    /// Takes what has come and lets go what has passed. True when the window changed.
    bool take(Time now);
    /// When that is due without anything having come.
    [[nodiscard]] Time next_due(Time now) const;

    [[nodiscard]] FrameWindow window() const;
    [[nodiscard]] LiveStatus status(Time now) const;
    [[nodiscard]] const MediaDescription& description() const { return media_->description(); }
    [[nodiscard]] std::string cleaning_in_words() const;
    [[nodiscard]] const CleaningSteps& steps() const { return assembly_.plan().steps; }
    [[nodiscard]] double clean_ms() const { return clean_ms_; }

  private:
    static constexpr int kLongestRest = 1920;  ///< frames without motion: a minute

    bool take_frame(Time now);
    [[nodiscard]] bool measures(const RawFrame& raw);
    void make_plan();
    [[nodiscard]] Frame cleaned_frame(const RawFrame& raw);
    void show(Frame frame, Time now);
    void connect(const Frame& next, Time begin);
    void show_again(Time now);
    void keep(const RawFrame& raw);
    void notice_motion(const Frame& frame, Time now);
    [[nodiscard]] bool watch_signal(Time now);
    [[nodiscard]] Time lost_at() const;

    Now now_;
    std::unique_ptr<Media> media_{};
    std::shared_ptr<LiveFeed> feed_{};
    std::uint32_t opened_{0};  ///< number it was opened by
    FrameAssembly assembly_;
    CleaningOptions options_{};
    DepthMemory memory_{};
    NoiseMeter meter_{};
    std::size_t measured_{0};  ///< frames
    std::optional<DepthNoise> noise_{};
    LiveClock clock_{};
    std::deque<Frame> frames_{};  ///< from the shown one on
    RawFrame last_{};             ///< the newest as it came, with its colour
    double last_stamp_s_{0.0};
    std::uint64_t taken_{0};  ///< number of the newest pair
    std::uint64_t discontinuity_{0};
    bool playing_{true};
    std::int64_t dropped_{0};
    double behind_s_{0.0};
    Time moved_{};  ///< when the surface did so last
    bool lost_{false};
    Time told_{};  ///< when the status was young last, while it is lost
    bool force_off_{false};
    LiveSink sink_{};
    std::optional<double> file_begin_s_{};  ///< stamp of the first frame of what is recorded
    double clean_ms_{0.0};
};

}  // namespace dibhr
