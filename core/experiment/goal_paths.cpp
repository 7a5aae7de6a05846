// The line and the circle.
#include "core/experiment/goal_paths.hpp"

#include <cmath>

namespace dibhr {

namespace {

constexpr double kHalfLine_px = 300.0;
constexpr double kRadius_px = 200.0;

}  // namespace

Vec3 linear_goal(const PathPlace& place, int update) noexcept {
    const double gone = std::fmod(update * kHandStep_px, 4.0 * kHalfLine_px);
    const double x = gone < 2.0 * kHalfLine_px ? gone : 4.0 * kHalfLine_px - gone;
    return {place.centre_x - kHalfLine_px + x, place.centre_y, place.surface_px - place.depth_px};
}

Vec3 circle_goal(const PathPlace& place, int update) noexcept {
    const double turned_rad = update * kHandStep_px / kRadius_px;
    return {place.centre_x + kRadius_px * std::cos(turned_rad),
            place.centre_y + kRadius_px * std::sin(turned_rad), place.surface_px - place.depth_px};
}

}  // namespace dibhr
