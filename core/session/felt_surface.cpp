// How far the motion is read.
#include "core/session/felt_surface.hpp"

namespace dibhr {

PixelBox motion_box(const MotionField& motion, const PixelBox& read) noexcept {
    const auto pixel = [](double at, int count) {
        return static_cast<int>(at > 0.0 ? std::min(at, count - 1.0) : 0.0);
    };
    float longest = 0.0F;
    for (int j = pixel(read.top, motion.rows); j <= pixel(read.bottom, motion.rows); ++j) {
        for (int i = pixel(read.left, motion.columns); i <= pixel(read.right, motion.columns);
             ++i) {
            const MotionField::Way& way = motion.at(i, j);
            longest = std::max({longest, std::abs(way.right), std::abs(way.down)});
        }
    }
    return read.wider(2.0 * static_cast<double>(longest));
}

}  // namespace dibhr
