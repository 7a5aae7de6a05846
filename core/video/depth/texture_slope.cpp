// Means of squares by OpenCV, and the median of the differences between neighbours.
#include "core/video/depth/texture_slope.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace dibhr {

std::optional<double> texture_slope(const DepthImage& image) {
    constexpr int kLeastSide_px = 4;
    constexpr int kSidesAcross = 240;
    constexpr std::size_t kLeastCount = 100;
    const int side_px = std::max(kLeastSide_px, image.columns / kSidesAcross);
    const cv::Size squares(image.columns / side_px, image.rows / side_px);
    if (squares.width < 2 || squares.height < 2) return std::nullopt;
    // OpenCV has no constant images; resize() only reads it.
    const cv::Mat1f levels(image.rows, image.columns, const_cast<float*>(image.levels.data()));
    cv::Mat1f means;
    cv::resize(levels(cv::Rect({0, 0}, squares * side_px)), means, squares, 0.0, 0.0,
               cv::INTER_AREA);
    std::vector<float> slopes;
    for (int j = 0; j + 1 < squares.height; ++j)
        for (int i = 0; i + 1 < squares.width; ++i) {
            const float here = means(j, i);
            const float slope =
                std::max(std::abs(means(j, i + 1) - here), std::abs(means(j + 1, i) - here));
            if (std::isfinite(slope)) slopes.push_back(slope);
        }
    if (slopes.size() < kLeastCount) return std::nullopt;
    const auto middle = slopes.begin() + static_cast<std::ptrdiff_t>(slopes.size() / 2);
    std::nth_element(slopes.begin(), middle, slopes.end());
    return static_cast<double>(*middle) / side_px / image.highest_level;
}

}  // namespace dibhr
