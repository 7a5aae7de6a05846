// The relief with its markers, dent and maps.
#include "app/touching/scene.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/haptics/facet.hpp"
#include "core/haptics/surface.hpp"
#include "core/plot/axes.hpp"
#include "core/video/cleaning/fingertip.hpp"

namespace dibhr {

namespace {

Vec3 normal_at(const DepthSurface& surface, Vec3 p) {
    const Vec3 inside = surface.clamped_to_frame(p);
    const Facet facet(surface, surface.triangle_at(inside.x, inside.y));
    return glm::normalize(Vec3{-facet.slope_x(), -facet.slope_y(), 1.0});
}

/// The algorithm's colour, as in every plot.
glm::vec3 tint_of(Algorithm algorithm) {
    const Ink ink = style_of(algorithm).stroke.ink;
    return glm::vec3(ink.red, ink.green, ink.blue) / 255.0F;
}

/// Adds the ball of a fingertip, which rests on the drawn surface.
void add_finger(const DepthBlend& shown, const SurfaceShape& shape, TouchMarkers& markers) {
    const Fingertip& finger = shown.nearest().cleaning.finger;
    if (!markers.visible || shown.nearest().undilated == nullptr) return;
    markers.finger_px = std::min(finger.radius_px, kWidestFinger_px);
    if (markers.contact && is_finite(markers.proxy))
        markers.finger_contact = contact_point(shown.drawn_surface(shape), finger, markers.proxy);
}

TouchMarkers markers_of(const Settings& settings, const TouchState& state,
                        const DepthSurface& surface) {
    const Touch& touch = state.haptic.touch;
    const Friction& friction = settings.touch.friction;
    TouchMarkers markers;
    markers.visible = state.haptic.touchable;
    markers.contact = touch.proxy.contact;
    markers.catching_up = state.catching_up;
    markers.goal = touch.goal;
    markers.proxy = touch.proxy.position;
    markers.normal = normal_at(surface, touch.proxy.position);
    markers.friction =
        touch.proxy.slipping ? friction.dynamic_coefficient : friction.static_coefficient;
    markers.force_newton = touch.sent_force_newton;
    markers.most_newton = std::min(settings.max_force_newton, state.device.limits.max_force_newton);
    if (state.replay && state.replay->computed) markers.recorded_proxy = state.replay->tick.proxy;
    if (!state.others.empty()) markers.proxy_tint = tint_of(settings.touch.algorithm);
    for (const AlgorithmProxy& other : state.others)
        markers.others.push_back({other.proxy.position, tint_of(other.algorithm)});
    return markers;
}

/// A soft dent, deeper the deeper the goal is pressed in, up to a share of the ball's radius.
Dent dent_under(const TouchMarkers& markers, const DepthImage& image) {
    constexpr double kRadiusPerColumn = 0.02;
    constexpr double kDeepest = 0.45;  // of the radius, so that the dent hides nothing
    constexpr double kShadow = 0.45;
    if (!markers.contact || !is_finite(markers.proxy)) return {};
    const double radius_px = kRadiusPerColumn * image.columns;
    const double pressed = glm::length(markers.proxy - markers.goal) / radius_px;
    const double share = 1.0 - std::exp(-pressed);
    return {markers.proxy, radius_px, kDeepest * radius_px * share, kShadow * (0.4 + 0.6 * share)};
}

}  // namespace

SceneContent scene_content(const Settings& settings, const TouchState& touch,
                           const DepthBlend& shown) {
    SceneContent content;
    content.shape = touch.shape(settings.touch);
    content.bump = touch.bump.get();
    content.relief_style = settings.relief_style;
    content.light_wall = settings.theme == Theme::light;
    if (!shown.makes_surface()) return content;
    content.depth = shown.with_in_betweens();
    content.colour = &shown.colour_frame();
    content.maps = shown.from->maps;
    const DepthSurface surface = shown.surface(content.shape, content.bump);
    content.markers = markers_of(settings, touch, surface);
    add_finger(shown, content.shape, content.markers);
    if (settings.relief_style.dent)
        content.dent = dent_under(content.markers, *shown.from->drawn());
    return content;
}

}  // namespace dibhr
