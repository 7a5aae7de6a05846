// One scene of known depth - a tilted plane, a ball, a step, a rim without data - as pictures in
// the codes that depth comes in, and as a photograph.
#pragma once

#include <functional>
#include <opencv2/core/mat.hpp>

#include "core/video/depth/depth_meaning.hpp"

namespace dibhr::test {

inline constexpr int kSceneColumns = 320;
inline constexpr int kSceneRows = 240;

/// From 0, near, to 1, far; NaN: no data. CV_32F.
[[nodiscard]] cv::Mat scene_depth();

/// What `level` says of each depth, as 8-bit BGR.
[[nodiscard]] cv::Mat painted(const cv::Mat& depth, const std::function<cv::Vec3b(float)>& level);

// Codes of one depth.
[[nodiscard]] cv::Vec3b as_hue(float depth);   ///< red near, black none
[[nodiscard]] cv::Vec3b as_grey(float depth);  ///< white near, black none
[[nodiscard]] cv::Vec3b as_ramp(float depth);  ///< white, cyan, blue, black

/// Numbers in the bytes of the channels, as 8-bit BGR, for floats BGRA; not finite: all bytes 0.
/// `numbers`: CV_32F; metres for terrain.
[[nodiscard]] cv::Mat in_bytes(const cv::Mat& numbers, DepthCode code);

/// Millimetres in 13 of 16 bits, below a confidence that changes every few pixels, as Android has
/// them; 0: no data.
[[nodiscard]] cv::Mat below_confidence(const cv::Mat& millimetres);

/// Surfaces of other colours with a rough texture, seen from `to_the_right` pixels further right.
[[nodiscard]] cv::Mat scene_photo(double to_the_right = 0.0);

/// Noise of several sizes around mid-grey, as photographs of rough things have it.
[[nodiscard]] cv::Mat rough(int columns, int rows, int seed);

/// Two pictures of a size side by side, or the first above the second.
[[nodiscard]] cv::Mat beside(const cv::Mat& left, const cv::Mat& right);
[[nodiscard]] cv::Mat above(const cv::Mat& top, const cv::Mat& bottom);

}  // namespace dibhr::test
