// Decodes depth that is a number in the bytes of a picture's colour channels, as simulators, map
// servers and scripts write it, and finds out which code it is; inside core/video.
#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>
#include <span>

#include "core/video/depth/depth_meaning.hpp"

namespace dibhr {

/// Whether depth of this code is a number in the bytes of the channels. With R, G, B and A from 0
/// to 255 it is
///   rg16          256 R + G
///   gb16          256 G + B: jonathantompson.github.io, "NYU Hand Pose Dataset"
///   rgb24         R + 256 G + 65536 B: carla.readthedocs.io, "Depth camera"
///   bgr24         65536 R + 256 G + B: github.com/stepjam/RLBench, rlbench/backend/utils.py
///   terrain       -10000 + 0.1 (65536 R + 256 G + B) metres of height: docs.mapbox.com,
///                 "Terrain-RGB"
///   float32       a little-endian 32-bit float, R its first byte, A its last
///   float32-bgra  likewise, B its first byte, as OpenCV writes a float's bytes:
///                 github.com/castacks/tartanairpy
[[nodiscard]] bool is_of_bytes(DepthCode code) noexcept;

/// Channels that a picture of this code has at least: 4 for floats, which need alpha, else 3.
[[nodiscard]] int least_channels(DepthCode code) noexcept;

/// Bits of its numbers: 16, or kRealBits.
[[nodiscard]] int bits_in_bytes(DepthCode code) noexcept;

/// Whether two codes have the same channels, one of which is above another in the one code and
/// below it in the other.
[[nodiscard]] bool have_contrary_bytes(DepthCode one, DepthCode other) noexcept;

/// The numbers of a picture: CV_16UC1 where they have 16 bits, else CV_32FC1. `picture`: 8-bit BGR
/// or BGRA. Other pictures have no data: 0, else NaN.
[[nodiscard]] cv::Mat numbers_in_bytes(const cv::Mat& picture, DepthCode code);

/// What the code itself states: rgb24 is a distance; of 24 bits the lowest and the highest number
/// are no data; terrain is a height, near where it is high, and its lowest number is no data. bgr24
/// may be of heights, too (Terrarium), so that it does not say what is near.
[[nodiscard]] DepthStatement byte_code_meaning(DepthCode code);

/// Whether the numbers of a surface go on smoothly where one of their high bytes steps by one: then
/// the byte below it wraps, and the step vanishes. Nothing: the pictures have too few such steps.
/// `pictures`: as for numbers_in_bytes().
[[nodiscard]] std::optional<bool> is_continuous(std::span<const cv::Mat> pictures, DepthCode code);

/// The code whose numbers are a continuous and plausible surface; nothing for other pictures, and
/// where two codes fit that have the bytes in contrary orders, and neither is clearly the smoother
/// one. A photograph's channels rise and fall together, so that none is the low byte of another.
[[nodiscard]] std::optional<DepthCode> byte_code_in(std::span<const cv::Mat> pictures);

}  // namespace dibhr
