// A depth video as a surface at any time, for runs without a clock: `dibhr touch`, experiments.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/haptics/surface.hpp"
#include "core/video/frames/cleaning_options.hpp"
#include "core/video/frames/frame_window.hpp"
#include "core/video/playing/frame_reader.hpp"
#include "core/video/sources/media.hpp"

namespace dibhr {

/// Reads forward and holds the two frames around the current time. Time 0 is the first frame. The
/// video loops; its last frame lasts as long as the one before it.
class DepthTimeline {
  public:
    /// How much is read: only the first frame and what cleaning it needs, or all frames.
    enum class Wanted { first, all };

    /// Reads the first frame. `motion`: what is computed between neighbouring frames. `maps` lie
    /// on every frame; null: none. Throws InputError when there is no frame, or it is smaller than
    /// 2 x 2.
    DepthTimeline(std::unique_ptr<Media> media, Wanted wanted, const CleaningOptions& cleaning,
                  const MotionRequest& motion = {},
                  std::shared_ptr<const TouchMaps> maps = nullptr);

    /// Advances to `playback_s`, which must not decrease from call to call. True when the video
    /// began another loop. Throws InputError when the file breaks off.
    bool advance_to(double playback_s);

    /// The surface at that time; valid until the next advance_to().
    [[nodiscard]] DepthBlend now() const noexcept { return depth_at(frames_, now_s_); }
    /// A sentence where a prepared surface was damaged; else empty.
    [[nodiscard]] const std::string& trouble() const { return reader_.prepared().trouble(); }

  private:
    bool add(std::optional<Frame> frame);
    bool start_again(double playback_s);

    FrameReader reader_;
    std::vector<Frame> frames_{};  ///< one or two; one: the depth no longer changes
    double now_s_{0.0};
    double first_media_s_{0.0};
    double offset_s_{0.0};  ///< playback time of this loop's first frame
    double last_interval_s_{0.0};
};

/// A whole depth video in memory: one or more frames of one size, the first at 0 s. The video
/// loops: the first frame follows the last after the last interval. Surfaces that the clip gives
/// are views into it.
class DepthClip {
  public:
    /// Throws InputError for no frame, one below 2 x 2, or frames that differ in size or are not
    /// in order of time.
    DepthClip(std::vector<Frame> frames, const SurfaceShape& shape,
              std::shared_ptr<const BumpMap> bump = nullptr);

    /// The surface `t_s` >= 0 after the first frame.
    [[nodiscard]] DepthSurface at(double t_s) const noexcept;
    /// The two frames of that surface, and the blend between them. Valid as long as the clip.
    [[nodiscard]] DepthBlend blend_at(double t_s) const noexcept;

    /// The time at `blend` in [0, 1] of the way from frame `frame` (0 to the last) to the next [s].
    [[nodiscard]] double time_of(std::int64_t frame, double blend) const noexcept;

    [[nodiscard]] int columns() const noexcept { return frames_.front().depth->columns; }
    [[nodiscard]] int rows() const noexcept { return frames_.front().depth->rows; }
    /// Of one loop [s]; 0 for a still.
    [[nodiscard]] double duration_s() const noexcept {
        return frames_.back().time_s - frames_.front().time_s;
    }

  private:
    std::vector<Frame> frames_;  ///< of a video, its first frame again at the end
    SurfaceShape shape_;
    std::shared_ptr<const BumpMap> bump_;  ///< null: none
};

/// Decodes all frames of a depth video. Throws InputError.
[[nodiscard]] DepthClip read_depth_clip(std::unique_ptr<Media> media,
                                        const CleaningOptions& cleaning, const SurfaceShape& shape,
                                        const std::function<void(double share)>& progress);

}  // namespace dibhr
