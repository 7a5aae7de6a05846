// The near and the far face of each cut cell, and where they end at the outline.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "render/silhouette_layers.hpp"
#include "render/silhouette_rims.hpp"

namespace dibhr {

/// On which face a vertex of a cut cell is; between: in the blur from one to the other.
enum class Face : std::uint8_t { far, near, between };

/// A cut cell: the rims at its corners, and on which face each of them is.
struct OutlineCell {
    std::array<std::uint32_t, 4> rims{};  ///< numbers
    std::array<Face, 4> face{};
    glm::vec2 ends_px{0.0F};  ///< elevations of its far and its near face
};

/// Adds a rim for each corner of the cut cells, with the elevations of the face that the corner is
/// not on, and with the colour of the far face. Returns the cells in the order of the cuts.
[[nodiscard]] std::vector<OutlineCell> join_faces(const CutRelief& relief, Rims& rims);

}  // namespace dibhr
