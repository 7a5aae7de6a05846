// Levels and colours of OpenCV's pictures; inside core/video, as OpenCV types are in the interface.
#pragma once

#include <opencv2/core/mat.hpp>

#include "core/haptics/depth_image.hpp"
#include "core/video/frames/colour_image.hpp"

namespace dibhr {

/// Stands for the bits of levels that are real numbers, which have no highest level.
inline constexpr int kRealBits = 32;

/// The highest level of these bits.
[[nodiscard]] double highest_level(int bits);

/// One channel of the same bits, from a picture of 1 to 4. Where the channels are equal the level
/// is exactly theirs, otherwise their luma.
[[nodiscard]] cv::Mat grey_of(const cv::Mat& picture);

/// A view of the image's own levels, CV_32FC1, only to be read.
[[nodiscard]] cv::Mat view_of(const DepthImage& depth);

/// RGB of an 8-bit BGR picture.
[[nodiscard]] ColourImage colour_of(const cv::Mat& picture);

/// The same levels scaled to the highest level of `bits`, for pictures of one series with different
/// bits. Real numbers are not scaled, but clamped to levels of these bits.
[[nodiscard]] cv::Mat with_bits(const cv::Mat& picture, int bits_now, int bits);

enum class PictureRole { colour, depth };

/// OpenCV resamples pictures with sides below 2^15 pixels: resampleable() shrinks larger ones.
inline constexpr int kMostSide_px = 32000;
[[nodiscard]] cv::Mat resampleable(const cv::Mat& picture);

/// The picture with square pixels: stretched along one side; `aspect`: width over height of its
/// pixels. A level of depth is never mixed with no data, which is level 0.
[[nodiscard]] cv::Mat with_square_pixels(const cv::Mat& picture, double aspect, PictureRole role);
/// The size of such a picture.
[[nodiscard]] cv::Size with_square_pixels(cv::Size size, double aspect);

/// By how many levels a picture rises from pixel to pixel, CV_32F.
[[nodiscard]] cv::Mat rise_of(const cv::Mat& picture);

}  // namespace dibhr
