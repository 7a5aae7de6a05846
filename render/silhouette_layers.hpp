// The two layers that are drawn where the relief is cut: the near face up to its outline, and what
// is behind, which goes on under the near face as far as it can be seen.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec4.hpp>
#include <vector>

#include "render/blended_depth.hpp"
#include "render/relief_grid.hpp"
#include "render/silhouette_cuts.hpp"

namespace dibhr {

struct Frame;

/// One corner of a triangle of a layer.
struct LayerVertex {
    GridVertex corner{};       ///< its place
    GridVertex source{};       ///< the drawn vertex of its face whose light and bumps it has
    float elevation_px{0.0F};  ///< without bumps
    float far_px{0.0F};   ///< of the faces here; a fragment nearer to far than to near is beyond
    float near_px{0.0F};  ///< the outline
    std::array<std::uint8_t, 4> fill{};  ///< red, green, blue from behind; 255: no light
                                         ///< of its own, as far under or at a side
};

struct SilhouetteLayer {
    std::vector<LayerVertex> vertices{};
    std::vector<std::uint32_t> indices{};  ///< three a triangle
};

struct SilhouetteLayers {
    SilhouetteLayer behind{};  ///< the far face in the cut cells
    SilhouetteLayer under{};   ///< its continuation where the near face covers it straight on
    SilhouetteLayer front{};   ///< the near face in the cut cells
};

/// What the layers are made from.
struct CutRelief {
    const BlendedDepth& depth;
    const ReliefGrid& grid;
    const std::vector<float>& elevations;  ///< of drawn_elevations()
    const SilhouetteCuts& cuts;
    const Frame* colour{nullptr};           ///< whose colour is continued; null: the fill is black
    glm::vec4 eye{0.0F, 0.0F, 1.0F, 0.0F};  ///< in grid space, homogeneous
};

void build_layers(const CutRelief& relief, SilhouetteLayers& layers);

}  // namespace dibhr
