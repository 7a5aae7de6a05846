// Tracks, from update to update, how the video's surface has moved since the last one.
#pragma once

#include <cstdint>

#include "core/haptics/surface_motion.hpp"
#include "core/video/frames/frame_window.hpp"

namespace dibhr {

/// Must get every update, in the loop, in a replay and in a run without a clock. Identifies frames
/// by media and media time, which are the same in a replay.
class MotionTrack {
  public:
    /// The motion since the last call. `pair`: two frames that make a surface; `field`: the motion
    /// between them, null: not known. No motion after a jump to another place of the video.
    [[nodiscard]] SurfaceMotion follow_to(const DepthBlend& pair, const MotionField* field,
                                          double dt_s) noexcept {
        const Place last = last_;
        last_ = {pair.from->media, pair.from->media_s, pair.to->media_s, pair.blend, true};
        SurfaceMotion motion{.field = last_.from_s == last_.to_s ? nullptr : field,
                             .from_blend = last.blend,
                             .to_blend = pair.blend,
                             .dt_s = dt_s};
        if (!last.known || last.media != last_.media) return motion.restarted();
        if (last.from_s == last_.from_s && last.to_s == last_.to_s) return motion;
        motion.crossed = last.to_s == last_.from_s;
        return motion.crossed ? motion : motion.restarted();
    }

    /// There was no surface: the next update begins anew.
    void forget() noexcept { last_.known = false; }

  private:
    struct Place {
        std::uint32_t media{0};
        double from_s{0.0};
        double to_s{0.0};
        double blend{0.0};
        bool known{false};
    };

    Place last_{};
};

}  // namespace dibhr
