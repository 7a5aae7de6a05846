// The scene of one picture, and the facts of a session.
#include "app/viewer/scene.hpp"

#include <glm/geometric.hpp>

#include "core/files/plain_text.hpp"
#include "core/haptics/facet.hpp"
#include "core/haptics/parameter_table.hpp"
#include "core/haptics/surface.hpp"
#include "core/video/libraries.hpp"

namespace dibhr {

namespace {

Vec3 normal_at(const DepthSurface& surface, Vec3 p) {
    const Vec3 inside = surface.clamped_to_frame(p);
    const Facet facet(surface, surface.triangle_at(inside.x, inside.y));
    return glm::normalize(Vec3{-facet.slope_x(), -facet.slope_y(), 1.0});
}

TouchMarkers markers_of(const ViewerState& state, const DepthSurface& surface) {
    const Touch& touch = state.haptic.touch;
    const Friction& friction = state.settings.touch.friction;
    TouchMarkers markers;
    markers.visible = state.haptic.touchable;
    markers.contact = touch.proxy.contact;
    markers.goal = touch.goal;
    markers.proxy = touch.proxy.position;
    markers.normal = normal_at(surface, touch.proxy.position);
    markers.friction =
        touch.proxy.slipping ? friction.dynamic_coefficient : friction.static_coefficient;
    markers.force_newton = touch.sent_force_newton;
    if (state.replay && state.replay->computed) {
        const double(&proxy)[3] = state.replay->tick.proxy;
        markers.recorded_proxy = Vec3{proxy[0], proxy[1], proxy[2]};
    }
    return markers;
}

}  // namespace

SceneContent scene_content(const ViewerState& state, const DepthBlend& shown) {
    SceneContent content;
    content.shape = state.settings.touch.shape;
    content.bump = state.bump.get();
    content.look = state.settings.look;
    if (!shown.makes_surface()) return content;
    content.depth = shown;
    content.colour = shown.from;
    const DepthSurface surface = shown.surface(content.shape, content.bump);
    content.markers = markers_of(state, surface);
    return content;
}

std::map<std::string, std::string> session_facts(const ViewerState& state) {
    std::map<std::string, std::string> facts{
        {"program", "dibhr " DIBHR_VERSION},
        {"device", state.device.name},
        {"device-max-force", number_text(state.device.limits.max_force_newton)},
        {"device-max-stiffness", number_text(state.device.limits.max_stiffness_newton_per_mm)},
        {"device-workspace-mm", number_text(state.device.workspace_mm.x) + " x " +
                                    number_text(state.device.workspace_mm.y) + " x " +
                                    number_text(state.device.workspace_mm.z)},
        {"algorithm", name_of(state.settings.touch.algorithm)},
        {"colour", state.media.colour_path.string()},
        {"depth", state.media.depth_path.string()},
        {"depth-columns", std::to_string(state.media.depth_columns)},
        {"depth-rows", std::to_string(state.media.depth_rows)},
        {"bump", state.bump_file.string()},
        {"max-force", number_text(state.settings.max_force_newton)},
    };
    facts.merge(library_versions());
    for (const TouchNumber& number : touch_numbers()) {
        facts.emplace(std::string(number.name), number_text(number.of(state.settings.touch)));
    }
    const CleaningOptions& cleaning = state.settings.cleaning;
    facts.emplace("fill-holes", cleaning.fill_holes ? "yes" : "no");
    facts.emplace("remove-spikes", cleaning.remove_spikes ? "yes" : "no");
    facts.emplace("smooth-steps", cleaning.smooth_steps ? "yes" : "no");
    if (state.falcon) {
        FalconSettings falcon = state.settings.falcon;
        facts.emplace("falcon-serial", state.falcon->status.serial);
        for (const FalconNumber& number : falcon_numbers()) {
            facts.emplace("falcon-" + std::string(number.name), number_text(number.in(falcon)));
        }
    }
    return facts;
}

}  // namespace dibhr
