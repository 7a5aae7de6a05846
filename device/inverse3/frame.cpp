// Rotation between the service's axes and the hand's axes over the image.
#include "device/inverse3/frame.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dibhr::inverse3 {

ImageTilt::ImageTilt(double tilt_deg) noexcept {
    const double tilt = std::isfinite(tilt_deg) ? std::clamp(tilt_deg, 0.0, 90.0) : 0.0;
    cosine_ = std::cos(tilt * std::numbers::pi / 180.0);
    sine_ = std::sin(tilt * std::numbers::pi / 180.0);
}

// Upright: up in the image is the service's z, and out of the image is towards the user (-y). Flat:
// up in the image is forward (y), and out of the image is up (z).
Vec3 ImageTilt::hand_from_service(Vec3 service) const noexcept {
    return {service.x, cosine_ * service.z + sine_ * service.y,
            sine_ * service.z - cosine_ * service.y};
}

Vec3 ImageTilt::service_from_hand(Vec3 hand) const noexcept {
    return {hand.x, sine_ * hand.y - cosine_ * hand.z, cosine_ * hand.y + sine_ * hand.z};
}

double fitting_scale_to_box(const ImageFrame& image, double box_mm) noexcept {
    constexpr double kLeast = 0.1;
    constexpr double kMost = 10.0;
    const double box = std::isfinite(box_mm) ? std::clamp(box_mm, kSmallestBox_mm, kLargestBox_mm)
                                             : kLargestBox_mm;
    const double longest_px =
        std::max({static_cast<double>(image.columns - 1), static_cast<double>(image.rows - 1),
                  std::isfinite(image.relief_px) ? image.relief_px : 0.0});
    const double scale = longest_px * image.pixel_pitch_mm / box;
    return std::isfinite(scale) ? std::clamp(scale, kLeast, kMost) : 1.0;
}

}  // namespace dibhr::inverse3
