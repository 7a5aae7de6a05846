// A depth video as a surface at any time, for runs without a clock: `dibhr touch`, experiments.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "core/haptics/surface.hpp"
#include "core/video/frames/cleaning_options.hpp"
#include "core/video/frames/frame_window.hpp"
#include "core/video/playing/frame_reader.hpp"
#include "core/video/sources/media.hpp"

namespace dibhr {

/// Reads forward and holds the two frames around now. Time 0 is the first frame; the video repeats,
/// its last frame lasting as long as the one before it.
class DepthInTime {
  public:
    /// How much is wanted: the first frame and what it is cleaned with, or all of them.
    enum class Wanted { first, all };

    /// Reads the first frame. `motion` is found out of all that follow each other. `maps` lie on
    /// every frame; null: none. Throws InputError when there is no frame or it is smaller than
    /// 2 x 2.
    DepthInTime(std::unique_ptr<Media> media, Wanted wanted, const CleaningOptions& cleaning,
                const MotionWanted& motion = {}, std::shared_ptr<const TouchMaps> maps = nullptr);

    /// Goes on to `playback_s`, which must not fall from call to call. True when the video started
    /// again on the way. Throws InputError when the file breaks off.
    bool advance_to(double playback_s);

    /// At the time advanced to; valid until the next advance.
    [[nodiscard]] DepthBlend now() const noexcept { return depth_at(frames_, now_s_); }

  private:
    bool add(std::optional<Frame> frame);
    bool start_again(double playback_s);

    FrameReader reader_;
    std::vector<Frame> frames_{};  ///< one or two; one: the depth does not change any more
    double now_s_{0.0};
    double first_media_s_{0.0};
    double offset_s_{0.0};  ///< playback time of this lap's first frame
    double last_interval_s_{0.0};
};

/// A whole depth video in memory: one or more frames of one size, the first at 0 s. It repeats:
/// after the last frame comes the first again, as long after it as the last is after the one
/// before. The surfaces it gives are views into it.
class DepthClip {
  public:
    /// Throws InputError for no frame, one below 2 x 2, or frames that differ in size or are not
    /// in order of time.
    DepthClip(std::vector<Frame> frames, const SurfaceShape& shape,
              std::shared_ptr<const BumpMap> bump = nullptr);

    /// The surface `t_s` >= 0 after the first frame.
    [[nodiscard]] DepthSurface at(double t_s) const noexcept;
    /// The frames that it is of. Valid as long as the clip.
    [[nodiscard]] DepthBlend blend_at(double t_s) const noexcept;

    /// The time of frame number `frame` (from 0, held at the last), `blend` in [0, 1] of the way to
    /// the next [s].
    [[nodiscard]] double time_of(std::int64_t frame, double blend) const noexcept;

    [[nodiscard]] int columns() const noexcept { return frames_.front().depth->columns; }
    [[nodiscard]] int rows() const noexcept { return frames_.front().depth->rows; }
    /// Of one lap [s]; 0 for a still.
    [[nodiscard]] double duration_s() const noexcept {
        return frames_.back().time_s - frames_.front().time_s;
    }

  private:
    std::vector<Frame> frames_;  ///< after a video's last one its first, at the end of the lap
    SurfaceShape shape_;
    std::shared_ptr<const BumpMap> bump_;  ///< null: none
};

/// Decodes all frames of a depth video. Throws InputError.
[[nodiscard]] DepthClip read_depth_clip(std::unique_ptr<Media> media,
                                        const CleaningOptions& cleaning, const SurfaceShape& shape,
                                        const std::function<void(double share)>& progress);

}  // namespace dibhr
