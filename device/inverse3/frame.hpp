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

/// Range of the comfortable box's edge [mm].
inline constexpr double kSmallestBox_mm = 20.0;
inline constexpr double kLargestBox_mm = 200.0;

/// The scale at which the image's longer side, and half its relief, fit into a box of that edge.
[[nodiscard]] double fitting_scale_to_box(const ImageFrame& image, double box_mm) noexcept;

}  // namespace dibhr::inverse3
