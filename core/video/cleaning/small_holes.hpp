// Small holes continue what is around them; what is behind an object goes on behind it.
#pragma once

#include <vector>

#include "core/haptics/depth_image.hpp"
#include "core/video/cleaning/patches.hpp"

namespace dibhr {

/// A small hole is at most this part of the image's width wide and high.
inline constexpr int kSmallInWidth = 20;

/// Fills patches that are no wider and no higher than a twentieth of the image's width. Each pixel
/// takes the mean of the nearest levels to its left, right, above and below, weighted by
/// 1 / distance, which continues a plane. Where two of them are of different surfaces the nearer
/// one is left out: what is behind an object goes on behind it.
class SmallHoleFiller {
  public:
    void fill(DepthImage& image);

  private:
    using Run = Patches::Run;

    /// The nearest level in one direction.
    struct Side {
        float level{0.0F};
        float slope{0.0F};  ///< change of level a pixel, towards the hole
        int away{0};        ///< pixels; 0: there is none
    };
    /// What the sides of a row or a column say.
    struct Estimate {
        float level{0.0F};
        float weight{0.0F};  ///< 0: nothing
    };

    void keep_small(const DepthImage& image);
    void look_up(const DepthImage& image);
    void estimate(const DepthImage& image);
    void enter_column(const DepthImage& image, int column, int row, int step);
    [[nodiscard]] Estimate between(const Side& one, const Side& other) const noexcept;
    [[nodiscard]] static Estimate mean(const Estimate& one, const Estimate& other) noexcept;
    [[nodiscard]] Estimate behind(const Estimate& one, const Estimate& other) const noexcept;

    Patches patches_{};
    std::vector<Run> runs_{};         ///< of small patches
    std::vector<Side> above_{};       ///< of the pixels of all runs, one after the other
    std::vector<Side> in_column_{};   ///< the nearest level above, or below, by column
    std::vector<float> estimates_{};  ///< of the pixels of all runs; NaN: nothing near
    float outline_{0.0F};
};

}  // namespace dibhr
