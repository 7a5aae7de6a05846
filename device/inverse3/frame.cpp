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

}  // namespace dibhr::inverse3
