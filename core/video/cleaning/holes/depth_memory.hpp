// The last level of pixels that have lost their data: holes that come and go keep it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "core/haptics/depth_image.hpp"
#include "core/video/cleaning/patches.hpp"

namespace dibhr {

/// Levels are kept this long [s of media time].
inline constexpr double kHold_s = 1.0;

/// The last level of a pixel that has no data now.
struct HeldLevel {
    std::uint32_t index;  ///< of the pixel, row-major
    float level;
};

/// Remembers the last level of each pixel; takes the frames of a file in their order.
class DepthMemory {
  public:
    /// Pixels without data in this frame that had data less than kHold_s before, row-major.
    [[nodiscard]] std::vector<HeldLevel> take(const DepthImage& depth, double media_s);

    /// The next frame does not follow the last one.
    void forget() noexcept;

  private:
    std::vector<float> levels_{};           ///< the last one of each pixel; empty: no frame yet
    std::vector<std::uint32_t> seen_in_{};  ///< frame of that level, counted from 1; 0: none
    std::uint32_t whole_in_{0};             ///< last frame, if it had no holes; else 0
    std::deque<double> times_{};            ///< of the frames within kHold_s
    std::uint32_t oldest_{1};               ///< number of the first of these
};

/// Puts held levels into holes where they are plausible: where a similar level is within a few
/// pixels, or the held level is about the farthest around. Where no data is near, most of the hole
/// must have held levels. So a moving object leaves no ghost in the hole behind it.
class HeldFiller {
  public:
    void fill(DepthImage& image, std::span<const HeldLevel> held);

  private:
    void find_farthest(const DepthImage& image);
    void find_seen_patches(const DepthImage& image, std::span<const HeldLevel> held);
    [[nodiscard]] bool was_seen(std::size_t k) const;

    Patches patches_{};
    std::vector<std::int32_t> patch_of_{};  ///< of each held level
    std::vector<std::size_t> held_in_{};    ///< pixels of each patch
    // The lowest levels in a column of a square, in a square, and around it; infinity: no data.
    std::vector<float> in_row_{}, lowest_{}, farthest_{};
    std::vector<HeldLevel> used_{};
};

}  // namespace dibhr
