// What a material looks like, over the colour of the video or of clay.
#pragma once

#include <glm/vec3.hpp>

namespace dibhr {

struct SurfaceLook {
    glm::vec3 tint{1.0F};    ///< red, green, blue, 0 to 1
    double tint_share{0.0};  ///< of the tint in the colour; 0: the video's own colour, 1: only its
                             ///< brightness is the video's
    double gloss{0.0};       ///< of white highlights that bumps break up; 0: none, 1: as of ice
    double fuzz{0.0};        ///< of light that fibres scatter at grazing angles; 0: none, 1: felt

    [[nodiscard]] bool is_plain() const noexcept {
        return tint_share <= 0.0 && gloss <= 0.0 && fuzz <= 0.0;
    }
    bool operator==(const SurfaceLook&) const = default;
};

}  // namespace dibhr
