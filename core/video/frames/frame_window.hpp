// Frames, the depth at a moment between them, and what the player hands over: a few frames around
// now and the clock.
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

namespace dibhr {

/// One colour + depth frame, cleaned and ready to touch. Immutable once published.
struct Frame {
    std::shared_ptr<const DepthImage> depth{};
    /// Of the depth image's pixels, row-major: 1 where no surface was ever seen; null: seen all
    /// over.
    std::shared_ptr<const std::vector<std::uint8_t>> unseen{};
    std::shared_ptr<const ColourImage> colour{};
    bool colour_of_view{false};  ///< a camera's, and as far as is known of the depth's own view
    /// What a fingertip touches, of the same size; null: it is a point, and that is `depth`.
    std::shared_ptr<const DepthImage> beneath{};
    /// What was painted on it; null: nothing.
    std::shared_ptr<const TouchMaps> maps{};
    /// Of the drawn image's pixels until the next frame; null: nothing is known of it.
    std::shared_ptr<const MotionField> motion{};
    /// What is felt and drawn on the way to the next frame, equally spaced in time: of N of them
    /// the first is there at 1/(N + 1). Their times and numbers mean nothing. Null: the one frame
    /// blends into the other.
    std::shared_ptr<const std::vector<Frame>> between{};
    double time_s{0.0};        ///< on a playback timeline, which goes on across loops
    double media_s{0.0};       ///< presentation time in the file
    std::int64_t index{0};     ///< number of the frame in the file, from 0
    std::uint32_t media{0};    ///< number of the media it is of, as given to the player
    FrameCleaning cleaning{};  ///< how its depth was cleaned

    /// What is drawn: the surface that the fingertip touches, not the one that its lowest point
    /// feels.
    [[nodiscard]] const std::shared_ptr<const DepthImage>& drawn() const noexcept {
        return beneath ? beneath : depth;
    }
};

/// Containers round times to milliseconds: a time asked for matches a frame's within half of one.
inline constexpr double kTimeTolerance_s = 0.0005;

/// Of the items that `source.next()` gives the first that is not before `earliest_s`, or the last.
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

/// How slowly and how fast a video or a session plays.
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

/// The depth at a moment: the two frames around it, and how far it is from the one to the other.
/// What is felt and drawn lies between two neighbours of their in-betweens, where there are some.
struct DepthBlend {
    const Frame* from{nullptr};
    const Frame* to{nullptr};
    double blend{0.0};  ///< 0: from, 1: to

    /// Whether the two make one surface to touch and draw: there, of one size and scale, 2 x 2 or
    /// more.
    [[nodiscard]] bool makes_surface() const noexcept;

    /// The two that are felt and drawn, one after the other, and the blend between them; without
    /// in-betweens, and of frames that do not follow each other, these two. Valid as long as they
    /// are.
    [[nodiscard]] DepthBlend shown() const noexcept;

    /// The one that the moment is nearer to.
    [[nodiscard]] const Frame& nearest() const noexcept { return blend < 0.5 ? *from : *to; }

    /// Of frames that make one. Valid as long as they are.
    [[nodiscard]] DepthSurface surface(const SurfaceShape& shape,
                                       const BumpMap* bump = nullptr) const noexcept {
        const DepthBlend pair = shown();
        return {*pair.from->depth,           *pair.to->depth, pair.blend, shape, bump,
                pair.nearest().unseen.get(), from->maps.get()};
    }
    /// The same of what is drawn.
    [[nodiscard]] DepthSurface drawn_surface(const SurfaceShape& shape,
                                             const BumpMap* bump = nullptr) const noexcept {
        const DepthBlend pair = shown();
        return {*pair.from->drawn(),         *pair.to->drawn(), pair.blend, shape, bump,
                pair.nearest().unseen.get(), from->maps.get()};
    }
    /// The frame whose colour is drawn.
    [[nodiscard]] const Frame& coloured() const noexcept {
        return from->between ? shown().nearest() : *from;
    }
};

/// The depth at `time_s` in frames in order of their times, held at the first and the last. Null
/// when there is none.
[[nodiscard]] DepthBlend depth_at(std::span<const Frame> frames, double time_s) noexcept;

/// Travels whole through a triple buffer, so a tick never mixes frames or clocks. Frames are in
/// order of time and a few ahead, so that the reader crosses from one pair to the next by its own
/// clock.
struct FrameWindow {
    static constexpr std::size_t kFrames = 4;

    std::array<Frame, kFrames> frames{};
    std::size_t count{0};
    PlaybackClock clock{};
    /// Counts seeks, loops, jumps and new files: the force ramps after each.
    std::uint64_t discontinuity{0};
    /// What is live was moving when its signal was lost: until it comes back there is no force.
    bool silent{false};

    [[nodiscard]] DepthBlend at(double playback_s) const noexcept {
        return depth_at({frames.data(), std::min(count, kFrames)}, playback_s);
    }
};

}  // namespace dibhr
