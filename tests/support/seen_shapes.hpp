// Shapes of known size as a depth camera sees them, and shapes fitted to points.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "core/video/depth/depth_meaning.hpp"

namespace dibhr::test {

/// 60 degrees wide, without distortion.
inline constexpr int kSeenColumns = 640;
inline constexpr int kSeenRows = 480;
inline const Intrinsics kCamera{320.0 * std::sqrt(3.0), 320.0 * std::sqrt(3.0), 319.5, 239.5};
inline constexpr double kSphere_mm = 100.0;
inline constexpr double kWall_mm = 2500.0;

/// Distances from the camera's plane [mm], row by row; `distance` is that along a ray through
/// (x, y, 1), in the camera's axes: x to the right, y down, z forwards.
template <typename Distance>
[[nodiscard]] std::vector<float> seen(Distance&& distance) {
    std::vector<float> distances_mm;
    for (int j = 0; j < kSeenRows; ++j) {
        for (int i = 0; i < kSeenColumns; ++i) {
            const glm::dvec3 ray{(i - kCamera.cx) / kCamera.fx, (j - kCamera.cy) / kCamera.fy, 1.0};
            distances_mm.push_back(static_cast<float>(distance(ray)));
        }
    }
    return distances_mm;
}

/// A sphere before a wall.
[[nodiscard]] inline std::vector<float> seen_sphere(glm::dvec3 centre_mm) {
    return seen([=](glm::dvec3 ray) {
        const double along = glm::dot(ray, centre_mm) / glm::dot(ray, ray);
        const glm::dvec3 off = along * ray - centre_mm;
        const double inside = kSphere_mm * kSphere_mm - glm::dot(off, off);
        return inside < 0.0 ? kWall_mm : along - std::sqrt(inside / glm::dot(ray, ray));
    });
}

/// A table through a point of the axis, leaning back and to a side by these slopes.
[[nodiscard]] inline std::vector<float> seen_table(double distance_mm, double slope_x,
                                                   double slope_y) {
    return seen([=](glm::dvec3 ray) {
        const double distance = distance_mm / (1.0 - slope_x * ray.x - slope_y * ray.y);
        return distance > 0.0 ? std::min(distance, kWall_mm) : kWall_mm;
    });
}

/// As a sensor of whole millimetres gives them.
[[nodiscard]] inline std::vector<float> in_whole_mm(std::vector<float> distances_mm) {
    for (float& distance : distances_mm) distance = std::round(distance);
    return distances_mm;
}

struct Sphere {
    glm::dvec3 centre{0.0};
    double radius{0.0};
};

/// By least squares of x^2 + y^2 + z^2 = 2 (centre, x) + constant.
[[nodiscard]] inline Sphere fitted_sphere(const std::vector<glm::dvec3>& points) {
    glm::dvec3 mean{0.0};
    for (const glm::dvec3 p : points) mean += p / static_cast<double>(points.size());
    glm::dmat4 squares{0.0};
    glm::dvec4 products{0.0};
    for (const glm::dvec3 p : points) {
        const glm::dvec4 row{p - mean, 1.0};
        squares += glm::outerProduct(row, row);
        products += row * glm::dot(p - mean, p - mean);
    }
    const glm::dvec4 solved = glm::inverse(squares) * products;
    const glm::dvec3 centre = 0.5 * glm::dvec3(solved);
    return {centre + mean, std::sqrt(solved.w + glm::dot(centre, centre))};
}

/// Of the distances to the plane z = a x + b y + c that fits best.
[[nodiscard]] inline double rms_off_plane(const std::vector<glm::dvec3>& points) {
    glm::dmat3 squares{0.0};
    glm::dvec3 products{0.0};
    for (const glm::dvec3 p : points) {
        const glm::dvec3 row{p.x, p.y, 1.0};
        squares += glm::outerProduct(row, row);
        products += row * p.z;
    }
    const glm::dvec3 plane = glm::inverse(squares) * products;
    double sum = 0.0;
    for (const glm::dvec3 p : points) {
        const double off = p.z - glm::dot(plane, glm::dvec3{p.x, p.y, 1.0});
        sum += off * off / (1.0 + plane.x * plane.x + plane.y * plane.y);
    }
    return std::sqrt(sum / static_cast<double>(points.size()));
}

}  // namespace dibhr::test
