// Small pictures are JPEG files.
#include "core/video/sources/preview_picture.hpp"

#include <cstdint>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/error.hpp"
#include "core/video/depth/picture_levels.hpp"
#include "core/video/formats/still_picture.hpp"
#include "core/video/modules/picture_codecs.hpp"

namespace dibhr {

namespace {

constexpr int kQuality = 75;  // of 100

/// Every `side` x `side` pixels as one, as OpenCV orders its channels.
cv::Mat smaller(const ColourImage& image, int side) {
    const cv::Mat rgb(image.rows, image.columns, CV_8UC3,
                      const_cast<std::uint8_t*>(image.rgb.data()));  // only read
    cv::Mat small;
    const cv::Size squares(image.columns / side, image.rows / side);
    cv::resize(rgb(cv::Rect({0, 0}, squares * side)), small, squares, 0.0, 0.0, cv::INTER_AREA);
    cv::cvtColor(small, small, cv::COLOR_RGB2BGR);
    return small;
}

}  // namespace

std::string preview_of(const Frame& frame) try {
    const std::shared_ptr<const ColourImage> colour = frame.rgb();
    if (!colour || colour->rgb.empty()) return {};
    const int side = (colour->columns + kWidestPreview - 1) / kWidestPreview;
    if (colour->rows < side) return {};
    std::vector<unsigned char> bytes;
    if (!picture_codecs().encode(".jpg", smaller(*colour, side), bytes,
                                 {cv::IMWRITE_JPEG_QUALITY, kQuality}))
        return {};
    return {bytes.begin(), bytes.end()};
} catch (const cv::Exception&) {
    return {};
} catch (const Error&) {  // the codecs are missing
    return {};
}

std::shared_ptr<const ColourImage> picture_of_preview(const std::string& jpeg) try {
    const auto* const bytes = reinterpret_cast<const std::uint8_t*>(jpeg.data());
    const cv::Mat picture = decoded_picture({bytes, jpeg.size()}, cv::IMREAD_COLOR);
    if (picture.empty() || picture.type() != CV_8UC3) return nullptr;
    return std::make_shared<const ColourImage>(colour_of(picture));
} catch (const Error&) {
    return nullptr;
}

}  // namespace dibhr
