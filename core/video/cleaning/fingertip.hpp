// A ball as fingertip: dilates the surface, so that a point on it feels what the ball would.
#pragma once

#include <memory>

#include "core/haptics/depth_image.hpp"
#include "core/haptics/vec.hpp"
#include "core/video/frames/cleaning_options.hpp"

namespace dibhr {

class DepthSurface;

/// Largest radius, more than 10 mm at 4K. It bounds time and memory.
inline constexpr double kWidestFinger_px = 512.0;
/// A wider ball is computed at every second pixel, or third and so on, and linearly between them.
inline constexpr double kWidestExactFinger_px = 64.0;

/// A point feels on the dilated image what a ball of the finger's radius feels on the image itself:
/// at every pixel p the level of the ball's lowest point where it comes to rest from above,
///     max over q, |p - q| <= radius, of z(q) + sqrt(radius^2 - |p - q|^2) - radius,
/// over all points q of the triangulated height field (DepthSurface), not only over its vertices;
/// beyond the image's border there is nothing. A level surface stays as it is, ridges are rounded,
/// and what is narrower than the ball cannot be entered.
///
/// Exact but for the rounding of floats up to kWidestExactFinger_px; beyond, planes still are. The
/// same image gives the same bits, whatever came before. Of an image that differs from the last one
/// only the tiles near changes are dilated, by a wider ball also only what it may touch; many tiles
/// take two threads. Scratch memory is kept from image to image: that of three images with the
/// radius more on all sides, 160 radius bytes a column of 400, and 8 (2 radius)^2 bytes; of a wider
/// ball five images.
class FingertipDilation {
  public:
    FingertipDilation();
    ~FingertipDilation();
    FingertipDilation(FingertipDilation&&) noexcept;
    FingertipDilation& operator=(FingertipDilation&&) noexcept;

    /// `image`: at least 2 x 2, without NaN. Returns an image of the same size and highest level,
    /// with no level lower than the original's or above its highest. Where the radius or the relief
    /// is not above 0: the original.
    /// The memory of `buffer` is used for the result.
    [[nodiscard]] DepthImage dilated(const DepthImage& image, const Fingertip& finger,
                                     DepthImage buffer = {});

  private:
    struct Scratch;
    std::unique_ptr<Scratch> scratch_;
};

/// Where the ball whose lowest point is `proxy` (finite, grid space [px]) touches the `original`
/// surface (of images before dilation): the point nearest to the ball's centre, among those less
/// than the radius and one pixel to its side. Between two frames the blend of two dilated images
/// may be a little above the dilated blend: then the ball does not touch, and the point is farther
/// from the centre than the radius. Time grows with the square of the radius: 10 us for 10 px, 0.1
/// ms for 40 px.
[[nodiscard]] Vec3 contact_point(const DepthSurface& original, const Fingertip& finger,
                                 Vec3 proxy) noexcept;

}  // namespace dibhr
