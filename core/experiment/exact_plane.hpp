// The exact answer on a level plane, and the distance from it.
#pragma once

#include <span>
#include <vector>

#include "core/experiment/experiment.hpp"
#include "core/haptics/parameters.hpp"
#include "core/haptics/vec.hpp"

namespace dibhr {

/// The proxies of goals below the plane z = `elevation_px`: the first straight above its goal, then
/// each either stays or comes to the friction cone, `p_k = g_k + R (p_(k-1) - g_k) / |...|` with
/// `R = mu depth` around the goal's foot g_k.
[[nodiscard]] std::vector<Vec3> exact_plane_proxies(std::span<const Vec3> goals,
                                                    double elevation_px, double mu);

/// Over the updates in contact; all zero when there is none.
[[nodiscard]] ExactError error_against(std::span<const Vec3> exact_proxies,
                                       std::span<const Vec3> goals, std::span<const Vec3> proxies,
                                       std::span<const char> contact);

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
