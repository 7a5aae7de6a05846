// What a picture of the scene is drawn of, as values that compare.
#pragma once

#include <glm/vec2.hpp>

#include "core/haptics/parameters.hpp"
#include "render/camera.hpp"
#include "render/object_mark.hpp"
#include "render/scene_view.hpp"

namespace dibhr {

/// Of two scenes with equal marks SceneView::draw() makes pictures that look the same.
struct SceneMark {
    ObjectMark from{}, to{};  ///< the drawn depth images
    ObjectMark unseen{}, colour{}, maps{};
    double blend{0.0};
    SurfaceShape shape{};
    const BumpMap* bump{nullptr};
    ReliefStyle relief_style{};
    SurfaceLook look{};
    bool light_wall{false};
    Dent dent{};
    TouchMarkers markers{};
    Camera camera{};
    glm::ivec2 size{0};

    bool operator==(const SceneMark&) const = default;
};

/// Rounds the markers to less than a pixel and a hundredth of a newton, so that the last digits of
/// a hand that rests make no difference.
[[nodiscard]] SceneMark scene_mark(const SceneContent& content, const Camera& camera,
                                   glm::ivec2 size);

}  // namespace dibhr
