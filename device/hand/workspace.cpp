// Maps the grip's position into the image: scale, offset, clutch, and the soft boundary.
#include "device/hand/workspace.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace dibhr {

namespace {

constexpr double kLeastScale = 0.1;
constexpr double kMostScale = 10.0;
constexpr double kAboveAll_px = 6.0;

double or_usual(double value, double usual) noexcept {
    return std::isfinite(value) ? value : usual;
}

double scale_within_range(double scale) noexcept {
    return std::clamp(or_usual(scale, WorkspaceOptions{}.scale), kLeastScale, kMostScale);
}

double pitch_mm(const ImageFrame& image) noexcept {
    const bool usable = std::isfinite(image.pixel_pitch_mm) && image.pixel_pitch_mm > 0.0;
    return usable ? image.pixel_pitch_mm : ImageFrame{}.pixel_pitch_mm;
}

Vec3 from_centre_mm(Vec3 grip_mm, const WorkspaceOptions& options) noexcept {
    return grip_mm - Vec3{0.0, 0.0, or_usual(options.centre_z_mm, WorkspaceOptions{}.centre_z_mm)};
}

/// Middle of the image at half the height of the relief: the point under the workspace's centre
/// without offset and shift.
Vec3 middle_in_grid(const ImageFrame& image) noexcept {
    return 0.5 * Vec3{image.columns - 1, image.rows - 1, or_usual(image.relief_px, 0.0)};
}

}  // namespace

ImageFrame image_frame(const DepthSurface& surface, double pixel_pitch_mm) noexcept {
    return {surface.columns(), surface.rows(), surface.ceiling(), pixel_pitch_mm};
}

Vec3 above_image(const DepthSurface& surface) noexcept {
    return {0.5 * (surface.columns() - 1), 0.5 * (surface.rows() - 1),
            surface.ceiling() + kAboveAll_px};
}

Vec3 Workspace::goal_in_grid(Vec3 grip_mm, bool clutched, const ImageFrame& image,
                             const WorkspaceOptions& options) noexcept {
    const double pitch = pitch_mm(image);
    const Vec3 offset_mm = is_finite(options.offset_mm) ? options.offset_mm : Vec3{0.0};
    const Vec3 point_mm =
        scale_within_range(options.scale) * from_centre_mm(grip_mm, options) + offset_mm;
    const Vec3 middle = middle_in_grid(image);
    const Vec3 unshifted = middle + grid_axes(point_mm) / pitch;
    if (!is_finite(unshifted)) return placed_ ? last_goal_ : middle;

    // The goal also stays in the tick that engages the clutch and in the one that releases it.
    if (placed_ && (clutched || clutched_)) {
        shift_mm_ = device_axes(last_goal_ - unshifted) * pitch;
    } else {
        last_goal_ = unshifted + grid_axes(shift_mm_) / pitch;
    }
    placed_ = true;
    clutched_ = clutched;
    return last_goal_;
}

Vec3 Workspace::boundary_force(Vec3 grip_mm, const WorkspaceOptions& options) noexcept {
    const Vec3 way_mm = from_centre_mm(grip_mm, options);
    const double distance_mm = glm::length(way_mm);
    const double beyond_mm = distance_mm - std::max(options.radius_mm, 0.0);
    if (!(beyond_mm > 0.0) || !(options.boundary_newton_per_mm > 0.0)) return Vec3{0.0};
    const Vec3 force = -options.boundary_newton_per_mm * beyond_mm / distance_mm * way_mm;
    return is_finite(force) ? force : Vec3{0.0};
}

void Workspace::centre() noexcept {
    *this = Workspace{};
}

double fitting_scale(const ImageFrame& image, const WorkspaceOptions& options) noexcept {
    // The corners of the box that image and relief fill touch the sphere.
    const double corner_mm = glm::length(middle_in_grid(image)) * pitch_mm(image);
    return scale_within_range(corner_mm / options.radius_mm);
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

}  // namespace dibhr
