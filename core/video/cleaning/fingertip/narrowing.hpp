// Narrows what a ball may touch: it must not enter the surface some pixels away.
#pragma once

#include <array>
#include <cmath>

#include "core/video/cleaning/fingertip/ball.hpp"

namespace dibhr::fingertip {

/// Distances of checked neighbours [px], up to the ball's radius; the nearest is checked elsewhere.
inline constexpr std::array kDistances{2, 4, 8, 16, 32};

/// A point of the surface at one distance from the point that a ball touches.
///
/// In the plane of both, the ball's centre leans x towards the neighbour and is sqrt(reach^2 - x^2)
/// above: it enters the neighbour, `rise` above the touched point, where
///     x distance + sqrt(reach^2 - x^2) rise > (distance^2 + rise^2) / 2,
/// which is where x is above the lower root, as long as the ball has room upright beside the rise.
/// A higher neighbour counts as one of that rise, which the ball enters, too.
struct Neighbour {
    Neighbour(double distance, const Ball& ball)
        : distance_px(static_cast<float>(distance)), radius2(ball.radius * ball.radius) {}

    float distance_px;
    float radius2;

    /// How far the ball's centre may lean towards the neighbour at most [px], if the ball has its
    /// full radius in the plane of both. `cosine`: of the touched EDGE's slope across the plane.
    [[nodiscard, gnu::always_inline]] float most_lean(float rise_px, float cosine) const {
        return most_lean_of(rise_px, cosine, radius2);
    }

    /// Likewise, if the ball's reach in that plane is between a least one and its radius.
    [[nodiscard, gnu::always_inline]] float most_lean_of_less(float rise_px,
                                                              float least_reach2) const {
        return most_lean_of(rise_px, 1.0F, rise_px > 0.0F ? least_reach2 : radius2);
    }

  private:
    [[nodiscard, gnu::always_inline]] float most_lean_of(float rise_px, float cosine,
                                                         float reach2) const {
        const float distance2 = distance_px * distance_px;
        const float upright2 = 2.0F * distance_px * std::sqrt(reach2) - distance2;
        const float upright = std::sqrt(upright2 > 0.0F ? upright2 : 0.0F);
        const float rise = rise_px < upright ? rise_px : upright;
        const float over = rise * cosine;
        const float half = 0.5F * (distance2 + rise * rise);
        const float slant2 = distance2 + over * over;
        const float root2 = reach2 * slant2 - half * half;
        const float root = std::sqrt(root2 > 0.0F ? root2 : 0.0F);
        const float lean = (distance_px * half - over * root) / slant2;
        const bool enters = rise_px > -upright && root2 > 0.0F;
        return enters ? lean : std::sqrt(radius2) + 1.0F;
    }
};

}  // namespace dibhr::fingertip
