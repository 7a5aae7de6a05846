// A surface dilated by a ball is made of pieces: every TRIANGLE moved by the radius along its
// normal, a part of a cylinder around every convex EDGE, a part of a ball around every convex
// VERTEX. Each piece lies over few pixels, together they cover every pixel, and the highest piece
// over a pixel is where the ball rests. On a smooth surface that is about one candidate a pixel
// whatever the radius. A candidate too many does no harm, as each is a point of the surface that
// the ball must not enter. So the code first leaves out pieces, with generous rounding: those not
// convex, those deeper than a ball can get (grounds.hpp), and of pieces over many pixels the part
// where the ball would enter the surface nearby (narrowing.hpp).
#include "core/video/cleaning/fingertip.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "core/video/cleaning/fingertip/image_dilation.hpp"
#include "core/video/cleaning/fingertip/levels.hpp"
#include "core/video/cleaning/fingertip/wide_dilation.hpp"

namespace dibhr {

namespace {

/// Largest level, from 0 [px, level]: beyond, the square of a slope would overflow.
constexpr double kMost_px = 1e17;
constexpr double kMost_level = 1e30;

}  // namespace

struct FingertipDilation::Scratch {
    fingertip::ImageDilation narrow{};
    fingertip::WideDilation wide{};
};

FingertipDilation::FingertipDilation() : scratch_(std::make_unique<Scratch>()) {}
FingertipDilation::~FingertipDilation() = default;
FingertipDilation::FingertipDilation(FingertipDilation&&) noexcept = default;
FingertipDilation& FingertipDilation::operator=(FingertipDilation&&) noexcept = default;

DepthImage FingertipDilation::dilated(const DepthImage& image, const Fingertip& finger,
                                      DepthImage buffer) {
    assert(image.columns >= 2 && image.rows >= 2);
    if (!(finger.radius_px > 0.0) || !(finger.relief_px > 0.0)) return image;
    const double most_level = kMost_px * image.highest_level / finger.relief_px;
    const auto [highest, touchable] =
        fingertip::range_of(image.levels.data(), image.levels.size(),
                            static_cast<float>(std::min(most_level, kMost_level)));
    assert(touchable);
    if (!touchable) return image;
    const double radius_px = std::min(finger.radius_px, kWidestFinger_px);
    if (radius_px > kWidestExactFinger_px) {
        const int step = static_cast<int>(std::ceil(radius_px / kWidestExactFinger_px));
        scratch_->wide.dilate(image, {radius_px, finger.relief_px}, step, highest, buffer);
        return buffer;
    }
    scratch_->narrow.take(image, finger);
    scratch_->narrow.dilate_all();
    buffer.columns = image.columns;
    buffer.rows = image.rows;
    buffer.highest_level = image.highest_level;
    buffer.levels.resize(image.levels.size());
    fingertip::copy_up_to(highest, scratch_->narrow.felt(0), buffer.levels.size(),
                          buffer.levels.data());
    return buffer;
}

}  // namespace dibhr
