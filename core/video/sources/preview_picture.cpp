// Small pictures by averaging whole squares of pixels.
#include "core/video/sources/preview_picture.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "core/error.hpp"
#include "core/video/formats/still_picture.hpp"
#include "core/video/modules/picture_codecs.hpp"

namespace dibhr {

namespace {

constexpr int kJpegQuality = 1;  // OpenCV's IMWRITE_JPEG_QUALITY
constexpr int kQuality = 75;     // of 100
constexpr int kInColour = 1;     // OpenCV's IMREAD_COLOR

/// Blue, green and red, each the mean of side x side pixels.
cv::Mat smaller(const ColourImage& image, int side) {
    cv::Mat small(image.rows / side, image.columns / side, CV_8UC3);
    for (int j = 0; j < small.rows; ++j) {
        for (int i = 0; i < small.cols; ++i) {
            std::array<int, 3> sum{};
            for (int k = 0; k < side * side; ++k) {
                const auto row = static_cast<std::size_t>(j * side + k / side);
                const auto column = static_cast<std::size_t>(i * side + k % side);
                const std::size_t at = 3 * (row * static_cast<std::size_t>(image.columns) + column);
                for (std::size_t c = 0; c < 3; ++c) sum[c] += image.rgb[at + c];
            }
            auto& pixel = small.at<cv::Vec3b>(j, i);
            for (std::size_t c = 0; c < 3; ++c)
                pixel[2 - static_cast<int>(c)] = static_cast<std::uint8_t>(sum[c] / (side * side));
        }
    }
    return small;
}

}  // namespace

std::string preview_of(const Frame& frame) try {
    const std::shared_ptr<const ColourImage> colour = frame.rgb();
    if (!colour || colour->rgb.empty()) return {};
    const int side = (colour->columns + kWidestPreview - 1) / kWidestPreview;
    if (colour->rows < side) return {};
    std::vector<unsigned char> bytes;
    if (!picture_codecs().encode(".jpg", smaller(*colour, side), bytes, {kJpegQuality, kQuality}))
        return {};
    return {bytes.begin(), bytes.end()};
} catch (const cv::Exception&) {
    return {};
} catch (const Error&) {  // the codecs are missing
    return {};
}

std::shared_ptr<const ColourImage> picture_of_preview(const std::string& jpeg) try {
    const auto* const bytes = reinterpret_cast<const std::uint8_t*>(jpeg.data());
    const cv::Mat picture = decoded_picture({bytes, jpeg.size()}, kInColour);
    if (picture.empty() || picture.type() != CV_8UC3) return nullptr;
    auto colour = std::make_shared<ColourImage>();
    colour->columns = picture.cols;
    colour->rows = picture.rows;
    colour->rgb.reserve(3 * picture.total());
    for (int j = 0; j < picture.rows; ++j) {
        for (int i = 0; i < picture.cols; ++i) {
            const auto& pixel = picture.at<cv::Vec3b>(j, i);
            colour->rgb.insert(colour->rgb.end(), {pixel[2], pixel[1], pixel[0]});
        }
    }
    return colour;
} catch (const Error&) {
    return nullptr;
}

}  // namespace dibhr
