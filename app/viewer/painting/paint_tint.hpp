// Shows in colour what the brush has painted.
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "app/panels/viewer_state.hpp"
#include "core/haptics/depth_image.hpp"
#include "core/haptics/touch_maps.hpp"
#include "core/video/guide/regions.hpp"

namespace dibhr {

/// By which numbers a painted material is known in the maps, and its colour.
struct PaintedMaterial {
    double stiffness_newton_per_mm{0.0};
    double friction{0.0};
    glm::vec3 tint{1.0F};
};

/// Of the program's and the user's materials, which are read; those that cannot be read are left
/// out.
[[nodiscard]] std::vector<PaintedMaterial> painted_materials();

/// The picture, of any size, coloured by the values of the map of a layer; for materials with the
/// tint of the one with the painted stiffness and friction, and orange where there is none.
[[nodiscard]] ColourImage with_paint(const ColourImage& picture, const TouchMaps& maps,
                                     BrushLayer layer, std::span<const PaintedMaterial> materials);
/// The same with a colour for each region of that label picture.
[[nodiscard]] ColourImage with_regions(const ColourImage& picture, const Regions& regions,
                                       int label_picture);

}  // namespace dibhr
