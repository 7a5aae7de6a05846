// The drawn surface between two depth images, without bumps and painted heights.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "core/haptics/depth_image.hpp"
#include "render/relief_grid.hpp"

namespace dibhr {

/// The surface between two depth images of one size.
struct BlendedDepth {
    const DepthImage& from;
    const DepthImage& to;
    double blend{0.0};  ///< 0: from, 1: to
    double px_per_level{1.0};
};

/// How many pixels of a picture's row are one of 640 pixels in a row: the unit of all widths and
/// heights that are judged at outlines, so that a picture has the same ones at any size.
[[nodiscard]] inline int outline_unit(const DepthImage& image) {
    constexpr int kUsualColumns = 640;
    return std::max(1, (image.columns + kUsualColumns / 2) / kUsualColumns);
}

/// The elevation of a pixel of the whole image [px].
class PixelElevation {
  public:
    explicit PixelElevation(const BlendedDepth& depth)
        : from_(depth.from.levels.data()),
          to_(depth.to.levels.data()),
          from_part_(static_cast<float>(depth.px_per_level * (1.0 - depth.blend))),
          to_part_(static_cast<float>(depth.px_per_level * depth.blend)) {}

    [[nodiscard]] float operator()(std::size_t pixel) const {
        return from_[pixel] * from_part_ + to_[pixel] * to_part_;
    }

  private:
    const float* from_;
    const float* to_;
    float from_part_, to_part_;  // of a level [px]
};

/// The elevation [px] of every drawn vertex, row-major. The images have the grid's size.
void drawn_elevations(const BlendedDepth& depth, const ReliefGrid& grid,
                      std::vector<float>& elevations);

}  // namespace dibhr
