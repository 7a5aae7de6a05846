// The exact answer on a level plane, and the distance from it.
#pragma once

#include <span>
#include <vector>

#include "core/experiment/experiment.hpp"
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

}  // namespace dibhr
