// Colour and depth of two cameras, one picture over the other; inside the room.
#pragma once

#include <opencv2/core/mat.hpp>

#include "core/video/depth/camera.hpp"

namespace dibhr {

/// The level of all channels of what no colour is known of: its shape still shows in its shading.
inline constexpr double kNoColour = 96.0;

/// The colour picture moved and stretched over the depth, without colour where it ends. As it is
/// for a registration that changes nothing.
[[nodiscard]] cv::Mat moved(const cv::Mat& colour, const Registration& registration,
                            cv::Size depth_size);

/// Paints every pixel of the depth picture in the colour that the other camera sees there: as
/// calibrated, each at its own distance. Deterministic. Scratch memory is kept from picture to
/// picture.
class ColourRegistration {
  public:
    /// `far_mm`: how far a picture is of which nothing is known.
    ColourRegistration(cv::Size depth_size, const CameraPair& cameras, double far_mm);

    /// `depth_mm`: CV_32FC1 of that size, distances from the depth camera's plane, NaN without
    /// data: there it is as far as what is behind the hole. `colour`: 8-bit BGR. Returns a picture
    /// of the depth's size, or of twice its columns and rows where the colour is that fine; what
    /// the colour camera does not see, because it is outside its picture, has no colour; what is
    /// hidden from it behind something nearer takes the colour beside it.
    [[nodiscard]] cv::Mat seen_from_depth(const cv::Mat& depth_mm, const cv::Mat& colour);

  private:
    void close_holes(const cv::Mat& depth_mm);
    void project(const Camera& colour);
    void find_hidden(cv::Size colour_size, double pixels_apart);
    void uncover();
    static void make_finer(const cv::Mat& map, double pixels_apart, cv::Mat& finer);

    CameraPair cameras_;
    float far_mm_;
    Rays rays_;
    cv::Mat depth_mm_{};  ///< without holes
    cv::Mat x_{}, y_{};   ///< of each depth pixel: where the colour picture shows it
    cv::Mat finer_x_{}, finer_y_{};
    cv::Mat distance_mm_{};  ///< and how far it is from that camera
    cv::Mat nearest_mm_{};   ///< the colour picture in cells: what is nearest in each
    cv::Mat hidden_{};       ///< CV_8U: not 0 where something nearer covers it
};

}  // namespace dibhr
