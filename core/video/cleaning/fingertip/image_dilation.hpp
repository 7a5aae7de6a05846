// Dilates one image after another by a ball, as far as it is wanted and has changed.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "core/haptics/depth_image.hpp"
#include "core/video/cleaning/fingertip/area_dilation.hpp"
#include "core/video/cleaning/fingertip/tiles.hpp"

namespace dibhr::fingertip {

class ImageDilation {
  public:
    /// The image to dilate from now on. What lies farther from all changes than the ball reaches
    /// stays dilated.
    void take(const DepthImage& image, const Fingertip& by);

    void dilate(const Tiles& wanted);
    void dilate_all();

    /// Where the image is dilated.
    [[nodiscard]] const Tiles& dilated() const { return dilated_; }
    /// A row of dilated levels. Rounding may have raised them above the image's highest.
    [[nodiscard]] const float* felt(int row) const {
        return felt_.data() + std::ptrdiff_t{row} * image_.columns;
    }

  private:
    void dilate_rows(AreaDilation& worker, const Tiles& wanted, int top, int bottom);

    Fingertip finger_{};
    double highest_level_{0.0};
    TouchedImage image_{};
    bool has_squares_{false};    ///< those of the image
    std::vector<float> felt_{};  ///< levels, where `dilated_` is marked
    Tiles dilated_{};
    std::array<AreaDilation, 2> workers_{};
};

}  // namespace dibhr::fingertip
