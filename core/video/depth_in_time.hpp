// A depth video read forward to any playback time, for runs without a clock: `dibhr touch`.
#pragma once

#include <memory>
#include <optional>

#include "core/haptics/depth_image.hpp"
#include "core/haptics/surface.hpp"
#include "core/video/depth_cleaning.hpp"
#include "core/video/media.hpp"

namespace dibhr {

/// Holds the two frames around now; decodes when time passes them. Playback time 0 is the first
/// frame; the video repeats, its last frame lasting as long as the one before it.
class DepthInTime {
  public:
    /// Reads the first frame, and only that one when not `moving`. Throws InputError when there is
    /// none or it is smaller than 2 x 2.
    DepthInTime(std::unique_ptr<Media> media, bool moving, const CleaningOptions& cleaning);

    /// Goes on to `playback_s`, which must not fall from call to call. True when the video started
    /// again on the way. Throws InputError when the file breaks off.
    bool advance_to(double playback_s);

    /// The surface at the time advanced to; valid until the next advance.
    [[nodiscard]] DepthSurface surface(const SurfaceShape& shape, const BumpMap* bump) const;

  private:
    struct TimedDepth {
        DepthImage image{};
        double playback_s{0.0};
    };

    std::optional<TimedDepth> read();
    bool start_again(double playback_s);

    std::unique_ptr<Media> media_;
    CleaningOptions cleaning_{};
    DepthCleaner cleaner_{};
    TimedDepth from_{};
    std::optional<TimedDepth> to_{};  ///< empty: the depth does not change
    double first_media_s_{0.0};
    double offset_s_{0.0};  ///< playback time of this round's first frame
    double last_interval_s_{0.0};
    double blend_{0.0};
};

}  // namespace dibhr
