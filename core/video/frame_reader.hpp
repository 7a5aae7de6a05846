// Frames of one media, cleaned, in any order; and a depth video as a surface at any time, for runs
// without a clock: `dibhr touch`, experiments.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "core/haptics/surface.hpp"
#include "core/video/depth/depth_cleaning.hpp"
#include "core/video/frame_window.hpp"
#include "core/video/media.hpp"

namespace dibhr {

/// What the last frame cost.
struct FrameCost {
    double decode_ms{0.0};
    double clean_ms{0.0};
    std::chrono::steady_clock::time_point cleaned{};  ///< when it was ready
};

/// One thread at a time. Frames are named by their presentation time in the file; those
/// given out have `time_s` 0. Everything that decodes may throw InputError.
class FrameReader {
  public:
    /// Every frame carries `number`, for who needs to know where it came from.
    explicit FrameReader(std::unique_ptr<Media> media, std::uint32_t number = 0);

    /// The frame shown at `media_s`; the first before the beginning, the last after the end.
    std::optional<Frame> at(double media_s);
    /// The frame after the one at exactly `media_s`; nothing at the end.
    std::optional<Frame> after(double media_s);
    /// The frame before the one at exactly `media_s`; nothing at the beginning.
    std::optional<Frame> before(double media_s);

    /// How long the last frame, the one at exactly `media_s`, is shown: as long as the one before
    /// [s].
    [[nodiscard]] double last_interval_s(double media_s);

    /// From here on frames come cleaned so; those given out before are asked for again.
    void set_cleaning(const CleaningOptions& options);

    [[nodiscard]] const MediaDescription& description() const { return media_->description(); }
    [[nodiscard]] const FrameCost& cost() const { return cost_; }

  private:
    /// A decoded frame and its neighbours, as far as they were read one after the other.
    struct Kept {
        Frame raw{};
        std::vector<HeldLevel> held{};
        std::optional<CleanedDepth> cleaned{};
        std::optional<double> previous_s{}, next_s{};
    };

    Kept* find(double media_s);
    Kept* read();  ///< decodes the next frame and keeps it; null at the end
    void jump_to(double media_s);
    void drop_oldest();
    [[nodiscard]] static std::size_t bytes_of(const Kept& kept);
    Frame cleaned(Kept& kept);

    std::unique_ptr<Media> media_;
    std::uint32_t number_;
    DepthCleaner cleaner_{};
    CleaningOptions cleaning_{};
    std::deque<Kept> kept_{};             ///< in the order of decoding
    bool begun_{false};                   ///< something has been read
    std::optional<double> position_s_{};  ///< of the last decoded frame, if the next one follows it
    FrameCost cost_{};
};

/// Reads forward and holds the two frames around now. Time 0 is the first frame; the video repeats,
/// its last frame lasting as long as the one before it.
class DepthInTime {
  public:
    /// Reads the first frame, and only that one when not `moving`. Throws InputError when there is
    /// none or it is smaller than 2 x 2.
    DepthInTime(std::unique_ptr<Media> media, bool moving, const CleaningOptions& cleaning);

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
