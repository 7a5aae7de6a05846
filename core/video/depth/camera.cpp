// From rays to pixels and back.
#include "core/video/depth/camera.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include "core/files/plain_text.hpp"

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

// A camera for pictures of another size.

constexpr std::string_view kGiveCamera =
    ": give the camera of the depth pictures, --intrinsics FX,FY,CX,CY, or its field of view "
    "(60deg)";

std::string text_of(cv::Size size) {
    return std::to_string(size.width) + " x " + std::to_string(size.height);
}

bool sees_centre(const Intrinsics& camera, cv::Size picture) {
    return camera.cx > -0.5 && camera.cy > -0.5 && camera.cx < picture.width - 0.5 &&
           camera.cy < picture.height - 0.5;
}

/// How many times as large the camera's picture is, where both coordinates of the centre say the
/// same of a usual factor; they are near the middle of most pictures.
std::optional<double> factor_by_centre(const Intrinsics& camera, cv::Size picture) {
    constexpr std::array kUsual{0.25, 1.0 / 3.0, 0.5, 2.0 / 3.0, 1.5, 2.0, 3.0, 4.0};
    constexpr double kMiddle = 0.08;  // centres are off the middle by up to this part
    const double across = 2.0 * (camera.cx + 0.5) / picture.width;
    const double down = 2.0 * (camera.cy + 0.5) / picture.height;
    const auto* const found = std::find_if(kUsual.begin(), kUsual.end(), [&](double factor) {
        return std::abs(across / factor - 1.0) < kMiddle && std::abs(down / factor - 1.0) < kMiddle;
    });
    return found == kUsual.end() ? std::nullopt : std::optional(*found);
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

Intrinsics scaled_camera(const Intrinsics& camera, cv::Size2d from, cv::Size2d to) {
    return {camera.fx * to.width / from.width, camera.fy * to.height / from.height,
            (camera.cx + 0.5) * to.width / from.width - 0.5,
            (camera.cy + 0.5) * to.height / from.height - 0.5};
}

CameraModel camera_for(cv::Size picture, const CameraModel& camera, cv::Size calibrated) {
    const double scale = 1.0 * picture.width / calibrated.width;
    Intrinsics scaled = scaled_camera(camera.intrinsics(), {1.0, 1.0}, {scale, scale});
    scaled.cy -= 0.5 * (calibrated.height * scale - picture.height);
    return {scaled, camera.lens()};
}

FittedCamera fit_camera(const Intrinsics& stated, cv::Size calibrated, cv::Size picture) {
    constexpr double kAlike = 0.01;        // proportions of a picture with rounded sides
    constexpr double kLargestFactor = 16;  // beyond, it is a camera of other pictures
    const std::string left_out = ", so it is left out" + std::string(kGiveCamera);
    if (!is_camera(stated))
        return {{},
                "the camera has focal lengths of " + short_text(stated.fx) + " and " +
                    short_text(stated.fy) + " pixels" + left_out};
    if (calibrated.empty()) {
        if (const auto factor = factor_by_centre(stated, picture))
            return {scaled_camera(stated, {*factor, *factor}, {1.0, 1.0}),
                    "the camera is by its centre that of a picture " + short_text(*factor, 3) +
                        " times as large, so it is scaled to " + text_of(picture)};
        if (sees_centre(stated, picture)) return {stated, {}};
        return {{},
                "the camera's centre, " + short_text(stated.cx) + ", " + short_text(stated.cy) +
                    ", is outside the picture of " + text_of(picture) + left_out};
    }
    const double across = 1.0 * picture.width / calibrated.width;
    const double down = 1.0 * picture.height / calibrated.height;
    const std::string its_picture = "the camera is of a picture of " + text_of(calibrated);
    const bool is_scaled =
        std::abs(across / down - 1.0) < kAlike && std::max(across, 1.0 / across) <= kLargestFactor;
    if (!is_scaled) return {{}, its_picture + ", not of " + text_of(picture) + left_out};
    if (!sees_centre(stated, calibrated))
        return {{},
                "the camera's centre, " + short_text(stated.cx) + ", " + short_text(stated.cy) +
                    ", is outside its picture of " + text_of(calibrated) + left_out};
    if (calibrated == picture) return {stated, {}};
    return {scaled_camera(stated, calibrated, picture),
            its_picture + ", so it is scaled to " + text_of(picture)};
}

}  // namespace dibhr
