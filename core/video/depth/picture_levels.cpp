// Levels and colours of pictures.
#include "core/video/depth/picture_levels.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace dibhr {

double highest_level(int bits) {
    return std::ldexp(1.0, bits) - 1.0;
}

/// The weights of luma sum to one in OpenCV's fixed point, so equal channels keep their level
/// exactly.
cv::Mat grey_of(const cv::Mat& picture) {
    cv::Mat grey;
    if (picture.channels() == 3)
        cv::cvtColor(picture, grey, cv::COLOR_BGR2GRAY);
    else if (picture.channels() == 4)
        cv::cvtColor(picture, grey, cv::COLOR_BGRA2GRAY);
    else if (picture.channels() == 2)
        cv::extractChannel(picture, grey, 0);
    else
        grey = picture;
    return grey;
}

cv::Mat view_of(const DepthImage& depth) {
    return {depth.rows, depth.columns, CV_32FC1, const_cast<float*>(depth.levels.data())};
}

ColourImage colour_of(const cv::Mat& picture) {
    ColourImage colour;
    colour.columns = picture.cols;
    colour.rows = picture.rows;
    colour.rgb.resize(picture.total() * 3);
    cv::Mat rgb(picture.rows, picture.cols, CV_8UC3, colour.rgb.data());
    cv::cvtColor(picture, rgb, cv::COLOR_BGR2RGB);
    return colour;
}

cv::Mat with_bits(const cv::Mat& picture, int bits_now, int bits) {
    if (bits_now == bits) return picture;
    cv::Mat scaled;
    if (bits_now == kRealBits || bits == kRealBits) {  // no highest level to go by
        picture.convertTo(scaled, CV_32F);
        if (bits == kRealBits) return scaled;
        cv::patchNaNs(scaled, 0.0);
        return cv::min(cv::max(scaled, 0.0), highest_level(bits));
    }
    picture.convertTo(scaled, CV_32F, highest_level(bits) / highest_level(bits_now));
    return scaled;
}

cv::Mat resampleable(const cv::Mat& picture) {
    const double shrink = 1.0 * kMostSide_px / std::max(picture.cols, picture.rows);
    if (shrink >= 1.0) return picture;
    cv::Mat smaller;
    cv::resize(picture, smaller, {}, shrink, shrink, cv::INTER_AREA);
    return smaller;
}

cv::Size with_square_pixels(cv::Size size, double aspect) {
    return {static_cast<int>(std::lround(size.width * std::max(aspect, 1.0))),
            static_cast<int>(std::lround(size.height / std::min(aspect, 1.0)))};
}

cv::Mat with_square_pixels(const cv::Mat& picture, double aspect, PictureRole role) {
    if (aspect == 1.0 || picture.empty()) return picture;
    const cv::Size size = with_square_pixels(picture.size(), aspect);
    cv::Mat between;
    cv::resize(picture, between, size, 0.0, 0.0, cv::INTER_LINEAR);
    if (role == PictureRole::colour) return between;
    const cv::Mat data = grey_of(picture) > 0.0;  // 255 each
    cv::Mat beside_none;
    cv::resize(data, beside_none, size, 0.0, 0.0, cv::INTER_LINEAR);
    cv::Mat nearest;
    cv::resize(picture, nearest, size, 0.0, 0.0, cv::INTER_NEAREST);
    nearest.copyTo(between, beside_none < 255.0);
    return between;
}

cv::Mat rise_of(const cv::Mat& picture) {
    cv::Mat across;
    cv::Mat down;
    cv::Sobel(picture, across, CV_32F, 1, 0, 3, 1.0 / 8.0);
    cv::Sobel(picture, down, CV_32F, 0, 1, 3, 1.0 / 8.0);
    cv::Mat rise;
    cv::magnitude(across, down, rise);
    return rise;
}

}  // namespace dibhr
