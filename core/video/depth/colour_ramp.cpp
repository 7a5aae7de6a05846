// The colours, as OpenCV has them.
#include "core/video/depth/colour_ramp.hpp"

#include <opencv2/imgproc.hpp>

#include "core/video/depth/picture_levels.hpp"

namespace dibhr {

ColourImage colours_of(ColourRamp ramp) {
    constexpr int kColours = 256;
    cv::Mat levels(1, kColours, CV_8UC1);
    for (int k = 0; k < kColours; ++k)
        levels.at<unsigned char>(0, k) = static_cast<unsigned char>(k);
    cv::Mat bgr;
    if (ramp == ColourRamp::grey) {
        cv::cvtColor(levels, bgr, cv::COLOR_GRAY2BGR);
    } else {
        cv::applyColorMap(levels, bgr,
                          ramp == ColourRamp::turbo ? cv::COLORMAP_TURBO : cv::COLORMAP_VIRIDIS);
    }
    return colour_of(bgr);
}

}  // namespace dibhr
