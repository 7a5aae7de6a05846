// Maps the grip's position into the image: scale, offset, clutch, and the soft boundary.
#pragma once

#include "core/haptics/parameters.hpp"
#include "core/haptics/surface.hpp"
#include "core/haptics/vec.hpp"

namespace dibhr {

/// How the hand's volume lies over the image: without an offset, the centre of the workspace is at
/// the middle of the image, half way up the relief.
struct WorkspaceOptions {
    double scale{1.0};  ///< image millimetres per hand millimetre; 0.1 .. 10
    /// Offset of the workspace's centre in the image; x right, y up, z to the user.
    Vec3 offset_mm{0.0};
    double centre_z_mm{115.0};  ///< centre of the usable volume, out of the base; x and y are 0
    double radius_mm{40.0};     ///< beyond this radius the soft boundary pushes back
    double boundary_newton_per_mm{0.3};

    bool operator==(const WorkspaceOptions&) const = default;
};

/// The image under the workspace.
struct ImageFrame {
    int columns{0};
    int rows{0};
    double relief_px{0.0};
    double pixel_pitch_mm{kPaperPitch_mm};
};

[[nodiscard]] ImageFrame image_frame(const DepthSurface& surface, double pixel_pitch_mm) noexcept;

/// The goal while no pose is known yet: over the middle of the image, above the whole relief; grid
/// space.
[[nodiscard]] Vec3 above_image(const DepthSurface& surface) noexcept;

/// Maps device millimetres to grid space; the clutch shifts the mapping. No allocation. Values out
/// of range are clamped; values that are not finite are replaced by their defaults.
class Workspace {
  public:
    /// `grip_mm`: device frame. While `clutched`, the goal stays where it is in the image while the
    /// hand moves; afterwards it continues from there: the clutch never makes the goal jump. A grip
    /// position that is not finite leaves the goal unchanged.
    [[nodiscard]] Vec3 goal_in_grid(Vec3 grip_mm, bool clutched, const ImageFrame& image,
                                    const WorkspaceOptions& options) noexcept;

    /// Force of the soft boundary on the hand [N], device frame: zero within the radius, beyond it
    /// towards the centre. Zero for values that are not finite.
    [[nodiscard]] static Vec3 boundary_force(Vec3 grip_mm,
                                             const WorkspaceOptions& options) noexcept;

    /// Resets the shift of the clutch.
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

/// Range of the comfortable box's edge [mm].
inline constexpr double kSmallestBox_mm = 20.0;
inline constexpr double kLargestBox_mm = 200.0;

/// The scale at which the image's longer side, and half its relief, fit into a box of that edge.
[[nodiscard]] double fitting_scale_to_box(const ImageFrame& image, double box_mm) noexcept;

/// Hand axes (x right, y up, z to the user) and grid axes (x right, y down, z to the user) differ
/// in the sign of y.
[[nodiscard]] constexpr Vec3 device_axes(Vec3 grid) noexcept {
    return {grid.x, -grid.y, grid.z};
}
[[nodiscard]] constexpr Vec3 grid_axes(Vec3 device) noexcept {
    return {device.x, -device.y, device.z};
}

}  // namespace dibhr
