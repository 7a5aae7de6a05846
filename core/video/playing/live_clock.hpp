// When a live frame is shown: as soon as it can be without the surface standing still.
#pragma once

#include <cstddef>
#include <deque>
#include <optional>

#include "core/video/frames/frame_window.hpp"

namespace dibhr {

/// Frames come one interval apart by their stamps, and unevenly by our clock. The surface moves
/// from one to the next in that interval: so the moment that is shown is an interval behind the
/// newest frame when that is ready, and as much more as frames come unevenly, up to another
/// interval. The clock is steered towards that by its speed, never by a step, which also follows a
/// source whose clock runs at another rate. Plain numbers: belongs to one thread.
class LiveClock {
  public:
    using Time = std::chrono::steady_clock::time_point;

    /// The next frame begins anew: after a pause, a lost signal, other stamps.
    void begin_again() noexcept { begins_ = true; }
    /// Whether the surface moves on to a frame of that stamp [s] from those that are there.
    [[nodiscard]] bool goes_on_to(double stamp_s, const std::deque<Frame>& frames) const noexcept;
    /// Puts a frame of that stamp [s], ready now, on the timeline behind `frames`, those on it,
    /// which may be held longer or let go. True: the timeline begins anew with it, alone.
    bool add(Frame frame, double stamp_s, Time now, std::deque<Frame>& frames);
    /// Stands still at this moment; goes on with begin_again().
    void stop(Time now) noexcept { clock_ = {now, clock_.playback_s(now), 0.0}; }

    [[nodiscard]] const PlaybackClock& clock() const noexcept { return clock_; }
    [[nodiscard]] double interval_s() const noexcept { return interval_s_; }

  private:
    void begin_with(Frame frame, double stamp_s, Time now, std::deque<Frame>& frames);
    void steer(double time_s, Time now);

    PlaybackClock clock_{};
    double offset_s_{0.0};  ///< from a stamp to the timeline
    double last_stamp_s_{0.0};
    double interval_s_{1.0 / 30.0};
    std::deque<double> ahead_s_{};  ///< of our clock, each frame's time when it was ready
    bool begins_{true};
    bool alone_{false};  ///< the clock stands until there is a frame to move towards
};

}  // namespace dibhr
