// What stands where a depth image has no data: what is behind goes on there.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/haptics/depth_image.hpp"
#include "core/video/depth/patches.hpp"

namespace dibhr {

/// Levels that differ by no more are of one surface, as noise allows; others are on two sides of an
/// object's outline.
[[nodiscard]] float outline_levels(const DepthImage& image) noexcept;

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

/// Fills all that is left, so that nothing falls into a hole: near data with the farthest surface
/// there, between data with what is behind, and what is open with level 0.
class LargeHoleFiller {
  public:
    /// `seen` is the image before any hole was filled: no pixel that has no data in it stays lower
    /// than all that it has within a fingertip's reach. Puts 1 into `unseen` (columns x rows, all
    /// 0) where a hole is wider than a twentieth of the image's width. `refused` are pixels whose
    /// data was not believed: what stands there instead does not end beside them either.
    void fill(DepthImage& image, const DepthImage& seen, std::span<const std::size_t> refused,
              std::vector<std::uint8_t>& unseen);

  private:
    void find_wide_and_open(int columns);
    void widen(const DepthImage& seen, int row);
    [[nodiscard]] float* span_of(int row, int reach, std::size_t columns);
    void find_farthest(const DepthImage& seen, int row);
    void fill_row(DepthImage& image, int row, std::vector<std::uint8_t>& unseen);
    void lift_row(DepthImage& image, const DepthImage& seen, int row) const;
    void lift_beside(DepthImage& image, const DepthImage& seen,
                     std::span<const std::size_t> refused);

    /// Levels of squares of pixels, of the farther surface where there are two: each image of half
    /// as many columns and rows as the one before.
    std::vector<DepthImage> grids_{};
    std::vector<float> wide_{}, open_{};  ///< of the first one's squares: above 0 inside
    std::vector<float> level_row_{}, wide_row_{}, open_row_{};  ///< of the grid, at an image's row
    DepthImage given_{};                                        ///< with what refused pixels became
    std::vector<float> spans_{};  ///< by row and reach, of as many rows as a disc has
    std::vector<float> padded_{};
    std::vector<float> farthest_{};  ///< of one row: the lowest level in reach; infinity: none
    int widened_{0};                 ///< rows whose spans are known
};

}  // namespace dibhr
