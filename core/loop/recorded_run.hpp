// Recorded ticks computed again: the way from a tick's row back to its input.
#pragma once

#include <chrono>

#include "core/haptics/parameters.hpp"
#include "core/haptics/touch.hpp"
#include "core/loop/tick_runner.hpp"
#include "core/session/felt_surface.hpp"
#include "core/session/tick_record.hpp"
#include "core/video/frames/frame_window.hpp"

namespace dibhr {

/// A proxy of its own that follows the recorded goals, from the first tick of a recording on.
class RecordedRun {
  public:
    /// `frames`: the tick's, which make a surface. `touch`: as in `recorded`, or changed. With the
    /// recorded parameters it gives the recorded bits.
    const Touch& run(const TickRecord& tick, const DepthBlend& frames, const BumpMap* bump,
                     const TouchParameters& touch, const SessionParameters& recorded) noexcept;
    /// A tick without a surface.
    const Touch& pause() noexcept;

    [[nodiscard]] const Touch& touch() const noexcept { return touch_; }
    /// Holds all of the surface that the last update may have read.
    [[nodiscard]] const SurfaceRead& read() const noexcept { return read_; }
    /// Of the last update; 0 without a surface.
    [[nodiscard]] std::chrono::steady_clock::duration update_time() const noexcept {
        return runner_.update_time();
    }

  private:
    TickRunner runner_{};
    Touch touch_{};  // the runner's; without a surface there is no contact
    SurfaceRead read_{};
    bool started_{false};
};

}  // namespace dibhr
