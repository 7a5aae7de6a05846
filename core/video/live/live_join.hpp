// Decides which depth and colour pictures of two connections belong together: by their stamps, or
// by their arrival.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>

#include "core/video/live/live_input.hpp"

namespace dibhr {

/// Depth and colour of one moment. Of one connection both members are the same picture.
struct LivePair {
    LivePicture depth{};
    LivePicture colour{};
    std::uint64_t number{0};  ///< one more than that of the pair before it
};

/// The pictures that a live frame was made of, for recording. Shared; never written to.
struct SourcePictures {
    cv::Mat levels{};  ///< of depth, before their meaning is applied
    int bits{8};       ///< of a level
    cv::Mat colour{};  ///< 8-bit blue, green, red, unchanged; empty: none
    std::shared_ptr<const LivePair> pair{};
};

/// The offset from a source's stamps to our clock: the smallest delay from stamp to arrival. With
/// it, stamps of clocks with another zero are compared. Plain data.
class ClockOffset {
  public:
    /// Adds a picture, in order. Starts again where the source's clock was set to another time.
    void add(double stamp_s, double arrived_s);
    /// To be added to a stamp; 0 before the first picture.
    [[nodiscard]] double offset_s() const;
    [[nodiscard]] std::size_t count() const noexcept { return offsets_.size(); }
    /// Whether the newest picture had a smaller delay than all before, as pictures of a backlog
    /// have. True of the first picture.
    [[nodiscard]] bool catches_up() const noexcept { return catches_up_; }

  private:
    std::deque<double> offsets_{};
    bool catches_up_{true};
};

/// Joins each depth picture with the colour nearest in time, for which it waits at most half an
/// interval. Plain data.
class LiveJoin {
  public:
    using Time = LivePicture::Clock::time_point;

    void add_depth(LivePicture picture);
    void add_colour(LivePicture picture);
    /// The mean interval of depth pictures [s].
    void set_interval(double interval_s) noexcept { interval_s_ = interval_s; }

    /// The newest depth picture that need not wait any longer, with its colour. Nothing before the
    /// first colour, nor while a backlog is read: at most two seconds.
    [[nodiscard]] std::optional<LivePair> take(Time now);
    /// When the oldest waiting depth picture stops waiting; nothing: none waits.
    [[nodiscard]] std::optional<Time> due() const;

  private:
    [[nodiscard]] double colour_s(const LivePicture& picture) const;
    [[nodiscard]] bool backlog_is_over(Time now);
    [[nodiscard]] bool is_ready(const LivePicture& depth, Time now) const;
    [[nodiscard]] const LivePicture* nearest_colour(double depth_s) const;

    std::deque<LivePicture> waiting_{};  ///< depth, for its colour
    std::deque<LivePicture> colours_{};  ///< the newest
    ClockOffset depth_offset_{}, colour_offset_{};
    std::optional<Time> first_depth_{};  ///< its arrival
    bool backlog_over_{false};           ///< the backlog is read
    double interval_s_{1.0 / 30.0};
};

}  // namespace dibhr
