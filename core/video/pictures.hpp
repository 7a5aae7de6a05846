// Still pictures and the way from OpenCV's pictures to ours.
#pragma once

#include <filesystem>
#include <opencv2/core/mat.hpp>

#include "core/haptics/depth_image.hpp"
#include "core/video/frame_window.hpp"

namespace dibhr {

/// 8 or 16 bits, 1 to 4 channels, as the file has them. Throws InputError.
[[nodiscard]] cv::Mat read_picture_unchanged(const std::filesystem::path& file);

/// 8-bit BGR, whatever the file has. Throws InputError.
[[nodiscard]] cv::Mat read_colour_picture(const std::filesystem::path& file);

/// Grey levels of an 8- or 16-bit picture of 1 to 4 channels. Where the channels are equal the
/// level is exactly theirs, otherwise their luma.
[[nodiscard]] DepthImage depth_of(const cv::Mat& picture);

/// RGB of an 8-bit BGR picture.
[[nodiscard]] ColourImage colour_of(const cv::Mat& picture);

}  // namespace dibhr
