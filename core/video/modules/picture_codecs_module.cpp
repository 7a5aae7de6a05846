// The module of OpenCV's picture codecs, and of libtiff, which they bring.
#include <tiffio.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <opencv2/imgcodecs.hpp>

#include "core/video/modules/picture_codecs.hpp"

namespace {

/// The bytes of a tag that libtiff has no name for; empty: the file has none.
std::string bytes_of_tag(TIFF* file, std::uint32_t tag) {
    constexpr std::uint32_t kMostBytes = 64;
    std::uint32_t count = 0;
    const char* values = nullptr;
    if (TIFFGetField(file, tag, &count, &values) == 0 || values == nullptr) return {};
    return {values, std::min(count, kMostBytes)};
}

dibhr::TiffTags tiff_tags(const std::string& name) {
    constexpr std::uint32_t kPixelScale = 33550;
    constexpr std::uint32_t kGeoKeys = 34735;
    constexpr std::uint32_t kGdalNoData = 42113;
    TIFFSetWarningHandler(nullptr);  // it warns of each such tag
    TIFFSetErrorHandler(nullptr);
    const std::unique_ptr<TIFF, void (*)(TIFF*)> file(TIFFOpen(name.c_str(), "r"), TIFFClose);
    if (!file) return {};
    const bool is_geographic = !bytes_of_tag(file.get(), kPixelScale).empty() ||
                               !bytes_of_tag(file.get(), kGeoKeys).empty();
    // Written with a zero at its end.
    return {bytes_of_tag(file.get(), kGdalNoData).c_str(), is_geographic};
}

}  // namespace

extern "C" {
extern const dibhr::PictureCodecs dibhr_picture_codecs;
const dibhr::PictureCodecs dibhr_picture_codecs{
    .can_read = [](const std::string& file) { return cv::haveImageReader(file); },
    .read = [](const std::string& file, int flags) { return cv::imread(file, flags); },
    .decode = [](const cv::Mat& bytes, int flags) { return cv::imdecode(bytes, flags); },
    .encode =
        [](const std::string& extension, const cv::Mat& picture,
           std::vector<unsigned char>& bytes) { return cv::imencode(extension, picture, bytes); },
    .write = [](const std::string& file, const cv::Mat& picture,
                const std::vector<int>& options) { return cv::imwrite(file, picture, options); },
    .tiff_tags = tiff_tags};
}
