// Models of cameras as calibrations describe them; inside core/video.
#pragma once

#include <array>
#include <opencv2/core/mat.hpp>
#include <opencv2/core/matx.hpp>
#include <opencv2/core/types.hpp>
#include <optional>
#include <string>

#include "core/video/depth/depth_meaning.hpp"

namespace dibhr {

/// Distortion of a lens: Brown and Conrady's model with a rational radial part, as in OpenCV and
/// Azure Kinect calibrations.
struct Lens {
    std::array<double, 6> k{};  ///< radial: (1 + k1 r2 + k2 r4 + k3 r6) / (1 + k4 r2 + k5 r4 + ...)
    double p1{0.0}, p2{0.0};    ///< tangential
    double widest{20.0};        ///< valid up to this length of a ray (sideways over forwards)

    bool operator==(const Lens&) const = default;
};

/// The factor of the radial part for a ray; `r2`: square of its length.
template <typename Number>
[[nodiscard]] Number radial_stretch(const std::array<Number, 6>& k, Number r2) {
    return (Number{1} + r2 * (k[0] + r2 * (k[1] + r2 * k[2]))) /
           (Number{1} + r2 * (k[3] + r2 * (k[4] + r2 * k[5])));
}

/// A lens in floats for every pixel of every frame, without branches: exact to a thousandth of a
/// pixel.
class FloatLens {
  public:
    explicit FloatLens(const Lens& lens);

    struct Distorted {
        float x, y;
        bool known;  ///< the ray is within the lens's valid range; false for NaN
    };
    [[nodiscard]] Distorted distorted(float x, float y) const {
        const float r2 = x * x + y * y;
        const float stretch = radial_stretch(k_, r2);
        const float twice_xy = 2.0F * x * y;
        return {x * stretch + p1_ * twice_xy + p2_ * (r2 + 2.0F * x * x),
                y * stretch + p1_ * (r2 + 2.0F * y * y) + p2_ * twice_xy, r2 <= widest2_};
    }

  private:
    std::array<float, 6> k_{};
    float p1_, p2_, widest2_;
};

/// A ray (x, y): how far it goes right and down for each 1 forwards.
class CameraModel {
  public:
    CameraModel() = default;
    /// Without a lens: a pinhole camera, to which intrinsics convert.
    CameraModel(const Intrinsics& intrinsics, const Lens& lens = {});  // NOLINT(*explicit*)

    [[nodiscard]] const Intrinsics& intrinsics() const noexcept { return intrinsics_; }
    [[nodiscard]] const Lens& lens() const noexcept { return lens_; }

    /// Where a ray meets the picture [px]; NaN outside the lens's valid range.
    [[nodiscard]] cv::Point2d pixel_of(cv::Point2d ray) const;
    /// The ray of a place in the picture; NaN where no ray is valid.
    [[nodiscard]] cv::Point2d ray_of(cv::Point2d pixel) const;

  private:
    Intrinsics intrinsics_{};
    Lens lens_{};
    bool distorts_{false};
};

/// The rays through the middles of all pixels.
struct Rays {
    cv::Mat right{};  ///< CV_32FC1, NaN where no ray is valid
    cv::Mat down{};
};
[[nodiscard]] Rays rays_of(cv::Size picture, const CameraModel& camera);

/// From one camera's axes (right, down, forwards) to another's: rotation * point + shift.
struct Placement {
    cv::Matx33d rotation{};
    cv::Vec3d shift_mm{};
};
/// Whether the placement is possible in one device: a rotation, and less than ten metres.
[[nodiscard]] bool is_placement(const Placement& placement);

/// The two cameras of a device that sees depth and colour.
struct CameraPair {
    CameraModel depth{};
    CameraModel colour{};
    cv::Size colour_size{};    ///< of the pictures that `colour` is for
    Placement to_colour{};     ///< from the depth camera's axes to the colour camera's
    std::string known_from{};  ///< origin of the calibration: "Azure Kinect calibration"
};

/// Intrinsics for the same pictures in another size.
[[nodiscard]] Intrinsics scaled_camera(const Intrinsics& camera, cv::Size2d from, cv::Size2d to);

/// The same camera for pictures of another size: as wide a view, cut equally above and below.
[[nodiscard]] CameraModel camera_for(cv::Size picture, const CameraModel& camera,
                                     cv::Size calibrated);

/// A stated camera for pictures of a size, or why it cannot be theirs.
struct FittedCamera {
    std::optional<Intrinsics> camera{};
    std::string notice{};  ///< a clause on what was changed or left out; empty: as stated
};

/// Fits intrinsics to pictures. `calibrated`: the size of the picture that they are stated for;
/// empty: not stated, then their centre tells it. Pictures that were made smaller or larger as a
/// whole get a scaled camera; none where focal lengths are no numbers above 0, where the
/// proportions differ, or where the centre is outside the picture.
[[nodiscard]] FittedCamera fit_camera(const Intrinsics& stated, cv::Size calibrated,
                                      cv::Size picture);

}  // namespace dibhr
