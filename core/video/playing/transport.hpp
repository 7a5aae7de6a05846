// Play, pause and seek, for a video, a live source or a session.
#pragma once

#include <algorithm>
#include <optional>

#include "core/video/frames/frame_window.hpp"

namespace dibhr {

/// Position and settings of what plays; times on its own clock [s].
struct PlayState {
    bool playing{false};
    bool looping{false};
    double speed{1.0};
    double now_s{0.0};
    double begin_s{0.0}, end_s{0.0};
    std::optional<MediaPart> part{};  ///< only this part is played; nothing: all

    /// Where it stops or loops.
    [[nodiscard]] double last_s() const noexcept {
        return part ? std::min(part->to_s, end_s) : end_s;
    }
};

/// Used by the window thread; no method waits for a disk or for decoding. A live source can only be
/// played and paused.
class Transport {
  public:
    virtual ~Transport() = default;

    virtual void play() = 0;  ///< at the end: from the beginning
    virtual void pause() = 0;
    /// Keeps playing or paused; of many calls in a row the last one counts.
    virtual void seek(double t_s) = 0;
    virtual void step(int by) = 0;  ///< pauses, then moves by frames or ticks; < 0: back
    virtual void set_looping(bool looping) = 0;
    /// Plays only that part: stops at its end, or loops it. From behind the part playback goes on
    /// to the end of all.
    virtual void set_part(const std::optional<MediaPart>& part) = 0;
    virtual void set_speed(double speed) = 0;  ///< kSlowestSpeed .. kFastestSpeed
};

}  // namespace dibhr
