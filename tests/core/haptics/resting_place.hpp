// Where a proxy may rest, by a slow search: checks for every TRIANGLE and EDGE around the proxy
// whether it leads nearer to the goal.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>

#include "core/haptics/facet.hpp"
#include "core/haptics/neighbours.hpp"
#include "core/haptics/touch.hpp"

namespace dibhr::test {

/// The point of a triangle nearest to p (Ericson, Real-Time Collision Detection, 5.1.5).
inline Vec3 nearest_on(Vec3 a, Vec3 b, Vec3 c, Vec3 p) {
    const Vec3 ab = b - a, ac = c - a, ap = p - a;
    const double d1 = glm::dot(ab, ap), d2 = glm::dot(ac, ap);
    if (d1 <= 0.0 && d2 <= 0.0) return a;
    const Vec3 bp = p - b;
    const double d3 = glm::dot(ab, bp), d4 = glm::dot(ac, bp);
    if (d3 >= 0.0 && d4 <= d3) return b;
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return a + (d1 / (d1 - d3)) * ab;
    const Vec3 cp = p - c;
    const double d5 = glm::dot(ab, cp), d6 = glm::dot(ac, cp);
    if (d6 >= 0.0 && d5 <= d6) return c;
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return a + (d2 / (d2 - d6)) * ac;
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) {
        return b + ((d4 - d3) / ((d4 - d3) + (d5 - d6))) * (c - b);
    }
    const double sum = va + vb + vc;
    return a + ab * (vb / sum) + ac * (vc / sum);
}

/// The smallest distance from the goal to any triangle that the proxy touches.
inline double nearest_around(const DepthSurface& surface, Vec3 proxy, Vec3 goal) {
    double nearest = glm::length(goal - proxy);
    const int i0 = static_cast<int>(std::floor(proxy.x));
    const int j0 = static_cast<int>(std::floor(proxy.y));
    const auto corner = [&](int i, int j) { return Vec3(i, j, surface.elevation(i, j)); };
    for (int j = std::max(0, j0 - 1); j <= std::min(surface.rows() - 2, j0 + 1); ++j) {
        for (int i = std::max(0, i0 - 1); i <= std::min(surface.columns() - 2, i0 + 1); ++i) {
            const Vec3 triangles[2][3] = {
                {corner(i, j), corner(i + 1, j), corner(i, j + 1)},
                {corner(i + 1, j + 1), corner(i, j + 1), corner(i + 1, j)}};
            for (const auto& t : triangles) {
                if (glm::length(nearest_on(t[0], t[1], t[2], proxy) - proxy) > 1e-9) continue;
                nearest = std::min(nearest, glm::length(nearest_on(t[0], t[1], t[2], goal) - goal));
            }
        }
    }
    return nearest;
}

/// Whether friction holds a proxy back from going to the foot F of the goal on a straight piece.
inline bool is_held(Vec3 proxy, Vec3 foot, Vec3 goal, double mu) {
    return glm::length(proxy - foot) <= mu * glm::length(goal - foot) + 1e-7;
}

/// Whether a TRIANGLE that the proxy touches leads it nearer to the goal, and friction lets it.
inline bool leads_on(const std::array<Vec3, 3>& corners, Vec3 proxy, Vec3 goal, double mu) {
    const auto& [a, b, c] = corners;
    if (glm::length(nearest_on(a, b, c, proxy) - proxy) > 1e-9) return false;
    for (int k = 0; k < 3; ++k) {
        const Vec3 begin = corners[static_cast<std::size_t>(k)];
        const Vec3 along = corners[static_cast<std::size_t>((k + 1) % 3)] - begin;
        const double at = glm::dot(proxy - begin, along) / glm::dot(along, along);
        if (glm::length(begin + at * along - proxy) > 1e-9) continue;  // not on this EDGE
        const double foot_at = glm::dot(goal - begin, along) / glm::dot(along, along);
        const bool is_way = foot_at > at ? at < 1.0 - 1e-6 : at > 1e-6;
        if (is_way && !is_held(proxy, begin + foot_at * along, goal, mu)) return true;
    }
    const Vec3 normal = glm::normalize(glm::cross(b - a, c - a));
    const Vec3 foot = goal - normal * glm::dot(goal - a, normal);
    const Vec3 ahead = proxy + 1e-4 * glm::normalize(foot - proxy);
    const bool is_way = glm::length(nearest_on(a, b, c, ahead) - ahead) <= 1e-9;
    return is_way && !is_held(proxy, foot, goal, mu);
}

/// Whether any TRIANGLE or EDGE around the proxy leads it nearer to the goal, and friction lets it.
inline bool something_leads_on(const DepthSurface& surface, Vec3 proxy, Vec3 goal, double mu) {
    const int i0 = static_cast<int>(std::floor(proxy.x));
    const int j0 = static_cast<int>(std::floor(proxy.y));
    for (int j = std::max(0, j0 - 1); j <= std::min(surface.rows() - 2, j0 + 1); ++j) {
        for (int i = std::max(0, i0 - 1); i <= std::min(surface.columns() - 2, i0 + 1); ++i) {
            const std::array<Vec3, 4> z{surface.vertex_at(i, j), surface.vertex_at(i + 1, j),
                                        surface.vertex_at(i, j + 1),
                                        surface.vertex_at(i + 1, j + 1)};
            if (leads_on({z[0], z[1], z[2]}, proxy, goal, mu)) return true;
            if (leads_on({z[3], z[2], z[1]}, proxy, goal, mu)) return true;
        }
    }
    return false;
}

/// Whether the proxy is in the cone around the goal's foot on the active piece.
inline bool in_cone(const DepthSurface& surface, const Proxy& proxy, Vec3 goal, double mu) {
    Vec3 foot(0.0);
    if (proxy.active.kind == PrimitiveKind::triangle) {
        const Facet facet(surface, proxy.active);
        const Vec3 n = glm::normalize(Vec3(-facet.slope_x(), -facet.slope_y(), 1.0));
        foot = goal - n * glm::dot(goal - proxy.position, n);
    } else if (proxy.active.kind == PrimitiveKind::edge) {
        const EdgeEnds ends = ends_of(proxy.active);
        const Vec3 a(ends.begin_i, ends.begin_j, surface.elevation(ends.begin_i, ends.begin_j));
        const Vec3 b(ends.end_i, ends.end_j, surface.elevation(ends.end_i, ends.end_j));
        const Vec3 along = glm::normalize(b - a);
        foot = a + along * glm::dot(goal - a, along);
    } else {
        return false;
    }
    return glm::length(proxy.position - foot) <= mu * glm::length(goal - foot) + 1e-7;
}

}  // namespace dibhr::test
