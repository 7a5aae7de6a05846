// Marks a scene by what its picture is drawn of.
#include "render/scene_mark.hpp"

#include <cmath>
#include <glm/common.hpp>

namespace dibhr {

namespace {

constexpr double kPlaces_per_px = 64.0;
constexpr double kForces_per_newton = 256.0;
constexpr double kShares = 32.0;  // of what lies between 0 and 1

void round_to(double parts, double& value) {
    value = std::round(value * parts) / parts;
}

void round_to(double parts, Vec3& value) {
    value = glm::round(value * parts) / parts;
}

template <typename Value>
void round_to(double parts, std::optional<Value>& value) {
    if (value) round_to(parts, *value);
}

void round_all(TouchMarkers& markers) {
    round_to(kPlaces_per_px, markers.goal);
    round_to(kPlaces_per_px, markers.proxy);
    round_to(kPlaces_per_px, markers.recorded_proxy);
    round_to(kPlaces_per_px, markers.finger_contact);
    round_to(kShares, markers.normal);
    round_to(kForces_per_newton, markers.force_newton);
    for (OtherProxy& other : markers.others) round_to(kPlaces_per_px, other.place);
    for (TracePoint& point : markers.trace) {
        round_to(kPlaces_per_px, point.place);
        round_to(kShares, point.strength);
    }
}

void round_all(Dent& dent) {
    round_to(kPlaces_per_px, dent.at);
    round_to(kPlaces_per_px, dent.depth_px);
    round_to(kShares, dent.shadow);
}

}  // namespace

SceneMark scene_mark(const SceneContent& content, const Camera& camera, glm::ivec2 size) {
    SceneMark mark{.maps = ObjectMark(content.maps),
                   .blend = content.depth.blend,
                   .shape = content.shape,
                   .bump = content.bump,
                   .relief_style = content.relief_style,
                   .look = content.look,
                   .light_wall = content.light_wall,
                   .dent = content.dent,
                   .markers = content.markers,
                   .camera = camera,
                   .size = size};
    if (content.depth.makes_surface()) {
        mark.from = ObjectMark(content.depth.from->drawn());
        mark.to = ObjectMark(content.depth.to->drawn());
        mark.unseen = ObjectMark(content.depth.nearest().unseen);
    }
    if (content.colour != nullptr) mark.colour = ObjectMark(content.colour->colour_object());
    round_all(mark.markers);
    round_all(mark.dent);
    return mark;
}

}  // namespace dibhr
