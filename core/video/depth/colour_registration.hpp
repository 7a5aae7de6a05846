// Registration of colour and depth: one camera's picture over the other's; inside core/video.
#pragma once

#include <opencv2/core/mat.hpp>

#include "core/video/depth/camera.hpp"

namespace dibhr {

/// Grey level of pixels without known colour: their shape still shows by shading.
inline constexpr double kNoColour = 96.0;

/// The colour picture moved and scaled over the depth; kNoColour beyond its border. The picture
/// itself if the registration changes nothing.
[[nodiscard]] cv::Mat apply_registration(const cv::Mat& colour, const Registration& registration,
                                         cv::Size depth_size);

/// Finds for every depth pixel the colour that the other camera sees there, by the calibration and
/// the pixel's distance. Deterministic. Scratch memory is kept from picture to picture.
class ColourRegistration {
  public:
    /// `far_mm`: the distance of pictures without any data.
    ColourRegistration(cv::Size depth_size, const CameraPair& cameras, double far_mm);

    /// `depth_mm`: CV_32FC1 of that size, distances from the depth camera's plane; NaN is no data,
    /// and counts as far as the background of the hole. `colour`: 8-bit BGR. Returns a picture of
    /// the depth's size, or of twice its columns and rows where the colour is that fine. Pixels
    /// outside the colour picture become kNoColour; pixels hidden from the colour camera take the
    /// colour beside them.
    [[nodiscard]] cv::Mat seen_from_depth(const cv::Mat& depth_mm, const cv::Mat& colour);

  private:
    void close_holes(const cv::Mat& depth_mm);
    void project(const CameraModel& colour);
    void find_hidden(cv::Size colour_size, double pixels_apart);
    void uncover();
    static void make_finer(const cv::Mat& map, double pixels_apart, cv::Mat& finer);

    CameraPair cameras_;
    float far_mm_;
    Rays rays_;
    cv::Mat depth_mm_{};  ///< without holes
    cv::Mat x_{}, y_{};   ///< place of each depth pixel in the colour picture
    cv::Mat finer_x_{}, finer_y_{};
    cv::Mat distance_mm_{};  ///< its distance from the colour camera
    cv::Mat nearest_mm_{};   ///< the least distance in each cell of the colour picture
    cv::Mat hidden_{};       ///< CV_8U: not 0 where something nearer covers it
};

}  // namespace dibhr
