// Camera: its matrices, and the ray under the cursor.
#include "render/camera.hpp"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/ext/matrix_clip_space.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>
#include <numbers>

namespace dibhr {
namespace {

constexpr double kHomeYaw_rad = 20.0 * std::numbers::pi / 180.0;
constexpr double kHomePitch_rad = 12.0 * std::numbers::pi / 180.0;
constexpr double kMostPitch_rad = 85.0 * std::numbers::pi / 180.0;
constexpr double kFrontYaw_rad = 60.0 * std::numbers::pi / 180.0;
constexpr double kFrontPitch_rad = 40.0 * std::numbers::pi / 180.0;
constexpr double kDistanceInRadii = 3.2;  // a weak perspective, about 35 degrees of view
constexpr double kMargin = 1.03;          // free space around the relief
constexpr double kLeastZoom = 0.2;
constexpr double kMostZoom = 50.0;
constexpr double kDepthInRadii = 3.0;  // of the clip planes, before and behind the middle

glm::dmat4 turn(double yaw_rad, double pitch_rad) {
    const glm::dmat4 pitched = glm::rotate(glm::dmat4(1.0), pitch_rad, glm::dvec3(1.0, 0.0, 0.0));
    return glm::rotate(pitched, yaw_rad, glm::dvec3(0.0, 1.0, 0.0));
}

/// Half the height of the view, so that the whole extent is in view at this aspect.
double half_height(glm::dvec2 half_extent, double aspect) {
    return std::max(half_extent.y, half_extent.x / aspect);
}

}  // namespace

void Camera::frame_relief(int columns, int rows, double relief_px) {
    columns_ = std::max(columns, 1);
    rows_ = std::max(rows, 1);
    relief_px_ = relief_px;
    reset();
}

void Camera::reset() {
    yaw_rad_ = kHomeYaw_rad;
    pitch_rad_ = kHomePitch_rad;
    zoom_ = 1.0;
    centre_in_world_ = Vec3(0.0, 0.0, 0.5 * relief_px_);
}

void Camera::orbit(double yaw_rad, double pitch_rad) {
    yaw_rad_ += yaw_rad;
    pitch_rad_ = std::clamp(pitch_rad_ + pitch_rad, -kMostPitch_rad, kMostPitch_rad);
}

void Camera::keep_in_front() {
    yaw_rad_ = std::clamp(yaw_rad_, -kFrontYaw_rad, kFrontYaw_rad);
    pitch_rad_ = std::clamp(pitch_rad_, -kFrontPitch_rad, kFrontPitch_rad);
}

void Camera::pan(double right_px, double up_px, int viewport_height) {
    const double scale = projection_ == Projection::perspective ? distance_px() : 1.0;
    const double free_px = free_share() * std::max(viewport_height, 1);
    const double world_per_px = 2.0 * half_extent().y * scale / free_px;
    const glm::dmat3 world_from_view = glm::transpose(glm::dmat3(view_from_world()));
    centre_in_world_ -= world_from_view * Vec3(right_px, up_px, 0.0) * world_per_px;
}

void Camera::zoom(double factor) {
    if (factor > 0.0) zoom_ = std::clamp(zoom_ * factor, kLeastZoom, kMostZoom);
}

void Camera::close_up(Vec3 centre_in_grid, double radius_px) {
    centre_in_world_ = world_from_grid(centre_in_grid);
    zoom_ = 1.0;
    const double scale = projection_ == Projection::perspective ? distance_px() : 1.0;
    zoom(half_extent().y * scale / std::max(radius_px, 1e-3));
}

void Camera::set_view(const View& view) {
    yaw_rad_ = view.yaw_rad;
    pitch_rad_ = 0.0;
    orbit(0.0, view.pitch_rad);
    zoom_ = 1.0;
    zoom(view.zoom);
    constexpr double kFarthest = 4.0;  // the relief would be out of sight
    const Vec3 bound(kFarthest * radius_px());
    centre_in_world_ = glm::clamp(view.centre_in_world, -bound, bound);
}

void Camera::set_covered_below(double share) {
    covered_below_ = std::clamp(share, 0.0, 0.5);
}

double Camera::radius_px() const {
    return 0.5 * glm::length(Vec3(columns_, rows_, relief_px_));
}

double Camera::distance_px() const {
    return kDistanceInRadii * radius_px();
}

/// Half width and height of the view: tangents in perspective, pixels in the straight projection.
glm::dvec2 Camera::half_extent() const {
    const glm::dvec2 half(0.5 * columns_, 0.5 * rows_);
    if (projection_ == Projection::straight) return half * (kMargin / zoom_);
    const glm::dmat3 home(turn(kHomeYaw_rad, kHomePitch_rad));
    glm::dvec2 most(0.0);
    for (int corner = 0; corner < 8; ++corner) {
        const Vec3 sign(corner & 1 ? 1.0 : -1.0, corner & 2 ? 1.0 : -1.0, corner & 4 ? 1.0 : -1.0);
        const Vec3 p = home * (sign * Vec3(half, 0.5 * relief_px_));
        most = glm::max(most, glm::abs(glm::dvec2(p)) / (distance_px() - p.z));
    }
    return most * (kMargin / zoom_);
}

glm::dmat4 Camera::view_from_world() const {
    const bool straight = projection_ == Projection::straight;
    const glm::dmat4 turned = straight ? glm::dmat4(1.0) : turn(yaw_rad_, pitch_rad_);
    const glm::dmat4 back = glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, 0.0, -distance_px()));
    return back * turned * glm::translate(glm::dmat4(1.0), -centre_in_world_);
}

