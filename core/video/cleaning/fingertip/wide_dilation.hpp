// Dilates an image by a wide ball: by a first ball, and a second one at some of the pixels.
#pragma once

#include <cstddef>
#include <vector>

#include "core/haptics/depth_image.hpp"
#include "core/video/cleaning/fingertip/ball.hpp"
#include "core/video/cleaning/fingertip/grounds.hpp"
#include "core/video/cleaning/fingertip/image_dilation.hpp"
#include "core/video/cleaning/fingertip/squares.hpp"
#include "core/video/cleaning/fingertip/tiles.hpp"

namespace dibhr::fingertip {

/// One ball dilates like two after each other whose radii add up to its own. After the first one
/// the surface is smooth enough to be thinned out to every `step`-th pixel. Only what the second
/// ball may touch is dilated by the first one, and where the result of the first may be above what
/// lies between the pixels of the second. The bits are those of dilating all.
class WideDilation {
  public:
    /// `most`: the image's highest level. The result has the image's size.
    void dilate(const DepthImage& image, const Fingertip& finger, int step, float most,
                DepthImage& result);

  private:
    /// Of a cell, whose origin is a thinned pixel and which is `step` wide: an upper bound of its
    /// pixels' levels after the first ball.
    class Bound {
      public:
        void find(const DepthImage& image, const DepthImage& thinned, int step, const Ball& first);
        /// For each thinned pixel of a row.
        [[nodiscard]] const float* row(int row) const { return levels_.data() + at(row); }

      private:
        [[nodiscard]] std::size_t at(int row) const;
        void find_highest(const DepthImage& image, int step);
        void widen(const Ball& first, int step);

        int columns_{0}, rows_{0}, pitch_{0};
        std::vector<float> levels_{}, highest_{}, row_{};
    };

    [[nodiscard]] Tiles touched_by_rest(const DepthImage& image, const Ball& rest);
    [[nodiscard]] Tiles above_coarse(const DepthImage& image) const;
    void find_coarse(const DepthImage& image, const Fingertip& rest, float most);
    void raise_between(float most, DepthImage& result);
    void stretch(int coarse_row, std::vector<float>& levels) const;

    int step_{1};
    ImageDilation fine_{}, second_{};
    DepthImage coarse_{};  ///< every step-th pixel; then dilated
    Bound bound_{};
    PaddedImage lowest_{};  ///< the thinned image, a lower bound of the dilated one
    Squares squares_{};
    Grounds grounds_{};
    std::vector<float> upper_{}, lower_{};  ///< rows of the coarse image, stretched
};

}  // namespace dibhr::fingertip
