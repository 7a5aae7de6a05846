// From rays to pixels and back.
#include "core/video/depth/camera.hpp"

#include <cmath>
#include <cstddef>
#include <limits>

namespace dibhr {

namespace {

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

cv::Point2d tangential_shift(const Lens& lens, cv::Point2d ray) {
    const double r2 = ray.dot(ray);
    return {2.0 * lens.p1 * ray.x * ray.y + lens.p2 * (r2 + 2.0 * ray.x * ray.x),
            lens.p1 * (r2 + 2.0 * ray.y * ray.y) + 2.0 * lens.p2 * ray.x * ray.y};
}

cv::Point2d distorted(const Lens& lens, cv::Point2d ray) {
    return ray * radial_stretch(lens.k, ray.dot(ray)) + tangential_shift(lens, ray);
}

/// Inverts the distortion by fixed-point iteration; NaN if it does not converge.
cv::Point2d undistorted(const Lens& lens, cv::Point2d seen) {
    constexpr int kMostRounds = 100;  // real lenses take 10 in the middle, 40 at 120 degrees
    constexpr int kFirstRounds = 5;
    constexpr double kSame = 1e-10;
    cv::Point2d ray = seen;
    double last_step = std::numeric_limits<double>::infinity();
    for (int round = 0; round < kMostRounds; ++round) {
        const cv::Point2d next =
            (seen - tangential_shift(lens, ray)) / radial_stretch(lens.k, ray.dot(ray));
        const double step = cv::norm(next - ray);
        const bool is_lost = !(step < last_step) && round >= kFirstRounds;
        ray = next;
        if (step < kSame || is_lost) break;
        last_step = step;
    }
    constexpr double kHit = 1e-6;  // of a ray: a thousandth of a pixel
    const bool hit = cv::norm(distorted(lens, ray) - seen) < kHit && cv::norm(ray) <= lens.widest;
    return hit ? ray : cv::Point2d{kNothing, kNothing};
}

}  // namespace

FloatLens::FloatLens(const Lens& lens)
    : p1_(static_cast<float>(lens.p1)),
      p2_(static_cast<float>(lens.p2)),
      widest2_(static_cast<float>(lens.widest * lens.widest)) {
    for (std::size_t n = 0; n < lens.k.size(); ++n) k_[n] = static_cast<float>(lens.k[n]);
}

CameraModel::CameraModel(const Intrinsics& intrinsics, const Lens& lens)
    : intrinsics_(intrinsics),
      lens_(lens),
      distorts_(lens.k != Lens().k || lens.p1 != 0.0 || lens.p2 != 0.0) {}

cv::Point2d CameraModel::pixel_of(cv::Point2d ray) const {
    if (!(ray.dot(ray) <= lens_.widest * lens_.widest)) return {kNothing, kNothing};
    const cv::Point2d seen = distorts_ ? distorted(lens_, ray) : ray;
    return {intrinsics_.cx + intrinsics_.fx * seen.x, intrinsics_.cy + intrinsics_.fy * seen.y};
}

cv::Point2d CameraModel::ray_of(cv::Point2d pixel) const {
    const cv::Point2d seen{(pixel.x - intrinsics_.cx) / intrinsics_.fx,
                           (pixel.y - intrinsics_.cy) / intrinsics_.fy};
    return distorts_ ? undistorted(lens_, seen) : seen;
}

Rays rays_of(cv::Size picture, const CameraModel& camera) {
    Rays rays{cv::Mat(picture, CV_32FC1), cv::Mat(picture, CV_32FC1)};
    for (int j = 0; j < picture.height; ++j) {
        float* const right = rays.right.ptr<float>(j);
        float* const down = rays.down.ptr<float>(j);
        for (int i = 0; i < picture.width; ++i) {
            const cv::Point2d ray = camera.ray_of({1.0 * i, 1.0 * j});
            right[i] = static_cast<float>(ray.x);
            down[i] = static_cast<float>(ray.y);
        }
    }
    return rays;
}

bool is_placement(const Placement& placement) {
    constexpr double kRound = 1e-3;
    constexpr double kFarthest_mm = 1e4;
    const cv::Matx33d& rotation = placement.rotation;
    const double off = cv::norm(rotation * rotation.t() - cv::Matx33d::eye());
    return off < kRound && cv::norm(placement.shift_mm) < kFarthest_mm;
}

CameraModel camera_for(cv::Size picture, const CameraModel& camera, cv::Size calibrated) {
    const double scale = 1.0 * picture.width / calibrated.width;
    const double cut = 0.5 * (calibrated.height * scale - picture.height);
    const Intrinsics& c = camera.intrinsics();
    return {Intrinsics{c.fx * scale, c.fy * scale, (c.cx + 0.5) * scale - 0.5,
                       (c.cy + 0.5) * scale - 0.5 - cut},
            camera.lens()};
}

}  // namespace dibhr
