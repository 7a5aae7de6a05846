// Fills small holes with the surface around them; at an object's outline with the background.
#pragma once

#include <vector>

#include "core/haptics/depth_image.hpp"
#include "core/video/cleaning/patches.hpp"

namespace dibhr {

/// A small hole is at most the image's width over this number wide and high.
inline constexpr int kSmallInWidth = 20;

/// Fills holes that are no wider and no higher than a twentieth of the image's width. Each pixel
/// takes the mean of the nearest levels to its left, right, above and below, weighted by
/// 1 / distance, which continues a plane. Where two of them are of different surfaces only the
/// farther one counts: the background is continued behind an object.
class SmallHoleFiller {
  public:
    void fill(DepthImage& image);

  private:
    using Run = Patches::Run;

    /// The nearest level in one direction.
    struct Side {
        float level{0.0F};
        float slope{0.0F};  ///< change of level a pixel, towards the hole
        int away{0};        ///< distance [px]; 0: there is none
    };
    /// The level from the sides in a row or a column, and its weight.
    struct Estimate {
        float level{0.0F};
        float weight{0.0F};  ///< 0: nothing
    };

    void find_small_runs(const DepthImage& image);
    void find_levels_above(const DepthImage& image);
    void estimate(const DepthImage& image);
    void update_column(const DepthImage& image, int column, int row, int step);
    [[nodiscard]] Estimate between(const Side& one, const Side& other) const noexcept;
    [[nodiscard]] static Estimate mean(const Estimate& one, const Estimate& other) noexcept;
    [[nodiscard]] Estimate behind(const Estimate& one, const Estimate& other) const noexcept;

    Patches patches_{};
    std::vector<Run> runs_{};         ///< of small patches
    std::vector<Side> above_{};       ///< of all pixels of all runs in order
    std::vector<Side> in_column_{};   ///< the nearest level above, or below, by column
    std::vector<float> estimates_{};  ///< likewise; NaN: no level on any side
    float outline_{0.0F};
};

}  // namespace dibhr
