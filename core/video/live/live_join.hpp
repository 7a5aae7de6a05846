// Which depth and which colour picture of two connections belong together: by their stamps, or by
// when they come.
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

/// Of one moment. Where both are of one picture the colour is in the depth's.
struct LivePair {
    LivePicture depth{};
    LivePicture colour{};
    std::uint64_t number{0};  ///< one more than that of the pair before it
};

/// What a live frame is made of, to be kept. Shared with nobody who writes.
struct TakenPictures {
    cv::Mat levels{};  ///< of depth, before their meaning is looked up
    int bits{8};       ///< of a level
    cv::Mat colour{};  ///< 8-bit blue, green, red, as it came; empty: there is none
    std::shared_ptr<const LivePair> pair{};
};

/// How much later than its stamp a source's picture comes when it comes quickly: by that, stamps of
/// clocks with another zero are compared. Plain data.
class StampLine {
  public:
    /// A picture's, in order. Nothing is known any more where the clock was set to another time.
    void add(double stamp_s, double arrived_s);
    /// On our clock, of a stamp; 0 before anything was added.
    [[nodiscard]] double later_s() const;
    [[nodiscard]] std::size_t count() const noexcept { return later_.size(); }
    /// Whether the newest picture came quicker than all before, as those do that piled up. True of
    /// the first one.
    [[nodiscard]] bool catches_up() const noexcept { return catches_up_; }

  private:
    std::deque<double> later_{};
    bool catches_up_{true};
};

/// Every depth picture goes with the colour that is nearest in time, and waits for it half the time
/// from picture to picture at most. Plain data.
class LiveJoin {
  public:
    using Time = LivePicture::Clock::time_point;

    void add_depth(LivePicture picture);
    void add_colour(LivePicture picture);
    /// The time from depth picture to depth picture, as of late [s].
    void set_interval(double interval_s) noexcept { interval_s_ = interval_s; }

    /// Of the depth pictures that need not wait any more the newest, with its colour; nothing
    /// before the first colour, and nothing while the pictures that piled up are worked off: two
    /// seconds at most.
    [[nodiscard]] std::optional<LivePair> take(Time now);
    /// When one that waits goes without; nothing: none waits.
    [[nodiscard]] std::optional<Time> due() const;

  private:
    [[nodiscard]] double colour_s(const LivePicture& picture) const;
    [[nodiscard]] bool begins(Time now);
    [[nodiscard]] bool may_go(const LivePicture& depth, Time now) const;
    [[nodiscard]] const LivePicture* nearest_colour(double depth_s) const;

    std::deque<LivePicture> waiting_{};  ///< depth, for its colour
    std::deque<LivePicture> colours_{};  ///< the newest
    StampLine depth_line_{}, colour_line_{};
    std::optional<Time> first_depth_{};  ///< when it came
    bool begun_{false};                  ///< no more is piled up
    double interval_s_{1.0 / 30.0};
};

}  // namespace dibhr
