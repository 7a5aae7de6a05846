// Decides when a live frame is shown: as early as possible without the surface stopping.
#pragma once

#include <cstddef>
#include <deque>
#include <optional>

#include "core/video/frames/frame_window.hpp"

namespace dibhr {

/// Frames are one interval apart by their stamps, but arrive unevenly. The surface moves from one
/// frame to the next in that interval. So the shown moment is one interval behind the newest frame
/// when that is ready, plus the jitter, up to another interval. The clock is steered there by its
/// speed, never by a step; so it also follows a source whose clock runs at another rate.
/// For one thread.
class LiveClock {
  public:
    using Time = std::chrono::steady_clock::time_point;

    /// The next frame restarts the timeline: after a pause, a lost signal, a jump of the stamps.
    void restart() noexcept { restarts_ = true; }
    /// Whether the surface moves from the present frames to a frame of that stamp [s].
    [[nodiscard]] bool continues_with(double stamp_s,
                                      const std::deque<Frame>& frames) const noexcept;
    /// Appends a frame of that stamp [s], ready now, to the timeline `frames`, whose frames may be
    /// held longer or removed. True: the timeline restarted and holds this frame alone.
    bool add(Frame frame, double stamp_s, Time now, std::deque<Frame>& frames);
    /// Stops the clock at this moment; restart() starts it.
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
    std::deque<double> ahead_s_{};  ///< of each frame: its time minus our clock's when it was ready
    bool restarts_{true};
    bool waits_for_second_{false};  ///< the clock stands until a second frame arrives
};

}  // namespace dibhr
