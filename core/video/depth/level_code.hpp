// Decodes depth in levels that are no distances, as some cameras and data sets write it, and finds
// out which code it is; inside core/video.
#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>
#include <span>

#include "core/video/depth/depth_meaning.hpp"

namespace dibhr {

/// Whether depth of this code is in levels that are no distances:
///   turned16  16 bits, turned to the left by three: (v >> 3 | v << 13) is in millimetres (SUN3D
///             and SUN RGB-D: github.com/PrincetonVision/SUN3Dsfm, depthRead.m)
///   kinect11  raw disparities of a Kinect v1 in 11 bits, 2047 where there is none; where levels
///             are higher, their bytes are swapped (NYU Depth V2)
///   stereo    disparities in pixels, with the calibration of two cameras
///   xyz       points, x, y and the distance z, in three channels of real numbers
///   depth16   millimetres in the 13 low bits, 0 where there is none, and a confidence in the three
///             above (developer.android.com, ImageFormat.DEPTH16), which is left out
[[nodiscard]] bool is_of_levels(DepthCode code) noexcept;

/// Distances from disparities: factor_mm / (level + offset).
struct InverseLevels {
    double factor_mm{0.0};
    double offset{0.0};

    bool operator==(const InverseLevels&) const = default;
};
/// The usual Kinect v1: 1 / (3.3309495161 - 0.0030711016 v) metres (openkinect.org, "Imaging
/// Information").
inline constexpr InverseLevels kKinectLevels{-1000.0 / 0.0030711016, -3.3309495161 / 0.0030711016};

/// Whether the numbers of the code are whole, of 16 bits: turned16 and depth16.
[[nodiscard]] bool has_whole_numbers(DepthCode code) noexcept;

/// Whether a picture has the channels and bits of the code.
[[nodiscard]] bool has_levels(const cv::Mat& picture, DepthCode code);

/// The numbers of a picture: CV_16UC1 of whole numbers, where 0 is no data; else CV_32FC1, where
/// NaN is, in millimetres for kinect11 and stereo. `law`: of these two. Other pictures have no
/// data.
[[nodiscard]] cv::Mat numbers_in_levels(const cv::Mat& picture, DepthCode code,
                                        const InverseLevels& law);

/// What the code itself states: distances; millimetres but for xyz.
[[nodiscard]] DepthStatement level_code_meaning(DepthCode code);

/// Whether the levels of pictures do not contradict the code: numbers of turned16 are distances of
/// a room, those of kinect11 have 11 bits, points of xyz are seen by one camera, and depth16 has
/// even distances where its confidence changes.
[[nodiscard]] bool may_be_of(std::span<const cv::Mat> pictures, DepthCode code);

/// The code that levels show by themselves: kinect11, whose no data stands far from its other
/// levels, xyz, turned16, whose levels are multiples of 8, or depth16, by many such places.
[[nodiscard]] std::optional<DepthCode> level_code_in(std::span<const cv::Mat> pictures);

}  // namespace dibhr
