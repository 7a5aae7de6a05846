// The orbit of a proxy that friction drags over a plane.
#include "core/experiment/exact_plane.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>

#include "core/metrics/force_variation.hpp"

namespace dibhr {

namespace {

constexpr double kHalfLine_px = 300.0;
constexpr double kRadius_px = 200.0;

}  // namespace

std::vector<Vec3> exact_plane_proxies(std::span<const Vec3> goals, double elevation_px, double mu) {
    std::vector<Vec3> proxies;
    proxies.reserve(goals.size());
    for (const Vec3& goal : goals) {
        const Vec3 foot{goal.x, goal.y, elevation_px};
        const double cone_px = mu * (elevation_px - goal.z);
        if (proxies.empty()) {
            proxies.push_back(foot);
            continue;
        }
        const Vec3 lag = proxies.back() - foot;
        const double distance_px = glm::length(lag);
        const bool sticks = distance_px <= cone_px;
        proxies.push_back(sticks ? proxies.back() : foot + (cone_px / distance_px) * lag);
    }
    return proxies;
}

ExactError error_against(std::span<const Vec3> exact_proxies, std::span<const Vec3> goals,
                         std::span<const Vec3> proxies, std::span<const char> contact) {
    ExactError error;
    std::size_t count = 0;
    for (std::size_t k = 0; k < goals.size(); ++k) {
        if (contact[k] == 0) continue;
        const double off_px = glm::length(proxies[k] - exact_proxies[k]);
        const double off_rad =
            angle_between_rad(proxies[k] - goals[k], exact_proxies[k] - goals[k]);
        error.max_px = std::max(error.max_px, off_px);
        error.max_rad = std::max(error.max_rad, off_rad);
        error.mean_px += off_px;
        error.mean_rad += off_rad;
        ++count;
    }
    if (count > 0) {
        error.mean_px /= static_cast<double>(count);
        error.mean_rad /= static_cast<double>(count);
    }
    return error;
}

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
