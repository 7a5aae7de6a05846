// Why a finger at rest lost its contact: by the data of the pixel under it in the file.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "core/haptics/depth_image.hpp"
#include "core/video/frames/frame_window.hpp"

namespace dibhr::bench {

/// Why the surface under a finger went away.
enum class Cause {
    hole,          ///< in a gap, after which the data came back alike within a second
    unseen,        ///< of a filled-in surface, without data for a second
    gone,          ///< the data ended, for more than a second or until it came back elsewhere
    cleaning,      ///< by cleaning, of data that would have kept contact
    moved,         ///< the data fell and stayed: for most of half a second it is down
    flicker,       ///< it fell and came back, this pixel alone
    flicker_wide,  ///< it fell and came back with most pixels around
    other,         ///< the recording ends too soon to tell
};
inline constexpr std::array kCauses{Cause::hole,         Cause::unseen, Cause::gone,
                                    Cause::cleaning,     Cause::moved,  Cause::flicker,
                                    Cause::flicker_wide, Cause::other};
static_assert(kCauses.size() == static_cast<std::size_t>(Cause::other) + 1);

[[nodiscard]] constexpr const char* name_of(Cause cause) noexcept {
    switch (cause) {
        case Cause::hole:
            return "hole";
        case Cause::unseen:
            return "unseen";
        case Cause::gone:
            return "gone";
        case Cause::cleaning:
            return "cleaning";
        case Cause::moved:
            return "moved";
        case Cause::flicker:
            return "flicker";
        case Cause::flicker_wide:
            return "flicker-wide";
        case Cause::other:
            break;
    }
    return "other";
}

/// Milliseconds without contact.
struct LostContact {
    std::array<std::size_t, kCauses.size()> of{};

    [[nodiscard]] std::size_t& operator[](Cause cause) {
        return of[static_cast<std::size_t>(cause)];
    }
    [[nodiscard]] std::size_t operator[](Cause cause) const {
        return of[static_cast<std::size_t>(cause)];
    }
    LostContact& operator+=(const LostContact& more) {
        for (std::size_t k = 0; k < of.size(); ++k) of[k] += more.of[k];
        return *this;
    }
};

/// A pixel.
struct Spot {
    int i{0};
    int j{0};
};

/// Gives each loss one cause, by a second finger on the pixel's data alone, whose gaps are bridged
/// by straight lines in time. `raw`, where NaN is no data, are `frames` before cleaning; `contact`
/// is that of a finger at rest, an entry a millisecond from the first frame on.
[[nodiscard]] LostContact explain_losses(std::span<const Frame> frames,
                                         std::span<const DepthImage> raw, Spot spot,
                                         std::span<const char> contact, double relief_px);

}  // namespace dibhr::bench
