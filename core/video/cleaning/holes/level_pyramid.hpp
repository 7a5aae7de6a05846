// A pyramid of the background's levels: a depth image in squares, coarser and coarser.
#pragma once

#include <vector>

#include "core/haptics/depth_image.hpp"

namespace dibhr {

/// One level a square, of the farther surface where there are two. Each image has half as many
/// columns and rows as the one before. The other functions are about the last built image.
class LevelPyramid {
  public:
    static constexpr int kSquare_px = 4;  ///< of the finest image

    /// False: there is no data anywhere.
    [[nodiscard]] bool build(const DepthImage& image);
    /// Squares without data take their level from the coarser squares around.
    void fill();

    /// The finest image; NaN: no data.
    [[nodiscard]] const DepthImage& squares() const noexcept { return images_.front(); }
    /// Interpolates `values` of the finest squares at the pixels of an image row, and a few more.
    void spread(const std::vector<float>& values, int row, std::vector<float>& pixels);

  private:
    std::vector<DepthImage> images_{};
    std::vector<float> square_row_{};  ///< values of the squares, interpolated at the row
};

}  // namespace dibhr
