// The levels and the colours of OpenCV's pictures; inside the room, so OpenCV types may show.
#pragma once

#include <opencv2/core/mat.hpp>

#include "core/haptics/depth_image.hpp"
#include "core/video/frames/colour_image.hpp"

namespace dibhr {

/// The bits of levels that are real numbers: they have no highest one.
inline constexpr int kRealBits = 32;

/// Of levels of so many bits.
[[nodiscard]] double highest_level(int bits);

/// One channel of the same bits, of a picture of 1 to 4. Where the channels are equal the level is
/// exactly theirs, otherwise their luma.
[[nodiscard]] cv::Mat grey_of(const cv::Mat& picture);

/// The image's own levels, CV_32FC1: only to be read.
[[nodiscard]] cv::Mat view_of(const DepthImage& depth);

/// RGB of an 8-bit BGR picture.
[[nodiscard]] ColourImage colour_of(const cv::Mat& picture);

/// The same levels, of which the highest is highest_level(bits): of a row of pictures that do not
/// agree. Real numbers stay as they are, as far as they are levels of so many bits.
[[nodiscard]] cv::Mat with_bits(const cv::Mat& picture, int bits_now, int bits);

enum class PictureRole { colour, depth };

/// OpenCV resamples pictures of less than 2^15 pixels along a side: the same, or as large as that.
inline constexpr int kMostAlong = 32000;
[[nodiscard]] cv::Mat resampleable(const cv::Mat& picture);

/// The picture as it is to be seen: stretched along one side until its pixels, `aspect` times as
/// wide as high, are square. A level of depth is never mixed with no data, which is level 0.
[[nodiscard]] cv::Mat with_square_pixels(const cv::Mat& picture, double aspect, PictureRole role);

}  // namespace dibhr
