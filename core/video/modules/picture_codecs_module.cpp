// The module of OpenCV's picture codecs, and of libtiff, which they bring.
#include <tiffio.h>

#include <cstdint>
#include <memory>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "core/video/modules/picture_codecs.hpp"

namespace {

constexpr std::uint32_t kPixelScale = 33550;
constexpr std::uint32_t kGeoKeys = 34735;
constexpr std::uint32_t kGdalNoData = 42113;

/// The text of GDAL_NODATA. How libtiff returns it depends on whether another library, such as
/// GDAL, has given it a name.
std::string gdal_no_data(TIFF* file) {
    const TIFFField* const field = TIFFFindField(file, kGdalNoData, TIFF_ANY);
    if (field == nullptr || TIFFFieldDataType(field) != TIFF_ASCII) return {};
    const char* text = nullptr;
    if (TIFFFieldPassCount(field) == 0)
        return TIFFGetField(file, kGdalNoData, &text) == 1 && text != nullptr ? text : "";
    std::uint16_t short_count = 0;
    std::uint32_t count = 0;
    const bool is_long = TIFFFieldReadCount(field) == TIFF_VARIABLE2;
    const int found = is_long ? TIFFGetField(file, kGdalNoData, &count, &text)
                              : TIFFGetField(file, kGdalNoData, &short_count, &text);
    if (found != 1 || text == nullptr) return {};
    const std::string bytes(text, is_long ? count : short_count);
    return bytes.substr(0, bytes.find('\0'));
}

dibhr::TiffTags tiff_tags(const std::string& name) {
    TIFFSetWarningHandler(nullptr);  // it warns of each tag without a name
    TIFFSetErrorHandler(nullptr);
    const std::unique_ptr<TIFF, void (*)(TIFF*)> file(TIFFOpen(name.c_str(), "r"), TIFFClose);
    if (!file) return {};
    dibhr::TiffTags tags{.gdal_no_data = gdal_no_data(file.get())};
    for (int k = 0; k < TIFFGetTagListCount(file.get()); ++k) {
        const std::uint32_t tag = TIFFGetTagListEntry(file.get(), k);
        tags.is_geographic = tags.is_geographic || tag == kPixelScale || tag == kGeoKeys;
    }
    return tags;
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
