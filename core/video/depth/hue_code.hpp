// Depth that is coded as colour: by hue, as volumetric recorders write it so that video codecs keep
// more than 256 levels, or along a ramp from white through cyan and blue to black; inside the room.
#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>

#include "core/video/depth/depth_meaning.hpp"

namespace dibhr {

/// One way of coding depth as hue: red is near, and hue rises with the distance. As it stands here
/// it is that of Scatter's Depthkit (black is none, the cut-offs are those of its own players) and
/// of Intel's "Depth image compression by colorization" (Sonoda and Grunnet-Jepsen), whose 1529
/// levels are 1530ths of the hue.
struct HueCode {
    std::optional<DepthRange> metres{};  ///< of hue 0 and hue 1; nothing: no unit is known
    double least_saturation{0.5};        ///< below, a pixel is no data
    double least_value{0.5};
    double nearest{0.0};  ///< hues outside of these are no data
    double farthest{1.0};
    bool red_is_data{true};  ///< the nearest or the farthest: its neighbours tell which

    bool operator==(const HueCode&) const = default;
};

/// Record3D: hue times 3 m unless the file says another range. What is none is red, so only the
/// hues of its player's 0.1 to 2.8 m count.
[[nodiscard]] HueCode record3d_code(std::optional<DepthRange> metres);

/// The hue of each pixel, 0 <= hue < 1, as CV_32F; NaN where there is no data: too pale, too dark,
/// or a mixture of two surfaces' hues, as codecs of coarser colours than brightness leave them
/// along silhouettes. `picture`: 8 or 16 bits; of fewer than 3 channels it has no hues.
[[nodiscard]] cv::Mat hues_of(const cv::Mat& picture, const HueCode& code);

/// Red that lies beside near hues is the nearest, 0, and beside far ones the farthest, just below
/// 1, whatever side of red noise has put it on. Other hues stay as they are.
void settle_red(cv::Mat& hues);

/// The share of a picture's pixels that lie on the ramp white - cyan - blue - black, of those that
/// have a colour; 0 where hardly any has.
[[nodiscard]] double share_on_ramp(const cv::Mat& picture);

/// A picture of that ramp as grey levels, near (white) the highest: the mean of red, green and
/// blue, which is linear along the ramp as luma is not. Levels of 8 bits, not rounded.
[[nodiscard]] cv::Mat ramp_levels(const cv::Mat& picture);

}  // namespace dibhr