glm::dmat4 Camera::clip_from_view(double aspect) const {
    const double reach = kDepthInRadii * radius_px();
    const double near_px = distance_px() - reach;
    const double far_px = distance_px() + reach;
    const double free_aspect = aspect / free_share();
    const double up = half_height(half_extent(), free_aspect);
    const double right = up * free_aspect;
    const double down = up * (2.0 / free_share() - 1.0);
    if (projection_ == Projection::straight)
        return glm::ortho(-right, right, -down, up, near_px, far_px);
    return glm::frustum(-right * near_px, right * near_px, -down * near_px, up * near_px, near_px,
                        far_px);
}

glm::dmat4 Camera::clip_from_grid(double aspect) const {
    const glm::dmat4 upright = glm::scale(glm::dmat4(1.0), glm::dvec3(1.0, -1.0, 1.0));
    const glm::dmat4 world_from_grid = glm::translate(upright, -grid_from_world(Vec3(0.0)));
    return clip_from_view(aspect) * view_from_world() * world_from_grid;
}

Vec3 Camera::grid_from_world(Vec3 world) const {
    return {world.x + 0.5 * (columns_ - 1), 0.5 * (rows_ - 1) - world.y, world.z};
}

Vec3 Camera::world_from_grid(Vec3 grid) const {
    return {grid.x - 0.5 * (columns_ - 1), 0.5 * (rows_ - 1) - grid.y, grid.z};
}

Camera::Ray Camera::ray_under(glm::dvec2 screen_px, glm::ivec2 viewport) const {
    const glm::dvec2 size(std::max(viewport.x, 1), std::max(viewport.y, 1));
    const glm::dvec2 ndc(2.0 * screen_px.x / size.x - 1.0, 1.0 - 2.0 * screen_px.y / size.y);
    const glm::dmat4 world_from_clip =
        glm::inverse(clip_from_view(size.x / size.y) * view_from_world());
    const auto unproject = [&](double depth) {
        const glm::dvec4 p = world_from_clip * glm::dvec4(ndc, depth, 1.0);
        return grid_from_world(Vec3(p) / p.w);
    };
    return {unproject(-1.0), unproject(1.0)};
}

}  // namespace dibhr
