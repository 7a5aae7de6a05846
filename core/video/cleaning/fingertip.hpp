// A fingertip instead of a point: the surface that a point feels where a ball would touch.
#pragma once

#include <memory>

#include "core/haptics/depth_image.hpp"
#include "core/haptics/vec.hpp"
#include "core/video/frames/cleaning_options.hpp"

namespace dibhr {

class DepthSurface;

/// Wider than 10 mm at 4K. Time and memory are bounded by it.
inline constexpr double kWidestFinger_px = 512.0;
/// A wider one is felt at every second pixel, or third and so on, and linearly between them.
inline constexpr double kWidestExactFinger_px = 64.0;

/// What a point feels on a dilated image, a ball of the finger's radius feels on the image itself:
/// at every pixel p the level of the ball's lowest point where it comes to rest from above,
///     max over q, |p - q| <= radius, of z(q) + sqrt(radius^2 - |p - q|^2) - radius,
/// over all points q of the triangulated height field (DepthSurface), not only over its vertices;
/// beyond the image's border there is nothing. A level surface stays as it is, ridges are rounded,
/// and what is narrower than the ball cannot be entered.
///
/// Exact but for the rounding of floats up to kWidestExactFinger_px; beyond, planes still are. The
/// same image gives the same bits. Scratch memory is kept from image to image: that of two images
/// with the radius more on all sides, 80 radius bytes a column, and 4 (2 radius)^2 bytes.
class FingertipDilation {
  public:
    FingertipDilation();
    ~FingertipDilation();
    FingertipDilation(FingertipDilation&&) noexcept;
    FingertipDilation& operator=(FingertipDilation&&) noexcept;

    /// An image of the same size and highest level, at least 2 x 2, with data everywhere (no NaN).
    /// No level is lower than the original's, none higher than its highest; the original's bits
    /// where the radius or the relief is not above 0.
    [[nodiscard]] DepthImage dilated(const DepthImage& image, const Fingertip& finger);

  private:
    [[nodiscard]] DepthImage exactly_dilated(const DepthImage& image, const Fingertip& finger);

    struct Scratch;
    std::unique_ptr<Scratch> scratch_;
};

/// Where the ball whose lowest point is `proxy` (finite, grid space [px]) touches: the point of the
/// `original` surface, made of the images before they were dilated, that is nearest to the ball's
/// centre, of all points less than the radius and one pixel to its side. Between two frames the
/// blend of two dilated images may be a little above the dilated blend: then the ball floats, and
/// the point is farther from the centre than the radius. Grows with the square of the radius: 10 us
/// for 10 px, 0.1 ms for 40 px.
[[nodiscard]] Vec3 contact_point(const DepthSurface& original, const Fingertip& finger,
                                 Vec3 proxy) noexcept;

}  // namespace dibhr
