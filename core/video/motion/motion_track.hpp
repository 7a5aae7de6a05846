// From update to update: what has moved in the video since the last one.
#pragma once

#include <cstdint>

#include "core/haptics/surface_motion.hpp"
#include "core/video/frames/frame_window.hpp"

namespace dibhr {

/// Told of every update, whoever runs them: the loop, a replay, a run without a clock. Goes by the
/// frames' names in their media, which a recording gives again.
class MotionTrack {
  public:
    /// What has moved since the last call, in two frames that make a surface, between which `field`
    /// (null: nothing is known) is the motion. After another place of the video nothing has.
    [[nodiscard]] SurfaceMotion go_on_to(const DepthBlend& pair, const MotionField* field,
                                         double dt_s) noexcept {
        const Place last = last_;
        last_ = {pair.from->media, pair.from->media_s, pair.to->media_s, pair.blend, true};
        SurfaceMotion motion{.field = last_.from_s == last_.to_s ? nullptr : field,
                             .from_blend = last.blend,
                             .to_blend = pair.blend,
                             .dt_s = dt_s};
        if (!last.known || last.media != last_.media) return motion.begun_anew();
        if (last.from_s == last_.from_s && last.to_s == last_.to_s) return motion;
        motion.crossed = last.to_s == last_.from_s;
        return motion.crossed ? motion : motion.begun_anew();
    }

    /// There was nothing to touch.
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
