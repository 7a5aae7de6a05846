// Tells sparse depth, whose seen pixels are spread over the picture, from depth with holes.
#pragma once

#include <optional>

#include "core/haptics/depth_image.hpp"

namespace dibhr {

/// Measures some pictures of a source. Depth is sparse where two fifths of the square of 5 x 5
/// pixels around a seen pixel have no data, on average, and where seen pixels are in two fifths of
/// the picture at least. So holes are everywhere, and not regions, however large.
class SparseMeter {
  public:
    static constexpr int kLeastSide_px = 32;

    /// NaN is no data. A picture with a side below kLeastSide_px, or with hardly any data, is
    /// ignored.
    void add(const DepthImage& image);

    /// Whether a picture was measured.
    [[nodiscard]] bool has_measured() const noexcept { return seen_ > 0.0; }
    /// The share of pixels with data, in (0, 1); nothing: the depth is not sparse.
    [[nodiscard]] std::optional<double> sparse_share() const noexcept;

  private:
    double pixels_{0.0};
    double seen_{0.0};           ///< pixels with data
    double unseen_around_{0.0};  ///< sum over these: the share without data around them
    double covered_{0.0};        ///< likewise: the share of the picture that has data, in tiles
};

}  // namespace dibhr
