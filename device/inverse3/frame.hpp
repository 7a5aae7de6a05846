// Rotation between the service's axes and the hand's axes over the image.
#pragma once

#include "core/haptics/vec.hpp"
#include "device/hand/workspace.hpp"

namespace dibhr::inverse3 {

/// Turns the service's axes (x right, y forward, z up) into the hand's over the image (x right, y
/// up, z to the person), with the image upright (0) to lying flat on the table (90 degrees).
class ImageTilt {
  public:
    /// Values outside 0 .. 90 are clamped.
    explicit ImageTilt(double tilt_deg) noexcept;
    [[nodiscard]] Vec3 hand_from_service(Vec3 service) const noexcept;
    [[nodiscard]] Vec3 service_from_hand(Vec3 hand) const noexcept;

  private:
    double cosine_{1.0};
    double sine_{0.0};
};

}  // namespace dibhr::inverse3
