// What a pixel without data was a moment before: holes that come and go keep their last level.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "core/haptics/depth_image.hpp"
#include "core/video/cleaning/patches.hpp"

namespace dibhr {

/// A level older than this is forgotten [s of media time].
inline constexpr double kHold_s = 1.0;

/// The last level of a pixel that has no data now.
struct HeldLevel {
    std::uint32_t index;  ///< of the pixel, row-major
    float level;
};

/// Goes along with the frames of a file, in their order.
class DepthMemory {
  public:
    /// Of the frame's pixels without data those that had some less than kHold_s before, row-major.
    [[nodiscard]] std::vector<HeldLevel> take(const DepthImage& depth, double media_s);

    /// The next frame does not follow the last one.
    void forget() noexcept;

  private:
    std::vector<float> levels_{};           ///< the last of each pixel; empty: nothing was taken
    std::vector<std::uint32_t> seen_in_{};  ///< in which frame, counted from 1; 0: in none
    std::uint32_t whole_in_{0};             ///< in which all of them were, since when; 0: in none
    std::deque<double> times_{};            ///< of the frames that are young enough
    std::uint32_t oldest_{1};               ///< the first one of them
};

/// Puts held levels where nothing speaks against them. One is used where a level like it is seen
/// within a few pixels, or where it is about the farthest around; where no data is near at all, if
/// the hole was seen for the most part. So what moves away leaves no ghost in the hole behind it.
class HeldFiller {
  public:
    void fill(DepthImage& image, std::span<const HeldLevel> held);

  private:
    void find_farthest(const DepthImage& image);
    void find_seen_patches(const DepthImage& image, std::span<const HeldLevel> held);
    [[nodiscard]] bool was_seen(std::size_t k) const;

    Patches patches_{};
    std::vector<std::int32_t> patch_of_{};  ///< each held level
    std::vector<std::size_t> held_in_{};    ///< pixels of each patch
    // The lowest levels of pixels in a column, a square and all around; infinity: no data.
    std::vector<float> in_row_{}, lowest_{}, farthest_{};
    std::vector<HeldLevel> used_{};
};

}  // namespace dibhr
