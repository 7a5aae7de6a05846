// Decodes depth coded as colour: by hue, as volumetric recorders do so that video codecs keep more
// than 256 levels, or by a ramp from white through cyan and blue to black; inside core/video.
#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>

#include "core/video/depth/depth_meaning.hpp"

namespace dibhr {

/// A coding of depth as hue: red is near, and hue rises with the distance. The defaults are those
/// of Scatter's Depthkit (black is no data, limits as in its players) and of Intel's "Depth image
/// compression by colorization" (Sonoda and Grunnet-Jepsen), whose 1529 levels are 1530ths of the
/// hue.
struct HueCode {
    std::optional<DepthRange> metres{};  ///< at hue 0 and hue 1; nothing: no unit is known
    double least_saturation{0.5};        ///< below, a pixel is no data
    double least_value{0.5};
    double nearest{0.0};  ///< hues outside of [nearest, farthest] are no data
    double farthest{1.0};
    bool red_is_data{true};  ///< red is the nearest or the farthest, decided by its neighbours

    bool operator==(const HueCode&) const = default;
};

/// Record3D: hue times 3 m unless the file gives another range. No data is red, so only the hues of
/// 0.1 to 2.8 m count, as in its player.
[[nodiscard]] HueCode record3d_code(std::optional<DepthRange> metres);

/// The hue of each pixel, 0 <= hue < 1, as CV_32F; NaN for no data: too pale, too dark, or mixed of
/// two surfaces' hues along silhouettes, by codecs that store colours coarser than brightness.
/// `picture`: 8 or 16 bits; with fewer than 3 channels it has no hues.
[[nodiscard]] cv::Mat hues_of(const cv::Mat& picture, const HueCode& code);

/// Decides red pixels by their neighbours: beside near hues they become the nearest, 0, beside far
/// hues the farthest, just below 1, as noise moves red to either side. Other hues do not change.
void assign_red_side(cv::Mat& hues);

/// The share of a picture's coloured pixels that lie on the ramp white - cyan - blue - black; 0 if
/// hardly any pixel is coloured.
[[nodiscard]] double share_on_ramp(const cv::Mat& picture);

/// Grey levels of a picture with that ramp, near (white) the highest: the mean of red, green and
/// blue, which is linear along the ramp, unlike luma. Levels of 8 bits, not rounded.
[[nodiscard]] cv::Mat ramp_levels(const cv::Mat& picture);

}  // namespace dibhr
