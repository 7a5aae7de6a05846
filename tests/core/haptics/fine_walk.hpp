// A reference for DIBHR that does not use EDGEs and VERTEXes: it creeps over the surface.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <glm/geometric.hpp>

#include "core/haptics/dibhr.hpp"
#include "core/haptics/facet.hpp"
#include "core/haptics/surface.hpp"

namespace dibhr::test {

/// Walks downhill on the distance to the goal in steps of a hundredth of a pixel, each along the
/// facet under it, or along the grid where that leads no nearer (in a crease), and stops in the
/// friction cone of its way or where no step leads nearer.
class FineWalk {
  public:
    explicit FineWalk(Vec3 start) : proxy_(start) {}

    Vec3 update(const DepthSurface& surface, Vec3 goal, double mu) {
        while (step_along_facet(surface, goal, mu) || step_along_grid(surface, goal, mu)) {
        }
        return proxy_;
    }

  private:
    static constexpr double kStep_px = 0.01;

    bool step_along_facet(const DepthSurface& surface, Vec3 goal, double mu) {
        const Facet facet(surface, surface.triangle_at(proxy_.x, proxy_.y));
        const Vec3 normal = glm::normalize(Vec3(-facet.slope_x(), -facet.slope_y(), 1.0));
        const Vec3 way = goal + glm::dot(proxy_ - goal, normal) * normal - proxy_;
        return glm::length(way) > 0.0 && step(surface, goal, mu, glm::normalize(way));
    }

    bool step_along_grid(const DepthSurface& surface, Vec3 goal, double mu) {
        for (int j = -1; j <= 1; ++j) {
            for (int i = -1; i <= 1; ++i) {
                if (i == 0 && j == 0) continue;
                const Vec3 ahead = on(surface, proxy_ + 0.5 * kStep_px * Vec3(i, j, 0.0));
                if (ahead != proxy_ && step(surface, goal, mu, glm::normalize(ahead - proxy_)))
                    return true;
            }
        }
        return false;
    }

    /// False when the cone holds it or the step leads no nearer.
    bool step(const DepthSurface& surface, Vec3 goal, double mu, Vec3 along) {
        const double to_foot = glm::dot(goal - proxy_, along);
        const double to_cone = to_foot - mu * glm::length(goal - proxy_ - to_foot * along);
        if (to_cone <= 1e-9) return false;
        const Vec3 next = on(surface, proxy_ + std::min(to_cone, kStep_px) * along);
        if (glm::length(goal - next) >= glm::length(goal - proxy_) - 1e-12) return false;
        proxy_ = next;
        return true;
    }

    static Vec3 on(const DepthSurface& surface, Vec3 p) {
        p = surface.clamped_to_frame(p);
        return {p.x, p.y, surface.elevation_at(p.x, p.y)};
    }

    Vec3 proxy_;
};

/// The angle between DIBHR's force and the reference's, in degrees, for each goal after the first.
/// The goals stay under the surface.
inline std::vector<double> angles_to_fine_walk(const DepthSurface& surface,
                                               const std::vector<Vec3>& goals, double mu) {
    std::vector<double> angles_deg;
    Dibhr dibhr;
    FineWalk reference(dibhr.update(surface, goals.front(), {mu, mu}).position);
    for (std::size_t k = 1; k < goals.size(); ++k) {
        const Vec3 force = dibhr.update(surface, goals[k], {mu, mu}).position - goals[k];
        const Vec3 expected = reference.update(surface, goals[k], mu) - goals[k];
        angles_deg.push_back(
            std::atan2(glm::length(glm::cross(force, expected)), glm::dot(force, expected)) *
            180.0 / 3.14159265358979323846);
    }
    return angles_deg;
}

inline double median_of(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

}  // namespace dibhr::test
