// Frames, the depth at a moment between them, and the window of frames that the player publishes
// with its clock.
#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/haptics/depth_image.hpp"
#include "core/haptics/surface.hpp"
#include "core/haptics/surface_motion.hpp"
#include "core/haptics/touch_maps.hpp"
#include "core/video/frames/cleaning_options.hpp"
#include "core/video/frames/colour_image.hpp"
#include "core/video/frames/video_picture.hpp"

namespace dibhr {

/// One colour + depth frame, cleaned and ready to touch. Immutable once published.
struct Frame {
    std::shared_ptr<const DepthImage> depth{};
    /// For each pixel of the depth image, row-major: 1 where no surface was ever seen. Null: every
    /// pixel was seen.
    std::shared_ptr<const std::vector<std::uint8_t>> unseen{};
    std::shared_ptr<const ColourImage> colour{};
    /// The colour of a video, as its decoder made it; `colour` is null then.
    std::shared_ptr<const VideoPicture> video{};
    bool colour_of_view{false};  ///< from a camera, with the depth's own view as far as known
    /// The surface that a ball as fingertip touches, of the same size; `depth` is it dilated by the
    /// ball. Null: the fingertip is a point, which touches `depth`.
    std::shared_ptr<const DepthImage> undilated{};
    std::shared_ptr<const TouchMaps> maps{};  ///< painted on the surface; null: none
    /// Where each pixel of drawn() moves until the next frame; null: not known.
    std::shared_ptr<const MotionField> motion{};
    /// The N in-betweens: frames felt and drawn before the next one, equally spaced in time, the
    /// first at 1/(N + 1). Their time_s, media_s and index are not set. Null: this frame blends
    /// into the next.
    std::shared_ptr<const std::vector<Frame>> in_betweens{};
    double time_s{0.0};        ///< on a playback timeline, which goes on across loops
    double media_s{0.0};       ///< presentation time in the file
    std::int64_t index{0};     ///< number of the frame in the file, from 0
    std::uint32_t media{0};    ///< number of its media, as given to the player
    FrameCleaning cleaning{};  ///< how its depth was cleaned

    /// In red, green and blue, which each call converts from `video`. Null or empty: no colour.
    [[nodiscard]] std::shared_ptr<const ColourImage> rgb() const;
    [[nodiscard]] bool has_colour() const noexcept {
        return video != nullptr || (colour != nullptr && !colour->rgb.empty());
    }
    /// What tells its colour from those of other frames.
    [[nodiscard]] std::shared_ptr<const void> colour_object() const noexcept {
        if (video) return video;
        return colour;
    }
    [[nodiscard]] std::size_t colour_bytes() const noexcept {
        if (video) return video->bytes;
        return colour ? colour->rgb.size() : 0;
    }

    /// The drawn surface: the one that the ball touches, not the dilated one that its lowest point
    /// follows.
    [[nodiscard]] const std::shared_ptr<const DepthImage>& drawn() const noexcept {
        return undilated ? undilated : depth;
    }
};

/// Containers round times to milliseconds: a requested time matches a frame's within half of one.
inline constexpr double kTimeTolerance_s = 0.0005;

/// The first item of `source.next()` that is not before `earliest_s`, else the last item.
template <typename Source, typename Item>
std::optional<Item> first_from(double earliest_s, Source& source, double Item::*time_s) {
    std::optional<Item> first = source.next();
    while (first && (*first).*time_s < earliest_s) {
        std::optional<Item> later = source.next();
        if (!later) break;
        first = std::move(later);
    }
    return first;
}

/// Limits of the speed at which a video or a session plays.
inline constexpr double kSlowestSpeed = 0.1;
inline constexpr double kFastestSpeed = 4.0;

/// From one media time to a later one [s].
struct MediaPart {
    double from_s{0.0};
    double to_s{0.0};

    bool operator==(const MediaPart&) const = default;
};

/// Maps the monotonic clock to the playback timeline.
struct PlaybackClock {
    std::chrono::steady_clock::time_point anchor{};
    double anchor_s{0.0};  ///< playback time at `anchor`
    double speed{0.0};     ///< 0 when paused

    [[nodiscard]] double playback_s(std::chrono::steady_clock::time_point now) const noexcept {
        return anchor_s + speed * std::chrono::duration<double>(now - anchor).count();
    }
};

/// The depth at a moment: the two frames around it, and how far the moment is from one to the
/// other. Where the frames have in-betweens, two of those are felt and drawn.
struct DepthBlend {
    const Frame* from{nullptr};
    const Frame* to{nullptr};
    double blend{0.0};  ///< 0: from, 1: to

    /// Whether the two make one surface to touch and draw: both exist, have the same size and
    /// scale, and 2 x 2 pixels or more.
    [[nodiscard]] bool makes_surface() const noexcept;

    /// The two neighbours among the frames and their in-betweens that are felt and drawn, and the
    /// blend between them. Without in-betweens: the two frames. Valid as long as the frames are.
    [[nodiscard]] DepthBlend with_in_betweens() const noexcept;

    /// The frame that is nearer to the moment.
    [[nodiscard]] const Frame& nearest() const noexcept { return blend < 0.5 ? *from : *to; }

    /// The surface that is felt; makes_surface() must be true. Valid as long as the frames are.
    [[nodiscard]] DepthSurface surface(const SurfaceShape& shape,
                                       const BumpMap* bump = nullptr) const noexcept {
        const DepthBlend pair = with_in_betweens();
        return {*pair.from->depth,           *pair.to->depth, pair.blend, shape, bump,
                pair.nearest().unseen.get(), from->maps.get()};
    }
    /// The surface that is drawn.
    [[nodiscard]] DepthSurface drawn_surface(const SurfaceShape& shape,
                                             const BumpMap* bump = nullptr) const noexcept {
        const DepthBlend pair = with_in_betweens();
        return {*pair.from->drawn(),         *pair.to->drawn(), pair.blend, shape, bump,
                pair.nearest().unseen.get(), from->maps.get()};
    }
    /// The frame whose colour is drawn: the one that most of the depth is of.
    [[nodiscard]] const Frame& colour_frame() const noexcept {
        return with_in_betweens().nearest();
    }
};

/// The depth at `time_s` in frames that are in order of time; before the first frame it is the
/// first, after the last the last. Null when there are none.
[[nodiscard]] DepthBlend depth_at(std::span<const Frame> frames, double time_s) noexcept;

/// Passes through a triple buffer as a whole, so a tick never mixes frames or clocks. Frames are in
/// order of time, and some lie in the future, so that the reader goes on to the next pair by its
/// own clock.
struct FrameWindow {
    static constexpr std::size_t kFrames = 4;

    std::array<Frame, kFrames> frames{};
    std::size_t count{0};
    PlaybackClock clock{};
    /// Counts seeks, loops, jumps and new files: the force ramps after each.
    std::uint64_t discontinuity{0};
    /// A live source lost its signal while the surface moved: no force until the signal returns.
    bool silent{false};

    [[nodiscard]] DepthBlend at(double playback_s) const noexcept {
        return depth_at({frames.data(), std::min(count, kFrames)}, playback_s);
    }
};

}  // namespace dibhr
