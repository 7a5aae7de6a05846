// The goals of the paper's evaluation: a line back and forth and a circle, at a hand's highest
// speed.
#pragma once

#include "core/haptics/parameters.hpp"
#include "core/haptics/vec.hpp"

namespace dibhr {

/// 700 mm/s at 1 kHz: px per update.
inline constexpr double kHandStep_px = 700.0 / kPaperPitch_mm / 1000.0;

/// Where the paper's runs take place: the middle of an image, the goal `depth_px` below elevation
/// `surface_px`.
struct PathPlace {
    double centre_x{0.0};
    double centre_y{0.0};
    double surface_px{0.0};
    double depth_px{20.0};
};

/// Along a row, 300 px to either side of the centre, back and forth; update = 0, 1, 2, ...
[[nodiscard]] Vec3 linear_goal(const PathPlace& place, int update) noexcept;

/// On a circle of radius 200 px around the centre.
[[nodiscard]] Vec3 circle_goal(const PathPlace& place, int update) noexcept;

}  // namespace dibhr
