// A depth image in squares, coarser and coarser, of what is behind.
#pragma once

#include <vector>

#include "core/haptics/depth_image.hpp"

namespace dibhr {

/// One level a square, of the farther surface where there are two; each image has half as many
/// columns and rows as the one before. What comes after build() is of the image that it was of.
class LevelPyramid {
  public:
    static constexpr int kSquare_px = 4;  ///< of the finest image

    /// False: there is no data anywhere.
    [[nodiscard]] bool build(const DepthImage& image);
    /// Squares without data become as high as the coarser ones around.
    void fill();

    /// The finest image; NaN: no data.
    [[nodiscard]] const DepthImage& squares() const noexcept { return images_.front(); }
    /// What `values` of the finest squares are at the pixels of a row of the image, and a few more.
    void spread(const std::vector<float>& values, int row, std::vector<float>& pixels);

  private:
    std::vector<DepthImage> images_{};
    std::vector<float> square_row_{};  ///< at the row, not yet at its pixels
};

}  // namespace dibhr
