// Which strokes show what the hand does.
#include "render/markers.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace dibhr {
namespace {

// After Okabe and Ito's palette, told apart by colour-blind people too; shapes differ besides.
constexpr glm::vec4 kProxyTint{0.16F, 0.56F, 0.95F, 1.0F};
constexpr glm::vec4 kRecordedTint{0.88F, 0.92F, 0.98F, 0.85F};
constexpr glm::vec4 kGoalTint{0.95F, 0.55F, 0.05F, 1.0F};
constexpr glm::vec4 kSpringTint{0.86F, 0.86F, 0.86F, 1.0F};
constexpr glm::vec4 kNormalTint{0.10F, 0.78F, 0.60F, 1.0F};
constexpr glm::vec4 kForceTint{0.98F, 0.90F, 0.25F, 1.0F};

// Radii on the screen [px] in a picture 800 pixels high.
constexpr double kProxyRadius = 7.0;
constexpr double kGoalRadius = 11.0;
constexpr float kGoalHollow = 0.66F;
constexpr double kSpringRadius = 1.4;
constexpr double kNormalRadius = 1.6;
constexpr double kShaftRadius = 2.6;
constexpr double kHeadRadius = 7.5;

constexpr double kNormalLength_px = 60.0;  // grid
constexpr double kHeadLength_px = 16.0;    // grid; a short arrow has a shorter head
constexpr double kLeastForce_newton = 1e-3;
constexpr double kLeastConeHeight_px = 0.5;

glm::vec4 ball(const Camera& camera, Vec3 centre_in_grid, double radius) {
    return {glm::vec3(camera.world_from_grid(centre_in_grid)), static_cast<float>(radius)};
}

/// A direction of grid space in world space: y turns round.
Vec3 upright(Vec3 direction) {
    return {direction.x, -direction.y, direction.z};
}

/// Any unit vector at a right angle to this unit vector.
Vec3 perpendicular(Vec3 unit) {
    const Vec3 other = std::abs(unit.x) < 0.7 ? Vec3(1.0, 0.0, 0.0) : Vec3(0.0, 1.0, 0.0);
    return glm::normalize(glm::cross(unit, other));
}

void add_force_arrow(std::vector<Stroke>& strokes, const TouchMarkers& touch, const Camera& camera,
                     double scale) {
    const double newton = glm::length(touch.force_newton);
    if (!(newton > kLeastForce_newton) || !(touch.newton_per_px > 0.0)) return;
    const Vec3 direction = touch.force_newton / newton;
    const double length_px = newton / touch.newton_per_px;
    const double head_px = std::min(kHeadLength_px, 0.5 * length_px);
    const Vec3 tip = touch.proxy + direction * length_px;
    const Vec3 neck = tip - direction * head_px;
    const double slim = std::min(1.0, length_px / kHeadLength_px);  // weak forces, small arrows
    strokes.push_back({ball(camera, touch.proxy, kShaftRadius * scale),
                       ball(camera, neck, kShaftRadius * scale), kForceTint});
    strokes.push_back({ball(camera, neck, kHeadRadius * scale * slim),
                       ball(camera, tip, 0.8 * scale), kForceTint});
}

}  // namespace

std::vector<Stroke> touch_strokes(const TouchMarkers& touch, const Camera& camera, double scale) {
    std::vector<Stroke> strokes;
    if (!touch.visible || !is_finite(touch.goal) || !is_finite(touch.proxy)) return strokes;
    const glm::vec4 goal = ball(camera, touch.goal, kGoalRadius * scale);
    const glm::vec4 proxy = ball(camera, touch.proxy, kProxyRadius * scale);
    if (touch.contact) {
        const Vec3 normal_end = touch.proxy + touch.normal * kNormalLength_px;
        strokes.push_back({ball(camera, touch.goal, kSpringRadius * scale),
                           ball(camera, touch.proxy, kSpringRadius * scale), kSpringTint});
        strokes.push_back({ball(camera, touch.proxy, kNormalRadius * scale),
                           ball(camera, normal_end, kNormalRadius * scale), kNormalTint});
    }
    if (is_finite(touch.force_newton)) add_force_arrow(strokes, touch, camera, scale);
    if (touch.recorded_proxy && is_finite(*touch.recorded_proxy)) {
        const glm::vec4 recorded = ball(camera, *touch.recorded_proxy, kProxyRadius * scale);
        strokes.push_back({recorded, recorded, kRecordedTint});
    }
    strokes.push_back({goal, goal, kGoalTint, kGoalHollow});
    strokes.push_back({proxy, proxy, kProxyTint});
    return strokes;
}

std::optional<FrictionCone> friction_cone(const TouchMarkers& touch, const Camera& camera) {
    if (!touch.visible || !touch.contact || !(touch.friction > 0.0)) return std::nullopt;
    const double length = glm::length(touch.normal);
    if (!(length > 0.0)) return std::nullopt;
    const Vec3 normal = touch.normal / length;
    const double height_px = glm::dot(touch.proxy - touch.goal, normal);
    if (!(height_px > kLeastConeHeight_px) || !std::isfinite(height_px)) return std::nullopt;
    const Vec3 axis = upright(normal) * height_px;
    const Vec3 u = perpendicular(upright(normal));
    const Vec3 v = glm::cross(upright(normal), u);
    const double radius_px = height_px * touch.friction;
    return FrictionCone{glm::vec3(camera.world_from_grid(touch.goal)), glm::vec3(axis),
                        glm::vec3(u * radius_px), glm::vec3(v * radius_px)};
}

}  // namespace dibhr
