// Where the grip's point is in the image: scale, offset, clutch, and the soft boundary.
#pragma once

#include "core/haptics/parameters.hpp"
#include "core/haptics/surface.hpp"
#include "core/haptics/vec.hpp"

namespace dibhr {

/// The hand's volume over the image: the workspace's centre is over the image's middle, half way up
/// the relief.
struct WorkspaceOptions {
    double scale{1.0};  ///< image millimetres a hand millimetre; 0.1 .. 10
    /// Of the image point under the centre; image frame: x right, y up, z to the person.
    Vec3 offset_mm{0.0};
    double centre_z_mm{115.0};  ///< of the usable volume, out of the base; x and y are 0
    double radius_mm{40.0};     ///< beyond it the soft boundary pushes back
    double boundary_newton_per_mm{0.3};

    bool operator==(const WorkspaceOptions&) const = default;
};

/// The image it is laid over.
struct ImageFrame {
    int columns{0};
    int rows{0};
    double relief_px{0.0};
    double pixel_pitch_mm{kPaperPitch_mm};
};

[[nodiscard]] ImageFrame image_frame(const DepthSurface& surface, double pixel_pitch_mm) noexcept;

/// Where a hand rests of which no pose is known yet: over the middle of the image, above all that
/// is there; grid space.
[[nodiscard]] Vec3 above_image(const DepthSurface& surface) noexcept;

/// Lays the device's millimetres over the image; the clutch shifts it. No allocation. Options and
/// images beyond their ranges, or not finite, are taken as the nearest or the usual that is.
class Workspace {
  public:
    /// `grip_mm`: device frame. While `clutched` the point stays where it is in the image and the
    /// hand moves under it; afterwards the point goes on from there: engaging and releasing never
    /// make it jump. A grip that is not finite leaves it where it was.
    [[nodiscard]] Vec3 goal_in_grid(Vec3 grip_mm, bool clutched, const ImageFrame& image,
                                    const WorkspaceOptions& options) noexcept;

    /// Force of the soft boundary on the hand [N], device frame: none within the radius, beyond it
    /// towards the centre. Zero for whatever is not finite.
    [[nodiscard]] static Vec3 boundary_force(Vec3 grip_mm,
                                             const WorkspaceOptions& options) noexcept;

    /// The clutch's shift is forgotten: the next goal is where the grip is.
    void centre() noexcept;

  private:
    Vec3 shift_mm_{0.0};   // image frame, by the clutch
    Vec3 last_goal_{0.0};  // grid space
    bool placed_{false};   // there is a last goal
    bool clutched_{false};
};

/// The scale at which the image, and half the relief, fit into the usable volume; as
/// WorkspaceOptions::scale.
[[nodiscard]] double fitting_scale(const ImageFrame& image,
                                   const WorkspaceOptions& options) noexcept;

/// Hand axes (x right, y up, z to the person) and grid axes (x right, y down, z to the person)
/// differ in the sign of y.
[[nodiscard]] constexpr Vec3 device_axes(Vec3 grid) noexcept {
    return {grid.x, -grid.y, grid.z};
}
[[nodiscard]] constexpr Vec3 grid_axes(Vec3 device) noexcept {
    return {device.x, -device.y, device.z};
}

}  // namespace dibhr
