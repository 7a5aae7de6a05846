// The true shape of what a depth camera sees: its surface in millimetres, in orthographic view
// instead of the camera's perspective, so that a ball is round and a table flat at any distance;
// inside core/video.
#pragma once

#include <opencv2/core/mat.hpp>
#include <opencv2/core/types.hpp>
#include <vector>

#include "core/haptics/depth_image.hpp"
#include "core/video/depth/camera.hpp"
#include "core/video/depth/depth_meaning.hpp"
#include "core/video/frames/colour_image.hpp"

namespace dibhr {

/// Where a surface is sampled: column i is left_mm + i pitch_mm to the right of the camera's axis,
/// row j is top_mm + j pitch_mm below it, at every distance.
struct OrthographicGrid {
    int columns{0};
    int rows{0};
    double pitch_mm{0.0};
    double left_mm{0.0};
    double top_mm{0.0};
};

/// The grid for what a camera sees between the two distances `range_mm` from its plane. It spans
/// the pixels of `samples_mm` (pictures from all over the clip, as TrueShape takes them) in that
/// range, without two thousandths on each side, and a tenth more. Without such pixels it spans all
/// that the camera can see, which is much wider at the far distance.
///
/// It is as fine as the camera's pixels at the nearest distance, so that nothing of a near hand is
/// lost; but it has at most half a million points, or as many as the pictures have pixels: else a
/// room behind the hand would make it grow with the square of far / near.
/// Throws InputError if the intrinsics are no camera's, or the range is invalid.
[[nodiscard]] OrthographicGrid orthographic_grid(cv::Size depth_size, const CameraModel& camera,
                                                 const DepthRange& range_mm,
                                                 const std::vector<cv::Mat>& samples_mm = {});

/// One frame, resampled on the grid.
struct OrthographicPicture {
    /// Elevation over the farthest distance [mm]; the highest level is at the nearest distance. NaN
    /// where nothing is seen: behind something nearer, outside the picture, without data.
    DepthImage depth{};
    ColourImage colour{};  ///< of the grid's size, black where nothing is seen; empty: none given
};

/// Resamples the pictures of one clip. The surface is made of triangles between the middles of
/// depth pixels with data, without those from an edge to the background. Where triangles overlap
/// the nearest is taken. Deterministic. Scratch memory is kept from picture to picture.
class TrueShape {
  public:
    /// For depth pictures of this size, with a grid that was made for the same camera and range.
    TrueShape(cv::Size depth_size, const CameraModel& camera, const DepthRange& range_mm,
              const OrthographicGrid& grid);

    [[nodiscard]] const OrthographicGrid& grid() const noexcept { return grid_; }
    /// The relief for the depth image's true shape: the highest elevation in grid pitches.
    [[nodiscard]] double relief_px() const noexcept {
        return (range_mm_.far - range_mm_.near) / grid_.pitch_mm;
    }

    /// `depth_mm`: CV_32FC1 of the clip's size, distances from the camera's plane. Not finite, or
    /// not above 0, is no data; values outside the range are clamped along their ray. `colour`:
    /// 8-bit BGR of any size and the same field of view, or empty.
    [[nodiscard]] OrthographicPicture orthographic_view(const cv::Mat& depth_mm,
                                                        const cv::Mat& colour);

  private:
    /// The middle of a depth pixel: its place in the grid [px] and its elevation [mm], NaN without
    /// data.
    struct Corner {
        float x, y, elevation;
    };

    void place_row(const cv::Mat& depth_mm, int row, std::vector<Corner>& corners) const;
    void draw(const Corner& a, const Corner& b, const Corner& c, DepthImage& image) const;
    void find_pixels(const DepthImage& image, cv::Size colour_size);
    [[nodiscard]] ColourImage colour_on(const DepthImage& image, const cv::Mat& colour);

    cv::Size depth_size_;
    CameraModel camera_;
    Rays rays_;
    DepthRange range_mm_;
    OrthographicGrid grid_;
    float steepest_;  ///< of a triangle: its height over the distance of its nearest corner
    std::vector<Corner> above_{}, below_{};
    cv::Mat pixel_x_{}, pixel_y_{};  ///< of the colour picture, for every point of the grid
};

}  // namespace dibhr
