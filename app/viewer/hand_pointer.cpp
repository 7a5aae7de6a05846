// The ray under the cursor against the surface.
#include "app/viewer/hand_pointer.hpp"

#include <algorithm>
#include <cmath>

#include "core/haptics/collision.hpp"

namespace dibhr {

namespace {

constexpr double kWheelStep_px = 4.0;

/// Shortens [begin, end] of p = from + s * way to where `axis` of p is in [low, high]; false:
/// nowhere.
bool clip(const Vec3& from, const Vec3& way, int axis, double low, double high, double& begin,
          double& end) {
    if (std::abs(way[axis]) < 1e-12) return from[axis] >= low && from[axis] <= high;
    const double a = (low - from[axis]) / way[axis];
    const double b = (high - from[axis]) / way[axis];
    begin = std::max(begin, std::min(a, b));
    end = std::min(end, std::max(a, b));
    return begin < end;
}

}  // namespace

SurfacePoint surface_under(const Camera::Ray& ray, const DepthSurface& surface) {
    const Vec3 way = ray.far_in_grid - ray.near_in_grid;
    double begin = 0.0;
    double end = 1.0;
    if (!clip(ray.near_in_grid, way, 0, 0.0, surface.columns() - 1.0, begin, end) ||
        !clip(ray.near_in_grid, way, 1, 0.0, surface.rows() - 1.0, begin, end)) {
        return {};
    }
    const Vec3 first = surface.clamped_to_frame(ray.near_in_grid + begin * way);
    const Vec3 last = surface.clamped_to_frame(ray.near_in_grid + end * way);
    if (first.z < surface.elevation_at(first.x, first.y)) return {first, true};
    if (const auto hit = first_hit(surface, first, last)) return {hit->position, true};
    return {};
}

MouseTarget HandPointer::target(const Camera::Ray& ray, const DepthSurface& surface,
                                const PointerUse& use) {
    last_.pressed = use.pressed;
    last_.wheel_px =
        use.pressed ? std::max(0.0, last_.wheel_px + kWheelStep_px * use.wheel_steps) : 0.0;
    if (!use.over_relief && !use.pressed) return last_;
    Vec3 point{0.0};
    if (const SurfacePoint under = surface_under(ray, surface); under.met) {
        point = under.in_grid;
        height_px_ = point.z;
        last_.pointing = true;
    } else {
        const Vec3 way = ray.far_in_grid - ray.near_in_grid;
        if (!last_.pointing || std::abs(way.z) < 1e-9) return last_;
        point = ray.near_in_grid + (height_px_ - ray.near_in_grid.z) / way.z * way;
    }
    last_.cursor_in_grid = {point.x, point.y};
    return last_;
}

}  // namespace dibhr
