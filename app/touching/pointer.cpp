// Turning and touching with the mouse.
#include "app/touching/pointer.hpp"

#include <algorithm>
#include <cmath>

#include "core/haptics/collision.hpp"

namespace dibhr {

namespace {

constexpr double kOrbit_rad_per_px = 0.006;
constexpr double kZoomPerStep = 1.12;

bool inside(glm::dvec2 p, glm::ivec2 size) {
    return p.x >= 0.0 && p.y >= 0.0 && p.x < size.x && p.y < size.y;
}

constexpr double kWheelStep_px = 4.0;

/// Clips the range [begin, end] of s to where `axis` of from + s * way is in [low, high]; false:
/// nothing is left.
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

PointerUse ReliefMouse::use(const Pointer& pointer, double wheel_steps, bool over_panel,
                            glm::ivec2 viewport, Camera& camera) {
    const bool over_relief = !over_panel && inside(pointer.position_px, viewport);
    const bool any = pointer.left || pointer.right || pointer.middle;
    if (!any) drag_ = Drag::none;
    if (any && drag_ == Drag::none) {
        drag_ = !over_relief                                         ? Drag::panel
                : pointer.left                                       ? Drag::touch
                : pointer.middle || (pointer.right && pointer.shift) ? Drag::pan
                                                                     : Drag::orbit;
        last_px_ = pointer.position_px;  // movement before the press does not turn the view
    }
    const glm::dvec2 moved = pointer.position_px - last_px_;
    last_px_ = pointer.position_px;
    if (drag_ == Drag::orbit)
        camera.orbit(moved.x * kOrbit_rad_per_px, moved.y * kOrbit_rad_per_px);
    if (drag_ == Drag::pan) camera.pan(moved.x, -moved.y, viewport.y);
    const bool touching = drag_ == Drag::touch && pointer.left;
    if (!touching && over_relief && std::abs(wheel_steps) > 0.0)
        camera.zoom(std::pow(kZoomPerStep, wheel_steps));
    const bool free = drag_ == Drag::none && over_relief;
    return {free || touching, touching, touching ? wheel_steps : 0.0};
}

std::optional<Vec3> surface_under(const Camera::Ray& ray, const DepthSurface& surface) {
    const Vec3 way = ray.far_in_grid - ray.near_in_grid;
    double begin = 0.0;
    double end = 1.0;
    if (!clip(ray.near_in_grid, way, 0, 0.0, surface.columns() - 1.0, begin, end) ||
        !clip(ray.near_in_grid, way, 1, 0.0, surface.rows() - 1.0, begin, end)) {
        return {};
    }
    const Vec3 first = surface.clamped_to_frame(ray.near_in_grid + begin * way);
    const Vec3 last = surface.clamped_to_frame(ray.near_in_grid + end * way);
    if (first.z < surface.elevation_at(first.x, first.y)) return first;
    if (const auto hit = first_hit(surface, first, last)) return hit->position;
    return {};
}

MouseTarget HandPointer::target(const Camera::Ray& ray, const DepthSurface& surface,
                                const PointerUse& use) {
    last_.pressed = use.pressed;
    last_.wheel_px =
        use.pressed ? std::max(0.0, last_.wheel_px + kWheelStep_px * use.wheel_steps) : 0.0;
    if (!use.over_relief && !use.pressed) return last_;
    Vec3 point{0.0};
    if (const auto under = surface_under(ray, surface)) {
        point = *under;
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
